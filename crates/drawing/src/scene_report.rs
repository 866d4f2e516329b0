//! What became of a drawing when it was made a scene.

use crate::{DrawingFinding, LayerPattern, LengthUnit, Unused};
use std::fmt;
use traverse_geometry::Scene;

/// A scene and what became of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFromDrawing {
    /// Obstacles `LAYER/1`, `LAYER/2`, … in file order, and the work area.
    pub scene: Scene,
    /// What was used, and what is wrong.
    pub report: SceneReport,
}

/// What was used of a drawing, and what is wrong with it.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneReport {
    /// Unit of the file.
    pub unit: LengthUnit,
    /// Whether that unit was assumed because the file names none.
    pub unit_assumed: bool,
    /// Every layer with a curve on it.
    pub layers: Vec<LayerUse>,
    /// Patterns that were asked for and fit no layer.
    pub unmatched_patterns: Vec<LayerPattern>,
    /// What is wrong on the layers that were used.
    pub findings: Vec<DrawingFinding>,
    /// Entities that could not be read, on any layer.
    pub unused: Vec<Unused>,
}

/// So many findings are listed when a report is printed.
const LISTED_FINDINGS: usize = 20;

/// What a layer was used for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayerUse {
    /// Layer name.
    pub layer: String,
    /// What it stands for.
    pub role: LayerRole,
    /// Curves on it.
    pub curve_count: usize,
    /// Loops that they join to; 0 when the layer has no role.
    pub loop_count: usize,
}

/// What a layer stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerRole {
    /// Its outermost loop bounds the work area.
    WorkArea,
    /// Its loops are obstacles.
    Obstacles,
    /// No pattern chose it.
    None,
}

impl SceneReport {
    /// Whether everything on the chosen layers is in the scene: no curve that could not be closed, no entity but
    /// annotation that could not be read on any layer, no pattern that fits nothing. Otherwise a path may run through
    /// something that was drawn.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.unused.iter().any(|unused| unused.why.loses_something())
            && self.unmatched_patterns.is_empty()
            && !self.findings.iter().any(|finding| finding.fault.loses_something())
    }
}

impl fmt::Display for SceneReport {
    /// One line per layer, finding and kind of unused entity; of the findings the first 20.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let assumed = if self.unit_assumed { " (assumed: the file names none)" } else { "" };
        writeln!(f, "unit: {}{assumed}", self.unit)?;
        for LayerUse { layer, role, curve_count, loop_count } in &self.layers {
            let role = match role {
                LayerRole::WorkArea => "work area",
                LayerRole::Obstacles => "obstacles",
                LayerRole::None => "not used",
            };
            writeln!(f, "layer {layer}: {role}, {loop_count} loops of {curve_count} curves")?;
        }
        for pattern in &self.unmatched_patterns {
            writeln!(f, "no layer fits {pattern}")?;
        }
        for finding in self.findings.iter().take(LISTED_FINDINGS) {
            writeln!(f, "{finding}")?;
        }
        if self.findings.len() > LISTED_FINDINGS {
            writeln!(f, "and {} findings more", self.findings.len() - LISTED_FINDINGS)?;
        }
        for unused in &self.unused {
            writeln!(f, "not used: {unused}")?;
        }
        Ok(())
    }
}

/// Why a drawing can't be made a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The layer of the work area holds no usable loop.
    #[error(
        "layer {layer} should bound the work area but holds no closed loop; close it or choose another layer"
    )]
    NoWorkAreaLoop {
        /// Layer name.
        layer: String,
        /// What is wrong on the layer.
        findings: Vec<DrawingFinding>,
    },
    /// More than one loop could bound the work area.
    #[error("{count} loops side by side could bound the work area, the first on layer {layer}; leave one")]
    SeveralWorkAreas {
        /// Layer of the first one.
        layer: String,
        /// How many.
        count: usize,
    },
    /// A hole of the work area that can't be taken out of it.
    #[error("the work area's holes do not fit it: {}", .findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; "))]
    InvalidWorkArea {
        /// What is wrong.
        findings: Vec<DrawingFinding>,
    },
}
