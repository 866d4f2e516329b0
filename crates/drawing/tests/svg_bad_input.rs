//! Whatever arrives as SVG is read or refused with a reason, within bounds.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod random;

use proptest::prelude::*;
use random::Random;
use std::time::{Duration, Instant};
use traverse_drawing::{
    Drawing, ReadError, ReadOptions, SceneOptions, read_drawing, read_drawing_from, read_svg, read_svg_from,
    scene_from_drawing,
};

fn read(text: &str) -> Result<Drawing, ReadError> {
    read_svg(text.as_bytes(), &ReadOptions::default())
}

fn svg(content: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink'>{content}</svg>"
    )
}

/// Reads it within a time that only linear work can keep.
fn read_soon(text: &str) -> Result<Drawing, ReadError> {
    let begun = Instant::now();
    let read = read(text);
    assert!(begun.elapsed() < Duration::from_secs(20), "{:?}", begun.elapsed());
    read
}

fn files() -> Vec<Vec<u8>> {
    ["inkscape-layers", "illustrator-classes", "laser-job", "pixels"]
        .map(|name| format!("{}/tests/svg/{name}.svg", env!("CARGO_MANIFEST_DIR")))
        .map(|path| std::fs::read(path).unwrap())
        .to_vec()
}

#[test]
fn other_files_are_named() {
    for (bytes, found) in [
        (&b"<!DOCTYPE html>\n<html><body>404</body></html>"[..], "a web page (HTML)"),
        (b"<html><body><svg/></body></html>", "a web page (HTML)"),
        (b"<?xml version=\"1.0\"?>\n<kml/>", "an XML file"),
        (b"  0\nSECTION\n  2\nHEADER\n", "a DXF drawing"),
        (b"AutoCAD Binary DXF\r\n\x1a\0", "a DXF drawing"),
        (b"%PDF-1.7", "a PDF file"),
        (b"%!PS-Adobe-3.0 EPSF-3.0", "a PostScript file"),
        (b"\x1f\x8b\x08\0\0\0\0\0", "a compressed archive"),
        (&[0; 4096], "binary data"),
        (b"hello", "some other text"),
    ] {
        assert_eq!(read_svg(bytes, &ReadOptions::default()), Err(ReadError::NotSvg { found }));
    }
    for empty in [&b""[..], b"\n", b" \r\n\t\r\n", b"\xef\xbb\xbf"] {
        assert_eq!(read_svg(empty, &ReadOptions::default()), Err(ReadError::Empty));
        assert_eq!(read_drawing(empty, &ReadOptions::default()), Err(ReadError::Empty));
    }
}

#[test]
fn the_content_chooses_the_reader() {
    let options = ReadOptions::default();
    let line = svg("<line x2='9'/>");
    assert_eq!(read_drawing(line.as_bytes(), &options).unwrap().curve_count(), 1);
    assert_eq!(read_drawing_from(line.as_bytes(), &options).unwrap().curve_count(), 1);
    let circle = b"0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\nA\n10\n0\n20\n0\n40\n1\n0\nENDSEC\n0\nEOF\n";
    assert_eq!(read_drawing(circle, &options).unwrap().curve_count(), 1);
    assert_eq!(read_drawing(b"%PDF", &options), Err(ReadError::NotDrawing { found: "a PDF file" }));
    assert!(matches!(read_drawing(b"<kml/>", &options), Err(ReadError::NotSvg { .. })));
}

#[test]
fn encodings_are_told_apart() {
    let text = "<?xml version='1.0' encoding='UTF-16'?><svg><g id='Ä'><line x2='9'/></g></svg>";
    let units = |to: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(to).collect::<Vec<_>>();
    for (mark, bytes) in [([0xff, 0xfe], units(u16::to_le_bytes)), ([0xfe, 0xff], units(u16::to_be_bytes))] {
        let bytes = [mark.to_vec(), bytes].concat();
        assert_eq!(read_svg(&bytes, &ReadOptions::default()).unwrap().layers[0].name, "Ä");
        assert_eq!(read_drawing(&bytes, &ReadOptions::default()).unwrap().curve_count(), 1);
    }
    let latin = b"<?xml version='1.0' encoding='ISO-8859-1'?><svg><g id='\xc4'><line x2='9'/></g></svg>";
    assert_eq!(read_svg(latin, &ReadOptions::default()).unwrap().layers[0].name, "Ä");
    let damaged = read_svg(b"<svg>\n<g id='\xc4'/></svg>", &ReadOptions::default());
    assert!(matches!(damaged, Err(ReadError::Malformed { line: 2, .. })));
}

#[test]
fn what_is_not_well_formed_is_refused_with_its_line() {
    for (text, at) in
        [("<svg>\n<g>\n</svg>", 3), ("<svg>\n<rect x='1' x='2'/></svg>", 2), ("<svg>\n<rect x=1/></svg>", 2)]
    {
        let Err(ReadError::Malformed { line, .. }) = read(text) else { panic!("{text}") };
        assert_eq!(line, at, "{text}");
    }
    // Against the rules, but harmless and common.
    assert_eq!(read("<!-- a -- b\n--><svg><!----- c --><line x2='9'/></svg>").unwrap().curve_count(), 1);
    for file in files() {
        for length in (0..file.len() - 8).step_by(97) {
            assert!(read_svg(&file[..length], &ReadOptions::default()).is_err());
        }
    }
}

#[test]
fn bad_values_name_element_attribute_and_line() {
    for (content, attribute) in [
        ("<rect id='a' width='NaN' height='1'/>", "width"),
        ("<rect id='a' width='1e999' height='1'/>", "width"),
        ("<rect id='a' width='2e9' height='1'/>", "a coordinate"),
        ("<circle id='a' r='4 yards'/>", "r"),
        ("<path id='a' d='M0 0L5 NaN'/>", "d"),
        ("<path id='a' d='L5 5'/>", "d"),
        ("<path id='a' d='M0 0C1 1 1e7 1e7 1 1'/>", "a coordinate"),
        ("<path id='a' d='M0 0A1e9 1e-9 7 0 1 1 1'/>", "a coordinate"),
        ("<polyline id='a' points='0 0 1'/>", "points"),
        ("<polygon id='a' points='0 0 1 inf 3 4'/>", "points"),
        ("<line id='a' x2='1' transform='rotate(x)'/>", "transform"),
        ("<line id='a' x2='1' transform='scale(1e200) scale(1e200)'/>", "a coordinate"),
        ("<line id='a' x2='1' style='transform:scaleX(2)'/>", "style"),
        ("<line id='a' x2='1' style='transform:rotate(1turn)'/>", "style"),
        ("<line id='a' x2='1' transform='scale(2)' transform-origin='a b'/>", "transform-origin"),
        ("<line id='a' x2='1' style='transform:scale(2);transform-box:fill-box'/>", "transform-box"),
        ("<svg id='a' viewBox='0 0 0 0'><line x2='1'/></svg>", "viewBox"),
    ] {
        let Err(ReadError::BadAttribute { element, attribute: found, line, .. }) =
            read(&svg(&format!("\n{content}")))
        else {
            panic!("{content}: {:?}", read(&svg(content)))
        };
        assert_eq!((found, line), (attribute, 2), "{content}");
        assert!(element.ends_with(" id=\"a\">"), "{element}");
    }
    for page in [
        "width='0' height='1'",
        "width='-5mm'",
        "width='x'",
        "viewBox='0 0 1'",
        "width='1e9mm' height='1e9mm'",
    ] {
        assert!(
            matches!(read(&format!("<svg {page}/>")), Err(ReadError::BadAttribute { line: 1, .. })),
            "{page}"
        );
    }
    for pixels_per_inch in [0.0, f64::NAN, -96.0, f64::INFINITY] {
        let mut options = ReadOptions::default();
        options.pixels_per_inch = pixels_per_inch;
        let read = read_svg(svg("<circle r='9'/>").as_bytes(), &options);
        assert!(read.is_err(), "{pixels_per_inch}");
    }
}

#[test]
fn limits_hold() {
    let file = svg(&"<circle r='9'/>".repeat(50));
    let limited = |change: fn(&mut ReadOptions)| {
        let mut options = ReadOptions::default();
        change(&mut options);
        options
    };
    let options = limited(|options| options.entity_limit = 49);
    assert_eq!(read_svg(file.as_bytes(), &options), Err(ReadError::TooManyEntities { limit: 49 }));
    let options = limited(|options| options.vertex_limit = 49);
    assert_eq!(read_svg(file.as_bytes(), &options), Err(ReadError::TooManyVertices { limit: 49 }));
    let curve = svg("<path d='M0 0C99 0 0 99 99 99'/>");
    assert_eq!(
        read_svg(curve.as_bytes(), &limited(|options| options.vertex_limit = 9)),
        Err(ReadError::TooManyVertices { limit: 9 })
    );
    let options = limited(|options| options.byte_limit = 100);
    assert_eq!(read_svg(file.as_bytes(), &options), Err(ReadError::TooLong { limit: 100 }));
    assert_eq!(read_svg_from(std::io::repeat(b' '), &options), Err(ReadError::TooLong { limit: 100 }));
    for tolerance in [0.0, -1.0, f64::NAN] {
        let mut options = ReadOptions::default();
        options.fit_tolerance_mm = tolerance;
        options.vertex_limit = 10_000;
        assert!(matches!(read_svg(curve.as_bytes(), &options), Err(ReadError::TooManyVertices { .. })));
    }
}

#[test]
fn nesting_and_circles_are_refused() {
    let deep = svg(&("<g>".repeat(100_000) + "<line x2='1'/>" + &"</g>".repeat(100_000)));
    assert!(matches!(read_soon(&deep), Err(ReadError::TooDeep { .. })));
    let deep = svg(&("<g>".repeat(200) + "<line x2='1'/>" + &"</g>".repeat(200)));
    assert_eq!(read(&deep).unwrap().curve_count(), 1);
    for circle in [
        "<use id='a' href='#a'/>",
        "<g id='a'><use href='#a'/></g>",
        "<use id='a' href='#b'/><use id='b' href='#a'/>",
        "<symbol id='a'><use href='#b'/></symbol><g id='b'><use xlink:href='#a'/></g>",
        "<g id='a'><svg><a><use href='#a'/></a></svg></g>",
    ] {
        assert!(matches!(read(&svg(circle)), Err(ReadError::UseCycle { .. })), "{circle}");
    }
    let chain: String = (0..1000).map(|i| format!("<use id='u{i}' href='#u{}'/>", i + 1)).collect();
    assert!(matches!(read_soon(&svg(&chain)), Err(ReadError::TooDeep { .. })));
}

#[test]
fn bombs_are_refused_soon() {
    // 2 to the power of 30 lines by use.
    let doubling: String =
        (0..30).map(|i| format!("<g id='g{}'><use href='#g{i}'/><use href='#g{i}'/></g>", i + 1)).collect();
    let bomb = svg(&format!("<defs><line id='g0' x2='1'/>{doubling}</defs><use href='#g30'/>"));
    assert!(matches!(read_soon(&bomb), Err(ReadError::TooManyEntities { .. })));
    // Billions of laughs, and a long entity many times.
    let laughs: String =
        (1..10).map(|i| format!("<!ENTITY l{i} '{}'>", format!("&l{};", i - 1).repeat(10))).collect();
    let laughs = format!("<!DOCTYPE svg [<!ENTITY l0 '<g/>'>{laughs}]><svg>&l9;</svg>");
    assert!(read_soon(&laughs).is_err());
    let long = format!("<!DOCTYPE svg [<!ENTITY l '{}'>]><svg>", "x".repeat(1_000_000));
    let long = long + &"<g id='&l;&l;&l;&l;'/>".repeat(10_000) + "</svg>";
    assert!(matches!(read_soon(&long), Err(ReadError::TooMuchRepeated { .. })));
    // Long path data and blanks, used again and again.
    let blank = " ".repeat(1_000_000);
    let uses = "<use href='#p'/>".repeat(10_000);
    for data in [format!("M0 0{blank}"), "M0 0".repeat(250_000), "M0 0z".repeat(200_000)] {
        let read = read_soon(&svg(&format!("<path id='p' d='{data}'/>{uses}")));
        assert!(
            matches!(read, Err(ReadError::TooMuchRepeated { .. } | ReadError::TooManyVertices { .. })),
            "{read:?}"
        );
    }
    // Group names copied to each element; attributes, namespaces, style rules by the thousand.
    let name = "n".repeat(1_000_000);
    let named = svg(&format!("<g id='{name}'>{}</g>", "<line x2='1'/>".repeat(1000)));
    assert!(matches!(read_soon(&named), Err(ReadError::TooMuchRepeated { .. })));
    let attributes: String = (0..100_000).map(|i| format!(" a{i}='1'")).collect();
    assert!(matches!(read_soon(&svg(&format!("<g{attributes}/>"))), Err(ReadError::Malformed { .. })));
    let namespaces: String = (0..100_000).map(|i| format!("<g xmlns:n{i}='u{i}'/>")).collect();
    assert!(matches!(read_soon(&svg(&namespaces)), Err(ReadError::Malformed { .. })));
    let rules =
        svg(&format!("<style>{}</style>{}", ".a{fill:red}".repeat(100_000), "<g class='a'/>".repeat(10_000)));
    assert!(matches!(read_soon(&rules), Err(ReadError::TooMuchRepeated { .. })));
    let classes =
        svg(&format!("<style>{}</style><g class='{}'/>", ".a{fill:red}".repeat(5000), "a ".repeat(100_000)));
    assert!(matches!(read_soon(&classes), Ok(_) | Err(ReadError::TooMuchRepeated { .. })));
    // Path data of ten million commands.
    let path = svg(&format!("<path d='M0 0{}'/>", "h1v1".repeat(5_000_000)));
    assert!(matches!(read_soon(&path), Err(ReadError::TooManyVertices { .. })));
}

#[test]
fn a_hundred_thousand_elements_take_little_time() {
    let shapes: String = (0..100_000)
        .map(|i| match i % 4 {
            0 => format!(
                "<rect id='r{i}' class='a' x='{}' y='{}' width='3' height='2' rx='.5'/>",
                i % 300,
                i / 300
            ),
            1 => format!("<circle cx='{}' cy='{}' r='1.5' style='fill:none;stroke:red'/>", i % 300, i / 300),
            2 => format!("<path d='M{} {}c1 2 3 2 4 0s3-2 4 0' transform='rotate({i})'/>", i % 300, i / 300),
            _ => format!("<line x1='{}' y1='{}' x2='9' y2='9'/>", i % 300, i / 300),
        })
        .collect();
    let file = svg(&format!("<style>.a{{fill:none}}</style><g id='all'>{shapes}</g>"));
    let begun = Instant::now();
    assert_eq!(read(&file).unwrap().curve_count(), 100_000);
    let took = begun.elapsed();
    println!("100 000 elements, {} MB: {took:?}", file.len() / 1_000_000);
    // This build checks every sum, on a machine that may be busy; docs/benchmarks.md says what an optimised one takes.
    assert!(took < Duration::from_secs(15), "{took:?}");
}

/// Changes a file: bytes, numbers, pieces cut out, doubled or swapped.
fn damaged(random: &mut Random, mut bytes: Vec<u8>) -> Vec<u8> {
    const PIECES: [&str; 12] = [
        "1e308",
        "-0",
        "NaN",
        "1e-320",
        "#clamp",
        "'",
        "<g>",
        "/>",
        "<use href='#pair'/>",
        " Z M",
        "rotate(",
        "999999",
    ];
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len().max(1)).min(bytes.len().saturating_sub(1));
        let end = (at + random.below(200)).min(bytes.len());
        match random.below(6) {
            0 if at < bytes.len() => bytes[at] = random.next() as u8,
            1 if at < bytes.len() => bytes[at] = b"0123456789-.e \"<>aAzZ"[random.below(21)],
            2 => drop(bytes.drain(at..end)),
            3 => {
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
            4 => {
                // A number for another.
                let digits = bytes[at..].iter().position(u8::is_ascii_digit).map_or(at, |offset| at + offset);
                let after = bytes[digits..]
                    .iter()
                    .position(|b| !b.is_ascii_digit())
                    .map_or(bytes.len(), |n| digits + n);
                bytes.splice(digits..after, PIECES[random.below(PIECES.len())].bytes());
            }
            _ => drop(bytes.splice(at..at, PIECES[random.below(PIECES.len())].bytes())),
        }
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_do_no_harm(seed: u32) {
        let files = files();
        let mut random = Random::new(u64::from(seed));
        let bytes = damaged(&mut random, files[seed as usize % files.len()].clone());
        let mut options = ReadOptions::default();
        (options.entity_limit, options.vertex_limit) = (2000, 20_000);
        if let Ok(drawing) = read_svg(&bytes, &options) {
            let curves: Vec<_> = drawing.layers.iter().flat_map(|layer| &layer.curves).collect();
            prop_assert!(curves.iter().map(|curve| curve.vertices.len()).sum::<usize>() <= 20_000);
            for curve in curves {
                prop_assert!(curve.vertices.len() >= 2 && curve.vertices.len() == curve.bulges.len());
                prop_assert!(curve.vertices.iter().all(|v| v.x.abs() <= 1e6 && v.y.abs() <= 1e6));
                prop_assert!(curve.bulges.iter().all(|bulge| bulge.abs() <= 1.0));
                prop_assert!(curve.edges().all(|edge| edge.start() != edge.end() && edge.length().is_finite()));
            }
            if seed % 8 == 0 {
                let _ = scene_from_drawing(&drawing, &SceneOptions::new(4.0));
            }
        }
    }
}
