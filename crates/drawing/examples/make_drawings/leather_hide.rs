//! A hide with marks to keep away from and pieces laid out on it. Single lines and arcs whose ends miss each other by
//! micrometres.

use crate::dxf_text::{DxfText, MILLIMETRES, Vertex};

pub(crate) fn text() -> String {
    let mut dxf = DxfText::new(MILLIMETRES);
    dxf.loose_loop("WORK_AREA", &HIDE);
    // A brand, holes and a scar.
    dxf.circle("MARKS", 880.0, 610.0, 26.0);
    dxf.circle("MARKS", 955.0, 560.0, 14.0);
    dxf.circle("MARKS", 410.0, 640.0, 9.0);
    dxf.loose_loop(
        "MARKS",
        &[(560.0, 250.0, 0.25), (690.0, 300.0, 0.3), (700.0, 318.0, -0.22), (555.0, 266.0, 0.6)],
    );
    // Uppers with a tongue nested in the opening of each, and one tongue more.
    for (x, y, degrees) in [(345.0, 440.0, 8.0), (570.0, 590.0, 186.0), (840.0, 400.0, -12.0)] {
        dxf.loose_loop("PIECES", &placed(&VAMP, x, y, degrees));
        let opening = placed(&[(0.0, -55.0, 0.0)], x, y, degrees)[0];
        dxf.loose_loop("PIECES", &placed(&TONGUE, opening.0, opening.1, degrees));
    }
    dxf.loose_loop("PIECES", &placed(&TONGUE, 1050.0, 350.0, 40.0));
    // A strap with its buckle hole.
    dxf.loose_loop("PIECES", &placed(&STRAP, 690.0, 205.0, 4.0));
    dxf.loose_loop("PIECES", &placed(&BUCKLE_HOLE, 690.0, 205.0, 4.0));
    dxf.finish("Hide with marks and nested pieces, millimetres, single lines and arcs.")
}

/// The border: legs, flanks, neck, counter-clockwise.
const HIDE: [Vertex; 18] = [
    (140.0, 120.0, 0.35),
    (215.0, 70.0, 0.2),
    (290.0, 130.0, -0.25),
    (420.0, 150.0, -0.08),
    (760.0, 120.0, -0.2),
    (930.0, 110.0, 0.3),
    (1020.0, 60.0, 0.35),
    (1090.0, 150.0, -0.3),
    (1120.0, 300.0, 0.12),
    (1190.0, 420.0, 0.4),
    (1170.0, 560.0, 0.0),
    (1110.0, 620.0, -0.3),
    (1070.0, 760.0, 0.45),
    (960.0, 790.0, -0.2),
    (800.0, 740.0, 0.05),
    (420.0, 750.0, -0.25),
    (270.0, 800.0, 0.5),
    (170.0, 700.0, -0.18),
];

/// The front of a shoe's upper: a horseshoe of arcs about 240 mm wide.
const VAMP: [Vertex; 8] = [
    (-110.0, -70.0, 0.0),
    (-62.0, -78.0, -0.1),
    (-50.0, 10.0, -0.62),
    (50.0, 10.0, -0.1),
    (62.0, -78.0, 0.0),
    (110.0, -70.0, 0.12),
    (96.0, 40.0, 0.55),
    (-96.0, 40.0, 0.12),
];

/// A tongue: round at the top, narrower below.
const TONGUE: [Vertex; 4] =
    [(-26.0, -60.0, 0.15), (26.0, -60.0, 0.05), (36.0, 50.0, 0.6), (-36.0, 50.0, 0.05)];

/// A strap with a round end.
const STRAP: [Vertex; 4] =
    [(-130.0, -16.0, 0.0), (110.0, -16.0, 1.0), (110.0, 16.0, 0.0), (-130.0, 16.0, 0.0)];

/// The slot for its buckle.
const BUCKLE_HOLE: [Vertex; 4] = [(80.0, -5.0, 0.0), (100.0, -5.0, 1.0), (100.0, 5.0, 0.0), (80.0, 5.0, 1.0)];

fn placed(shape: &[Vertex], x: f64, y: f64, degrees: f64) -> Vec<Vertex> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    shape.iter().map(|&(u, v, bulge)| (x + u * cos - v * sin, y + u * sin + v * cos, bulge)).collect()
}
