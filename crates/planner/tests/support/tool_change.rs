//! Tool changes: asked, checked, held against sampling.

use super::{answer_by, assert_close, disc, mitred, plan_by, point, rectangle, scene, star, stars};
use rand::RngExt;
use traverse_checker::{PlacedChange, check_tool_change};
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, Location, Point, Polygon, RapidRules, Ring, Scene, TravelCost, Vector,
};
use traverse_planner::{
    Answer, NoPath, Refusal, ToolChange, ToolChangeAnswer, ToolChangePlan, plan_tool_change,
};
use traverse_solve::{Budget, Seed, Silent};

pub fn change(start: Point, target: Point, regions: Vec<Polygon>) -> ToolChange {
    ToolChange { start, target, regions, points: Vec::new(), place_z_mm: None, rules: RapidRules::default() }
}

/// What came of a tool change; every plan is checked.
pub fn placed(scene: &Scene, question: &ToolChange) -> Result<ToolChangeAnswer, Vec<Refusal>> {
    assert!(question.findings().is_empty() && question.rules.findings().is_empty());
    let (answer, _) = plan_tool_change(scene, question, &Budget::unlimited(), &mut Silent)?;
    if let ToolChangeAnswer::Plan(plan) = &answer {
        assert_sound(scene, question, plan);
    }
    Ok(answer)
}

pub fn assert_sound(scene: &Scene, question: &ToolChange, plan: &ToolChangePlan) {
    let [approach, departure] = [question.approach_rules(), question.departure_rules()];
    let placed = PlacedChange {
        scene,
        start: question.start,
        target: question.target,
        regions: &question.regions,
        points: &question.points,
        rules: [&approach, &departure],
        place: plan.place,
        paths: [&plan.approach.path, &plan.departure.path],
    };
    let check = check_tool_change(&placed, CONTACT_TOLERANCE_MM);
    assert!(check.violations.is_empty(), "{:#?}\n{plan:?}\n{question:?}\n{scene:?}", check.violations);
    assert_close(check.cost, plan.cost, "cost recomputed");
    assert_eq!(check.clearance_mm, plan.approach.clearance_mm);
    assert_eq!(plan.departure.clearance_mm, plan.approach.clearance_mm);
    assert_close(plan.approach.cost + plan.departure.cost, plan.cost, "sum");
    let moves = [(&approach, question.start, plan.place), (&departure, plan.place, question.target)];
    if question.rules.clearances_mm.is_empty() {
        let by_hand: f64 = moves.map(|(rules, from, to)| plan_by(scene, rules, from, to).cost).iter().sum();
        assert_close(by_hand, plan.cost, "planned one by one");
    }
    assert!(plan.lower_bound <= plan.cost, "{plan:?}");
    let is_proven =
        !matches!(question.rules.cost, TravelCost::Kinematics(_)) && question.rules.dog_leg().is_none();
    assert!(!is_proven || plan.lower_bound >= plan.cost * (1.0 - 2e-9), "{plan:?}");
}

pub fn placed_plan(scene: &Scene, question: &ToolChange) -> ToolChangePlan {
    match placed(scene, question) {
        Ok(ToolChangeAnswer::Plan(plan)) => *plan,
        other => panic!("no place: {other:?}\n{question:?}"),
    }
}

pub fn no_place(scene: &Scene, question: &ToolChange) -> NoPath {
    match placed(scene, question) {
        Ok(ToolChangeAnswer::NoPath(no_path)) => no_path,
        other => panic!("a place: {other:?}\n{question:?}"),
    }
}

/// The least cost over many places of the regions, and of the points.
pub fn sampled(scene: &Scene, question: &ToolChange, per_side: usize) -> Option<f64> {
    let mut best: Option<f64> = None;
    let mut places = question.points.clone();
    for region in &question.regions {
        let bounds = region.bounds();
        let size = bounds.size();
        for i in 0..=per_side {
            for j in 0..=per_side {
                let [x, y] = [i, j].map(|at| at as f64 / per_side as f64);
                places.push(bounds.min + Vector::new(size.x * x, size.y * y));
            }
        }
        for edge in region.rings().flat_map(Ring::edges) {
            places.extend((0..2 * per_side).map(|i| edge.point_at(i as f64 / (2 * per_side) as f64)));
        }
    }
    let permitted = |p: &Point| {
        question.points.contains(p)
            || question.regions.iter().any(|region| region.locate(*p) != Location::Outside)
    };
    let [to, on] = [question.approach_rules(), question.departure_rules()];
    for place in places.into_iter().filter(permitted) {
        let approach = answer_by(scene, &to, question.start, place);
        let Ok(Answer::Plan(approach)) = approach else { continue };
        if best.is_some_and(|best| approach.cost + straight(&question.rules, question.target - place) > best)
        {
            continue;
        }
        let Ok(Answer::Plan(departure)) = answer_by(scene, &on, place, question.target) else { continue };
        let cost = approach.cost + departure.cost;
        best = Some(best.map_or(cost, |best| best.min(cost)));
    }
    best
}

/// No straight way along `by` costs less.
fn straight(rules: &RapidRules, by: Vector) -> f64 {
    match &rules.cost {
        TravelCost::Length => by.norm(),
        TravelCost::AxisSpeeds(speeds) => {
            (by.x.abs() / speeds.x_mm_per_s).max(by.y.abs() / speeds.y_mm_per_s)
        }
        TravelCost::Kinematics(limits) => by.norm() / limits.speed_mm_per_s.max(limits.arc_speed_mm_per_s()),
    }
}

/// Holds the plan against sampling: nothing sampled is cheaper, and the best sampled comes near.
pub fn compare(scene: &Scene, question: &ToolChange, near: f64, what: &str) -> bool {
    let found = match placed(scene, question) {
        Err(refusals) => {
            assert!(
                refusals.iter().all(|r| matches!(r, Refusal::EndInsideBarrier { .. })),
                "{what}: {refusals:?}"
            );
            return false;
        }
        Ok(found) => found,
    };
    let best = sampled(scene, question, 10);
    match (found, best) {
        (ToolChangeAnswer::Plan(plan), Some(best)) => {
            assert!(
                best >= plan.cost * (1.0 - 1e-9),
                "{what}: {best} is below {}\n{question:?}\n{scene:?}",
                plan.cost
            );
            assert!(best <= plan.cost + near, "{what}: {best} is far above {}", plan.cost);
            true
        }
        (ToolChangeAnswer::NoPath(_), Some(best)) => {
            panic!("{what}: there is a place for {best}\n{question:?}")
        }
        (ToolChangeAnswer::Plan(_) | ToolChangeAnswer::NoPath(_), None) => false,
    }
}

pub fn any_region(random: &mut impl RngExt, side: f64) -> Polygon {
    let center = point(random.random_range(0.0..side), random.random_range(0.0..side));
    match random.random_range(0..3) {
        0 => disc(center.x, center.y, random.random_range(1.0..side / 6.0)),
        1 => star(random, center, side / 5.0, 6),
        _ => {
            let (w, h) = (random.random_range(0.5..side / 4.0), random.random_range(0.5..side / 4.0));
            rectangle(center.x - w, center.y - h, center.x + w, center.y + h)
        }
    }
}

/// A scene of stars, some mitred, some with a work area; start and target; one or two regions.
pub fn among_stars(seed: u64) -> (Scene, [Point; 2], Vec<Polygon>) {
    let mut random = Seed(seed).stream();
    let count = random.random_range(1..7);
    let shapes = stars(&mut random, count, 60.0, 14.0);
    let mut scene = scene(shapes, [0.0, 1.5, 4.0][seed as usize % 3]);
    if seed.is_multiple_of(5) {
        scene = mitred(scene);
    }
    if seed % 4 == 1 {
        scene.work_area = Some(rectangle(-20.0, -20.0, 80.0, 80.0));
    }
    let mut at = || point(random.random_range(-15.0..75.0), random.random_range(-15.0..75.0));
    let ends = [at(), at()];
    let mut regions = vec![any_region(&mut random, 60.0)];
    if seed.is_multiple_of(3) {
        regions.push(any_region(&mut random, 60.0));
    }
    (scene, ends, regions)
}
