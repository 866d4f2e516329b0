//! A bar of a round number of millimetres, below the drawing on the left.

use super::frame::{Frame, MARGIN};
use super::style::SMALL;
use super::text::round_millimetres;
use super::text_line::push_text;
use std::fmt::Write;

/// Width of the bar at most, canvas units.
const LONGEST: f64 = 220.0;
/// Height of the bar.
const HEIGHT: f64 = 9.0;
/// Fields of the bar.
const FIELDS: u8 = 4;
/// Width that the scale bar needs with its figures.
pub(super) const SPACE: f64 = LONGEST + 100.0;
/// From the drawing down to the end of the figures.
pub(super) const HEIGHT_WITH_FIGURES: f64 = 24.0 + HEIGHT + SMALL * 1.5;

pub(super) fn draw(svg: &mut String, frame: &Frame) {
    let length = round_length(LONGEST / frame.scale);
    let (left, top) = (MARGIN + 6.0, frame.area.bottom + 24.0);
    let field = length * frame.scale / f64::from(FIELDS);
    for i in 0..FIELDS {
        let class = if i % 2 == 0 { "tick" } else { "gap" };
        let x = left + f64::from(i) * field;
        let _ = writeln!(
            svg,
            "<rect class=\"{class}\" x=\"{x:.2}\" y=\"{top:.1}\" width=\"{field:.2}\" height=\"{HEIGHT}\"/>"
        );
    }
    let text_y = top + HEIGHT + SMALL * 1.1;
    push_text(svg, "mid", left, text_y, "0");
    push_text(svg, "mid", left + f64::from(FIELDS) * field, text_y, &round_millimetres(length));
}

/// The greatest of 1, 2, 5 times a power of ten that is not above `longest`.
fn round_length(longest: f64) -> f64 {
    let power = 10_f64.powf(longest.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|digit| digit * power).find(|&length| length <= longest).unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::round_length;

    #[test]
    fn lengths_are_round_and_fit() {
        for (longest, length) in [(260.0, 200.0), (999.0, 500.0), (1000.0, 1000.0), (0.07, 0.05), (1.99, 1.0)]
        {
            assert!((round_length(longest) - length).abs() < 1e-12 * length, "{longest}");
        }
    }
}
