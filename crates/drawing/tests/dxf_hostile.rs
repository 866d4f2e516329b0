//! Files made to hurt, and files that were hurt.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use proptest::prelude::*;
use std::fmt::Write;
use std::time::{Duration, Instant};
use traverse_drawing::{Drawing, ReadError, ReadOptions, WhyUnused, read_dxf};

const LINE: &str = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n1\n";

fn file(blocks: &str, entities: &str) -> String {
    format!(
        "0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    )
}

fn block(name: &str, inside: &str) -> String {
    format!("0\nBLOCK\n2\n{name}\n{inside}0\nENDBLK\n")
}

fn insert(name: &str, rest: &str) -> String {
    format!("0\nINSERT\n8\n0\n2\n{name}\n{rest}")
}

/// Reads, and within five seconds.
fn read(text: &str) -> Result<Drawing, ReadError> {
    let begun = Instant::now();
    let drawing = read_dxf(text.as_bytes(), &ReadOptions::default());
    assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", begun.elapsed());
    drawing
}

#[test]
fn blocks_that_hold_themselves_are_named() {
    let blocks = block("A", &insert("B", ""))
        + &block("B", &(LINE.to_owned() + &insert("c", "")))
        + &block("C", &insert("B", "70\n1000\n"));
    let error = read(&file(&blocks, &insert("A", ""))).unwrap_err();
    let names = ["B", "C", "B"].map(str::to_owned).to_vec();
    assert_eq!(error, ReadError::BlockCycle { blocks: names });
    assert!(error.to_string().starts_with("block B → C → B holds itself"));
    let own = block("A", &insert("A", ""));
    assert!(matches!(read(&file(&own, &insert("A", ""))), Err(ReadError::BlockCycle { .. })));
    // Nobody draws it.
    assert_eq!(read(&file(&own, LINE)).unwrap().curve_count(), 1);
    // A ring of thousands is named by its beginning and end.
    let ring: String =
        (0..5000).map(|i| block(&format!("R{i}"), &insert(&format!("R{}", (i + 1) % 5000), ""))).collect();
    let Err(ReadError::BlockCycle { blocks }) = read(&file(&ring, &insert("R0", ""))) else { panic!() };
    assert_eq!(blocks, ["R0", "R1", "R2", "R3", "…", "R4997", "R4998", "R4999", "R0"]);
}

#[test]
fn arrays_within_arrays_are_counted_before_they_are_drawn() {
    let array = "70\n32767\n71\n32767\n44\n1\n45\n1\n";
    let too_many = Err(ReadError::TooManyEntities { limit: 400_000 });
    let nested = block("A", LINE) + &block("B", &insert("A", array)) + &block("C", &insert("B", array));
    assert_eq!(read(&file(&nested, &insert("C", array))), too_many);
    // Nothing in it, but it would take for ever.
    let empty = block("A", "") + &block("B", &insert("A", array)) + &block("C", &insert("B", array));
    assert_eq!(read(&file(&empty, &insert("C", array))), too_many);
    // Twice each, 63 times.
    let mut doubled = block("D0", LINE);
    for i in 1..64 {
        doubled += &block(&format!("D{i}"), &insert(&format!("D{}", i - 1), "").repeat(2));
    }
    assert_eq!(read(&file(&doubled, &insert("D63", ""))), too_many);
    let wide = format!("70\n{0}\n71\n{0}\n", i64::MAX);
    assert_eq!(read(&file(&block("A", LINE), &insert("A", &wide))), too_many);
    let polyline = format!("0\nLWPOLYLINE\n8\n0\n{}", "10\n1\n20\n1\n".repeat(100));
    let vertices = file(&block("A", &polyline), &insert("A", "70\n30000\n"));
    assert_eq!(read(&vertices), Err(ReadError::TooManyVertices { limit: 2_000_000 }));
    // Negative counts are one.
    assert_eq!(read(&file(&block("A", LINE), &insert("A", "70\n-5\n71\n0\n"))).unwrap().curve_count(), 1);
}

/// Blocks in blocks, 10 000 deep.
fn chain(inside: &str) -> String {
    let mut blocks = block("N0", LINE);
    for i in 1..10_000 {
        let inside = inside.to_owned() + &insert(&format!("N{}", i - 1), "10\n0.01\n20\n0\n");
        blocks += &block(&format!("N{i}"), &inside);
    }
    file(&blocks, &insert("N9999", ""))
}

#[test]
fn any_depth_is_drawn_within_bounds() {
    let drawing = read(&chain("")).unwrap();
    let curve = &drawing.layers[0].curves[0];
    assert_eq!(curve.source.groups.len(), 10_000);
    assert!((curve.vertices[0].x - 99.99).abs() < 1e-6);
    // A line on every level would take a gigabyte of names.
    assert_eq!(read(&chain(LINE)), Err(ReadError::TooMuchNesting { limit: 64 << 20 }));
}

#[test]
fn shapes_that_contradict_themselves_or_are_too_long() {
    let mut spline = "0\nSPLINE\n8\n0\n71\n1000\n".to_owned();
    for i in 0..3000 {
        write!(spline, "40\n{i}\n10\n{i}\n20\n0\n").unwrap();
    }
    assert_eq!(read(&file("", &spline)).unwrap().unused[0].why, WhyUnused::Inconsistent);
    let many = "10\n1\n20\n1\n".repeat(3_000_000);
    let too_many = Err(ReadError::TooManyVertices { limit: 2_000_000 });
    assert_eq!(read(&file("", &format!("0\nLWPOLYLINE\n{many}"))), too_many);
    assert_eq!(read(&file("", &format!("0\nSPLINE\n{many}"))), too_many);
    let vertices = "0\nVERTEX\n10\n1\n20\n1\n".repeat(2_100_000);
    assert_eq!(read(&file("", &format!("0\nPOLYLINE\n{vertices}"))), too_many);
    // A spline that needs more arcs than are allowed.
    let wild: String = (0..2000).map(|i| format!("11\n{}\n21\n{}\n", i, (i % 2) * 900_000)).collect();
    let mut options = ReadOptions::default();
    options.vertex_limit = 5000;
    let found = read_dxf(file("", &format!("0\nSPLINE\n{wild}")).as_bytes(), &options);
    assert_eq!(found, Err(ReadError::TooManyVertices { limit: 5000 }));
    for wrong in ["nan", "1e308", "-inf"] {
        let ellipse = format!("0\nELLIPSE\n10\n0\n20\n0\n11\n{wrong}\n21\n3\n40\n0.5\n");
        let through = format!("0\nSPLINE\n11\n0\n21\n0\n11\n5\n21\n{wrong}\n11\n7\n21\n0\n");
        let placed = insert("A", &format!("10\n{wrong}\n20\n0\n"));
        for entity in [ellipse, through, placed] {
            let found = read(&file(&block("A", LINE), &entity));
            assert!(matches!(found, Err(ReadError::NumberOutOfRange { .. })), "{entity}: {found:?}");
        }
    }
}

/// Files of all kinds, whole: every entity in blocks and outside.
fn whole() -> Vec<u8> {
    let shapes = "0\nCIRCLE\n8\nA\n5\n1F\n10\n5\n20\n5\n40\n2\n62\n3\n0\nARC\n8\nA\n10\n0\n20\n0\n40\n4\n50\n10\n51\n200\n230\n-1\n\
        0\nELLIPSE\n8\nB\n10\n1\n20\n1\n11\n9\n21\n2\n40\n0.3\n41\n0.5\n42\n4\n0\nLWPOLYLINE\n8\nA\n90\n3\n70\n1\n\
        10\n0\n20\n0\n42\n0.5\n10\n9\n20\n0\n10\n9\n20\n7\n42\n-2\n0\nPOLYLINE\n8\nB\n66\n1\n70\n1\n0\nVERTEX\n10\n1\n20\n1\n\
        0\nVERTEX\n10\n3\n20\n1\n42\n1\n0\nVERTEX\n10\n3\n20\n5\n0\nSEQEND\n0\nSPLINE\n8\nA\n70\n8\n71\n3\n40\n0\n40\n0\n40\n0\n\
        40\n0\n40\n1\n40\n2\n40\n2\n40\n2\n40\n2\n10\n0\n20\n0\n10\n3\n20\n9\n10\n8\n20\n1\n10\n7\n20\n-4\n10\n15\n20\n0\n\
        0\nSPLINE\n8\nA\n70\n8\n71\n3\n11\n0\n21\n0\n11\n5\n21\n4\n11\n9\n21\n-3\n12\n1\n22\n1\n0\nHATCH\n8\nA\n71\n1\n91\n1\n92\n1\n\
        97\n1\n330\n1F\n75\n0\n0\nTEXT\n8\nA\n1\nhi\n";
    let inner = insert("S", "10\n4\n20\n4\n41\n2\n42\n-3\n50\n33\n");
    let placed = insert("T", "10\n1\n20\n2\n70\n2\n71\n3\n44\n50\n45\n40\n50\n15\n");
    let blocks = block("S", shapes) + &block("T", &inner);
    let head = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n9\n$DWGCODEPAGE\n3\nANSI_1252\n0\nENDSEC\n\
        0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nA\n62\n3\n0\nENDTAB\n0\nENDSEC\n";
    (head.to_owned() + &file(&blocks, &(LINE.to_owned() + shapes + &placed))).into_bytes()
}

/// The same groups in binary, codes of two bytes or one.
fn binary(text: &[u8], two_bytes: bool) -> Vec<u8> {
    let mut bytes = b"AutoCAD Binary DXF\r\n\x1a\0".to_vec();
    let text = String::from_utf8(text.to_vec()).unwrap();
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    for group in lines.chunks(2) {
        let code: u16 = group[0].parse().unwrap();
        bytes.extend(&code.to_le_bytes()[..if two_bytes { 2 } else { 1 }]);
        match code {
            10..=59 | 210..=239 => bytes.extend(group[1].parse::<f64>().unwrap().to_le_bytes()),
            60..=79 => bytes.extend(group[1].parse::<i16>().unwrap().to_le_bytes()),
            90..=99 => bytes.extend(group[1].parse::<i32>().unwrap().to_le_bytes()),
            330 if !two_bytes => {
                // R12 has no such code.
                bytes.pop();
                bytes.extend([255, 74, 1]);
                bytes.extend(group[1].as_bytes());
                bytes.push(0);
            }
            _ => {
                bytes.extend(group[1].as_bytes());
                bytes.push(0);
            }
        }
    }
    bytes
}

#[test]
fn binary_files_say_what_their_text_says() {
    let text = whole();
    let options = ReadOptions::default();
    let from_text = read_dxf(&text, &options).unwrap();
    assert_eq!(from_text.curve_count(), 1 + 7 + 6 * 7);
    assert_eq!(read_dxf(&binary(&text, true), &options).unwrap(), from_text);
    assert_eq!(read_dxf(&binary(&text, false), &options).unwrap(), from_text);
}

/// One thing that happens to a file; places are shares of its length.
#[derive(Clone, Debug)]
enum Damage {
    Byte(f64, u8),
    Cut(f64),
    DropGroups(f64, usize),
    RepeatGroups(f64, usize),
    Number(f64, &'static str),
}

fn damage() -> impl Strategy<Value = Damage> {
    let numbers = ["nan", "1e308", "-1", "0", "-1e308", "inf", "32767", "99999999999999999999", "1e-308", ""];
    let share = 0.0..1.0;
    prop_oneof![
        (share.clone(), any::<u8>()).prop_map(|(at, byte)| Damage::Byte(at, byte)),
        share.clone().prop_map(Damage::Cut),
        (share.clone(), 1_usize..20).prop_map(|(at, count)| Damage::DropGroups(at, count)),
        (share.clone(), 1_usize..40).prop_map(|(at, count)| Damage::RepeatGroups(at, count)),
        (share, prop::sample::select(numbers.to_vec())).prop_map(|(at, number)| Damage::Number(at, number)),
    ]
}

/// What is left of a text file; groups are pairs of lines.
fn damaged(text: &[u8], damage: &Damage) -> Vec<u8> {
    let place = |share: f64, count: usize| ((share * count as f64) as usize).min(count.saturating_sub(1));
    let mut bytes = text.to_vec();
    let lines: Vec<&[u8]> = text.split(|&b| b == b'\n').collect();
    let mut groups: Vec<Vec<&[u8]>> = lines.chunks(2).map(<[_]>::to_vec).collect();
    let count = groups.len();
    match *damage {
        Damage::Byte(at, byte) => {
            let at = place(at, bytes.len());
            bytes.splice(at..(at + 1).min(bytes.len()), [byte]);
            return bytes;
        }
        Damage::Cut(at) => {
            bytes.truncate(place(at, bytes.len()));
            return bytes;
        }
        Damage::DropGroups(at, few) => {
            let at = place(at, count);
            groups.drain(at..(at + few).min(count));
        }
        Damage::RepeatGroups(at, few) => {
            let at = place(at, count);
            let piece = groups[at..(at + few).min(count)].to_vec();
            groups.splice(at..at, piece);
        }
        Damage::Number(at, number) => {
            if let Some(value) = groups[place(at, count)].get_mut(1) {
                *value = number.as_bytes();
            }
        }
    }
    groups.concat().join(&b'\n')
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(800))]

    #[test]
    fn damaged_files_are_read_or_refused(
        damages in prop::collection::vec(damage(), 1..5),
        kind in 0..3,
        bytes in prop::collection::vec((0.0..1.0, any::<u8>()), 0..4),
    ) {
        let text = damages.iter().fold(whole(), |text, damage| damaged(&text, damage));
        let mut file = match kind {
            0 => text,
            // Text that still has a meaning in binary; the bytes are hurt afterwards.
            _ => binary(&whole(), kind == 1),
        };
        if kind != 0 {
            for (share, byte) in bytes {
                let at = (share * file.len() as f64) as usize;
                file[at] = byte;
            }
        }
        let mut options = ReadOptions::default();
        options.entity_limit = 2000;
        options.vertex_limit = 20_000;
        let begun = Instant::now();
        if let Ok(drawing) = read_dxf(&file, &options) {
            let curves = || drawing.layers.iter().flat_map(|layer| &layer.curves);
            prop_assert!(curves().count() <= 2000);
            prop_assert!(curves().map(|curve| curve.vertices.len()).sum::<usize>() <= 20_000);
            for curve in curves() {
                prop_assert!(curve.vertices.len() >= 2 && curve.bulges.len() == curve.vertices.len());
                prop_assert!(curve.vertices.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
                prop_assert!(curve.bulges.iter().all(|bulge| bulge.abs() <= 1.0));
            }
        }
        prop_assert!(begun.elapsed() < Duration::from_secs(2));
    }
}
