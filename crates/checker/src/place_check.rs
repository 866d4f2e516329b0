//! Checks a tool change: the place is one of those permitted, and the moves there and on are sound.

use crate::boundary::Boundary;
use crate::boundary_tree::BoundaryTree;
use crate::inside::is_inside;
use crate::message::millimetres;
use crate::rapid_check::RapidMoveChecker;
use crate::{PathCheck, SMALLEST_TOLERANCE_MM, Violation, ViolationReason};
use traverse_geometry::{CornerStyle, Obstacle, Path, Point, Polygon, RapidRules, Scene};

/// A tool change that was placed.
#[derive(Clone, Copy, Debug)]
pub struct PlacedChange<'a> {
    /// What to keep away from.
    pub scene: &'a Scene,
    /// Where the tool's centre is.
    pub start: Point,
    /// Where the new tool has to go.
    pub target: Point,
    /// The change is permitted anywhere in these, their borders included.
    pub regions: &'a [Polygon],
    /// And at these points.
    pub points: &'a [Point],
    /// Rules of the moves to the place and on; of their clearances the same counts for both.
    pub rules: [&'a RapidRules; 2],
    /// Where the tool is changed.
    pub place: Point,
    /// The moves to the place and on.
    pub paths: [&'a Path; 2],
}

/// What checking a tool change found.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaceCheck {
    /// What is wrong: with the place (`place`), the approach (`approach.path…`), the departure (`departure.path…`).
    pub violations: Vec<Violation>,
    /// Of both moves, recomputed, in the unit of the rules' cost.
    pub cost: f64,
    /// The scene's clearance that was held against both, millimetres.
    pub clearance_mm: f64,
}

/// Checks a tool change. What lies less than `tolerance_mm` inside a barrier counts as touching it, and a place that near
/// to a region or a point as permitted. That no place is better is not checked.
///
/// Cost: linear in the regions, and two checks of a path for each clearance.
#[must_use]
pub fn check_tool_change(placed: &PlacedChange<'_>, tolerance_mm: f64) -> PlaceCheck {
    let tolerance = tolerance_mm.max(SMALLEST_TOLERANCE_MM);
    let own = [placed.scene.clearance_mm];
    let clearances = match &placed.rules[0].clearances_mm[..] {
        [] => &own[..],
        several => several,
    };
    let mut last = None;
    for &clearance_mm in clearances {
        let scene = Scene { clearance_mm, ..placed.scene.clone() };
        let checker = RapidMoveChecker::new(&scene);
        let ends = [(placed.start, placed.place), (placed.place, placed.target)];
        let checks = [0, 1].map(|side| {
            let (start, target) = ends[side];
            let (rules, path) = (placed.rules[side], placed.paths[side]);
            let check = checker.check_while(rules, start, target, path, tolerance, &|| true);
            check.expect("invariant: only a no gives up")
        });
        let is_sound = checks.iter().all(PathCheck::is_sound);
        last = Some((clearance_mm, checks));
        if is_sound {
            break;
        }
    }
    let (clearance_mm, [approach, departure]) = last.expect("invariant: there is a clearance");
    let mut violations: Vec<Violation> = not_permitted(placed, tolerance).into_iter().collect();
    let cost = approach.cost + departure.cost;
    for (name, check) in [("approach", approach), ("departure", departure)] {
        violations.extend(
            check
                .violations
                .into_iter()
                .map(|violation| Violation { field: format!("{name}.{}", violation.field), ..violation }),
        );
    }
    PlaceCheck { violations, cost, clearance_mm }
}

/// Whether the place is none of those permitted.
fn not_permitted(placed: &PlacedChange<'_>, tolerance: f64) -> Option<Violation> {
    let place = placed.place;
    let to_point = placed.points.iter().map(|p| (place - p).norm()).fold(f64::INFINITY, f64::min);
    if to_point <= tolerance {
        return None;
    }
    // Regions as solids of no clearance.
    let solid = |(index, region): (usize, &Polygon)| Obstacle {
        id: index.to_string(),
        shape: region.clone(),
        clearance_mm: None,
        top_z_mm: None,
    };
    let regions = Scene {
        work_area: None,
        obstacles: placed.regions.iter().enumerate().map(solid).collect(),
        clearance_mm: 0.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    };
    let boundary = Boundary::of(&regions);
    let tree = BoundaryTree::over(&boundary, &|| true)?;
    let to_border = |solid: usize| {
        let edges = boundary.solids[solid].edges.clone();
        edges.map(|edge| boundary.curve(edge).distance_to_point(place)).fold(f64::INFINITY, f64::min)
    };
    let mut nearest = to_point;
    for solid in 0..boundary.solids.len() {
        nearest = nearest.min(to_border(solid));
        if nearest <= tolerance || is_inside(&boundary, &tree, place, solid as u32) {
            return None;
        }
    }
    let message = if nearest.is_finite() {
        format!("the place lies {} mm from everything that is permitted", millimetres(nearest))
    } else {
        "no place is permitted".to_owned()
    };
    Some(Violation {
        field: "place".to_owned(),
        reason: ViolationReason::PlaceNotPermitted,
        message,
        amount: if nearest.is_finite() { nearest } else { 0.0 },
        at: Some(place),
        obstacle: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::{CONTACT_TOLERANCE_MM, Ring};

    fn ring(points: &[(f64, f64)], bulges: &[f64]) -> Ring {
        Ring::new(points.iter().map(|&(x, y)| Point::new(x, y)).collect(), bulges.to_vec()).unwrap()
    }

    #[test]
    fn a_place_is_permitted_in_regions_and_at_points() {
        let disc = ring(&[(10.0, 0.0), (14.0, 0.0)], &[1.0, 1.0]);
        let hole = ring(&[(11.0, 0.0), (13.0, 0.0)], &[1.0, 1.0]);
        let regions = [Polygon::new(disc, vec![hole]).unwrap()];
        let points = [Point::new(0.0, 5.0)];
        let scene = Scene {
            work_area: None,
            obstacles: Vec::new(),
            clearance_mm: 1.0,
            work_area_clearance_mm: None,
            corner_style: CornerStyle::Round,
        };
        let (start, target) = (Point::new(0.0, 0.0), Point::new(20.0, 0.0));
        let rules = RapidRules::default();
        let check = |place: Point, through: Point| {
            let mut approach = Path::at(start);
            approach.line_to(through);
            let mut departure = Path::at(through);
            departure.line_to(target);
            let placed = PlacedChange {
                scene: &scene,
                start,
                target,
                regions: &regions,
                points: &points,
                rules: [&rules, &rules],
                place,
                paths: [&approach, &departure],
            };
            check_tool_change(&placed, CONTACT_TOLERANCE_MM)
        };
        for (x, y) in [(10.0, 0.0), (10.5, 0.0), (11.0, 0.0), (0.0, 5.0), (12.0, 2.0), (13.0, 0.0)] {
            let found = check(Point::new(x, y), Point::new(x, y));
            assert!(found.violations.is_empty(), "{x}, {y}: {:?}", found.violations);
        }
        for (x, y, amount) in [(12.0, 0.0, 1.0), (9.5, 0.0, 0.5), (0.0, 4.0, 1.0), (10.0 - 1e-5, 0.0, 1e-5)] {
            let found = check(Point::new(x, y), Point::new(x, y));
            let [violation] = &found.violations[..] else { panic!("{x}, {y}: {:?}", found.violations) };
            assert_eq!(violation.reason, ViolationReason::PlaceNotPermitted);
            assert!((violation.amount - amount).abs() < 1e-9, "{violation}");
        }
        // Moves that do not meet in the place.
        let found = check(Point::new(10.0, 0.0), Point::new(11.0, 0.0));
        let fields: Vec<&str> = found.violations.iter().map(|violation| violation.field.as_str()).collect();
        assert_eq!(fields, ["approach.path.steps[0].end", "departure.path.start"]);
    }
}
