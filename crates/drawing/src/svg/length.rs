//! Lengths with units.

use std::str::FromStr;
use svgtypes::Number;

/// Unit of a length in a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measure {
    /// User units, that is pixels.
    Pixels,
    /// A physical unit: its name and its millimetres.
    Physical(&'static str, f64),
    /// Hundredths of the page's size.
    Percent,
    /// Pixels of a letter's size: a letter is taken to be 16 pixels high.
    Letters(f64),
}

/// The units that a length may carry.
const MEASURES: [(&str, Measure); 11] = [
    ("mm", Measure::Physical("millimetres", 1.0)),
    ("cm", Measure::Physical("centimetres", 10.0)),
    ("in", Measure::Physical("inches", 25.4)),
    ("pt", Measure::Physical("points", 25.4 / 72.0)),
    ("pc", Measure::Physical("picas", 25.4 / 6.0)),
    ("q", Measure::Physical("quarter millimetres", 0.25)),
    ("px", Measure::Pixels),
    ("%", Measure::Percent),
    ("rem", Measure::Letters(16.0)),
    ("em", Measure::Letters(16.0)),
    ("ex", Measure::Letters(8.0)),
];

/// A number and its unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Length {
    pub(super) number: f64,
    pub(super) measure: Measure,
}

impl Length {
    /// None when it can't be read.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let of = |number: &str, measure| {
            Number::from_str(number).ok().map(|number| Self { number: number.0, measure })
        };
        for (suffix, measure) in MEASURES {
            let split = text.len().checked_sub(suffix.len()).filter(|&at| text.is_char_boundary(at));
            if let Some((number, unit)) = split.map(|at| text.split_at(at))
                && unit.eq_ignore_ascii_case(suffix)
            {
                return of(number, measure);
            }
        }
        of(text, Measure::Pixels)
    }

    /// In user units; `whole` is what percentages are of.
    pub(super) fn user_units(self, whole: f64, pixels_per_inch: f64) -> f64 {
        match self.measure {
            Measure::Pixels => self.number,
            Measure::Physical(_, millimetres) => self.number * millimetres / 25.4 * pixels_per_inch,
            Measure::Percent => self.number / 100.0 * whole,
            Measure::Letters(pixels) => self.number * pixels,
        }
    }
}
