//! Controllers and what each of them wants.

use super::settings::GcodeUnit;

/// A family of controllers.
///
/// | | LinuxCNC | Grbl 1.1 | Fanuc |
/// |---|---|---|---|
/// | decimals, mm / inch | 3 / 4, up to 6 / 7 | 3 / 4, up to 4 / 5 | 3 / 4 (IS-B), up to 4 / 5 (IS-C, if asked for) |
/// | a whole number | `X10` | `X10` | `X10.`: without the point it may count in the least increment |
/// | radii at start and end may differ by | 0.005 mm or 0.0005 inch; more if within 0.1 % | 0.005 mm; more if within 0.1 % | 0.01 mm taken; the machine's parameter 3410 decides |
/// | numbers up to | 10¹² last places | 2²³ last places (single precision) | 8 digits |
/// | frame | none | no `%`, and no `? ! ~ $` even in comments | `%`, `O0001`, …, `M30`, `%`; no lower case |
/// | line end | LF | LF | CR LF |
/// | longest line | 255 | 79 | 255 taken |
/// | diameter programming | G7, G8 | none | a parameter of the machine; nothing is written |
/// | path between blocks | G61: exact path, not the rounding default | always exact | its default: G64 |
/// | G0 | straight | straight | straight only if parameter 1401#1 (LRP) is 1; use fed straight moves otherwise |
///
/// Sources: LinuxCNC, G-code reference, "G2, G3 Arc Move" and "G64"; Grbl 1.1, `gcode.c`, `config.h`, `protocol.h`;
/// Fanuc, operator's manuals of series 0i (G00, G02/G03, alarm PS0020).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GcodeDialect {
    /// LinuxCNC 2.8 and later.
    #[default]
    LinuxCnc,
    /// Grbl 1.1 and what descends from it.
    Grbl,
    /// Fanuc and what understands its programs: mills in G17, lathes of G-code system A in G18.
    Fanuc,
}

impl GcodeDialect {
    /// Every dialect.
    pub const ALL: [Self; 3] = [Self::LinuxCnc, Self::Grbl, Self::Fanuc];

    /// Its name in profiles: `linuxcnc`, `grbl`, `fanuc`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::LinuxCnc => "linuxcnc",
            Self::Grbl => "grbl",
            Self::Fanuc => "fanuc",
        }
    }

    /// The dialect of that name, upper and lower case alike.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|dialect| dialect.name().eq_ignore_ascii_case(name))
    }

    /// Decimal places that are tried first.
    #[must_use]
    pub fn usual_decimals(self, unit: GcodeUnit) -> u8 {
        match unit {
            GcodeUnit::Millimetres => 3,
            GcodeUnit::Inches => 4,
        }
    }

    /// Decimal places that are tried last when none are asked for.
    pub(crate) fn finest_automatic_decimals(self, unit: GcodeUnit) -> u8 {
        match self {
            Self::Fanuc => self.usual_decimals(unit),
            Self::LinuxCnc | Self::Grbl => self.most_decimals(unit),
        }
    }

    /// The most decimal places that it takes.
    #[must_use]
    pub fn most_decimals(self, unit: GcodeUnit) -> u8 {
        let finer = match self {
            Self::LinuxCnc => 3,
            Self::Grbl | Self::Fanuc => 1,
        };
        self.usual_decimals(unit) + finer
    }

    /// By how much the radii at start and end of an arc may differ, millimetres.
    #[must_use]
    pub fn radius_tolerance_mm(self, unit: GcodeUnit, radius_mm: f64) -> f64 {
        let relative = 0.001 * radius_mm;
        match (self, unit) {
            (Self::LinuxCnc, GcodeUnit::Inches) => relative.clamp(0.0005 * 25.4, 0.05 * 25.4),
            (Self::LinuxCnc | Self::Grbl, _) => relative.clamp(0.005, 0.5),
            (Self::Fanuc, _) => 0.01,
        }
    }

    /// The largest number that it reads to the last place, counted in last places.
    pub(crate) fn largest_count(self) -> i64 {
        match self {
            Self::LinuxCnc => 1_000_000_000_000,
            Self::Grbl => 1 << 23,
            Self::Fanuc => 99_999_999,
        }
    }

    pub(crate) fn line_end(self) -> &'static str {
        match self {
            Self::LinuxCnc | Self::Grbl => "\n",
            Self::Fanuc => "\r\n",
        }
    }

    pub(crate) fn longest_line(self) -> usize {
        match self {
            Self::Grbl => 79,
            Self::LinuxCnc | Self::Fanuc => 255,
        }
    }

    /// Whether whole numbers end in a point.
    pub(crate) fn keeps_point(self) -> bool {
        self == Self::Fanuc
    }
}
