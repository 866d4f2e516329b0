//! The gap of an open chain: both loose ends, a line between them, and its length where there is room.

use super::frame::Frame;
use super::label::{Places, box_at};
use super::style::SMALL;
use super::text::{Weight, millimetres, width_of};
use super::text_line::push_text;
use std::f64::consts::TAU;
use std::fmt::Write;
use traverse_geometry::Point;

/// Half the side of the mark of a loose end.
const HALF: f64 = 5.0;
/// Shorter gaps have no line, canvas units: the marks of their ends touch.
const SHORTEST: f64 = 14.0;
/// How far from the gap's middle its length is tried.
const REACH: [f64; 4] = [6.0, 16.0, 30.0, 48.0];

/// Both loose ends and the line between them.
pub(super) fn draw(svg: &mut String, ends: [Point; 2], frame: &Frame) {
    let [(x0, y0), (x1, y1)] = ends.map(|end| frame.place(end));
    if (x1 - x0).hypot(y1 - y0) >= SHORTEST {
        let _ = writeln!(svg, "<path class=\"gapline\" d=\"M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}\"/>");
    }
    loose_end(svg, (x0, y0));
    loose_end(svg, (x1, y1));
}

/// A small square.
pub(super) fn loose_end(svg: &mut String, (x, y): (f64, f64)) {
    let _ = writeln!(
        svg,
        "<rect class=\"loose\" x=\"{:.2}\" y=\"{:.2}\" width=\"{:.1}\" height=\"{:.1}\"/>",
        x - HALF,
        y - HALF,
        2.0 * HALF,
        2.0 * HALF
    );
}

/// Writes the length beside the gap; not at all when there is no room: the list says it as well.
pub(super) fn write_length(
    svg: &mut String,
    places: &mut Places,
    ends: [Point; 2],
    gap_mm: f64,
    frame: &Frame,
) {
    let text = format!("gap {}", millimetres(gap_mm));
    let (width, height) = (width_of(&text, SMALL, Weight::Bold), SMALL);
    let (x, y) = frame.place(ends[0] + (ends[1] - ends[0]) / 2.0);
    let spots = REACH.iter().flat_map(|&away| {
        (0..16).map(move |turn| {
            let angle = TAU * f64::from(turn) / 16.0;
            let (dx, dy) = (away + HALF + width / 2.0, away + HALF + height / 2.0);
            box_at(x + dx * angle.cos(), y + dy * angle.sin(), width, SMALL)
        })
    });
    let free = spots.into_iter().find(|spot| places.is_free(spot) && places.is_clear(spot));
    if let Some(spot) = free {
        push_text(
            svg,
            "end",
            (spot.left + spot.right) / 2.0,
            (spot.top + spot.bottom) / 2.0 + SMALL * 0.35,
            &text,
        );
        places.take(spot);
    }
}
