//! Which of many boxes meet.

use traverse_geometry::Bounds;

/// Calls `meet` with every pair of boxes, by place, that meet; false when that took more than `work_limit` comparisons
/// and some pairs were not looked at. Sweep along x. Cost: n log n, and for each box those that it lies beside.
pub(crate) fn meeting_boxes(boxes: &[Bounds], work_limit: usize, mut meet: impl FnMut(usize, usize)) -> bool {
    let mut order: Vec<usize> = (0..boxes.len()).filter(|&i| !boxes[i].is_empty()).collect();
    order.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x));
    let mut open: Vec<usize> = Vec::new();
    let mut work = 0;
    for next in order {
        open.retain(|&each| boxes[each].max.x >= boxes[next].min.x);
        work += open.len();
        if work > work_limit {
            return false;
        }
        for &each in &open {
            if boxes[each].min.y <= boxes[next].max.y && boxes[next].min.y <= boxes[each].max.y {
                meet(each.min(next), each.max(next));
            }
        }
        open.push(next);
    }
    true
}
