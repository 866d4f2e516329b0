//! What the lines and fills mean, below the drawing. Only what the picture holds.

use super::frame::{Frame, MARGIN, WIDTH};
use super::scale_bar;
use super::sign::Sign;
use super::style::SMALL;
use super::text::{Weight, fitted, width_of};
use super::text_line::push_text;

/// Where the legend's entries stand.
pub(super) struct Legend {
    entries: Vec<(Sign, String, f64, f64)>,
    note: Option<(String, f64)>,
    bottom: f64,
}

/// Height of a row.
const ROW: f64 = 32.0;
/// Between a sign and its text.
const SPACE: f64 = 8.0;

impl Legend {
    /// Entries in rows beside the scale bar, then a note in a line of its own; none when it is empty.
    pub(super) fn new(wanted: Vec<(Sign, String)>, note: String, frame: &Frame) -> Self {
        let left = MARGIN + scale_bar::SPACE;
        let (mut x, mut y) = (left, frame.area.bottom + 28.0);
        let mut entries = Vec::new();
        for (sign, text) in wanted {
            let most = WIDTH - MARGIN - left - sign.width() - SPACE;
            let text = fitted(&text, SMALL, Weight::Regular, most);
            let width = sign.width() + SPACE + width_of(&text, SMALL, Weight::Regular);
            if x + width > WIDTH - MARGIN && x > left {
                (x, y) = (left, y + ROW);
            }
            entries.push((sign, text, x, y));
            x += width + 22.0;
        }
        let mut bottom = (y + ROW / 2.0).max(frame.area.bottom + scale_bar::HEIGHT_WITH_FIGURES);
        let note = (!note.is_empty()).then(|| {
            let text = fitted(&note, SMALL, Weight::Regular, WIDTH - 2.0 * MARGIN);
            bottom += ROW;
            (text, bottom - SMALL * 0.3)
        });
        Self { entries, note, bottom }
    }

    pub(super) fn bottom(&self) -> f64 {
        self.bottom
    }

    pub(super) fn draw(&self, svg: &mut String) {
        for (sign, text, x, y) in &self.entries {
            sign.draw(svg, *x, *y);
            push_text(svg, "", x + sign.width() + SPACE, y + SMALL * 0.35, text);
        }
        if let Some((text, y)) = &self.note {
            push_text(svg, "note", MARGIN, *y, text);
        }
    }
}
