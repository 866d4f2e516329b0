//! Where the tool may be changed, and where it is.

use super::Shown;
use super::frame::Frame;
use super::outline::polygon_data;
use super::route::MARK_RADIUS;
use std::fmt::Write;

/// Styles that only these pictures need.
const SHEET: &str = "<style>
.region{fill:#2f9e63;fill-opacity:.16;fill-rule:evenodd;stroke:#1f6f43;stroke-width:2;stroke-dasharray:3 4}
</style>
";

/// Half the side of the mark of a point that is permitted, canvas units.
const POINT_SIZE: f64 = 6.0;

/// Regions and points, beneath the moves.
pub(super) fn draw_permitted(svg: &mut String, shown: &Shown<'_>, frame: &Frame) {
    let (regions, points) = shown.permitted();
    if regions.is_empty() && points.is_empty() {
        return;
    }
    svg.push_str(SHEET);
    for region in regions {
        let _ = writeln!(svg, "<path class=\"region\" d=\"{}\"/>", polygon_data(region, frame));
    }
    for &p in points {
        let (x, y) = frame.place(p);
        let _ = writeln!(
            svg,
            "<rect class=\"region\" x=\"{:.1}\" y=\"{:.1}\" width=\"{2:.1}\" height=\"{2:.1}\"/>",
            x - POINT_SIZE,
            y - POINT_SIZE,
            2.0 * POINT_SIZE
        );
    }
}

/// The mark of the place, above the moves.
pub(super) fn draw_place(svg: &mut String, shown: &Shown<'_>, frame: &Frame) {
    if let Some(place) = shown.place() {
        let (x, y) = frame.place(place);
        place_mark(svg, x, y);
    }
}

/// A square with a dot.
pub(super) fn place_mark(svg: &mut String, x: f64, y: f64) {
    let half = MARK_RADIUS - 1.5;
    let _ = writeln!(
        svg,
        "<rect class=\"mark\" x=\"{:.2}\" y=\"{:.2}\" width=\"{2:.1}\" height=\"{2:.1}\"/>\
         <circle class=\"dot\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4.0\"/>",
        x - half,
        y - half,
        2.0 * half
    );
}
