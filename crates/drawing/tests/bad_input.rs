//! Whatever arrives is read or refused with a reason, within bounds.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod random;

use random::Random;
use traverse_drawing::{
    LengthUnit, ReadError, ReadOptions, SceneError, SceneOptions, Shown, WhyUnused, picture_of_plan,
    read_dxf, read_dxf_from, scene_from_drawing,
};

fn read(bytes: &[u8]) -> Result<traverse_drawing::Drawing, ReadError> {
    read_dxf(bytes, &ReadOptions::default())
}

fn with_entities(entities: &str) -> String {
    format!("0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

fn bundled() -> Vec<Vec<u8>> {
    ["vise-and-clamps", "turned-shaft", "leather-hide"]
        .map(|name| format!("{}/../../drawings/{name}.dxf", env!("CARGO_MANIFEST_DIR")))
        .map(|path| std::fs::read(path).unwrap())
        .to_vec()
}

#[test]
fn other_files_are_named() {
    for (bytes, found) in [
        (&b"<!DOCTYPE html>\n<html><body>404</body></html>"[..], "a web page (HTML)"),
        (b"<?xml version=\"1.0\"?>\n<svg/>", "an SVG drawing"),
        (b"<?xml version=\"1.0\"?>\n<kml/>", "an XML file"),
        (b"AC1027\0\0\0", "a DWG drawing"),
        (b"%PDF-1.7", "a PDF file"),
        (b"PK\x03\x04", "a compressed archive"),
        (b"AutoCAD Binary DXF", "a damaged binary DXF file"),
        (&[0; 4096], "binary data"),
        (&[0xff; 4096], "binary data"),
        (b"\xff\xfe0\0\r\0\n\0S\0", "text in UTF-16, which DXF never is"),
        (b"\xfe\xff\x000\0\r\0\n", "text in UTF-16, which DXF never is"),
        (b" \0 \x000\0\r\0\n\0", "text in UTF-16, which DXF never is"),
        (b"hello", "some other text"),
        (b"nan\nnan\n", "some other text"),
    ] {
        assert_eq!(read(bytes), Err(ReadError::NotDxf { found }));
    }
    for empty in [&b""[..], b"\n", b" \r\n\t\r\n", b"\xef\xbb\xbf"] {
        assert_eq!(read(empty), Err(ReadError::Empty));
    }
    assert!(matches!(read(b"AutoCAD Binary DXF\r\n\x1a\0"), Err(ReadError::Truncated { .. })));
    assert!(matches!(read("0\n".repeat(5000).as_bytes()), Err(ReadError::Malformed { .. })));
}

#[test]
fn truncated_files_are_refused_wherever_they_end() {
    for file in bundled() {
        assert!(read(&file).is_ok());
        for length in (0..file.len() - 4).step_by(97) {
            assert!(read(&file[..length]).is_err(), "{length} of {}", file.len());
        }
    }
}

#[test]
fn numbers_out_of_range_are_refused_with_layer_and_value() {
    for (text, expected) in
        [("nan", f64::NAN), ("1e308", 1e308), ("-inf", f64::NEG_INFINITY), ("1000001", 1_000_001.0)]
    {
        let file = with_entities(&format!("0\nCIRCLE\n8\nPINS\n10\n{text}\n20\n0\n40\n1\n"));
        let error = read(file.as_bytes()).unwrap_err();
        let words = error.to_string();
        let ReadError::NumberOutOfRange { line, entity, layer, field, value, .. } = error else {
            panic!("{text}")
        };
        assert_eq!((line, entity, layer.as_str(), field), (6, "CIRCLE", "PINS", "x"));
        assert!(words.starts_with("line 6: CIRCLE on layer PINS: x is ") && words.len() < 120, "{words}");
        assert!(value == expected || value.is_nan() && expected.is_nan());
    }
    let file = with_entities("0\nLWPOLYLINE\n8\nA\n70\n1\n10\n0\n20\n0\n42\ninf\n10\n9\n20\n0\n");
    assert!(matches!(read(file.as_bytes()), Err(ReadError::NumberOutOfRange { field: "bulge", .. })));
    let file = with_entities("0\nLINE\n8\nA\n10\nabc\n");
    let Err(ReadError::Malformed { line, message }) = read(file.as_bytes()) else { panic!() };
    assert_eq!((line, message.as_str()), (10, "group 10 should hold a number but holds `abc`"));
    // A count that lies does no harm.
    let file = with_entities(
        "0\nLWPOLYLINE\n8\nA\n90\n2147483647\n70\n1\n10\n0\n20\n0\n10\n9\n20\n0\n10\n9\n20\n9\n",
    );
    assert_eq!(read(file.as_bytes()).unwrap().curve_count(), 1);
}

#[test]
fn limits_hold() {
    let circle = "0\nCIRCLE\n8\nA\n10\n0\n20\n0\n40\n1\n";
    let file = with_entities(&circle.repeat(50));
    let mut options = ReadOptions::default();
    options.entity_limit = 49;
    assert_eq!(read_dxf(file.as_bytes(), &options), Err(ReadError::TooManyEntities { limit: 49 }));
    options = ReadOptions::default();
    options.vertex_limit = 49;
    assert_eq!(read_dxf(file.as_bytes(), &options), Err(ReadError::TooManyVertices { limit: 49 }));
    options = ReadOptions::default();
    options.byte_limit = 100;
    assert_eq!(read_dxf(file.as_bytes(), &options), Err(ReadError::TooLong { limit: 100 }));
    assert_eq!(read_dxf_from(std::io::repeat(b'0'), &options), Err(ReadError::TooLong { limit: 100 }));
}

#[test]
fn everything_else_is_counted() {
    let file = with_entities(
        "0\nHATCH\n8\nA\n10\nx\n0\nCIRCLE\n8\nB\n10\n0\n20\n0\n40\n1\n210\n1\n230\n0\n0\nHATCH\n8\nA\n0\nLINE\n8\nB\n10\n1\n20\n1\n11\n1\n21\n1\n\
         0\nPOLYLINE\n8\nC\n0\nVERTEX\n8\nC\n0\nVERTEX\n8\nC\n0\nSEQEND\n0\nTEXT\n8\nC\n1\nhi\n0\nCIRCLE\n8\nB\n67\n1\n40\n1\n",
    );
    let drawing = read(file.as_bytes()).unwrap();
    let unused: Vec<_> = drawing
        .unused
        .iter()
        .map(|each| (each.layer.as_str(), each.entity.as_str(), each.why, each.count))
        .collect();
    assert_eq!(
        unused,
        [
            ("A", "HATCH", WhyUnused::Type, 2),
            ("B", "CIRCLE", WhyUnused::Extrusion, 1),
            ("B", "CIRCLE", WhyUnused::PaperSpace, 1),
            ("B", "LINE", WhyUnused::NoLength, 1),
            ("C", "POLYLINE", WhyUnused::NoLength, 1),
            ("C", "TEXT", WhyUnused::Annotation, 1),
        ]
    );
    assert_eq!(drawing.curve_count(), 0);
    let made = scene_from_drawing(&drawing, &SceneOptions::new(1.0)).unwrap();
    assert!(!made.report.is_complete());
}

#[test]
fn units_are_converted_or_assumed_and_said() {
    let file = |units: &str, size: f64| {
        let header = if units.is_empty() {
            String::new()
        } else {
            format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{units}\n0\nENDSEC\n")
        };
        header + &with_entities(&format!("0\nCIRCLE\n8\nA\n10\n{size}\n20\n0\n40\n{size}\n"))
    };
    for (units, size, millimetres, assumed) in [
        ("", 7.0, 7.0, true),
        ("0", 7.0, 7.0, true),
        ("99", 7.0, 7.0, true),
        ("1", 2.0, 50.8, false),
        ("4", 7.0, 7.0, false),
        ("5", 7.0, 70.0, false),
        ("6", 7.0, 7000.0, false),
    ] {
        let drawing = read(file(units, size).as_bytes()).unwrap();
        assert_eq!(drawing.unit_assumed, assumed, "{units}");
        let made = scene_from_drawing(&drawing, &SceneOptions::new(1.0)).unwrap();
        let bounds = made.scene.obstacles[0].shape.bounds();
        assert!((bounds.max.x - 2.0 * millimetres).abs() < 1e-9, "{units}");
    }
    let mut options = ReadOptions::default();
    options.default_unit = LengthUnit::INCHES;
    let drawing = read_dxf(file("", 1.0).as_bytes(), &options).unwrap();
    assert!((drawing.layers[0].curves[0].length() - 25.4 * std::f64::consts::TAU).abs() < 1e-9);
}

#[test]
fn a_work_area_must_be_one_loop() {
    let line = "0\nLINE\n8\nTable\n10\n0\n20\n0\n11\n9\n21\n0\n";
    let circle = |x: i32| format!("0\nCIRCLE\n8\nTable\n10\n{x}\n20\n0\n40\n1\n");
    let scene = |entities: &str| {
        let drawing = read(with_entities(entities).as_bytes()).unwrap();
        scene_from_drawing(&drawing, &SceneOptions::new(1.0))
    };
    assert!(matches!(scene(line), Err(SceneError::NoWorkAreaLoop { .. })));
    assert!(matches!(scene(&(circle(0) + &circle(5))), Err(SceneError::SeveralWorkAreas { count: 2, .. })));
    assert!(scene(&circle(0)).unwrap().scene.work_area.is_some());
}

/// Bytes changed at random, numbers and lines swapped, pieces cut out: read or refused, and what is read becomes a
/// scene and a picture.
#[test]
fn damaged_files_do_no_harm() {
    let files = bundled();
    let mut survived = 0;
    for seed in 0..1500 {
        let mut random = Random::new(seed);
        let mut bytes = files[random.below(files.len())].clone();
        for _ in 0..=random.below(4) {
            let at = random.below(bytes.len());
            match random.below(4) {
                0 => bytes[at] = random.next() as u8,
                1 => bytes[at] = b"0123456789-.e\n"[random.below(14)],
                2 => drop(bytes.drain(at..(at + random.below(200)).min(bytes.len()))),
                _ => {
                    let end = (at + random.below(300)).min(bytes.len());
                    let piece = bytes[at..end].to_vec();
                    let to = random.below(bytes.len());
                    bytes.splice(to..to, piece);
                }
            }
        }
        if let Ok(drawing) = read(&bytes)
            && let Ok(made) = scene_from_drawing(&drawing, &SceneOptions::new(4.0))
        {
            survived += 1;
            let svg = picture_of_plan(&made.scene, Shown::Scene, "damaged");
            assert!(roxmltree::Document::parse(&svg).is_ok(), "seed {seed}");
        }
    }
    assert!(survived > 100, "{survived}");
}

#[test]
fn what_is_not_read_stops_only_where_something_is_chosen() {
    let drawn = "0\nCIRCLE\n8\nPINS\n10\n0\n20\n0\n40\n5\n0\nHATCH\n8\nNOTES\n0\nTEXT\n8\nPINS\n1\nhello\n0\nMLINE\n8\nNOTES\n";
    let drawing = read(with_entities(drawn).as_bytes()).unwrap();
    let report = |obstacles: &str| {
        let mut options = SceneOptions::new(1.0);
        options.roles.obstacles = vec![traverse_drawing::ObstacleRole::new(obstacles)];
        scene_from_drawing(&drawing, &options).unwrap().report
    };
    let pins = report("PINS");
    assert!(
        pins.is_complete() && pins.unused.len() == 3 && pins.to_string().contains("1 × HATCH on layer NOTES")
    );
    for chosen in ["*", "NOTES", "id:*", "color:white"] {
        let report = report(chosen);
        assert!(!report.is_complete() && report.lost.len() == 2, "{report}");
        assert!(report.to_string().contains("not used though it may be in the way: 1 × HATCH"), "{report}");
    }
}

#[test]
fn utf_16_is_told_apart_from_binary_data() {
    let little = |text: &str| -> Vec<u8> {
        [0xff, 0xfe].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect()
    };
    let big = |text: &str| -> Vec<u8> {
        [0xfe, 0xff].into_iter().chain(text.encode_utf16().flat_map(u16::to_be_bytes)).collect()
    };
    let words = |bytes: &[u8]| {
        traverse_drawing::read_drawing(bytes, &ReadOptions::default()).unwrap_err().to_string()
    };
    let drawing = with_entities("");
    for bytes in [little(&drawing), big(&drawing)] {
        assert!(words(&bytes).contains("text in UTF-16, which DXF never is"), "{}", words(&bytes));
    }
    assert!(words(&little("a letter")).contains("some other text in UTF-16"));
}
