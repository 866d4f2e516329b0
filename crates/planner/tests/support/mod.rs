//! What the tests of the planner share: building scenes, planning, checking.
#![allow(dead_code, missing_docs, unreachable_pub, reason = "every test file uses a part of it")]

pub mod awkward;
pub mod oracle;
pub mod parallels;
pub mod taut;
pub mod tool_change;

use rand::RngExt;
use traverse_geometry::{CornerStyle, Obstacle, Path, Point, Polygon, RapidRules, Ring, Scene};
use traverse_planner::{Algorithm, Answer, NoPath, RapidMove, RapidPlan, Refusal, plan_rapid_move};
use traverse_solve::{Budget, Silent};

pub fn point(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

pub fn ring(points: &[(f64, f64)]) -> Ring {
    Ring::new(points.iter().map(|&(x, y)| point(x, y)).collect(), vec![]).unwrap()
}

pub fn polygon(points: &[(f64, f64)]) -> Polygon {
    Polygon::from_ring(ring(points))
}

pub fn rectangle(x0: f64, y0: f64, x1: f64, y1: f64) -> Polygon {
    polygon(&[(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
}

pub fn disc(x: f64, y: f64, radius: f64) -> Polygon {
    let vertices = vec![point(x - radius, y), point(x + radius, y)];
    Polygon::from_ring(Ring::new(vertices, vec![1.0, 1.0]).unwrap())
}

pub fn scene(shapes: impl IntoIterator<Item = Polygon>, clearance_mm: f64) -> Scene {
    let obstacles = shapes
        .into_iter()
        .enumerate()
        .map(|(i, shape)| Obstacle { id: format!("o{i}"), shape, clearance_mm: None, top_z_mm: None })
        .collect();
    Scene {
        work_area: None,
        obstacles,
        clearance_mm,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    }
}

pub fn mitred(scene: Scene) -> Scene {
    Scene { corner_style: CornerStyle::Miter { limit: None }, ..scene }
}

pub fn query(start: Point, target: Point) -> RapidMove {
    RapidMove { start, target, algorithm: Algorithm::Exact, rules: RapidRules::default() }
}

/// What came of a move; every plan is checked.
pub fn answer(scene: &Scene, start: Point, target: Point) -> Result<Answer, Vec<Refusal>> {
    let (answer, _) = plan_rapid_move(scene, &query(start, target), &Budget::unlimited(), &mut Silent)?;
    if let Answer::Plan(plan) = &answer {
        assert_sound(scene, start, target, plan);
    }
    Ok(answer)
}

pub fn plan(scene: &Scene, start: Point, target: Point) -> RapidPlan {
    match answer(scene, start, target) {
        Ok(Answer::Plan(plan)) => plan,
        other => panic!("no plan from {start} to {target}: {other:?}"),
    }
}

pub fn no_path(scene: &Scene, start: Point, target: Point) -> NoPath {
    match answer(scene, start, target) {
        Ok(Answer::NoPath(no_path)) => no_path,
        other => panic!("a path from {start} to {target}: {other:?}"),
    }
}

/// What comes of a move by rules; every plan is checked by them.
pub fn answer_by(
    scene: &Scene,
    rules: &RapidRules,
    start: Point,
    target: Point,
) -> Result<Answer, Vec<Refusal>> {
    let query = RapidMove { rules: rules.clone(), ..query(start, target) };
    let (answer, _) = plan_rapid_move(scene, &query, &Budget::unlimited(), &mut Silent)?;
    if let Answer::Plan(plan) = &answer {
        let check = check_by(scene, rules, start, target, &plan.path);
        assert!(check.violations.is_empty(), "{:#?}\n{plan:?}\n{rules:?}\n{scene:?}", check.violations);
        assert_eq!(check.clearance_mm, plan.clearance_mm);
        assert!((check.cost - plan.cost).abs() <= 1e-9 * plan.cost.max(1.0), "{} {}", check.cost, plan.cost);
        assert!(plan.lower_bound <= plan.cost);
    }
    Ok(answer)
}

pub fn check_by(
    scene: &Scene,
    rules: &RapidRules,
    start: Point,
    target: Point,
    path: &Path,
) -> traverse_checker::PathCheck {
    let tolerance = traverse_geometry::CONTACT_TOLERANCE_MM;
    traverse_checker::check_rapid_move_by(scene, rules, start, target, path, tolerance)
}

pub fn plan_by(scene: &Scene, rules: &RapidRules, start: Point, target: Point) -> RapidPlan {
    match answer_by(scene, rules, start, target) {
        Ok(Answer::Plan(plan)) => plan,
        other => panic!("no plan from {start} to {target}: {other:?}"),
    }
}

pub fn assert_sound(scene: &Scene, start: Point, target: Point, plan: &RapidPlan) {
    let check = traverse_checker::check_rapid_move(
        scene,
        start,
        target,
        &plan.path,
        traverse_geometry::CONTACT_TOLERANCE_MM,
    );
    assert!(check.violations.is_empty(), "{:#?}\n{plan:?}\n{scene:?}", check.violations);
    assert!((check.cost - plan.cost).abs() <= 1e-9 * plan.cost.max(1.0), "{} {}", check.cost, plan.cost);
    assert!(plan.lower_bound <= plan.cost);
}

pub fn assert_close(found: f64, expected: f64, what: &str) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs().max(1.0), "{what}: {found} is not {expected}");
}

/// A star-shaped polygon about `center`, convex or not.
pub fn star(random: &mut impl RngExt, center: Point, radius: f64, corners: usize) -> Polygon {
    let step = std::f64::consts::TAU / corners as f64;
    let points: Vec<Point> = (0..corners)
        .map(|i| {
            let angle = step * (i as f64 + random.random_range(0.1..0.9));
            center + traverse_geometry::unit(angle) * radius * random.random_range(0.3..1.0)
        })
        .collect();
    Polygon::from_ring(Ring::new(points, vec![]).unwrap())
}

/// Stars that may overlap, in a square of side `side`.
pub fn stars(random: &mut impl RngExt, count: usize, side: f64, radius: f64) -> Vec<Polygon> {
    (0..count)
        .map(|_| {
            let center = point(random.random_range(0.0..side), random.random_range(0.0..side));
            let corners = random.random_range(3..9);
            let radius = radius * random.random_range(0.4..1.0);
            star(random, center, radius, corners)
        })
        .collect()
}
