//! Programs made by chance, run by a second interpreter before and after: the same cuts in the same order with the
//! same feeds, the same state behind every line that was there, and no rapid move through an obstacle.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod machine;

use machine::{Move, run};
use proptest::prelude::*;
use std::fmt::Write;
use traverse_checker::RapidMoveChecker;
use traverse_drawing::{ArcMotion, StraightMotion};
use traverse_geometry::{CornerStyle, Obstacle, Path, Point, Polygon, Ring, Scene};
use traverse_programs::{
    Done, Program, ReadOptions, Rewritten, ScenePlanner, ToolScenes, WriteOptions, rewrite,
};
use traverse_solve::Budget;

/// The feed of arcs that stand for rapid moves, as no cut has it.
const TRAVEL_FEED: f64 = 7777.0;

/// How far rounding may bring the machine's own arc inside, and positions apart, millimetres.
const SLACK_MM: f64 = 1e-5;

/// One thing that a program does.
#[derive(Clone, Debug)]
enum Step {
    Rapid { x: i32, y: i32, modal: bool },
    Cut { x: i32, y: i32, feed: Option<u16> },
    HalfCircle { x: i32, y: i32, clockwise: bool },
    Height(i32),
    Absolute(bool),
    Inches(bool),
    AbsoluteCenters(bool),
    Plane(u32),
    Note,
}

fn step() -> impl Strategy<Value = Step> {
    let place = || (-1200..1200_i32, -1200..1200_i32);
    prop_oneof![
        8 => (place(), any::<bool>()).prop_map(|((x, y), modal)| Step::Rapid { x, y, modal }),
        4 => (place(), prop::option::of(50..900_u16)).prop_map(|((x, y), feed)| Step::Cut { x, y, feed }),
        2 => (place(), any::<bool>()).prop_map(|((x, y), clockwise)| Step::HalfCircle { x, y, clockwise }),
        2 => (-50..100_i32).prop_map(Step::Height),
        1 => any::<bool>().prop_map(Step::Absolute),
        1 => any::<bool>().prop_map(Step::Inches),
        1 => any::<bool>().prop_map(Step::AbsoluteCenters),
        1 => (17..=19_u32).prop_map(Step::Plane),
        1 => Just(Step::Note),
    ]
}

/// How a program is spelled.
#[derive(Clone, Copy, Debug)]
struct Spelling {
    compact: bool,
    lower: bool,
    ending: &'static str,
    number_blocks: bool,
}

fn spelling() -> impl Strategy<Value = Spelling> {
    let ending = prop_oneof![Just("\n"), Just("\r\n")];
    (any::<bool>(), any::<bool>(), ending, any::<bool>()).prop_map(
        |(compact, lower, ending, number_blocks)| Spelling { compact, lower, ending, number_blocks },
    )
}

/// Writes the steps as a program. Targets are tenths of millimetres; it keeps count of where it is.
fn program(steps: &[Step], spelling: Spelling) -> String {
    let mut writer =
        Writer { at: (0, 0), absolute: true, inches: false, centers: false, plane: 17, motion: 0 };
    let mut lines = vec!["G21 G90 G17 G91.1".to_owned(), "G0 X0 Y0".to_owned(), "F300".to_owned()];
    lines.extend(steps.iter().flat_map(|step| writer.line(step)));
    lines.push("M2".to_owned());
    let mut text = String::new();
    for (number, line) in lines.into_iter().enumerate() {
        let mut line = if spelling.compact { line.replace(' ', "") } else { line };
        if spelling.number_blocks {
            line = format!("N{}{}{line}", number * 10, if spelling.compact { "" } else { " " });
        }
        if spelling.lower {
            line = line.to_lowercase();
        }
        write!(text, "{line}{}", spelling.ending).unwrap();
    }
    text
}

struct Writer {
    at: (i32, i32),
    absolute: bool,
    inches: bool,
    centers: bool,
    plane: u32,
    motion: u8,
}

impl Writer {
    /// A number of tenths of a millimetre; of inches when they are in force, where tenths stand for hundredths.
    fn number(&self, tenths: i32) -> String {
        if self.inches {
            format!("{}", f64::from(tenths) / 200.0)
        } else {
            format!("{}", f64::from(tenths) / 10.0)
        }
    }

    fn words(&mut self, x: i32, y: i32) -> String {
        let (dx, dy) = if self.absolute { (x, y) } else { (x - self.at.0, y - self.at.1) };
        self.at = (x, y);
        format!(" X{} Y{}", self.number(dx), self.number(dy))
    }

    fn line(&mut self, step: &Step) -> Vec<String> {
        match *step {
            Step::Rapid { x, y, modal } => {
                let word = if modal && self.motion == 0 { "" } else { "G0" };
                self.motion = 0;
                vec![format!("{word}{}", self.words(x, y)).trim().to_owned()]
            }
            Step::Cut { x, y, feed } => {
                self.motion = 1;
                let feed = feed.map(|feed| format!(" F{feed}")).unwrap_or_default();
                vec![format!("G1{}{feed}", self.words(x, y))]
            }
            Step::HalfCircle { x, y, clockwise } if self.plane == 17 => {
                let from = self.at;
                // An even way, so that the centre stands on the grid.
                let (x, y) = (x - (x - from.0) % 2, y - (y - from.1) % 2);
                if (x, y) == from {
                    return Vec::new();
                }
                self.motion = if clockwise { 2 } else { 3 };
                let half = ((x - from.0) / 2, (y - from.1) / 2);
                let center = if self.centers { (from.0 + half.0, from.1 + half.1) } else { half };
                let (i, j) = (self.number(center.0), self.number(center.1));
                let words = self.words(x, y);
                vec![format!("G{}{words} I{i} J{j}", self.motion)]
            }
            Step::HalfCircle { .. } => Vec::new(),
            Step::Height(z) => {
                self.motion = 0;
                let was = std::mem::replace(&mut self.absolute, true);
                let line = format!("G90 G0 Z{}", self.number(z));
                self.absolute = was;
                vec![line, if was { "G90".to_owned() } else { "G91".to_owned() }]
            }
            Step::Absolute(absolute) => {
                self.absolute = absolute;
                vec![if absolute { "G90".to_owned() } else { "G91".to_owned() }]
            }
            // Another unit: the same numbers mean other places, so the count begins anew.
            Step::Inches(inches) => {
                let was = std::mem::replace(&mut self.inches, inches);
                if was == inches {
                    return Vec::new();
                }
                self.motion = 0;
                self.at = (0, 0);
                let unit = if inches { "G20" } else { "G21" };
                let back = if self.absolute { "G90" } else { "G91" };
                vec![format!("{unit} G90 G0 X0 Y0"), back.to_owned()]
            }
            Step::AbsoluteCenters(absolute) => {
                self.centers = absolute;
                vec![if absolute { "G90.1".to_owned() } else { "G91.1".to_owned() }]
            }
            Step::Plane(plane) => {
                self.plane = plane;
                vec![format!("G{plane}")]
            }
            Step::Note => vec!["(a note; G0 X1)".to_owned()],
        }
    }
}

fn scene(style: CornerStyle) -> Scene {
    let boxes = [
        (-60.0, -20.0, -30.0, 45.0),
        (20.0, -70.0, 38.0, -5.0),
        (5.0, 20.0, 80.0, 32.0),
        (70.0, -40.0, 84.0, 60.0),
    ];
    let mut obstacles: Vec<Obstacle> = boxes
        .into_iter()
        .enumerate()
        .map(|(index, (left, bottom, right, top))| {
            let ring = Ring::from_xy(&[left, bottom, right, bottom, right, top, left, top], &[]).unwrap();
            Obstacle {
                id: format!("box/{index}"),
                shape: Polygon::from_ring(ring),
                clearance_mm: None,
                top_z_mm: None,
            }
        })
        .collect();
    let disc = Ring::from_xy(&[-18.0, -50.0, -2.0, -50.0], &[1.0, 1.0]).unwrap();
    obstacles.push(Obstacle {
        id: "disc".into(),
        shape: Polygon::from_ring(disc),
        clearance_mm: Some(2.5),
        top_z_mm: None,
    });
    Scene { work_area: None, obstacles, clearance_mm: 4.0, work_area_clearance_mm: None, corner_style: style }
}

fn rewritten(text: &str, scene: &Scene, options: &WriteOptions) -> (Rewritten, Vec<(u32, u32)>) {
    let scenes =
        ToolScenes { any: scene.clone(), by_tool: std::collections::BTreeMap::new(), safe_z_mm: None };
    let read = ReadOptions { start: Some(Point::new(0.0, 0.0)), ..ReadOptions::default() };
    let program = Program::read(text.as_bytes(), &read).unwrap();
    assert!(program.faults.is_empty(), "{:?}", program.faults);
    assert!(program.untouched.is_empty(), "{:?}", program.untouched);
    let budget = Budget::unlimited();
    let lines = program.links.iter().map(traverse_programs::Link::lines).collect();
    (rewrite(&program, &ScenePlanner::new(&scenes, &budget), options), lines)
}

fn is_travel(each: &Move) -> bool {
    each.code == 0 || (each.feed - TRAVEL_FEED).abs() < 3.0
}

/// A travel move as the machine runs it, for the checker: an arc about the centre that both ends agree on.
fn as_path(each: &Move) -> Path {
    let [from, to] = [each.from, each.to].map(|[x, y, _]| Point::new(x, y));
    let mut path = Path::at(from);
    let Some([x, y]) = each.center else {
        path.line_to(to);
        return path;
    };
    let (center, chord) = (Point::new(x, y), to - from);
    let across = traverse_geometry::left_of(chord) / chord.norm();
    let middle = from + chord / 2.0;
    let center = middle + across * across.dot(&(center - middle));
    let angle = |p: Point| (p - center).y.atan2((p - center).x);
    let turn = traverse_geometry::positive_angle(angle(to) - angle(from));
    path.arc_to(to, center, if each.code == 3 { turn } else { turn - std::f64::consts::TAU });
    path
}

fn close(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < SLACK_MM)
}

fn same_work(text: &str, scene: &Scene, options: &WriteOptions) -> Result<(), TestCaseError> {
    let (result, lines) = rewritten(text, scene, options);
    let after_text = String::from_utf8(result.text).unwrap();
    let ((before, before_states), (after, after_states)) = (run(text), run(&after_text));
    let cuts = |moves: &[Move]| moves.iter().filter(|each| !is_travel(each)).cloned().collect::<Vec<_>>();
    let (cuts_before, cuts_after) = (cuts(&before), cuts(&after));
    prop_assert_eq!(cuts_before.len(), cuts_after.len(), "{}\n---\n{}", text, after_text);
    for (was, is) in cuts_before.iter().zip(&cuts_after) {
        let same = was.code == is.code
            && close(&was.from, &is.from)
            && close(&was.to, &is.to)
            && close(&was.center.unwrap_or_default(), &is.center.unwrap_or_default())
            && was.feed.to_bits() == is.feed.to_bits();
        prop_assert!(same, "{:?}\n{:?}\n{}\n---\n{}", was, is, text, after_text);
        prop_assert_eq!(&before_states[was.line].motion, &after_states[is.line].motion);
        let modes =
            |s: &machine::State| (s.absolute, s.inches, s.plane, s.absolute_centers, s.feed.to_bits());
        prop_assert_eq!(modes(&before_states[was.line]), modes(&after_states[is.line]), "{}", after_text);
    }
    prop_assert_eq!(modes_at_end(&before_states), modes_at_end(&after_states));
    // Every travel move is free, but for those of links that were told.
    let checker = RapidMoveChecker::new(scene);
    let told = result.outcomes.iter().filter(|outcome| outcome.still_hits()).count();
    let hit = after
        .iter()
        .filter(|each| is_travel(each) && each.from[..2] != each.to[..2])
        .filter(|each| {
            let path = as_path(each);
            !checker.check(path.start, path.end(), &path, SLACK_MM).is_sound()
        })
        .count();
    let ways_told: usize = result
        .outcomes
        .iter()
        .zip(&lines)
        .filter(|(outcome, _)| outcome.still_hits())
        .map(|(_, (first, last))| (last - first + 1) as usize)
        .sum();
    prop_assert!(hit <= ways_told, "{} hit, {} told\n{}\n---\n{}", hit, told, text, after_text);
    for outcome in &result.outcomes {
        if let Done::Changed(path) = &outcome.done {
            prop_assert!((path.length() - outcome.after_mm).abs() < 1e-9);
            prop_assert!(outcome.is_made_safe() || outcome.after_mm < outcome.before_mm + 0.01);
        }
    }
    Ok(())
}

fn modes_at_end(states: &[machine::State]) -> Option<(u8, u64, bool, bool, u32, bool)> {
    let s = states.last()?;
    Some((s.motion, s.feed.to_bits(), s.absolute, s.inches, s.plane, s.absolute_centers))
}

fn options(arcs: bool, straight: bool) -> WriteOptions {
    let mut options = WriteOptions::default();
    if arcs {
        options.arcs = ArcMotion::Fed { feed_mm_per_min: TRAVEL_FEED };
    }
    if straight {
        options.straight = StraightMotion::Fed { feed_mm_per_min: TRAVEL_FEED };
    }
    options
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn cuts_and_modes_stay_and_travel_is_free(
        steps in prop::collection::vec(step(), 1..25),
        spelling in spelling(),
        mitred in any::<bool>(),
        arcs in any::<bool>(),
        straight in prop::bool::weighted(0.2),
    ) {
        let style = if mitred { CornerStyle::Miter { limit: None } } else { CornerStyle::Round };
        same_work(&program(&steps, spelling), &scene(style), &options(arcs, straight))?;
    }

    #[test]
    fn a_rewritten_program_stays_as_it_is(
        steps in prop::collection::vec(step(), 1..25),
        spelling in spelling(),
        arcs in any::<bool>(),
    ) {
        let scene = scene(CornerStyle::Round);
        let options = options(arcs, false);
        let (once, _) = rewritten(&program(&steps, spelling), &scene, &options);
        let text = String::from_utf8(once.text).unwrap();
        let (twice, _) = rewritten(&text, &scene, &options);
        let still = once.outcomes.iter().any(traverse_programs::Outcome::still_hits);
        prop_assert!(still || twice.text == text.as_bytes(), "{}\n---\n{}", text, String::from_utf8_lossy(&twice.text));
    }
}
