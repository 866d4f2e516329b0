//! The double bridge (Martin, Otto, Felten 1991): four arcs leave, three neighbouring segments X Y Z come back as
//! Z Y X. No sequence of 3-opt moves that each improve undoes it, so it is the kick of iterated local search. The
//! segments are short and near one another, so that a kick and its repair cost the same in any tour.

use crate::cost::Costs;
use crate::tour_array::{Swap, TourArray};
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;

/// The least size of a tour that has a double bridge.
pub(crate) const LEAST_SIZE: usize = 8;

/// The swaps that were made, what they saved (mostly less than nothing), and the nodes whose arcs changed.
pub(crate) struct Kick {
    pub(crate) swaps: [Swap; 2],
    pub(crate) saving: i64,
    pub(crate) touched: [usize; 8],
}

/// Kicks the tour at a random place.
pub(crate) fn kick(
    costs: &impl Costs,
    tour: &mut TourArray,
    longest: usize,
    chance: &mut Xoshiro256PlusPlus,
) -> Kick {
    let size = tour.len();
    let longest = longest.min((size - 2) / 3).max(1);
    let start = chance.random_range(0..size);
    let lengths = [(); 3].map(|()| chance.random_range(1..=longest));
    let at = |steps: usize| tour.at((start + steps) % size);
    let [x, y, z] = lengths;
    // before | X | Y | Z | after
    let (before, after) = (at(0), at(1 + x + y + z));
    let (x_begin, x_end) = (at(1), at(x));
    let (y_begin, y_end) = (at(x + 1), at(x + y));
    let (z_begin, z_end) = (at(x + y + 1), at(x + y + z));
    let out = costs.cost(before, x_begin)
        + costs.cost(x_end, y_begin)
        + costs.cost(y_end, z_begin)
        + costs.cost(z_end, after);
    let come = costs.cost(before, z_begin)
        + costs.cost(z_end, y_begin)
        + costs.cost(y_end, x_begin)
        + costs.cost(x_end, after);
    // X (Y Z) → (Y Z) X → Z Y X
    let swaps = [tour.swap(x_begin, x, y + z), tour.swap(y_begin, y, z)];
    Kick {
        swaps,
        saving: out - come,
        touched: [before, x_begin, x_end, y_begin, y_end, z_begin, z_end, after],
    }
}
