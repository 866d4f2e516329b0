//! A closed walk that uses given arcs as often as given (Hierholzer 1873): how a many-visits solution becomes a tour.
//! O(arcs).

/// The walk's nodes, one for each use of an arc. Nothing when the arcs don't hang together or don't balance.
pub(crate) fn closed_walk(size: usize, arcs: &[(usize, usize, u32)]) -> Option<Vec<usize>> {
    let mut out: Vec<Vec<(usize, u32)>> = vec![vec![]; size];
    let mut uses = 0_usize;
    for &(from, to, count) in arcs {
        if count > 0 {
            out[from].push((to, count));
            uses += count as usize;
        }
    }
    let begin = arcs.iter().find(|arc| arc.2 > 0)?.0;
    let mut stack = vec![begin];
    let mut walk = vec![];
    while let Some(&node) = stack.last() {
        match out[node].last_mut() {
            Some((to, count)) => {
                stack.push(*to);
                *count -= 1;
                if *count == 0 {
                    out[node].pop();
                }
            }
            None => {
                walk.push(node);
                stack.pop();
            }
        }
    }
    walk.reverse();
    (walk.len() == uses + 1 && walk.first() == walk.last()).then(|| {
        walk.pop();
        walk
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walks_use_every_arc_and_parts_have_none() {
        let walk =
            closed_walk(3, &[(0, 0, 2), (0, 1, 1), (1, 2, 1), (2, 1, 1), (1, 0, 1)]).expect("connected");
        assert_eq!(walk.len(), 6);
        assert_eq!(closed_walk(4, &[(0, 1, 1), (1, 0, 1), (2, 3, 1), (3, 2, 1)]), None);
        assert_eq!(closed_walk(2, &[]), None);
    }
}
