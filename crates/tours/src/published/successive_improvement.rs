//! Successive improvement: a tour is changed as long as moving a few neighbours elsewhere makes it cheaper. Ends in
//! a tour that no such move improves. O(n²) for each round.

use crate::assignment_search::Incumbent;
use crate::cost::Costs;
use crate::moves::or_opt;
use crate::tour_array::TourArray;
use crate::work::Work;
use traverse_solve::Interrupt;

/// Improves the order until no move helps; every better tour is offered.
pub(super) fn search(
    costs: &impl Costs,
    order: Vec<usize>,
    incumbent: &mut dyn Incumbent,
    work: &mut Work<'_>,
) -> Result<(), Interrupt> {
    let size = order.len();
    let mut tour = TourArray::new(order);
    incumbent.offer(tour.order(), 0);
    let mut idle = 0;
    let mut node = 0;
    while idle < size {
        work.step()?;
        idle = match or_opt::improve(costs, &mut tour, node) {
            Some(_) => {
                incumbent.offer(tour.order(), 0);
                0
            }
            None => idle + 1,
        };
        node = (node + 1) % size;
    }
    Ok(())
}
