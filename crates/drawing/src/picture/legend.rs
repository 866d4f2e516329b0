//! What the lines and fills mean, below the drawing. Only what the picture holds.

use super::Shown;
use super::frame::{Frame, MARGIN, WIDTH};
use super::route::{MARK_RADIUS, start_mark, target_mark};
use super::scale_bar;
use super::style::SMALL;
use super::text::{push_text, width_of};
use std::fmt::Write;
use traverse_geometry::Scene;

/// Where the legend's entries stand.
pub(super) struct Legend {
    entries: Vec<(Sign, &'static str, f64, f64)>,
    bottom: f64,
}

#[derive(Clone, Copy)]
enum Sign {
    WorkArea,
    Obstacle(&'static str),
    Barrier,
    Line(&'static str),
    Start,
    Target,
}

/// Width of a sign.
const SIGN: f64 = 44.0;
/// Height of a row.
const ROW: f64 = 32.0;

impl Legend {
    pub(super) fn new(scene: &Scene, shown: &Shown<'_>, frame: &Frame) -> Self {
        let mut wanted = Vec::new();
        let barriers = scene.obstacles.iter().any(|obstacle| scene.clearance_of(obstacle) > 0.0)
            || scene.work_area.is_some() && scene.border_clearance() > 0.0;
        let parted = matches!(shown, Shown::NoPath { .. });
        let ends = !shown.ends().is_empty();
        for (holds, sign, name) in [
            (scene.work_area.is_some(), Sign::WorkArea, "work area"),
            (!scene.obstacles.is_empty(), Sign::Obstacle("obstacle"), "obstacle"),
            (barriers, Sign::Barrier, "barrier"),
            (parted, Sign::Obstacle("obstacle parts"), "parts start from target"),
            (!shown.paths().is_empty(), Sign::Line("rapid"), "rapid move"),
            (parted, Sign::Line("wish"), "wanted"),
            (ends, Sign::Start, "start"),
            (ends, Sign::Target, "target"),
        ] {
            if holds {
                wanted.push((sign, name));
            }
        }
        let left = MARGIN + scale_bar::SPACE;
        let (mut x, mut y) = (left, frame.area.bottom + 28.0);
        let mut entries = Vec::new();
        for (sign, name) in wanted {
            let width = sign.width() + 8.0 + width_of(name, SMALL) + 22.0;
            if x + width > WIDTH - MARGIN && x > left {
                (x, y) = (left, y + ROW);
            }
            entries.push((sign, name, x, y));
            x += width;
        }
        let bottom = (y + ROW / 2.0).max(frame.area.bottom + 24.0 + 9.0 + SMALL * 1.5);
        Self { entries, bottom }
    }

    pub(super) fn bottom(&self) -> f64 {
        self.bottom
    }

    pub(super) fn draw(&self, svg: &mut String) {
        for &(sign, name, x, y) in &self.entries {
            sign.draw(svg, x, y);
            push_text(svg, "", x + sign.width() + 8.0, y + SMALL * 0.35, name);
        }
    }
}

impl Sign {
    fn width(self) -> f64 {
        match self {
            Self::Start | Self::Target => 2.0 * MARK_RADIUS + 4.0,
            _ => SIGN,
        }
    }

    fn draw(self, svg: &mut String, x: f64, y: f64) {
        let (right, middle) = (x + SIGN, x + self.width() / 2.0);
        let rect = |class: &str, style: &str| {
            format!(
                "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{:.1}\" width=\"{SIGN}\" height=\"20\"{style}/>",
                y - 10.0
            )
        };
        let _ = match self {
            Self::WorkArea => {
                writeln!(svg, "<path class=\"border\" d=\"M{x:.1} {y:.1}H{right:.1}\"/>")
            }
            Self::Obstacle(class) => writeln!(svg, "{}", rect(class, "")),
            Self::Barrier => {
                writeln!(svg, "{}", rect("", " fill=\"#fdebc8\" stroke=\"#b9770e\" stroke-width=\"1.3\""))
            }
            Self::Line(class) => writeln!(svg, "<path class=\"{class}\" d=\"M{x:.1} {y:.1}H{right:.1}\"/>"),
            Self::Start => {
                start_mark(svg, middle, y);
                Ok(())
            }
            Self::Target => {
                target_mark(svg, middle, y);
                Ok(())
            }
        };
    }
}
