//! Pure 3-opt: three arcs leave, three come, two neighbouring segments change places, no arc turns round.
//!
//! Of the tour a→a′ … b→b′ … c→c′ it makes a→b′ … c→a′ … b→c′. Searched in the order of Lin and Kernighan: the arc
//! that comes must cost less than what has left so far. Moves of a few nodes to another place (Or-opt) are among
//! them. At most width² trials for a node.

use crate::cost::Costs;
use crate::neighbours::Neighbours;
use crate::tour_array::{Swap, TourArray};

/// A swap that was made, what it saved, and the nodes whose arcs changed.
pub(crate) struct Improvement {
    pub(crate) swap: Swap,
    pub(crate) saving: i64,
    pub(crate) touched: [usize; 6],
}

/// Makes the first improving move that begins with the arc out of `a`.
pub(crate) fn improve(
    costs: &impl Costs,
    neighbours: &Neighbours,
    tour: &mut TourArray,
    a: usize,
) -> Option<Improvement> {
    let a_next = tour.next(a);
    let first_out = costs.cost(a, a_next);
    for &b_next in neighbours.of(a) {
        let after_first = first_out - costs.cost(a, b_next);
        if after_first <= 0 {
            break;
        }
        let b = tour.previous(b_next);
        if b == a {
            continue;
        }
        let two_out = after_first + costs.cost(b, b_next);
        // c must lie behind b′ and before a.
        let reach = tour.steps(b_next, a);
        for &c_next in neighbours.of(b) {
            let after_second = two_out - costs.cost(b, c_next);
            if after_second <= 0 {
                break;
            }
            let steps = tour.steps(b_next, c_next);
            if steps == 0 || steps > reach {
                continue;
            }
            let c = tour.previous(c_next);
            let saving = after_second + costs.cost(c, c_next) - costs.cost(c, a_next);
            if saving > 0 {
                let swap = tour.swap(a_next, tour.steps(a_next, b) + 1, steps);
                return Some(Improvement { swap, saving, touched: [a, a_next, b, b_next, c, c_next] });
            }
        }
    }
    None
}
