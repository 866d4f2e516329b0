//! What became of a drawing when it was made a scene.

use crate::counted::counted;
use crate::{DrawingFinding, LengthUnit, Part, Role, Section, Selector, Unused};
use std::fmt;
use traverse_geometry::Scene;

/// A scene and what became of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFromDrawing {
    /// Obstacles `LAYER/1`, `LAYER/2`, … in file order, and the work area.
    pub scene: Scene,
    /// Parts to be cut out. They are not in the way of a rapid move.
    pub parts: Vec<Part>,
    /// Sections of a cutting layout, by name. They are not in the way of a rapid move.
    pub sections: Vec<Section>,
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
    /// Every layer with a curve on it; once for each role that its curves have.
    pub layers: Vec<LayerUse>,
    /// Selectors that were asked for and choose no curve.
    pub unmatched_selectors: Vec<Selector>,
    /// What is wrong on the layers that were used.
    pub findings: Vec<DrawingFinding>,
    /// Entities that could not be read, on any layer.
    pub unused: Vec<Unused>,
    /// Those among them that a machine could meet and that may be meant: on chosen layers, and on any layer where
    /// something is chosen by id, group or colour.
    pub lost: Vec<Unused>,
    /// How far at most arcs and segments run from the ellipses and splines that they stand for, millimetres: 0 when
    /// there are none. Clearances of what deviates are larger by as much.
    pub widest_deviation_mm: f64,
}

/// So many findings are listed when a report is printed.
const LISTED_FINDINGS: usize = 20;

/// What a layer was used for.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerUse {
    /// Layer name.
    pub layer: String,
    /// What it stands for.
    pub role: Role,
    /// How high its obstacles reach, millimetres. Absent: higher than any move, or no obstacles.
    pub top_mm: Option<f64>,
    /// Curves on it.
    pub curve_count: usize,
    /// Loops that they join to; 0 when the layer has no role.
    pub loop_count: usize,
}

impl SceneReport {
    /// Whether everything on the chosen layers is in the scene: no curve that could not be closed, no entity
    /// [`lost`](Self::lost), no selector that fits nothing. Otherwise a path may run through something that was drawn.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.lost.is_empty()
            && self.unmatched_selectors.is_empty()
            && !self.findings.iter().any(|finding| finding.fault.loses_something())
    }
}

impl fmt::Display for SceneReport {
    /// One line per layer, finding and kind of unused entity; of the findings the first 20.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let assumed = if self.unit_assumed { " (assumed: the file names none)" } else { "" };
        writeln!(f, "unit: {}{assumed}", self.unit)?;
        for LayerUse { layer, role, top_mm, curve_count, loop_count } in &self.layers {
            let top = top_mm.map(|top| format!(" up to {top} mm")).unwrap_or_default();
            let (loops, curves) = (counted(*loop_count, "loop"), counted(*curve_count, "curve"));
            writeln!(f, "layer {layer}: {role}{top}, {loops} of {curves}")?;
        }
        for selector in &self.unmatched_selectors {
            writeln!(f, "nothing in the drawing fits {selector}")?;
        }
        if self.widest_deviation_mm > 0.0 {
            writeln!(
                f,
                "ellipses and splines are taken as arcs and segments within {} mm; their clearance is larger by as much",
                self.widest_deviation_mm
            )?;
        }
        for finding in self.findings.iter().take(LISTED_FINDINGS) {
            writeln!(f, "{finding}")?;
        }
        if self.findings.len() > LISTED_FINDINGS {
            writeln!(f, "and {} findings more", self.findings.len() - LISTED_FINDINGS)?;
        }
        for unused in &self.unused {
            let lost = if self.lost.contains(unused) { " though it may be in the way" } else { "" };
            writeln!(f, "not used{lost}: {unused}")?;
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
