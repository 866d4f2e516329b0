//! The list of findings below the drawing, numbered as the markers are.

use super::frame::{MARGIN, WIDTH};
use super::markers::{Kind, MARKED_FINDINGS, disc};
use super::style::SAID;
use super::text::{Weight, wrapped};
use super::text_line::push_text;
use crate::DrawingFinding;

/// From line to line.
const LINE: f64 = SAID * 1.3;
/// Between findings.
const SPACE: f64 = 12.0;
/// Where the text begins, right of the number.
const INDENT: f64 = 40.0;
/// Most lines of one finding.
const MOST_LINES: usize = 4;

/// Writes the list from `top` down; where it ends.
pub(super) fn draw(svg: &mut String, findings: &[DrawingFinding], top: f64) -> f64 {
    let mut y = top + SPACE;
    let width = WIDTH - 2.0 * MARGIN - INDENT;
    for (finding, number) in findings.iter().zip(1..).take(MARKED_FINDINGS) {
        y += SPACE;
        disc(svg, Kind::of(finding), (MARGIN + 14.0, y + LINE * 0.5), &format!("{number}"));
        for line in wrapped(&finding.to_string(), SAID, Weight::Regular, width, MOST_LINES) {
            push_text(svg, "said", MARGIN + INDENT, y + LINE * 0.5 + SAID * 0.36, &line);
            y += LINE;
        }
    }
    let more = findings.len().saturating_sub(MARKED_FINDINGS);
    if more > 0 {
        y += SPACE;
        let text = format!("and {more} findings more, not marked");
        push_text(svg, "said", MARGIN + INDENT, y + LINE * 0.5 + SAID * 0.36, &text);
        y += LINE;
    }
    y
}
