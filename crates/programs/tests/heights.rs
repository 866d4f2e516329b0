//! Programs whose retracts are planned: over what is low, round what is high, back in the program's own spelling.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod machine;

use machine::run;
use proptest::prelude::*;
use traverse_checker::check_rapid_move_by;
use traverse_geometry::{CornerStyle, HeightRule, Obstacle, Path, Point, Polygon, RapidRules, Ring, Scene};
use traverse_programs::{
    Done, PassingOver, Program, ReadOptions, Reason, Rewritten, ScenePlanner, ToolScenes, WriteOptions,
    rewrite,
};
use traverse_solve::{Budget, CancelToken};

const OVER: PassingOver = PassingOver { clearance_z_mm: Some(2.0), highest_z_mm: Some(60.0) };

/// A low bar and a tall one across the line from (0, 0) to (200, 0), and one whose top is not known.
fn scenes() -> ToolScenes {
    let bar = |id: &str, [left, low, right, high]: [f64; 4], top_z_mm| {
        let ring = Ring::from_xy(&[left, low, right, low, right, high, left, high], &[]).unwrap();
        Obstacle { id: id.to_owned(), shape: Polygon::from_ring(ring), clearance_mm: None, top_z_mm }
    };
    let obstacles = vec![
        bar("low", [40.0, -300.0, 60.0, 300.0], Some(10.0)),
        bar("tall", [120.0, -20.0, 140.0, 20.0], Some(90.0)),
        bar("unknown", [300.0, -20.0, 310.0, 20.0], None),
    ];
    let any = Scene {
        work_area: None,
        obstacles,
        clearance_mm: 5.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Miter { limit: None },
    };
    ToolScenes { any, by_tool: Default::default(), safe_z_mm: None }
}

fn rewritten(text: &str, over: PassingOver) -> (String, Rewritten) {
    let (scenes, budget) = (scenes(), Budget::unlimited());
    let program = Program::read(text.as_bytes(), &ReadOptions::default()).unwrap();
    let planner = ScenePlanner::new(&scenes, &budget).passing_over(over);
    let found = rewrite(&program, &planner, &WriteOptions::default());
    (String::from_utf8(found.text.clone()).unwrap(), found)
}

#[track_caller]
fn becomes(between: &str, expected: &str) -> Rewritten {
    let program = |between: &str| format!("G21 G90\nG0 X0 Y0 Z3\nG1 Z-1 F200\n{between}G1 Z-1 F200\nM30\n");
    let (text, found) = rewritten(&program(between), OVER);
    assert_eq!(text, program(expected));
    // What was written stays as it is.
    assert_eq!(rewritten(&text, OVER).0, text);
    found
}

#[test]
fn a_retract_is_as_high_as_it_need_be() {
    let found = becomes("G0 Z55\nX100\nZ3\n", "G0 Z12\nX100\nZ3\n");
    let [outcome] = &found.outcomes[..] else { panic!("{found:?}") };
    assert_eq!((outcome.before_mm, outcome.after_mm), (56.0 + 100.0 + 52.0, 13.0 + 100.0 + 9.0));
    becomes(
        "N10 g0 z55.000 (up)\nN20 x100 (over)\nN30 z3 (down)\n",
        "N10 g0 z12 (up)\nN20 x100 (over)\nN30 z3 (down)\n",
    );
}

#[test]
fn what_is_high_is_gone_round_at_the_height_of_what_is_low() {
    becomes("G0 Z60\nX200 Y0\nZ3\n", "G0 Z12\nG0 X114.998 Y-25.002\nG0 X145.002 Y-25.002\nX200 Y0\nZ3\n");
}

#[test]
fn blocks_that_are_missing_are_inserted() {
    // Nothing rises in the program: it ran into the low bar.
    let found = becomes("G0 Z3\nM8\nG0 X100\nM9\n", "G0 Z3\nM8\nG0 Z12\nG0 X100\nG0 Z3\nM9\n");
    assert_eq!(found.outcomes[0].hits, ["low"]);
    assert!(found.outcomes[0].is_made_safe());
}

#[test]
fn what_is_as_good_or_not_known_stays_byte_for_byte() {
    for between in [
        "G0 Z12\nX100\nZ3\n",
        "G0 Z55 (traverse: keep)\nX100\nZ55 (traverse: keep)\n",
        "(traverse: off)\nG0 Z55\nX100\nZ3\n(traverse: on)\n",
        "G0 Z#5\nX-100\nZ3\n",
        "G43 H1 G0 Z55\nX100\nG49\n",
        "G91\nG0 Z56\nX100\nZ-52\nG90\n",
        "G0 Z55\nX100\nZ3 M8\n",
        "/G0 Z55\nG0 X-100\n",
        "G0 Z55\nM1\nX100\nM1\nZ3\n",
    ] {
        becomes(between, between);
    }
}

#[test]
fn the_limit_of_height_holds() {
    // Lower than the bar's top allows: there is no way over it, and its end is too far to go round.
    let over = PassingOver { clearance_z_mm: Some(2.0), highest_z_mm: Some(11.0) };
    let text = "G21 G90\nG0 X0 Y0 Z3\nG1 Z-1 F200\nG0 Z4\nX100 Y0\nZ3\nM30\n";
    let (written, found) = rewritten(text, over);
    assert!(found.outcomes[0].after_mm > 600.0, "{written}");
    let high = rewritten(text, OVER).1;
    assert!(high.outcomes[0].after_mm < 130.0);
}

#[test]
fn checks_stop_when_time_is_over() {
    let budget = Budget { cancel: CancelToken::new(), ..Budget::unlimited() };
    budget.cancel.cancel();
    let scenes = scenes();
    let text = "G21 G90\nG0 X0 Y0 Z3\nG1 Z-1 F200\nG0 Z55\nX100\nZ3\n";
    let program = Program::read(text.as_bytes(), &ReadOptions::default()).unwrap();
    let found = rewrite(&program, &ScenePlanner::new(&scenes, &budget), &WriteOptions::default());
    assert_eq!(found.outcomes[0].done, Done::Left(Reason::Interrupted));
    assert_eq!(found.text, text.as_bytes());
}

/// One thing that a program does, in whole millimetres.
#[derive(Clone, Debug)]
enum Step {
    Travel { x: i32, y: i32, twice: bool },
    Height(i32),
    Cut(i32),
    Note,
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        4 => (-50..260_i32, -60..60_i32, any::<bool>()).prop_map(|(x, y, twice)| Step::Travel { x, y, twice }),
        4 => (0..60_i32).prop_map(Step::Height),
        2 => (-5..3_i32).prop_map(Step::Cut),
        1 => Just(Step::Note),
    ]
}

fn program(steps: &[Step], inches: bool) -> String {
    let number = |mm: i32| if inches { format!("{}", f64::from(mm) / 20.0) } else { mm.to_string() };
    let mut text = format!("{} G90 G17\nG0 X0 Y0 Z{}\n", if inches { "G20" } else { "G21" }, number(30));
    for step in steps {
        text += &match *step {
            Step::Travel { x, y, twice: false } => format!("G0 X{} Y{}\n", number(x), number(y)),
            Step::Travel { x, y, twice: true } => {
                format!("G0 X{}\nX{} Y{}\n", number(x), number(-x), number(y))
            }
            Step::Height(z) => format!("G0 Z{}\n", number(z)),
            Step::Cut(z) => format!("G1 Z{} F300\n", number(z)),
            Step::Note => "(over)\n".to_owned(),
        };
    }
    text + "M30\n"
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// By a second interpreter: the same cuts from the same places, and every run of rapid moves that was changed is
    /// free at its heights.
    #[test]
    fn cuts_stay_and_changed_runs_are_free(
        steps in prop::collection::vec(step(), 1..20),
        inches in any::<bool>(),
    ) {
        let text = program(&steps, inches);
        let (written, found) = rewritten(&text, OVER);
        let cuts = |text: &str| -> Vec<_> {
            let moves = run(text).0;
            moves.into_iter().filter(|each| each.code == 1).map(|each| (each.from, each.to)).collect()
        };
        let (before, after) = (cuts(&text), cuts(&written));
        prop_assert_eq!(before.len(), after.len());
        for (was, is) in before.iter().zip(&after) {
            for axis in 0..3 {
                prop_assert!((was.0[axis] - is.0[axis]).abs() < 1e-9, "{}\n---\n{}", text, written);
                prop_assert!((was.1[axis] - is.1[axis]).abs() < 1e-9, "{}\n---\n{}", text, written);
            }
        }
        prop_assert_eq!(run(&text).1.last().map(|state| state.at), run(&written).1.last().map(|state| state.at));
        let scene = scenes().any;
        for outcome in &found.outcomes {
            let Done::Changed(path) = &outcome.done else { continue };
            prop_assert!(outcome.is_made_safe() || outcome.after_mm < outcome.before_mm);
            let Some((start, target)) = path.start_z_mm.zip(path.end_z_mm()) else { continue };
            let rule = HeightRule {
                start_z_mm: start,
                target_z_mm: target,
                highest_z_mm: 60.0,
                clearance_z_mm: 2.0,
            };
            let rules = RapidRules { heights: Some(rule), ..RapidRules::default() };
            let check = check_rapid_move_by(&scene, &rules, path.start, path.end(), path, 1e-5);
            // A link whose end lies beside an obstacle at its low end is planned at the level that it has.
            let level = path.in_plane().at_level(path.steps.iter().filter_map(|step| step.z_mm).fold(start, f64::max));
            prop_assert!(check.is_sound() || is_free_at_level(&scene, &level), "{:?}\n{}\n---\n{}", check.violations, text, written);
        }
        // What the machine runs in the plane below the pass heights is free, as far as links were changed or are free.
        if found.outcomes.iter().all(|outcome| !outcome.still_hits()) {
            for each in run(&written).0.iter().skip(1).filter(|each| each.code == 0 && each.from[..2] != each.to[..2]) {
                let mut path = Path::at_height(Point::new(each.from[0], each.from[1]), each.from[2]);
                path.line_to(Point::new(each.to[0], each.to[1]));
                prop_assert!(is_free_at_level(&scene, &path), "{:?}\n{}\n---\n{}", each, text, written);
            }
        }
        prop_assert!(found.outcomes.iter().any(traverse_programs::Outcome::still_hits) || rewritten(&written, OVER).0 == written, "{}\n---\n{}\n---\n{}", text, written, rewritten(&written, OVER).0);
    }
}

fn is_free_at_level(scene: &Scene, path: &Path) -> bool {
    let z = path.start_z_mm.unwrap();
    let rule = HeightRule { start_z_mm: z, target_z_mm: z, highest_z_mm: z, clearance_z_mm: 2.0 };
    let rules = RapidRules { heights: Some(rule), ..RapidRules::default() };
    check_rapid_move_by(scene, &rules, path.start, path.end(), path, 1e-5).is_sound()
}
