//! Programs for machines whose G0 runs dog-legs: kept and inserted rapid moves keep the clearance as they are run.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use traverse_checker::RapidMoveChecker;
use traverse_drawing::StraightMotion;
use traverse_geometry::{
    AxisSpeeds, CONTACT_TOLERANCE_MM, CornerStyle, Obstacle, Path, Polygon, RapidMotion, RapidRules, Ring,
    Scene, TravelCost,
};
use traverse_programs::{Done, Program, ReadOptions, ScenePlanner, ToolScenes, WriteOptions, rewrite};
use traverse_solve::Budget;

/// One clamp above the line from (0, 0) to (100, 50), one below it: in the way of both axes first, and of both axes last.
fn clamps() -> ToolScenes {
    let clamp = |id: &str, [left, low, right, high]: [f64; 4]| {
        let ring = Ring::from_xy(&[left, low, right, low, right, high, left, high], &[]).unwrap();
        Obstacle { id: id.to_owned(), shape: Polygon::from_ring(ring), clearance_mm: None, top_z_mm: None }
    };
    let scene = Scene {
        work_area: None,
        obstacles: vec![clamp("high", [20.0, 25.0, 38.0, 60.0]), clamp("low", [60.0, 0.0, 80.0, 20.0])],
        clearance_mm: 1.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    };
    ToolScenes { any: scene, by_tool: Default::default(), safe_z_mm: None }
}

fn rules(x: f64, y: f64) -> RapidRules {
    let speeds = AxisSpeeds { x_mm_per_s: x, y_mm_per_s: y, z_mm_per_s: 0.0 };
    RapidRules { cost: TravelCost::AxisSpeeds(speeds), motion: RapidMotion::DogLeg, ..RapidRules::default() }
}

const PROGRAM: &str = "G21 G90\nG0 X0 Y0\nG1 X0 Y0.5 F200\nG1 X0 Y0\nG0 X100 Y50\nM30\n";

#[test]
fn what_is_safe_as_a_line_and_not_as_a_dog_leg_is_replaced() {
    let (scenes, budget) = (clamps(), Budget::unlimited());
    let program = Program::read(PROGRAM.as_bytes(), &ReadOptions::default()).unwrap();
    let as_lines = rewrite(&program, &ScenePlanner::new(&scenes, &budget), &WriteOptions::default());
    assert_eq!(as_lines.text, PROGRAM.as_bytes());
    for (x, y) in [(100.0, 100.0), (100.0, 95.0), (300.0, 200.0)] {
        let rules = rules(x, y);
        let rewritten =
            rewrite(&program, &ScenePlanner::by(&scenes, &rules, &budget), &WriteOptions::default());
        let [outcome] = &rewritten.outcomes[..] else { panic!("one rapid move is known") };
        assert!(outcome.is_made_safe(), "{outcome:?}");
        let Done::Changed(path) = &outcome.done else { panic!("{outcome:?}") };
        assert!(path.steps.len() > 1 && path.steps.iter().all(|step| step.arc.is_none()));
        // Read again, it is sound as it is run, and stays.
        let again = Program::read(&rewritten.text, &ReadOptions::default()).unwrap();
        let run: Vec<Path> = again.links.iter().map(traverse_programs::Link::path).collect();
        for path in &run {
            let checker = RapidMoveChecker::new(&scenes.any);
            let check = checker
                .check_while(&rules, path.start, path.end(), path, CONTACT_TOLERANCE_MM, &|| true)
                .unwrap();
            assert!(check.is_sound(), "{:?}", check.violations);
        }
        let twice = rewrite(&again, &ScenePlanner::by(&scenes, &rules, &budget), &WriteOptions::default());
        assert_eq!(twice.text, rewritten.text);
    }
}

#[test]
fn fed_moves_are_interpolated_whatever_g0_does() {
    let (scenes, budget) = (clamps(), Budget::unlimited());
    let program = Program::read(PROGRAM.as_bytes(), &ReadOptions::default()).unwrap();
    let fed =
        WriteOptions { straight: StraightMotion::Fed { feed_mm_per_min: 9000.0 }, ..WriteOptions::default() };
    let rules = rules(100.0, 100.0);
    let rewritten = rewrite(&program, &ScenePlanner::by(&scenes, &rules, &budget), &fed);
    let [outcome] = &rewritten.outcomes[..] else { panic!("one rapid move is known") };
    // As G0 it ran into a clamp; as one G1 it does not.
    assert_eq!(outcome.hits, ["high"]);
    let Done::Changed(path) = &outcome.done else { panic!("{outcome:?}") };
    assert_eq!(path.steps.len(), 1);
}
