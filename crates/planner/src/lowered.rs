//! Scenes with other clearances, or fewer obstacles.

use std::collections::BTreeSet;
use traverse_geometry::{SMALLEST_CLEARANCE_MM, Scene};

/// The scene with another clearance for all that names none of its own.
pub(crate) fn with_clearance(scene: &Scene, clearance_mm: f64) -> Scene {
    Scene { clearance_mm, ..scene.clone() }
}

/// The scene without these of its obstacles.
pub(crate) fn without(scene: &Scene, left_out: &BTreeSet<usize>) -> Scene {
    let mut rest = scene.clone();
    let mut place = 0..;
    rest.obstacles.retain(|_| place.next().is_some_and(|place| !left_out.contains(&place)));
    rest
}

/// Lowers every clearance by the same amount, not below 0. What would come to lie between 0 and the smallest clearance
/// is the smallest, so that a path in the lowered scene keeps at least what is claimed.
pub(crate) fn lowered(scene: &Scene, by_mm: f64) -> Scene {
    let lower = |clearance: f64| {
        let rest = clearance - by_mm;
        if rest > 0.0 { rest.max(SMALLEST_CLEARANCE_MM) } else { 0.0 }
    };
    let mut lowered = scene.clone();
    lowered.clearance_mm = lower(scene.clearance_mm);
    lowered.work_area_clearance_mm = scene.work_area_clearance_mm.map(lower);
    for obstacle in &mut lowered.obstacles {
        obstacle.clearance_mm = obstacle.clearance_mm.map(lower);
    }
    lowered
}

/// The largest clearance that anything in the scene asks for.
pub(crate) fn largest_clearance(scene: &Scene) -> f64 {
    let obstacles = scene.obstacles.iter().map(|obstacle| scene.clearance_of(obstacle));
    let border = scene.work_area.iter().map(|_| scene.border_clearance());
    obstacles.chain(border).fold(0.0, f64::max)
}
