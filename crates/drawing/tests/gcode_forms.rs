//! Programs as each controller wants them, and what is refused.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::f64::consts::{PI, TAU};
use traverse_drawing::{
    ArcMotion, GcodeDialect, GcodeError, GcodePlane, GcodeSettings, GcodeUnit, ModalMotion, ModalState,
    StraightMotion, XWord, chords_outside, gcode_moves, write_gcode,
};
use traverse_geometry::{Path, Point};

/// Round a pin of radius 10 at (50, 20), clockwise over its top.
fn round_a_pin() -> Path {
    let mut path = Path::at(Point::new(0.0, 20.0));
    path.line_to(Point::new(40.0, 20.0));
    path.arc_to(Point::new(60.0, 20.0), Point::new(50.0, 20.0), -PI);
    path.line_to(Point::new(100.0, 20.5));
    path
}

fn with(dialect: GcodeDialect) -> GcodeSettings {
    GcodeSettings { dialect, ..GcodeSettings::new(1500.0) }
}

fn text(settings: &GcodeSettings) -> String {
    write_gcode(&round_a_pin(), settings).unwrap().text
}

#[test]
fn each_controller_gets_its_frame() {
    assert_eq!(
        text(&with(GcodeDialect::LinuxCnc)),
        "(TRAVERSE RAPID MOVE)\nG17 G21\nG90 G91.1 G40 G80 G94 G61\n(TOOL MUST STAND AT X0 Y20)\nG0 X40 Y20\n\
         G2 X60 Y20 I10 J0 F1500\nG0 X100 Y20.5\nM30\n"
    );
    assert_eq!(
        text(&with(GcodeDialect::Grbl)),
        "(TRAVERSE RAPID MOVE)\nG17 G21\nG90 G91.1 G40 G94\n(TOOL MUST STAND AT X0 Y20)\nG0 X40 Y20\n\
         G2 X60 Y20 I10 J0 F1500\nG0 X100 Y20.5\nM30\n"
    );
    let lathe = GcodeSettings {
        plane: GcodePlane::Zx { x: XWord::Diameter },
        program_number: 42,
        header: vec!["(SHAFT)".to_owned()],
        footer: Some(vec!["M5".to_owned(), "M30".to_owned()]),
        ..with(GcodeDialect::Fanuc)
    };
    assert_eq!(
        text(&lathe),
        "%\r\nO0042 (TRAVERSE RAPID MOVE)\r\n(SHAFT)\r\nG18 G21\r\nG40 G98\r\n\
         (X IS DIAMETER: AXIS PARAMETER 1006 BIT 3 MUST AGREE)\r\n(TOOL MUST STAND AT X40. Z0.)\r\n\
         G0 X40. Z40.\r\nG2 X40. Z60. I0. K10. F1500.\r\nG0 X41. Z100.\r\nM5\r\nM30\r\n%\r\n"
    );
}

#[test]
fn inches_are_converted_with_their_feeds() {
    let settings = GcodeSettings { unit: GcodeUnit::Inches, ..with(GcodeDialect::LinuxCnc) };
    let program = text(&settings);
    assert!(program.contains("G17 G20\n"), "{program}");
    assert!(program.contains("G2 X2.3622 Y0.7874 I0.3937 J0 F59.06\n"), "{program}");
}

#[test]
fn motion_mode_and_feed_come_back_behind_an_arc() {
    let mut path = round_a_pin();
    path.steps.pop();
    let written = |path: &Path, after: &ModalState| {
        gcode_moves(path, &with(GcodeDialect::LinuxCnc), after).unwrap().lines
    };
    let restored = |motion, feed_per_min| written(&path, &ModalState { motion, feed_per_min }).pop().unwrap();
    assert_eq!(restored(ModalMotion::Rapid, Some(812.345)), "G0 F812.345");
    assert_eq!(restored(ModalMotion::Linear, Some(500.0)), "G1 F500");
    assert_eq!(restored(ModalMotion::Rapid, None), "G0");
    path.steps.pop();
    let after = ModalState { feed_per_min: Some(500.0), ..ModalState::default() };
    assert_eq!(written(&path, &after), ["G0 X40 Y20"]);
    assert!(
        gcode_moves(
            &path,
            &with(GcodeDialect::Grbl),
            &ModalState { feed_per_min: Some(f64::NAN), ..ModalState::default() }
        )
        .is_err()
    );
}

#[test]
fn full_turns_are_split_and_tiny_arcs_go_straight() {
    let mut path = Path::at(Point::new(10.0, 0.0));
    path.arc_to(Point::new(10.0, 0.0), Point::origin(), TAU);
    let lines =
        |path: &Path| gcode_moves(path, &with(GcodeDialect::Grbl), &ModalState::default()).unwrap().lines;
    assert_eq!(lines(&path), ["G3 X-10 Y0 I-10 J0 F1500", "G3 X10 Y0 I10 J0 F1500", "G0"]);
    // Its ends fall on one point: read by centre it would be a full turn.
    let mut path = Path::at(Point::new(10.0, 0.0));
    let end = Point::new(10.0 * 1e-5_f64.cos(), 10.0 * 1e-5_f64.sin());
    path.arc_to(end, Point::origin(), 1e-5);
    assert!(lines(&path).is_empty());
    // A radius of five last places would not stay round.
    let mut path = Path::at(Point::new(0.005, 0.0));
    path.arc_to(Point::new(-0.005, 0.0), Point::origin(), PI);
    let tiny = gcode_moves(&path, &with(GcodeDialect::LinuxCnc), &ModalState::default()).unwrap();
    assert_eq!((tiny.fed_arc_count, tiny.straightened_arc_count), (0, 1));
    assert!(tiny.lines.iter().all(|line| line.starts_with("G0 ")) && tiny.lines.len() > 1);
}

#[test]
fn too_few_decimals_are_reported_or_refined() {
    let mut path = Path::at(Point::new(3.333, 0.777));
    let center = Point::new(21.234_567, 12.345_678);
    let spoke = path.start - center;
    path.arc_to(center + turned(spoke, 2.0), center, 2.0);
    let with_decimals =
        |decimals| GcodeSettings { decimals, unit: GcodeUnit::Inches, ..with(GcodeDialect::Grbl) };
    let moves = |decimals| gcode_moves(&path, &with_decimals(decimals), &ModalState::default());
    let Err(GcodeError::RadiiDiffer { step: 1, decimals: 2, mismatch_mm, tolerance_mm, .. }) = moves(Some(2))
    else {
        panic!("{:?}", moves(Some(2)))
    };
    assert!(mismatch_mm > tolerance_mm && (0.004..0.02).contains(&tolerance_mm));
    assert!(moves(None).unwrap().decimals >= 4);
    let refused = moves(Some(6)).unwrap_err().to_string();
    assert_eq!(refused, "the g-code settings can't be used: decimals is 6: grbl takes 1 to 5 in this unit");
}

fn turned(v: traverse_geometry::Vector, angle: f64) -> traverse_geometry::Vector {
    let (sin, cos) = angle.sin_cos();
    traverse_geometry::Vector::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos)
}

#[test]
fn what_a_controller_would_misread_is_refused() {
    let refused = |settings: &GcodeSettings| write_gcode(&round_a_pin(), settings).unwrap_err().to_string();
    for (dialect, line, why) in [
        (GcodeDialect::Grbl, "(READY?)", "grbl acts on"),
        (GcodeDialect::Grbl, "%", "ends a program"),
        (GcodeDialect::Fanuc, "g54", "no lower case"),
        (GcodeDialect::Fanuc, "G54 ; OFFSET", "ends a block"),
        (GcodeDialect::LinuxCnc, "(A (B))", "nested"),
        (GcodeDialect::LinuxCnc, "(A", "not closed"),
        (GcodeDialect::LinuxCnc, "G54\nM3", "not printable"),
        (GcodeDialect::LinuxCnc, "(Säge)", "not printable"),
    ] {
        let message = refused(&GcodeSettings { header: vec![line.to_owned()], ..with(dialect) });
        assert!(message.contains(why) && message.contains("header is `"), "{message}");
    }
    let diameter = GcodePlane::Zx { x: XWord::Diameter };
    assert!(refused(&GcodeSettings { plane: diameter, ..with(GcodeDialect::Grbl) }).contains("diameter"));
    for feed_mm_per_min in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let straight = StraightMotion::Fed { feed_mm_per_min };
        assert!(refused(&GcodeSettings { straight, ..with(GcodeDialect::Fanuc) }).contains("straight_feed"));
    }
}

#[test]
fn paths_that_make_no_sense_are_refused() {
    let settings = with(GcodeDialect::Grbl);
    let refused = |path: &Path| gcode_moves(path, &settings, &ModalState::default()).unwrap_err();
    let mut path = round_a_pin();
    path.steps[2].end.x = f64::NAN;
    assert!(matches!(refused(&path), GcodeError::NotFinite { step: 3, .. }));
    let mut path = round_a_pin();
    path.steps[1].end.y += 0.01;
    assert!(matches!(refused(&path), GcodeError::ArcContradictsItself { step: 2, .. }));
    let mut path = round_a_pin();
    path.line_to(Point::new(9000.0, 0.0));
    assert!(matches!(refused(&path), GcodeError::NumberTooLarge { step: 4, word: 'X', .. }));
}

#[test]
fn chords_can_be_had_as_a_path() {
    let path = chords_outside(&round_a_pin(), 0.01).unwrap();
    assert!(path.steps.iter().all(|step| step.arc.is_none()));
    assert_eq!((path.start, path.end()), (round_a_pin().start, round_a_pin().end()));
    assert!(path.length() > round_a_pin().length() && path.length() < round_a_pin().length() + 0.05);
    for tolerance_mm in [0.0, 1e-5, 11.0, f64::NAN] {
        assert!(matches!(
            chords_outside(&round_a_pin(), tolerance_mm),
            Err(GcodeError::ChordTolerance { .. })
        ));
        let settings =
            GcodeSettings { arcs: ArcMotion::Chords { tolerance_mm }, ..with(GcodeDialect::LinuxCnc) };
        assert!(matches!(write_gcode(&round_a_pin(), &settings), Err(GcodeError::Settings { .. })));
    }
}

#[test]
fn heights_are_moves_along_z() {
    let mut path = Path::at_height(Point::new(0.0, 0.0), 3.0);
    path.height_to(12.0001);
    path.line_to(Point::new(100.0, 5.0));
    path.height_to(-1.5);
    let settings = GcodeSettings::new(1000.0);
    let moves = gcode_moves(&path, &settings, &ModalState::default()).unwrap();
    // Rounded up: all of the height may be needed.
    assert_eq!(moves.lines, ["G0 Z12.001", "G0 X100 Y5", "G0 Z-1.5"]);
    assert!(write_gcode(&path, &settings).unwrap().text.contains("(TOOL MUST STAND AT X0 Y0 Z3)"));
    let lathe = GcodeSettings { plane: GcodePlane::Zx { x: XWord::Radius }, ..settings.clone() };
    assert_eq!(gcode_moves(&path, &lathe, &ModalState::default()), Err(GcodeError::Heights));
    path.steps[1].z_mm = None;
    assert_eq!(
        gcode_moves(&path, &settings, &ModalState::default()),
        Err(GcodeError::HeightMissing { step: 2 })
    );
}
