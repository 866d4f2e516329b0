//! What stands above the drawing: title, length or that there is no path, clearance.

use super::Shown;
use super::frame::{MARGIN, WIDTH};
use super::style::{LARGE, SMALL};
use super::text::{fitted, millimetres, push_text, width_of};
use traverse_geometry::{CornerStyle, Scene};

/// The lines above the drawing, each with its style and letter size.
pub(super) struct Header {
    lines: Vec<(&'static str, f64, String)>,
}

/// From line to line, as a multiple of the letter size.
const LEADING: f64 = 1.4;
/// Most lines that ids of separating obstacles fill.
const MOST_LINES: usize = 4;

impl Header {
    pub(super) fn new(scene: &Scene, shown: &Shown<'_>, title: &str) -> Self {
        let mut lines = Vec::new();
        let width = WIDTH - 2.0 * MARGIN;
        if !title.is_empty() {
            lines.push(("title", LARGE, fitted(title, LARGE * 1.06, width)));
        }
        match shown {
            Shown::NoPath { separating, .. } => {
                let said = if separating.is_empty() {
                    vec![String::from("no path: the work area's border parts start from target")]
                } else {
                    wrapped(
                        &format!("no path: start and target are parted by {}", separating.join(", ")),
                        width,
                    )
                };
                lines.extend(said.into_iter().map(|line| ("alert", SMALL, line)));
                lines.push(("", SMALL, clearance(scene)));
            }
            Shown::Scene => lines.push(("", SMALL, clearance(scene))),
            Shown::Path(_) | Shown::Paths(_) => {
                let lengths: f64 = shown.paths().iter().map(traverse_geometry::Path::length).sum();
                let straight: f64 = shown.ends().iter().map(|(start, target)| (target - start).norm()).sum();
                let count = shown.paths().len();
                let what = if count == 1 { "rapid move".to_owned() } else { format!("{count} rapid moves") };
                let text = format!(
                    "{what} {}, straight {}, {}",
                    millimetres(lengths),
                    millimetres(straight),
                    clearance(scene)
                );
                lines.push(("", SMALL, fitted(&text, SMALL, width)));
            }
        }
        Self { lines }
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

fn clearance(scene: &Scene) -> String {
    let corners = match scene.corner_style {
        CornerStyle::Round => "round corners",
        CornerStyle::Miter { .. } => "mitred corners",
    };
    format!("clearance {}, {corners}", millimetres(scene.clearance_mm))
}

/// The text broken at its spaces.
fn wrapped(text: &str, width: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let line = lines.last().map_or("", String::as_str);
        // Bold letters are wider.
        if !line.is_empty() && width_of(&format!("{line} {word}"), SMALL * 1.06) > width {
            if lines.len() == MOST_LINES {
                if let Some(last) = lines.last_mut() {
                    last.push_str(" …");
                }
                return lines;
            }
            lines.push(String::new());
        }
        if let Some(last) = lines.last_mut() {
            if !last.is_empty() {
                last.push(' ');
            }
            last.push_str(&fitted(word, SMALL * 1.06, width));
        }
    }
    lines
}
