//! Units of length of a drawing.

use std::fmt;

/// A unit of length that a drawing is in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthUnit {
    /// Its name, such as `inches`.
    pub name: &'static str,
    /// Millimetres in one unit.
    pub millimetres: f64,
}

impl LengthUnit {
    /// Millimetres: what a drawing is taken to be in when it does not say.
    pub const MILLIMETRES: Self = Self { name: "millimetres", millimetres: 1.0 };
    /// Inches.
    pub const INCHES: Self = Self { name: "inches", millimetres: 25.4 };

    /// The unit that `$INSUNITS` stands for; none when it is 0 (unitless) or no length that a machine cuts.
    #[must_use]
    pub fn from_insunits(code: i16) -> Option<Self> {
        let (name, millimetres) = match code {
            1 => ("inches", 25.4),
            2 => ("feet", 304.8),
            4 => ("millimetres", 1.0),
            5 => ("centimetres", 10.0),
            6 => ("metres", 1000.0),
            8 => ("microinches", 25.4e-6),
            9 => ("mils", 0.0254),
            10 => ("yards", 914.4),
            13 => ("microns", 0.001),
            14 => ("decimetres", 100.0),
            21 => ("US survey feet", 1_200_000.0 / 3937.0),
            22 => ("US survey inches", 100_000.0 / 3937.0),
            _ => return None,
        };
        Some(Self { name, millimetres })
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}
