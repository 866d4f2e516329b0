//! What is wrong with G-code settings.

use super::dialect::GcodeDialect;
use super::settings::{
    ArcMotion, GcodePlane, GcodeSettings, LARGEST_CHORD_TOLERANCE_MM, SMALLEST_CHORD_TOLERANCE_MM,
    StraightMotion, XWord,
};
use std::fmt;

/// The slowest and the fastest feed, millimetres per minute.
const FEEDS_MM_PER_MIN: (f64, f64) = (1.0, 1e6);

/// The most lines of a header, footer or safe start.
const LINE_LIMIT: usize = 1000;

/// One thing that is wrong with settings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SettingFinding {
    /// Which setting, as profiles name it.
    pub field: &'static str,
    /// Its value.
    pub value: String,
    /// What is wrong and what to do.
    pub message: String,
}

impl fmt::Display for SettingFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}: {}", self.field, self.value, self.message)
    }
}

impl GcodeSettings {
    /// Everything that is wrong with these settings. Empty: they can be written with.
    #[must_use]
    pub fn check(&self) -> Vec<SettingFinding> {
        let mut findings = Vec::new();
        let mut found = |field, value: String, message: String| {
            findings.push(SettingFinding { field, value, message });
        };
        let dialect = self.dialect.name();
        let most = self.dialect.most_decimals(self.unit);
        if let Some(decimals) = self.decimals.filter(|places| !(1..=most).contains(places)) {
            found("decimals", decimals.to_string(), format!("{dialect} takes 1 to {most} in this unit"));
        }
        if self.dialect == GcodeDialect::Grbl && self.plane == (GcodePlane::Zx { x: XWord::Diameter }) {
            let message = "grbl knows no diameter programming; use radius".to_owned();
            found("x_word", "diameter".to_owned(), message);
        }
        if !(1..=9999).contains(&self.program_number) {
            found("program_number", self.program_number.to_string(), "use 1 to 9999".to_owned());
        }
        let mut feed = |field, feed: f64| {
            let (slowest, fastest) = FEEDS_MM_PER_MIN;
            if !(slowest..=fastest).contains(&feed) {
                found(field, feed.to_string(), format!("use {slowest} to {fastest} mm/min"));
            }
        };
        if let StraightMotion::Fed { feed_mm_per_min } = self.straight {
            feed("straight_feed_mm_per_min", feed_mm_per_min);
        }
        match self.arcs {
            ArcMotion::Fed { feed_mm_per_min } => feed("arc_feed_mm_per_min", feed_mm_per_min),
            ArcMotion::Chords { tolerance_mm } => {
                let (least, largest) = (SMALLEST_CHORD_TOLERANCE_MM, LARGEST_CHORD_TOLERANCE_MM);
                if !(least..=largest).contains(&tolerance_mm) {
                    let message = format!("use {least} to {largest} mm");
                    found("chord_tolerance_mm", tolerance_mm.to_string(), message);
                }
            }
        }
        for (field, lines) in [
            ("header", Some(&self.header)),
            ("safe_start", self.safe_start.as_ref()),
            ("footer", self.footer.as_ref()),
        ] {
            let lines = lines.map_or(&[][..], Vec::as_slice);
            if lines.len() > LINE_LIMIT {
                found(field, format!("{} lines", lines.len()), format!("use at most {LINE_LIMIT}"));
            }
            for line in lines.iter().take(LINE_LIMIT) {
                if let Err(message) = check_line(line, self.dialect) {
                    found(field, format!("`{}`", line.escape_debug()), message);
                }
            }
        }
        findings
    }
}

/// Whether the controller reads a line that was written by hand.
fn check_line(line: &str, dialect: GcodeDialect) -> Result<(), String> {
    let name = dialect.name();
    if let Some(c) = line.chars().find(|c| !(' '..='~').contains(c)) {
        return Err(format!("`{}` is not printable ASCII; leave it out", c.escape_debug()));
    }
    if line.len() > dialect.longest_line() {
        return Err(format!("{name} takes lines of {} characters; shorten it", dialect.longest_line()));
    }
    if line.contains('%') {
        return Err("`%` ends a program; leave it out, where it is needed it is written anyway".to_owned());
    }
    let mut in_comment = false;
    for c in line.chars() {
        match (c, in_comment) {
            ('(', true) => return Err("comments must not be nested; take out one `(`".to_owned()),
            (')', false) if !line.contains(';') => return Err("`)` closes nothing; take it out".to_owned()),
            ('(', false) => in_comment = true,
            (')', true) => in_comment = false,
            (';', false) if dialect != GcodeDialect::Fanuc => break,
            _ => {}
        }
    }
    if in_comment {
        return Err("the comment is not closed; add `)`".to_owned());
    }
    match dialect {
        GcodeDialect::Grbl if line.contains(['?', '!', '~', '$']) => {
            Err("grbl acts on `?`, `!`, `~` and `$` at once, even in comments; leave them out".to_owned())
        }
        GcodeDialect::Fanuc if line.contains(|c: char| c.is_ascii_lowercase()) => {
            Err("fanuc takes no lower case; use capitals".to_owned())
        }
        GcodeDialect::Fanuc if line.contains(';') => Err("`;` ends a block; put comments in ( )".to_owned()),
        _ => Ok(()),
    }
}
