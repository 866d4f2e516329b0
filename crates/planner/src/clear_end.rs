//! Where an end of a move is clear of every barrier at its own height: itself, or where its way out ends.

use crate::Refusal;
use crate::barriers::Barriers;
use crate::level::passed_over;
use crate::standing::depths;
use crate::way_out::way_out;
use traverse_geometry::{EndRule, HeightRule, Point};
use traverse_solve::{Budget, Interrupt};

/// One end of a move: which, where, how high.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EndPlace {
    /// `start` or `target`.
    pub(crate) field: &'static str,
    pub(crate) point: Point,
    /// Of no meaning without heights.
    pub(crate) z_mm: f64,
}

/// Where the end is clear by `rule`.
///
/// # Errors
/// The budget ended; within, every barrier that the end lies inside of, or that no way leads out.
pub(crate) fn clear_end(
    barriers: &Barriers<'_>,
    heights: Option<HeightRule>,
    end: EndPlace,
    rule: &EndRule,
    budget: &Budget,
) -> Result<Result<Point, Vec<Refusal>>, Interrupt> {
    let EndPlace { field, point, z_mm } = end;
    let left_out = passed_over(barriers, heights, z_mm);
    let inside = depths(barriers, &left_out, point, budget)?;
    if inside.is_empty() {
        return Ok(Ok(point));
    }
    let name = |owner: usize| barriers.id(owner).to_owned();
    if *rule == EndRule::Refuse {
        let refusal = |(owner, depth_mm)| {
            let obstacle = name(owner);
            Refusal::EndInsideBarrier { field, obstacle, depth_mm }
        };
        return Ok(Err(inside.into_iter().map(refusal).collect()));
    }
    let found = way_out(barriers, &left_out, &inside, point, rule, budget)?;
    Ok(found.map_err(|shut| vec![Refusal::EndShutIn { field, obstacle: name(shut.by), why: shut.why }]))
}
