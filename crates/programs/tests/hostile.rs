//! Bad input: never a panic, bounded work, errors with line numbers.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

use proptest::prelude::*;
use std::collections::BTreeMap;
use std::time::Instant;
use traverse_drawing::ArcMotion;
use traverse_geometry::{CornerStyle, Obstacle, Point, Polygon, Ring, Scene};
use traverse_programs::{
    PROGRAM_BYTE_LIMIT, Program, ProgramError, ReadOptions, ScenePlanner, ToolScenes, WriteOptions, rewrite,
};
use traverse_solve::Budget;

const SEEDS: [&[u8]; 3] = [
    include_bytes!("../../../docs/examples/programs/plate-and-vise.ngc"),
    include_bytes!("../../../docs/examples/programs/stop-and-plate.nc"),
    include_bytes!("../../../docs/examples/programs/table-engraving.gcode"),
];

/// A row of pins along x.
fn pins(count: u32) -> ToolScenes {
    let obstacles = (0..count).map(|index| {
        let x = 20.0 + 40.0 * f64::from(index);
        let ring = Ring::from_xy(&[x - 5.0, 100.0, x + 5.0, 100.0], &[1.0, 1.0]).unwrap();
        Obstacle {
            id: format!("pin/{index}"),
            shape: Polygon::from_ring(ring),
            clearance_mm: None,
            top_z_mm: None,
        }
    });
    let any = Scene {
        work_area: None,
        obstacles: obstacles.collect(),
        clearance_mm: 5.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    };
    ToolScenes { any, by_tool: BTreeMap::new(), safe_z_mm: None }
}

fn rewritten(bytes: &[u8], scenes: &ToolScenes) -> Option<Vec<u8>> {
    let read = ReadOptions { start: Some(Point::new(0.0, 0.0)), ..ReadOptions::default() };
    let write = WriteOptions { arcs: ArcMotion::Fed { feed_mm_per_min: 5000.0 }, ..WriteOptions::default() };
    let program = Program::read(bytes, &read).ok()?;
    let budget = Budget::unlimited();
    Some(rewrite(&program, &ScenePlanner::new(scenes, &budget), &write).text)
}

#[derive(Clone, Debug)]
enum Damage {
    Cut(usize),
    Byte(usize, u8),
    Insert(usize, &'static [u8]),
    Swap(usize, usize),
}

fn damage() -> impl Strategy<Value = Damage> {
    const PIECES: [&[u8]; 16] = [
        b"(",
        b")",
        b"[",
        b"#",
        b"G91 ",
        b"G20 ",
        b"X",
        b"-",
        b".",
        b"9999999999999",
        b"\r",
        b"\n",
        b"/",
        b"%\n",
        b"O1 IF",
        b"X1e9Y-1000000.0001 ",
    ];
    prop_oneof![
        (0..900_usize).prop_map(Damage::Cut),
        (0..900_usize, any::<u8>()).prop_map(|(at, byte)| Damage::Byte(at, byte)),
        (0..900_usize, prop::sample::select(&PIECES[..])).prop_map(|(at, piece)| Damage::Insert(at, piece)),
        (0..900_usize, 0..900_usize).prop_map(|(a, b)| Damage::Swap(a, b)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn damaged_programs_never_panic(seed in 0..3_usize, damages in prop::collection::vec(damage(), 1..12)) {
        let mut bytes = SEEDS[seed].to_vec();
        for damage in damages {
            match damage {
                Damage::Cut(at) => bytes.truncate(at.max(40)),
                Damage::Byte(at, byte) => {
                    if let Some(place) = bytes.get_mut(at) {
                        *place = byte;
                    }
                }
                Damage::Insert(at, piece) => {
                    let at = at.min(bytes.len());
                    bytes.splice(at..at, piece.iter().copied());
                }
                Damage::Swap(a, b) => {
                    if a.max(b) < bytes.len() {
                        bytes.swap(a, b);
                    }
                }
            }
        }
        rewritten(&bytes, &pins(12));
    }

    #[test]
    fn any_bytes_never_panic(bytes in prop::collection::vec(prop_oneof![
        prop::sample::select(&b"GXYZIJFMNO0123456789.-+ \n\r()[];#/%$"[..]), any::<u8>()
    ], 0..400)) {
        rewritten(&bytes, &pins(2));
    }
}

#[test]
fn what_is_no_program_is_refused_with_its_line() {
    let refused = |bytes: &[u8]| Program::read(bytes, &ReadOptions::default()).unwrap_err();
    assert_eq!(refused(b"G0 X1\nG0\0X2\n"), ProgramError::NoText { line: 2 });
    let utf_16: Vec<u8> = "G0 X1".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert_eq!(refused(&utf_16), ProgramError::NoText { line: 1 });
    assert_eq!(refused(b"Dear Sir,\nthis is a letter.\nYours\n"), ProgramError::NoBlocks);
    let text = refused(b"{\"x\": 1}\n{\"y\": 2}\n").to_string();
    assert!(text.contains("no G-code: 2 lines make no sense, the first is line 1"), "{text}");
    assert!(refused(&vec![b'\n'; PROGRAM_BYTE_LIMIT + 1]).to_string().contains("longer than"));
    assert_eq!(rewritten(b"", &pins(1)).unwrap(), b"");
}

#[test]
fn all_lines_that_make_no_sense_are_told() {
    let long = format!("G1 X1\nG1 X2\nG1 X3\nG1 X4\nG0 X?\n(open\nG1 {}\n", "X1".repeat(3000));
    let program = Program::read(long.as_bytes(), &ReadOptions::default()).unwrap();
    let lines: Vec<u32> = program.faults.iter().map(|(line, _)| *line).collect();
    assert_eq!(lines, [5, 6, 7]);
}

/// A program of so many lines whose rapid moves run into every other pin.
fn long_program(lines: usize) -> String {
    let mut text = String::from("G21 G90 G17\nG0 X0 Y80\nG1 X1 F300\n");
    for index in 0..lines / 4 {
        let x = 40 * (index % 50);
        let y = if index % 2 == 0 { 80 } else { 120 };
        text.push_str(&format!("G0 X{x} Y{y}\nG1 X{}.5 F300\nG1 Y{y}.25\nG1 X{x}\n", x + 1));
    }
    text
}

#[test]
fn time_grows_with_the_lines_and_no_faster() {
    let scenes = pins(60);
    let seconds = |lines: usize| {
        let text = long_program(lines);
        let begin = Instant::now();
        let found = rewritten(text.as_bytes(), &scenes).unwrap();
        assert!(found.len() > text.len());
        begin.elapsed().as_secs_f64()
    };
    let (short, long) = (seconds(10_000), seconds(100_000));
    println!("10 000 lines: {short:.3} s; 100 000 lines: {long:.3} s");
    assert!(long < 40.0 * short.max(0.05), "{short} s and {long} s");
}

#[test]
fn a_million_lines_are_read() {
    let text = "G1 X1.5 Y2.5 (cut)\n".repeat(1_000_000);
    let begin = Instant::now();
    let program = Program::read(text.as_bytes(), &ReadOptions::default()).unwrap();
    println!("1 000 000 lines, {} bytes: {:?}", text.len(), begin.elapsed());
    assert_eq!(program.line_count, 1_000_000);
    let one_line = "X1".repeat(20_000_000);
    assert!(Program::read(one_line.as_bytes(), &ReadOptions::default()).is_err());
}
