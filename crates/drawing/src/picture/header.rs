//! What stands above the drawing: title and lines.

use super::frame::{MARGIN, WIDTH};
use super::style::{LARGE, SMALL};
use super::text::{Weight, fitted, wrapped};
use super::text_line::push_text;

/// The lines above the drawing, each with its style and letter size.
pub(super) struct Header {
    lines: Vec<(&'static str, f64, String)>,
}

/// From line to line, as a multiple of the letter size.
const LEADING: f64 = 1.4;
/// Most lines that one statement fills.
const MOST_LINES: usize = 4;

impl Header {
    /// The title alone; nothing when it is empty.
    pub(super) fn titled(title: &str) -> Self {
        let mut lines = Vec::new();
        if !title.is_empty() {
            lines.push(("title", LARGE, fitted(title, LARGE, Weight::Bold, WIDTH - 2.0 * MARGIN)));
        }
        Self { lines }
    }

    /// With a statement below, broken at its spaces.
    pub(super) fn with(self, text: &str) -> Self {
        self.with_lines("", Weight::Regular, text)
    }

    /// With a statement that stands out.
    pub(super) fn with_alert(self, text: &str) -> Self {
        self.with_lines("alert", Weight::Bold, text)
    }

    /// With a statement in bold.
    pub(super) fn with_strong(self, text: &str) -> Self {
        self.with_lines("strong", Weight::Bold, text)
    }

    fn with_lines(mut self, class: &'static str, weight: Weight, text: &str) -> Self {
        let lines = wrapped(text, SMALL, weight, WIDTH - 2.0 * MARGIN, MOST_LINES);
        self.lines.extend(lines.into_iter().map(|line| (class, SMALL, line)));
        self
    }

    /// With the space below it.
    pub(super) fn height(&self) -> f64 {
        self.lines.iter().map(|(_, size, _)| size * LEADING).sum::<f64>() + SMALL * 0.4
    }

    /// The header in one line, for the file's title.
    pub(super) fn summary(&self) -> String {
        self.lines.iter().map(|(_, _, text)| text.as_str()).collect::<Vec<_>>().join("; ")
    }

    pub(super) fn draw(&self, svg: &mut String) {
        let mut y = MARGIN;
        for (class, size, text) in &self.lines {
            push_text(svg, class, MARGIN, y + size * 0.85, text);
            y += size * LEADING;
        }
    }
}
