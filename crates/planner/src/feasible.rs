//! How much clearance a path could keep where none exists.
//!
//! All clearances are lowered by one common amount, and that amount is bisected between one at which there is no path
//! and one at which there is. Whether there is a path changes where a gap opens: at half the distance between two
//! features, of one obstacle or of two, or where mitred corners meet. The planner lets a path through a gap that is
//! too narrow by up to a contact tolerance, half of it on either side; that half is taken off again. So the answer was
//! planned with, does not exceed the critical clearance, and is below it by at most [`RESOLUTION_MM`] and half a contact
//! tolerance where corners are round (one whole where the other side keeps 0); a mitred corner multiplies both by
//! its ratio.
//!
//! Cost: about log2(clearance / resolution), 27 for 10 mm, times building the barriers and one search.

use crate::at_clearance::AtClearance;
use crate::barriers::Barriers;
use crate::lowered::{largest_clearance, lowered};
use crate::prepared::LinksAtLast;
use crate::{FeasibleClearance, RapidMove, Stats};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Scene};
use traverse_solve::{Budget, Interrupt};

/// How finely the amount is bisected, millimetres.
const RESOLUTION_MM: f64 = CONTACT_TOLERANCE_MM / 10.0;

/// The most that all clearances may keep in a scene without a path. The budget's end is an answer.
pub(crate) fn feasible_clearance(
    scene: &Scene,
    query: &RapidMove,
    budget: &Budget,
    stats: &mut Stats,
) -> FeasibleClearance {
    let mut has_path = |scene: &Scene| {
        let barriers = Barriers::new(scene, budget)?;
        AtClearance::new(&barriers, query, budget, &mut LinksAtLast).has_path(stats)
    };
    most_feasible(scene, &mut has_path).unwrap_or(FeasibleClearance::Unknown)
}

/// The most that all clearances may keep for `holds` to hold of the scene.
///
/// # Errors
/// The budget ended.
pub(crate) fn most_feasible(
    scene: &Scene,
    holds: &mut dyn FnMut(&Scene) -> Result<bool, Interrupt>,
) -> Result<FeasibleClearance, Interrupt> {
    let most = largest_clearance(scene);
    let mut is_feasible = |by_mm: f64| holds(&lowered(scene, by_mm));
    if most == 0.0 || !is_feasible(most)? {
        return Ok(FeasibleClearance::None);
    }
    let (mut too_little, mut enough) = (0.0, most);
    while enough - too_little > RESOLUTION_MM {
        let middle = f64::midpoint(too_little, enough);
        if is_feasible(middle)? {
            enough = middle;
        } else {
            too_little = middle;
        }
    }
    let by_mm = (enough + CONTACT_TOLERANCE_MM / 2.0).min(most);
    // With rules for ends inside barriers another way out may lead elsewhere.
    let by_mm = if is_feasible(by_mm)? { by_mm } else { enough };
    Ok(FeasibleClearance::Millimetres(lowered(scene, by_mm).clearance_mm))
}
