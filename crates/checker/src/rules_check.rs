//! Checks a rapid move by rules: heights, a list of clearances, ways out of and into barriers.

use crate::{PathCheck, RapidMoveChecker};
use traverse_geometry::{Path, Point, RapidRules, Scene};

/// As [`crate::check_rapid_move`], by `rules`, which have no findings.
///
/// With several clearances the path is held against each, largest first, until it is sound;
/// [`PathCheck::clearance_mm`] says which one that was. If it is sound at none, the violations are those at the smallest.
/// That no path exists at larger clearances is not checked, as little as that no shorter one does. Cost: one check for
/// each clearance.
#[must_use]
pub fn check_rapid_move_by(
    scene: &Scene,
    rules: &RapidRules,
    start: Point,
    target: Point,
    path: &Path,
    tolerance_mm: f64,
) -> PathCheck {
    check_rapid_move_by_while(scene, rules, start, target, path, tolerance_mm, &|| true)
        .expect("invariant: only a no gives up")
}

/// As [`check_rapid_move_by`], given up when `go_on`, asked between its parts, says no: then there is no answer.
#[must_use]
pub fn check_rapid_move_by_while(
    scene: &Scene,
    rules: &RapidRules,
    start: Point,
    target: Point,
    path: &Path,
    tolerance_mm: f64,
    go_on: &dyn Fn() -> bool,
) -> Option<PathCheck> {
    let at = |scene: &Scene| {
        let checker = RapidMoveChecker::new_while(scene, go_on)?;
        checker.check_while(rules, start, target, path, tolerance_mm, go_on)
    };
    let mut last = None;
    for &clearance_mm in &rules.clearances_mm {
        let check = at(&Scene { clearance_mm, ..scene.clone() })?;
        if check.is_sound() {
            return Some(check);
        }
        last = Some(check);
    }
    last.or_else(|| at(scene))
}
