//! Ten sections of a strip of leather, each a group of an SVG file: soles, uppers, tongues and straps of shoes, as a cutting
//! layout stacks them. They stand side by side by their bounding boxes.

use std::fmt::Write;

/// Between sections as they are drawn, millimetres.
const APART: f64 = 20.0;
/// Height of the strip.
const HEIGHT: f64 = 300.0;

/// Outlines as SVG path data, the section's lower left corner at the origin, y up; and the section's width.
type Shapes = (&'static str, f64, &'static [&'static str]);

/// Quarter and half circles are arcs; everything else is straight.
const SECTIONS: [Shapes; 10] = [
    // Soles that lean to the right, a heel above.
    (
        "soles",
        150.0,
        &[
            "M0 0H70A30 30 0 0 1 100 30L150 140A20 20 0 0 1 130 160H90A30 30 0 0 1 60 130L0 40Z",
            "M10 180H110V240A50 50 0 0 1 10 240Z",
        ],
    ),
    // Uppers, open to the left: a neighbour's tip reaches in.
    (
        "uppers",
        170.0,
        &[
            "M0 0L120 0A50 50 0 0 1 170 50V90L60 100L0 120L60 60Z",
            "M20 140L140 130L170 200L110 290H0L70 215Z",
        ],
    ),
    // Tongues side by side, points to the right.
    (
        "tongues",
        130.0,
        &[
            "M0 5H60L130 45L60 85H0L25 45Z",
            "M0 100H60L130 140L60 180H0L25 140Z",
            "M0 195H60L130 235L60 275H0L25 235Z",
        ],
    ),
    // Straps that lean to the left.
    ("straps", 180.0, &["M90 0H130L60 300H20Z", "M150 0H180L130 210H95Z", "M70 0L0 300V240L45 0Z"]),
    // A vamp with a round toe to the right and a quarter below it.
    ("vamps", 140.0, &["M0 150H70A70 70 0 0 1 70 290H0L40 220Z", "M0 0H110L140 60L110 130H0L30 60Z"]),
    // Counters: half circles back to back.
    ("counters", 110.0, &["M0 0H50A60 60 0 0 1 50 120H0Z", "M110 140V280H90A70 70 0 0 1 90 140Z"]),
    // Insoles that lean to the left.
    ("insoles", 150.0, &["M50 0H130A20 20 0 0 1 150 20L90 145H0L40 10Z", "M60 160H140L110 295H0L50 175Z"]),
    // Welts: a long slanted band and a triangle in its corner.
    ("welts", 160.0, &["M0 0H40L160 300H115Z", "M70 0H160V200Z", "M0 60L90 300H0Z"]),
    // Heels in a column, narrow.
    ("heels", 60.0, &["M0 0H60V60A30 30 0 0 1 0 60Z", "M0 100H60L40 190H20Z", "M20 200H40L60 290H0Z"]),
    // Linings with a tail at the lower right.
    ("linings", 190.0, &["M0 120H100V290H0Z", "M0 0H190L110 50L100 105H0Z"]),
];

pub(crate) fn text() -> String {
    let width: f64 = SECTIONS.iter().map(|(_, width, _)| width + APART).sum::<f64>() - APART;
    let mut svg = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    svg.push_str("<!-- Sections of a strip of leather, 300 mm high. Copyright the Traverse founders. MIT OR Apache-2.0.\n");
    svg.push_str("     Written by crates/drawing/examples/make_drawings.rs. -->\n");
    let _ = writeln!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{HEIGHT}mm\" viewBox=\"0 0 {width} {HEIGHT}\">"
    );
    let mut left = 0.0;
    for (name, width, shapes) in SECTIONS {
        // y points up in the path data.
        let _ = writeln!(
            svg,
            "  <g id=\"{name}\" transform=\"matrix(1 0 0 -1 {left} {HEIGHT})\" fill=\"none\" stroke=\"#000\">"
        );
        for shape in shapes {
            let _ = writeln!(svg, "    <path d=\"{shape}\"/>");
        }
        svg.push_str("  </g>\n");
        left += width + APART;
    }
    svg.push_str("</svg>\n");
    svg
}
