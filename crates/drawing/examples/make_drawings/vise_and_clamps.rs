//! A mill table of 600 mm × 300 mm: a vise with a part, a plate under four clamps, dowel pins, an L-shaped stop.

use crate::dxf_text::{DxfText, MILLIMETRES, Vertex};

const QUARTER: f64 = 0.414_213_562_373_095_03;

pub(crate) fn text() -> String {
    let mut dxf = DxfText::new(MILLIMETRES);
    let corners = [(0.0, 0.0), (600.0, 0.0), (600.0, 300.0), (0.0, 300.0)];
    for i in 0..4 {
        dxf.line("WORK_AREA", corners[i], corners[(i + 1) % 4]);
    }

    // Fixed jaw, moving jaw, screw, handle.
    for (x, y, width, height) in [
        (50.0, 185.0, 170.0, 45.0),
        (50.0, 90.0, 170.0, 35.0),
        (126.0, 58.0, 18.0, 32.0),
        (92.0, 46.0, 86.0, 12.0),
    ] {
        dxf.polyline("VISE", &box_of(x, y, width, height));
    }

    // Between the jaws, with a pocket whose corners have the cutter's radius, and an island left standing in it.
    dxf.polyline("PART", &box_of(75.0, 125.0, 120.0, 60.0));
    dxf.polyline("PART", &rounded(88.0, 137.0, 94.0, 36.0, 6.0));
    dxf.circle("PART", 135.0, 155.0, 8.0);

    // A plate with chamfered corners and a bore.
    dxf.polyline(
        "PLATE",
        &[
            (352.0, 92.0, 0.0),
            (498.0, 92.0, 0.0),
            (510.0, 104.0, 0.0),
            (510.0, 206.0, 0.0),
            (498.0, 218.0, 0.0),
            (352.0, 218.0, 0.0),
            (340.0, 206.0, 0.0),
            (340.0, 104.0, 0.0),
        ],
    );
    dxf.circle("PLATE", 425.0, 155.0, 38.0);

    for (x, y, degrees) in
        [(352.0, 190.0, 160.0), (425.0, 210.0, 90.0), (500.0, 118.0, -20.0), (425.0, 100.0, -90.0)]
    {
        let place = Place { x, y, degrees };
        dxf.polyline("CLAMPS", &place.of(&CLAMP));
        dxf.polyline("CLAMPS", &place.of(&SLOT));
    }

    for (x, y) in [(334.0, 120.0), (334.0, 160.0), (380.0, 86.0), (470.0, 86.0)] {
        dxf.circle("PINS", x, y, 6.0);
    }

    stop(&mut dxf);
    dxf.label("NOTES", 60.0, 280.0, "TABLE 600 X 300, ZERO AT LOWER LEFT");
    dxf.finish("Vise and clamps on a mill table, millimetres.")
}

/// An L-shaped stop of lines and arcs, rounded outside by 8 mm and in the corner by 12 mm.
fn stop(dxf: &mut DxfText) {
    let layer = "STOP";
    dxf.line(layer, (248.0, 20.0), (312.0, 20.0));
    dxf.arc(layer, (312.0, 28.0), 8.0, 270.0, 0.0);
    dxf.line(layer, (320.0, 28.0), (320.0, 40.0));
    dxf.line(layer, (320.0, 40.0), (277.0, 40.0));
    // Turned clockwise on the way round: DXF arcs always run counter-clockwise.
    dxf.arc(layer, (277.0, 52.0), 12.0, 180.0, 270.0);
    dxf.line(layer, (265.0, 52.0), (265.0, 142.0));
    dxf.arc(layer, (257.0, 142.0), 8.0, 0.0, 90.0);
    dxf.line(layer, (257.0, 150.0), (248.0, 150.0));
    dxf.arc(layer, (248.0, 142.0), 8.0, 90.0, 180.0);
    dxf.line(layer, (240.0, 142.0), (240.0, 28.0));
    dxf.arc(layer, (248.0, 28.0), 8.0, 180.0, 270.0);
}

/// A step clamp with its nose at the origin, pointing to the left: the body lies to the right.
const CLAMP: [Vertex; 4] = [(-2.0, 12.0, 1.0), (-2.0, -12.0, 0.0), (66.0, -12.0, 0.0), (66.0, 12.0, 0.0)];

/// The slot for its bolt.
const SLOT: [Vertex; 4] = [(24.0, -5.0, 0.0), (44.0, -5.0, 1.0), (44.0, 5.0, 0.0), (24.0, 5.0, 1.0)];

struct Place {
    x: f64,
    y: f64,
    degrees: f64,
}

impl Place {
    fn of(&self, shape: &[Vertex]) -> Vec<Vertex> {
        let (sin, cos) = self.degrees.to_radians().sin_cos();
        let turned =
            |&(x, y, bulge): &Vertex| (self.x + x * cos - y * sin, self.y + x * sin + y * cos, bulge);
        shape.iter().map(turned).collect()
    }
}

fn box_of(x: f64, y: f64, width: f64, height: f64) -> [Vertex; 4] {
    [(x, y, 0.0), (x + width, y, 0.0), (x + width, y + height, 0.0), (x, y + height, 0.0)]
}

fn rounded(x: f64, y: f64, width: f64, height: f64, radius: f64) -> [Vertex; 8] {
    let (right, top) = (x + width, y + height);
    [
        (x + radius, y, 0.0),
        (right - radius, y, QUARTER),
        (right, y + radius, 0.0),
        (right, top - radius, QUARTER),
        (right - radius, top, 0.0),
        (x + radius, top, QUARTER),
        (x, top - radius, 0.0),
        (x, y + radius, QUARTER),
    ]
}
