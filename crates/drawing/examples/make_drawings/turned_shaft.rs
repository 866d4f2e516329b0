//! A stepped shaft between chuck and tailstock, seen on a lathe: x is the machine's Z, y its X as a radius.
//! Polylines with bulges, in inches.

use crate::dxf_text::{DxfText, INCHES};

/// tan(90° / 4): a quarter turn.
const QUARTER: f64 = 0.414_213_562_373_095_03;

pub(crate) fn text() -> String {
    let mut dxf = DxfText::new(INCHES);
    // From the spindle's face to the end of the bed, from the axis to the slide's end.
    dxf.polyline(
        "WORK_AREA",
        &[(-20.0, 0.0, 0.0), (380.0, 0.0, 0.0), (380.0, 140.0, 0.0), (-20.0, 140.0, 0.0)],
    );

    dxf.polyline(
        "CHUCK",
        &[
            (-20.0, 0.0, 0.0),
            (24.0, 0.0, 0.0),
            (24.0, 100.0, QUARTER),
            (18.0, 106.0, 0.0),
            (-20.0, 106.0, 0.0),
        ],
    );
    // A stepped jaw that grips the shaft.
    dxf.polyline(
        "JAWS",
        &[
            (24.0, 30.0, 0.0),
            (58.0, 30.0, 0.0),
            (58.0, 48.0, 0.0),
            (46.0, 48.0, 0.0),
            (46.0, 66.0, 0.0),
            (34.0, 66.0, 0.0),
            (34.0, 88.0, 0.0),
            (24.0, 88.0, 0.0),
        ],
    );

    dxf.polyline(
        "SHAFT",
        &[
            (24.0, 0.0, 0.0),
            (24.0, 30.0, 0.0),
            // An undercut, a half circle.
            (92.0, 30.0, 1.0),
            (108.0, 30.0, 0.0),
            // A collar with rounded edges.
            (120.0, 30.0, 0.0),
            (120.0, 58.0, -QUARTER),
            (124.0, 62.0, 0.0),
            (148.0, 62.0, -QUARTER),
            (152.0, 58.0, 0.0),
            // A fillet down to the seat.
            (152.0, 40.0, QUARTER),
            (160.0, 32.0, 0.0),
            (200.0, 32.0, 0.0),
            // A square groove.
            (200.0, 20.0, 0.0),
            (212.0, 20.0, 0.0),
            (212.0, 32.0, 0.0),
            (240.0, 32.0, 0.0),
            (240.0, 44.0, 0.0),
            (262.0, 44.0, 0.0),
            (262.0, 24.0, 0.0),
            // A chamfer, then the end.
            (296.0, 24.0, 0.0),
            (299.0, 21.0, 0.0),
            (299.0, 0.0, 0.0),
        ],
    );

    // A live centre in its quill.
    dxf.polyline(
        "TAILSTOCK",
        &[
            (299.0, 0.0, 0.0),
            (299.0, 3.0, 0.0),
            (322.0, 16.0, 0.0),
            (334.0, 16.0, 0.0),
            (334.0, 34.0, -QUARTER),
            (340.0, 40.0, 0.0),
            (380.0, 40.0, 0.0),
            (380.0, 0.0, 0.0),
        ],
    );

    // A steady rest that reaches down from its arm, with a roller on the seat.
    dxf.polyline(
        "STEADY_REST",
        &[(172.0, 140.0, 0.0), (172.0, 52.0, 1.0), (190.0, 52.0, 0.0), (190.0, 140.0, 0.0)],
    );
    dxf.finish("Stepped shaft between chuck and tailstock, inches, x = Z, y = X as a radius.")
}
