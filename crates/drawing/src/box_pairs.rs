//! Which of many boxes meet.

use traverse_geometry::Bounds;

/// Bands at most.
const MOST_BANDS: f64 = 4096.0;

/// Comparisons at most, and for each box so many more: bounds the work on hostile drawings.
const WORK_LIMIT: usize = 1_000_000;
const WORK_LIMIT_PER_BOX: usize = 64;

/// Calls `meet` once with every pair of boxes, by place, that meet; false when too many lie beside one another and some
/// pairs were not looked at. Boxes that are not finite meet none.
///
/// The boxes are laid into level bands, twice as high as they are on average, and each band is swept along x. Cost:
/// n log n, and for each box those of its bands that it lies beside.
pub(crate) fn meeting_boxes(boxes: &[Bounds], mut meet: impl FnMut(usize, usize)) -> bool {
    let is_finite = |b: &Bounds| (b.min.coords.sum() + b.max.coords.sum()).is_finite();
    let mut order: Vec<usize> =
        (0..boxes.len()).filter(|&i| !boxes[i].is_empty() && is_finite(&boxes[i])).collect();
    order.sort_by(|&a, &b| boxes[a].min.x.total_cmp(&boxes[b].min.x));
    let mut work_left = WORK_LIMIT + WORK_LIMIT_PER_BOX * order.len();
    let bands = Bands::of(boxes, &order);
    // With their boxes: they are looked at again and again.
    let mut open: Vec<(Bounds, usize)> = Vec::new();
    for (band, of_band) in bands.filled(boxes, order).into_iter().enumerate() {
        open.clear();
        for next in of_band {
            let one = boxes[next];
            open.retain(|(other, _)| other.max.x >= one.min.x);
            match work_left.checked_sub(open.len()) {
                Some(left) => work_left = left,
                None => return false,
            }
            for &(other, each) in &open {
                let (low, high) = (other.min.y.max(one.min.y), other.max.y.min(one.max.y));
                // In several bands together: told in the lowest.
                if low <= high && bands.holding(low) == band {
                    meet(each.min(next), each.max(next));
                }
            }
            open.push((one, next));
        }
    }
    true
}

/// Level bands of equal height.
struct Bands {
    low: f64,
    /// Bands per millimetre.
    density: f64,
    count: usize,
}

impl Bands {
    fn of(boxes: &[Bounds], order: &[usize]) -> Self {
        let whole = order.iter().fold(Bounds::EMPTY, |whole, &each| whole.union(boxes[each]));
        if whole.is_empty() {
            return Self { low: 0.0, density: 0.0, count: 1 };
        }
        let height = whole.size().y;
        let mean = order.iter().map(|&each| boxes[each].size().y).sum::<f64>() / order.len() as f64;
        let count = (height / (2.0 * mean)).floor().clamp(1.0, MOST_BANDS);
        let density = if height > 0.0 { count / height } else { 0.0 };
        // No number where a size is not finite, or nothing has a height: one band.
        Self { low: whole.min.y, density, count: (count as usize).max(1) }
    }

    /// The band that holds that height.
    fn holding(&self, y: f64) -> usize {
        (((y - self.low) * self.density) as usize).min(self.count - 1)
    }

    /// The boxes of each band, each in the order given.
    fn filled(&self, boxes: &[Bounds], order: Vec<usize>) -> Vec<Vec<usize>> {
        if self.count == 1 {
            return vec![order];
        }
        let mut filled = vec![Vec::new(); self.count];
        for each in order {
            for band in &mut filled[self.holding(boxes[each].min.y)..=self.holding(boxes[each].max.y)] {
                band.push(each);
            }
        }
        filled
    }
}

#[cfg(test)]
mod tests {
    use super::meeting_boxes;
    use proptest::prelude::*;
    use traverse_geometry::{Bounds, Point};

    fn boxes(numbers: &[(f64, f64, f64, f64)]) -> Vec<Bounds> {
        let corner = |x: f64, y: f64| Bounds { min: Point::new(x, y), max: Point::new(x, y) };
        numbers.iter().map(|&(x, y, w, h)| corner(x, y).union(corner(x + w, y + h))).collect()
    }

    proptest! {
        #[test]
        fn each_pair_that_meets_is_told_once(
            numbers in prop::collection::vec((0.0..50.0, 0.0..50.0, 0.0..4.0, 0.0..4.0), 0..60),
            round in any::<bool>(),
        ) {
            let on_grid = |n: f64| if round { n.round() } else { n };
            let numbers: Vec<_> =
                numbers.into_iter().map(|(x, y, w, h)| (on_grid(x), on_grid(y), on_grid(w), on_grid(h))).collect();
            let mut boxes = boxes(&numbers);
            boxes.push(Bounds::EMPTY);
            let mut told = Vec::new();
            prop_assert!(meeting_boxes(&boxes, |a, b| told.push((a, b))));
            told.sort_unstable();
            let meet = |a: &Bounds, b: &Bounds| {
                a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y
            };
            let all = (0..numbers.len()).flat_map(|a| (a + 1..numbers.len()).map(move |b| (a, b)));
            let expected: Vec<_> = all.filter(|&(a, b)| meet(&boxes[a], &boxes[b])).collect();
            prop_assert_eq!(told, expected);
        }
    }

    #[test]
    fn work_is_bounded() {
        let meet = |count: usize| meeting_boxes(&boxes(&vec![(0.0, 0.0, 1.0, 1.0); count]), |_, _| {});
        assert!(meet(1000) && !meet(1600));
    }
}
