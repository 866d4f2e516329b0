//! The signs of the legend.

use super::change_place::place_mark;
use super::layer_style::LayerStyle;
use super::markers::{Kind, disc};
use super::route::{MARK_RADIUS, start_mark, target_mark};
use std::fmt::Write;

/// Width of most signs.
const SIGN: f64 = 44.0;

/// A sign of the legend.
#[derive(Clone, Copy, Debug)]
pub(super) enum Sign {
    /// A line of that style.
    Line(&'static str),
    /// A filled field of that style.
    Field(&'static str),
    /// A line of a layer.
    Layer(LayerStyle),
    /// The line that an open chain lies on.
    OpenChain,
    /// The mark of start.
    Start,
    /// The mark of target.
    Target,
    /// The mark of the place where the tool is changed.
    Place,
    /// A loose end.
    LooseEnd,
    /// A finding's number.
    Marker(Kind),
}

impl Sign {
    pub(super) fn width(self) -> f64 {
        match self {
            Self::Start | Self::Target | Self::Place | Self::Marker(_) => 2.0 * MARK_RADIUS + 4.0,
            Self::LooseEnd => 14.0,
            _ => SIGN,
        }
    }

    pub(super) fn draw(self, svg: &mut String, x: f64, y: f64) {
        let (right, middle) = (x + SIGN, x + self.width() / 2.0);
        let line = |class: &str| format!("<path class=\"{class}\" d=\"M{x:.1} {y:.1}H{right:.1}\"/>");
        match self {
            Self::Line(class) => svg.push_str(&line(class)),
            Self::Field(class) => {
                let top = y - 10.0;
                let _ = write!(
                    svg,
                    "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{top:.1}\" width=\"{SIGN}\" height=\"20\"/>"
                );
            }
            Self::Layer(style) => {
                let _ = write!(svg, "<g{}>{}</g>", style.stroke(), line("curve"));
            }
            Self::OpenChain => {
                let _ = write!(svg, "{}{}", line("glow"), line("curve sample"));
            }
            Self::Start => start_mark(svg, middle, y, 1.0),
            Self::Target => target_mark(svg, middle, y, 1.0),
            Self::Place => place_mark(svg, middle, y),
            Self::LooseEnd => super::gap::loose_end(svg, (middle, y)),
            Self::Marker(kind) => disc(svg, kind, (middle, y), "1"),
        }
        svg.push('\n');
    }
}
