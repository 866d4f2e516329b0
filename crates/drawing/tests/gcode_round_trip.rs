//! Programs are read back by an independent reader: it follows the path, within rounding, on every controller.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod gcode_reader;

use gcode_reader::{Controller, Move, Rules, distance};
use proptest::prelude::*;
use std::f64::consts::TAU;
use traverse_drawing::{
    ArcMotion, GcodeDialect, GcodePlane, GcodeSettings, GcodeUnit, ModalMotion, ModalState, StraightMotion,
    XWord, gcode_moves, write_gcode,
};
use traverse_geometry::{Path, Point, unit};

fn rules(dialect: GcodeDialect, in_unit: GcodeUnit) -> Rules {
    match dialect {
        GcodeDialect::LinuxCnc => Rules {
            needs_point: false,
            longest_line: 255,
            radius_mm: if in_unit == GcodeUnit::Inches { 0.0127 } else { 0.005 },
            radius_share: 0.001,
            single_precision: false,
            most_digits: 20,
        },
        GcodeDialect::Grbl => Rules {
            needs_point: false,
            longest_line: 79,
            radius_mm: 0.005,
            radius_share: 0.001,
            single_precision: true,
            most_digits: 8,
        },
        GcodeDialect::Fanuc => Rules {
            needs_point: true,
            longest_line: 255,
            radius_mm: 0.01,
            radius_share: 0.0,
            single_precision: false,
            most_digits: 8,
        },
    }
}

fn controller(settings: &GcodeSettings, at: Point) -> Controller {
    Controller {
        motion: None,
        feed: None,
        plane: if settings.plane == GcodePlane::Xy { 17 } else { 18 },
        unit_mm: settings.unit.millimetres(),
        x_is_diameter: settings.plane == GcodePlane::Zx { x: XWord::Diameter },
        rules: rules(settings.dialect, settings.unit),
        at: [at.x, at.y],
        ended: false,
    }
}

fn step_mm(settings: &GcodeSettings, decimals: u8) -> f64 {
    settings.unit.millimetres() / 10_f64.powi(i32::from(decimals))
}

#[derive(Clone, Debug)]
enum Step {
    Line(f64, f64),
    /// Logarithm of the radius, direction of the centre, sweep.
    Arc(f64, f64, f64),
}

fn steps() -> impl Strategy<Value = Vec<Step>> {
    let coordinate = -1000.0..1000.0;
    let sweep = prop_oneof![
        4 => -TAU..TAU,
        1 => (-12.0..0.0_f64).prop_map(|power| 10_f64.powf(power)),
        1 => (-12.0..0.0_f64).prop_map(|power| -10_f64.powf(power)),
        1 => (-12.0..0.0_f64).prop_map(|power| TAU - 10_f64.powf(power)),
        1 => Just(TAU),
        1 => Just(-TAU),
        1 => Just(TAU / 2.0),
    ];
    let step = prop_oneof![
        (coordinate.clone(), coordinate).prop_map(|(x, y)| Step::Line(x, y)),
        (-4.0..2.4_f64, 0.0..TAU, sweep)
            .prop_map(|(power, direction, sweep)| Step::Arc(power, direction, sweep)),
    ];
    prop::collection::vec(step, 0..10)
}

fn path_of(steps: &[Step], start: Point) -> Path {
    let mut path = Path::at(start);
    for step in steps {
        match *step {
            Step::Line(x, y) => path.line_to(Point::new(x, y)),
            Step::Arc(power, direction, sweep) => {
                let spoke = unit(direction) * 10_f64.powf(power);
                let center = path.end() - spoke;
                let turned = unit(direction + sweep) * spoke.norm();
                let end = if sweep.abs() >= TAU { path.end() } else { center + turned };
                path.arc_to(end, center, sweep);
            }
        }
    }
    path
}

fn settings() -> impl Strategy<Value = GcodeSettings> {
    let dialect = prop::sample::select(GcodeDialect::ALL.to_vec());
    let in_unit = prop::sample::select(vec![GcodeUnit::Millimetres, GcodeUnit::Inches]);
    let plane = prop::sample::select(vec![
        GcodePlane::Xy,
        GcodePlane::Zx { x: XWord::Radius },
        GcodePlane::Zx { x: XWord::Diameter },
    ]);
    let straight =
        prop::sample::select(vec![StraightMotion::Rapid, StraightMotion::Fed { feed_mm_per_min: 9000.0 }]);
    (dialect, in_unit, plane, straight).prop_map(|(dialect, unit, plane, straight)| {
        let plane = if dialect == GcodeDialect::Grbl && plane != GcodePlane::Xy {
            GcodePlane::Zx { x: XWord::Radius }
        } else {
            plane
        };
        GcodeSettings { dialect, unit, plane, straight, ..GcodeSettings::new(2000.0) }
    })
}

/// The greatest distance from sampled moves to the path.
fn farthest_from_path(moves: &[Move], path: &Path) -> f64 {
    let edges: Vec<_> = path.edges().collect();
    moves
        .iter()
        .flat_map(|each| (0..=40).map(|k| each.at(f64::from(k) / 40.0)))
        .map(|p| Point::new(p[0], p[1]))
        .map(|p| edges.iter().map(|edge| edge.distance_to_point(p)).fold((p - path.start).norm(), f64::min))
        .fold(0.0, f64::max)
}

/// The greatest distance from the sampled path to moves, which are sampled densely.
fn farthest_from_moves(path: &Path, moves: &[Move], start: Point) -> f64 {
    let to_move = |p: [f64; 2], each: &Move| match each.arc {
        None => {
            let d = [each.to[0] - each.from[0], each.to[1] - each.from[1]];
            let square = d[0] * d[0] + d[1] * d[1];
            let share = ((p[0] - each.from[0]) * d[0] + (p[1] - each.from[1]) * d[1]) / square;
            distance(p, each.at(if square > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 }))
        }
        Some((center, turn)) => {
            let angle = |p: [f64; 2]| (p[1] - center[1]).atan2(p[0] - center[0]);
            let along = ((angle(p) - angle(each.from)) * turn.signum()).rem_euclid(TAU) / turn.abs();
            let on = if along <= 1.0 { distance(p, each.at(along)) } else { f64::INFINITY };
            on.min(distance(p, each.from)).min(distance(p, each.to))
        }
    };
    path.edges()
        .flat_map(|edge| (0..=40).map(move |k| edge.point_at(f64::from(k) / 40.0)))
        .map(|p| {
            let nearest = distance([p.x, p.y], [start.x, start.y]);
            moves.iter().map(|each| to_move([p.x, p.y], each)).fold(nearest, f64::min)
        })
        .fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_read_back_follows_the_path(
        steps in steps(),
        (x, y) in (-1000.0..1000.0, -1000.0..1000.0),
        settings in settings(),
    ) {
        let path = path_of(&steps, Point::new(x, y));
        let program = write_gcode(&path, &settings).unwrap();
        let step = step_mm(&settings, program.moves.decimals);
        let mut controller = controller(&settings, path.start);
        let ends = if settings.dialect == GcodeDialect::Fanuc { "\r\n" } else { "\n" };
        let lines: Vec<&str> = program.text.strip_suffix(ends).unwrap().split(ends).collect();
        prop_assert!(program.text.is_ascii() && !program.text.chars().any(|c| c.is_ascii_lowercase()));
        let moves = controller.read(lines).unwrap();
        prop_assert!(controller.ended);

        let allowed = 3.0 * step + if controller.rules.single_precision { 1e-3 } else { 1e-9 };
        prop_assert!(farthest_from_path(&moves, &path) <= allowed, "{}", program.text);
        prop_assert!(farthest_from_moves(&path, &moves, path.start) <= allowed, "{}", program.text);
        let length: f64 = moves.iter().map(Move::length).sum();
        let slack = 20.0 * allowed * (1.0 + path.steps.len() as f64);
        prop_assert!((length - path.length()).abs() <= slack, "{length} {}\n{}", path.length(), program.text);
        prop_assert!(distance(controller.at, [path.end().x, path.end().y]) <= allowed);
        for each in &moves {
            let expected = match (each.arc, settings.straight) {
                (Some(_), _) => Some(2000.0),
                (None, StraightMotion::Rapid) => None,
                (None, StraightMotion::Fed { feed_mm_per_min }) => Some(feed_mm_per_min),
            };
            let as_asked = match (each.feed_mm, expected) {
                (Some(feed), Some(expected)) => (feed - expected).abs() < 0.2,
                (feed, expected) => feed == expected,
            };
            prop_assert!(as_asked);
        }
    }

    #[test]
    fn the_modal_state_is_restored(steps in steps(), settings in settings(), linear in any::<bool>()) {
        let path = path_of(&steps, Point::new(1.0, 2.0));
        let motion = if linear { ModalMotion::Linear } else { ModalMotion::Rapid };
        let after = ModalState { motion, feed_per_min: Some(123.456_789) };
        let written = gcode_moves(&path, &settings, &after).unwrap();
        let mut controller = controller(&settings, path.start);
        controller.motion = Some(u32::from(linear));
        controller.feed = after.feed_per_min;
        controller.read(written.lines.iter().map(String::as_str)).unwrap();
        prop_assert_eq!(controller.motion, Some(u32::from(linear)));
        prop_assert_eq!(controller.feed, after.feed_per_min);
    }

    #[test]
    fn chords_stay_outside_and_near(
        (power, direction, sweep) in (-2.0..3.0_f64, 0.0..TAU, -TAU..TAU),
        tolerance_power in -2.5..0.0_f64,
        settings in settings(),
    ) {
        let tolerance_mm = 10_f64.powf(tolerance_power);
        let path = path_of(&[Step::Arc(power, direction, sweep)], Point::new(30.0, 40.0));
        let settings = GcodeSettings { arcs: ArcMotion::Chords { tolerance_mm }, ..settings };
        let written = gcode_moves(&path, &settings, &ModalState::default()).unwrap();
        let step = step_mm(&settings, written.decimals);
        let mut controller = controller(&settings, path.start);
        let moves = controller.read(written.lines.iter().map(String::as_str)).unwrap();
        let Some(arc) = path.steps.first().and_then(|step| step.arc) else { return Ok(()) };
        let (center, radius) = ([arc.center.x, arc.center.y], 10_f64.powf(power));
        let rounding = step + if controller.rules.single_precision { 1e-4 } else { 1e-9 };
        for p in moves.iter().flat_map(|each| (0..=20).map(|k| each.at(f64::from(k) / 20.0))) {
            let r = distance(p, center);
            prop_assert!(r >= radius - rounding, "{r} {radius}");
            prop_assert!(r <= radius + tolerance_mm + 2.0 * rounding, "{r} {radius}");
        }
        prop_assert!(moves.iter().all(|each| each.arc.is_none()));
    }
}
