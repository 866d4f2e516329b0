//! What an element inherits of its looks.

use super::properties::Properties;
use crate::Color;
use std::str::FromStr;

/// What is inherited.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    fill: Paint,
    stroke: Paint,
    color: Color,
    pub(super) visible: bool,
}

/// What a line or an area is painted with.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Paint {
    /// Nothing, or something without one colour.
    None,
    Color(Color),
    /// The `color` of whatever element it is inherited by.
    Current,
}

const BLACK: Color = Color { red: 0, green: 0, blue: 0 };

impl Style {
    /// Where nothing is said: filled black.
    pub(super) const INITIAL: Self =
        Self { fill: Paint::Color(BLACK), stroke: Paint::None, color: BLACK, visible: true };

    /// The style of an element inside one of this style.
    pub(super) fn of_child(mut self, properties: &Properties<'_>) -> Self {
        if let Some(color) = properties.color.and_then(color) {
            self.color = color;
        }
        self.fill = properties.fill.map_or(self.fill, |text| paint(text, self.fill));
        self.stroke = properties.stroke.map_or(self.stroke, |text| paint(text, self.stroke));
        self.visible = match properties.visibility {
            Some("hidden" | "collapse") => false,
            Some("visible" | "initial") => true,
            _ => self.visible,
        };
        self
    }

    /// Colour of the stroke, else of the fill.
    pub(super) fn drawn_color(&self) -> Option<Color> {
        [self.stroke, self.fill].into_iter().find_map(|paint| match paint {
            Paint::None => None,
            Paint::Color(color) => Some(color),
            Paint::Current => Some(self.color),
        })
    }
}

fn paint(text: &str, inherited: Paint) -> Paint {
    match text {
        "inherit" | "unset" => return inherited,
        "none" | "transparent" => return Paint::None,
        _ if text.eq_ignore_ascii_case("currentColor") => return Paint::Current,
        _ => {}
    }
    // `url(#gradient) red`: the colour is what remains when there is no such gradient.
    let fallback = text.strip_prefix("url(").and_then(|rest| rest.split_once(')'));
    match color(fallback.map_or(text, |(_, rest)| rest.trim())) {
        Some(color) => Paint::Color(color),
        None if fallback.is_some() => Paint::None,
        // What can't be read counts as not said.
        None => inherited,
    }
}

fn color(text: &str) -> Option<Color> {
    let color = svgtypes::Color::from_str(text).ok()?;
    Some(Color { red: color.red, green: color.green, blue: color.blue })
}
