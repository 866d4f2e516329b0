//! Or-opt (Or 1976): up to three nodes in a row move to another place, in the same direction. All places are tried,
//! O(n) for each node; the lists of `three_opt` find most of it faster.

use crate::cost::Costs;
use crate::tour_array::TourArray;

/// The most nodes that move together.
const LONGEST: usize = 3;

/// Makes the best improving move of the nodes that begin at `begin`. What it saved.
pub(crate) fn improve(costs: &impl Costs, tour: &mut TourArray, begin: usize) -> Option<i64> {
    let size = tour.len();
    let mut best: Option<(i64, usize, usize)> = None;
    let before = tour.previous(begin);
    let mut last = begin;
    for length in 1..=LONGEST.min(size.saturating_sub(2)) {
        if length > 1 {
            last = tour.next(last);
        }
        let after = tour.next(last);
        let closing = costs.cost(before, begin) + costs.cost(last, after) - costs.cost(before, after);
        let mut left = after;
        for jumped in 1..size - length {
            let right = tour.next(left);
            let saving =
                closing + costs.cost(left, right) - costs.cost(left, begin) - costs.cost(last, right);
            if saving > 0 && best.is_none_or(|(most, ..)| saving > most) {
                best = Some((saving, length, jumped));
            }
            left = right;
        }
    }
    let (saving, length, jumped) = best?;
    tour.swap(begin, length, jumped);
    Some(saving)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::local_search::cycle_cost;
    use crate::test_support::random_matrix;
    use traverse_solve::Seed;

    #[test]
    fn a_move_saves_what_it_says() {
        let mut chance = Seed(9).stream();
        for round in 0..200 {
            let size = 3 + round % 6;
            let costs = random_matrix(size, -9..=9, 0.0, &mut chance);
            let mut tour = TourArray::new((0..size).collect());
            for begin in 0..size {
                let before = cycle_cost(&costs, tour.order());
                let saving = improve(&costs, &mut tour, begin).unwrap_or(0);
                assert_eq!(cycle_cost(&costs, tour.order()), before - saving);
            }
        }
    }
}
