//! What is known at which line: modes, cycles, offsets, tools, subprograms, whatever makes a position unknown.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use traverse_drawing::GcodeUnit;
use traverse_geometry::{Point, Vector};
use traverse_programs::{Offsets, Program, ReadOptions};

/// The links as `line: x0,y0 > x1,y1`, the rest as `line! reason`, the lines that make no sense as `line? fault`.
fn followed(text: &str, options: &ReadOptions) -> Vec<String> {
    let program = Program::read(text.as_bytes(), options).unwrap();
    let mut found: Vec<(u32, String)> = Vec::new();
    for link in &program.links {
        let (line, to) = (link.lines().1, link.to());
        let [a, b, c, d] = [link.from.x, link.from.y, to.x, to.y].map(|v| (v * 1e6).round() / 1e6 + 0.0);
        found.push((line, format!("{line}: {a},{b} > {c},{d}")));
    }
    found.extend(program.untouched.iter().map(|(line, reason)| (*line, format!("{line}! {reason}"))));
    found.extend(program.faults.iter().map(|(line, fault)| (*line, format!("{line}? {fault}"))));
    found.sort_by_key(|(line, _)| *line);
    found.into_iter().map(|(_, text)| text).collect()
}

#[track_caller]
fn check(text: &str, expected: &[&str]) {
    let text = format!("G21 G90 G0 X0 Y0\nG1 F100\n{text}");
    let found = followed(&text, &ReadOptions::default());
    let [first, found @ ..] = &found[..] else { panic!("{found:?}") };
    assert!(first.starts_with("1! where the tool stands at first"), "{first}");
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.starts_with(expected), "{found} instead of {expected}");
    }
}

#[test]
fn modes_are_followed() {
    check("G0 X10\nY5", &["4: 0,0 > 10,5"]);
    check("G91 G0 X10\nG90 X10.5", &["4: 0,0 > 10.5,0"]);
    check("G20 G0 X1\nG21 G1 X1\nG0 X2", &["3: 0,0 > 25.4,0", "5: 1,0 > 2,0"]);
    check("G1 X5\nG0 (to) Y-1.5;x", &["4: 5,0 > 5,-1.5"]);
    check("G2 X10 Y0 I5\nG0 X0", &["4: 10,0 > 0,0"]);
    check("G3 X10 Y0 R5\nG0 X0", &["4: 10,0 > 0,0"]);
    check("G18 G2 X10 Z3 I5\nG0 X0", &["4: 10,0 > 0,0"]);
    check("g00x 1 0 y.5\n g 1 x 2 0 \nx30\ng0y0", &["3: 0,0 > 10,0.5", "6: 30,0.5 > 30,0"]);
    check("G4 X3\nG0 X5", &["4: 0,0 > 5,0"]);
    check("X5\nG0 X9", &["4: 5,0 > 9,0"]);
    check(
        "G80 X5\nG0 X9",
        &["3! whether it moves rapidly", "4! where it begins is not known since line 3: a move whose end"],
    );
}

#[test]
fn runs_end_where_something_is_done() {
    check("G0 X10\nM8\nX20", &["3: 0,0 > 10,0", "5: 10,0 > 20,0"]);
    check("G0 X10\n\n(note)\nN7\nX20", &["7: 0,0 > 20,0"]);
    check("G0 X10 M8\nX20", &["3: 0,0 > 10,0", "4: 10,0 > 20,0"]);
    check("G0 X10\nZ5\nX20", &["3: 0,0 > 10,0", "5: 10,0 > 20,0"]);
    check("G0 X10 (traverse: keep)\nX20", &["3: 0,0 > 10,0", "4: 10,0 > 20,0"]);
}

#[test]
fn retract_and_plunge_are_seen_beside_a_link() {
    let text = b"G0 X0 Y0 Z1\nG1 X1\nG0 Z5\nX10\nY10\nZ1\nG1 X2\nG0 X3\n";
    let program = Program::read(text, &ReadOptions::default()).unwrap();
    let seen: Vec<_> =
        program.links.iter().map(|link| (link.retract_line, link.lines(), link.plunge_line)).collect();
    assert_eq!(seen, [(Some(3), (4, 5), Some(6)), (None, (8, 8), None)]);
    assert_eq!(program.links[0].heights.lowest(), Some(5.0));
}

#[test]
fn cycles_end_at_their_holes() {
    check(
        "G0 Z10\nG81 X10 Y5 Z-3 R2 F100\nX20\nG80\nG0 X30",
        &["4: 0,0 > 10,5", "5: 10,5 > 20,5", "7: 20,5 > 30,5"],
    );
    check("G91 G81 X10 Z-3 R-1 L3\nG80\nG90 G0 X30", &["3: 0,0 > 10,0", "5! where it begins is not known"]);
    check("G83 X10 Z-3 R2 Q1\nG0 X30", &["3: 0,0 > 10,0", "4: 10,0 > 30,0"]);
    let text = b"G0 X0 Y0 Z10\nG1 X1\nG99 G81 X10 Y5 Z-3 R2\nG0 X20 Y20\nG98 G81 X0 Y0 R2 Z-3\nG0 X5 Y5\n";
    let program = Program::read(text, &ReadOptions::default()).unwrap();
    let heights: Vec<_> = program.links.iter().map(|link| link.heights.lowest()).collect();
    assert_eq!(heights, [Some(10.0), Some(2.0), Some(2.0), Some(2.0)]);
}

#[test]
fn what_is_not_known_is_not_guessed() {
    let begins = "! where it begins is not known since line";
    for (text, expected) in [
        ("T1 M6\nG0 X5 Y5\nX6", vec![format!("4{begins} 3: a tool change"), "5: 5,5 > 6,5".to_owned()]),
        ("G28 X0\nG0 X5\nY6", vec![format!("4{begins} 3: a move to a place"), "5: 5,0 > 5,6".to_owned()]),
        ("G28\nG0 X5\nY6", vec![format!("4{begins} 3"), format!("5{begins} 3")]),
        ("G91 G28 Z0\nG90 G0 X5", vec!["4: 0,0 > 5,0".to_owned()]),
        ("G53 G0 X5\nG0 X5\nX6", vec![format!("4{begins} 3"), "5: 5,0 > 6,0".to_owned()]),
        ("M98 P100\nG90 G0 X5 Y5\nX6", vec![format!("4{begins} 3: a subprogram"), "5: 5,5 > 6,5".to_owned()]),
        (
            "M98 P100\nG0 X5 Y5\nG90 X6 Y6\nX7",
            vec![format!("4{begins} 3"), format!("5{begins} 4"), "6: 6,6 > 7,6".to_owned()],
        ),
        ("G65 P9000 X5\nG90 G0 X6 Y6", vec![format!("4{begins} 3")]),
        ("o100 call [3]\nG90 G0 X6 Y6", vec![format!("4{begins} 3")]),
        ("#1=5\nG0 X5", vec!["4: 0,0 > 5,0".to_owned()]),
        ("#5221=5\nG0 X5", vec!["4! the program sets offsets itself".to_owned()]),
        ("G10 L2 P1 X5\nG0 X5", vec!["4! the program sets offsets itself".to_owned()]),
        (
            "G0 X#1\nX5",
            vec!["3! where it ends is not known: a variable".to_owned(), format!("4{begins} 3: a variable")],
        ),
        ("G0 X[1+2] Y5\nX5", vec!["3! where it ends".to_owned(), format!("4{begins} 3: a variable")]),
        (
            "G41 D1 G1 X5\nG0 X9\nG40 G1 X20\nG0 X0",
            vec!["4! cutter compensation".to_owned(), format!("6{begins} 4")],
        ),
        ("G92 X0\nG0 X5", vec!["4! the origin was shifted (G92 or G52) since line 3".to_owned()]),
        ("G92 X0\nG92.1\nG0 X5 Y5", vec!["5: 0,0 > 5,5".to_owned()]),
        (
            "G68 X0 Y0 R45\nG0 X5\nG69\nG0 X5 Y5\nX6",
            vec!["4! coordinates are turned".to_owned(), format!("6{begins} 4"), "7: 5,5 > 6,5".to_owned()],
        ),
        (
            "G55\nG0 X5\nG54\nG0 X6 Y6\nX7",
            vec![
                "4! where it ends is not known: a work offset".to_owned(),
                format!("6{begins} 4: a work offset"),
                "7: 6,6 > 7,6".to_owned(),
            ],
        ),
        ("G0 A90\nG0 X5", vec!["4! a turning axis does not stand at 0".to_owned()]),
        ("G38.2 Z-5 F10\nG90 G0 X5 Y5", vec![format!("4{begins} 3")]),
        (
            "/G1 X5\nG0 X9 Y0\nX10",
            vec![format!("4{begins} 3: a block that may be skipped"), "5: 9,0 > 10,0".to_owned()],
        ),
        ("/G0 X5\nX0", vec!["3: 0,0 > 5,0".to_owned(), "4! whether it moves rapidly".to_owned()]),
        ("G123\nG0 X5", vec![format!("4{begins} 3: a move whose end")]),
        (
            "G1 X\nG90 G0 X5 Y1\nX6",
            vec![
                "3? X has no number".to_owned(),
                format!("4{begins} 3: a line that was not"),
                "5: 5,1 > 6,1".to_owned(),
            ],
        ),
        ("G0 G1 X5\nG90 G0 X5 Y1", vec!["3? two G codes".to_owned(), format!("4{begins} 3")]),
        ("N10 G0 X5\nGOTO 10\nX6", vec![format!("3{begins} 3"), "5! whether it".to_owned()]),
        ("M30\nG90 G0 X5 Y5", vec![format!("4{begins} 3")]),
    ] {
        let expected: Vec<&str> = expected.iter().map(String::as_str).collect();
        eprintln!("{text}");
        check(text, &expected);
    }
}

#[test]
fn nothing_is_read_behind_the_end_of_the_tape() {
    let text = "%\nG0 X0 Y0\nX5\nM30\n%\nG0 X7 Y7\nX8\n";
    assert_eq!(followed(text, &ReadOptions::default()).len(), 2);
}

#[test]
fn options_say_what_the_text_does_not() {
    let mut options = ReadOptions::new(GcodeUnit::Inches);
    options.start = Some(Point::new(1.0, 2.0));
    let mut offsets = Offsets::default();
    offsets.set(1, Vector::new(100.0, 50.0));
    offsets.set(200, Vector::new(1.0, 1.0));
    options.offsets = offsets;
    assert_eq!(
        followed("G90 G0 X1 Y1\nG1 X2\nG21\nG55 G0 X5\nG1 X6\nG54 G0 X0 Y0\n", &options),
        ["1: 1,2 > 25.4,25.4", "4: 50.8,25.4 > 105,25.4", "6: 106,25.4 > 0,0"]
    );
}

#[test]
fn numbers_without_a_point_are_not_trusted_on_fanuc() {
    let found = followed("O0001\nG90 G00 X0 Y0\nX10.\nX20\nG90 G00 X30. Y1.\n", &ReadOptions::default());
    assert!(found[2].starts_with("4? the number of X has no point"), "{found:?}");
    assert!(found[3].starts_with("5! where it begins is not known since line 4"), "{found:?}");
}

#[test]
fn cycles_in_other_planes_lose_the_position() {
    let begins = "! where it begins is not known since line 4: a move whose end";
    for plane in ["G18", "G19"] {
        let text = format!("{plane}\nG98 G81 X10 Z0 Y-40 R5\nG80\nG17\nG0 X100 Y5\nX101");
        check(&text, &["4! a canned cycle", &format!("7{begins}"), "8: 100,5 > 101,5"]);
    }
    check("M98 P1\nG90 G81 X10 Y5 Z-3 R2\nG80", &["4! a canned cycle"]);
}

#[test]
fn settings_without_axis_words_distort() {
    check("G10 L2 P1 R90\nG1 X10 Y0\nG0 X100 Y0", &["5! the program sets offsets itself"]);
}

#[test]
fn what_moves_without_a_motion_is_told() {
    check("G81 X1 Y0 Z-1 R2\nG80\nX100 Y0", &["3: 0,0 > 1,0", "5! whether it moves rapidly"]);
}

/// The heights of links, in order.
fn heights(text: &str, options: &ReadOptions) -> Vec<Option<f64>> {
    let program = Program::read(text.as_bytes(), options).unwrap();
    program.links.iter().map(|link| link.heights.lowest()).collect()
}

#[test]
fn heights_are_lost_where_they_count_from_elsewhere() {
    let start = "G21 G90 G54\nG0 X0 Y0 Z80\nG1 X1 F100\n";
    let mut options = ReadOptions { start: Some(Point::new(0.0, 0.0)), ..ReadOptions::default() };
    options.offsets.set(1, Vector::new(0.0, 0.0));
    let behind = |lines: &str| heights(&format!("{start}{lines}G0 X100 Y0\n"), &options).pop().unwrap();
    assert_eq!(behind(""), Some(80.0));
    assert_eq!(behind("G54\n"), Some(80.0));
    assert_eq!(behind("G55\n"), None);
    assert_eq!(behind("G55\nG54\n"), None);
    assert_eq!(behind("G55 G0 Z40\n"), Some(40.0));
    for lines in ["G92 Z100\nG0 Z102\nG92.1\n", "G92 Z100\nG92.2\n", "G51 Z2\nG0 Z9\nG50\n"] {
        assert_eq!(behind(&format!("{lines}G1 X1 Y0\n")), None, "{lines}");
    }
}

#[test]
fn m61_names_the_tool() {
    let tools = |lines: &str| {
        let text = format!("G21 G90\nG0 X0 Y0\nT1 M6\n{lines}\nG1 X1 Y0 F100\nG0 X100\n");
        let program = Program::read(text.as_bytes(), &ReadOptions::default()).unwrap();
        program.links.last().map(|link| link.tool)
    };
    assert_eq!(tools(""), Some(Some(1)));
    assert_eq!(tools("M61 Q2"), Some(Some(2)));
    assert_eq!(tools("M61 Q#5"), Some(None));
}

#[test]
fn nothing_is_inserted_before_a_byte_order_mark() {
    use traverse_geometry::{CornerStyle, Obstacle, Polygon, Ring, Scene};
    use traverse_programs::{ScenePlanner, ToolScenes, WriteOptions, rewrite};
    let clamp = Ring::from_xy(&[40.0, -10.0, 60.0, -10.0, 60.0, 30.0, 40.0, 30.0], &[]).unwrap();
    let shape = Polygon::from_ring(clamp);
    let any = Scene {
        work_area: None,
        obstacles: vec![Obstacle { id: "clamp".into(), shape, clearance_mm: None, top_z_mm: None }],
        clearance_mm: 5.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    };
    let scenes = ToolScenes { any, by_tool: Default::default(), safe_z_mm: None };
    let options = ReadOptions { start: Some(Point::new(0.0, 0.0)), ..ReadOptions::default() };
    let program = Program::read("\u{feff}G21 G90 G0 X100 Y0\nG1 X110 F100\n".as_bytes(), &options).unwrap();
    let budget = traverse_solve::Budget::unlimited();
    let text = rewrite(&program, &ScenePlanner::new(&scenes, &budget), &WriteOptions::default()).text;
    let text = String::from_utf8(text).unwrap();
    assert!(text.starts_with("\u{feff}G0 X"), "{text}");
    assert_eq!(text.matches('\u{feff}').count(), 1);
}
