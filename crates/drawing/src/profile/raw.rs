//! A profile as its TOML says it: keys and types right, values not yet looked at.

use super::ProfileFinding;
use super::line_index::LineIndex;
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawProfiles {
    pub(crate) machine: BTreeMap<String, Spanned<RawMachine>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawMachine {
    pub(crate) clearance_mm: Option<Spanned<f64>>,
    pub(crate) border_clearance_mm: Option<Spanned<f64>>,
    pub(crate) corner_style: Option<Spanned<RawCornerStyle>>,
    pub(crate) miter_limit: Option<Spanned<f64>>,
    pub(crate) g0: Option<Spanned<RawMotion>>,
    #[serde(default)]
    pub(crate) roles: RawRoles,
    #[serde(default)]
    pub(crate) speeds: RawSpeeds,
    pub(crate) gcode: Option<Spanned<RawGcode>>,
    #[serde(default)]
    pub(crate) tools: BTreeMap<String, Spanned<RawTool>>,
    #[serde(default)]
    pub(crate) offsets: BTreeMap<String, Spanned<[f64; 2]>>,
}

/// A tool: its clearance, or what that is made of.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawTool {
    pub(crate) clearance_mm: Option<f64>,
    pub(crate) diameter_mm: Option<f64>,
    pub(crate) margin_mm: Option<f64>,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RawCornerStyle {
    Round,
    Miter,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RawMotion {
    Linear,
    DogLeg,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawRoles {
    pub(crate) work_area: Option<Spanned<Vec<String>>>,
    pub(crate) parts: Option<Spanned<Vec<String>>>,
    pub(crate) sections: Option<Spanned<Vec<String>>>,
    pub(crate) obstacles: Option<Spanned<Vec<RawObstacleRole>>>,
}

/// A selector alone, or with what is the same for all that it chooses.
#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "write a selector such as \"CLAMPS*\", or { select = \"CLAMPS*\", top_mm = 25.0 }"
)]
pub(crate) enum RawObstacleRole {
    Selector(String),
    Table(RawObstacleTable),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawObstacleTable {
    pub(crate) select: String,
    pub(crate) top_mm: Option<f64>,
    pub(crate) clearance_mm: Option<f64>,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawSpeeds {
    pub(crate) arc_feed_mm_per_min: Option<Spanned<f64>>,
    pub(crate) straight_feed_mm_per_min: Option<Spanned<f64>>,
    pub(crate) rapid_mm_per_min: Option<Spanned<f64>>,
    pub(crate) rapid_x_mm_per_min: Option<Spanned<f64>>,
    pub(crate) rapid_y_mm_per_min: Option<Spanned<f64>>,
    pub(crate) rapid_z_mm_per_min: Option<Spanned<f64>>,
    pub(crate) acceleration_mm_per_s2: Option<Spanned<f64>>,
    pub(crate) junction_deviation_mm: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RawGcode {
    pub(crate) dialect: Option<RawDialect>,
    pub(crate) unit: Option<RawUnit>,
    pub(crate) plane: Option<RawPlane>,
    pub(crate) x_word: Option<Spanned<RawXWord>>,
    pub(crate) decimals: Option<Spanned<u8>>,
    pub(crate) straight: Option<RawStraight>,
    pub(crate) arcs: Option<RawArcs>,
    pub(crate) chord_tolerance_mm: Option<Spanned<f64>>,
    pub(crate) safe_start: Option<Spanned<Vec<String>>>,
    pub(crate) header: Option<Spanned<Vec<String>>>,
    pub(crate) footer: Option<Spanned<Vec<String>>>,
    pub(crate) program_number: Option<Spanned<u16>>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RawDialect {
    LinuxCnc,
    Grbl,
    Fanuc,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RawUnit {
    Mm,
    Inch,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
pub(crate) enum RawPlane {
    G17,
    G18,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RawXWord {
    Radius,
    Diameter,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
pub(crate) enum RawStraight {
    G0,
    G1,
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum RawArcs {
    Fed,
    Chords,
}

/// Reads the keys; the first that is wrong is the one finding.
pub(crate) fn read(text: &str) -> Result<RawProfiles, Vec<ProfileFinding>> {
    let lines = LineIndex::new(text);
    let finding = |error: &toml::de::Error, key: String| {
        let line = error.span().map_or(1, |span| lines.line(span.start));
        let message = format!("{}; correct this line", error.message().replace('\n', "; "));
        vec![ProfileFinding { line, key, message }]
    };
    let toml = toml::Deserializer::parse(text).map_err(|error| finding(&error, "toml".to_owned()))?;
    serde_path_to_error::deserialize(toml).map_err(|error| finding(error.inner(), key_of(error.path())))
}

/// The key as it stands in the file: `Spanned` passes through a key of its own.
fn key_of(path: &serde_path_to_error::Path) -> String {
    let own = |segment: &&serde_path_to_error::Segment| !segment.to_string().starts_with("$__serde_spanned");
    let keys: Vec<String> = path.iter().filter(own).map(ToString::to_string).collect();
    if keys.is_empty() { "toml".to_owned() } else { keys.join(".") }
}
