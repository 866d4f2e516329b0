//! stub
use crate::{Drawing, LayerPattern, Roles, SceneError, SceneFromDrawing, SceneReport};
use traverse_geometry::{CornerStyle, Scene};

/// How a drawing becomes a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneOptions {
    /// What the layers stand for.
    pub roles: Roles,
    /// Ends of lines and arcs that are no farther apart are joined, millimetres.
    pub join_tolerance_mm: f64,
    /// The scene's clearance, millimetres.
    pub clearance_mm: f64,
    /// Clearance from the work area's border, millimetres. Absent: `clearance_mm`.
    pub work_area_clearance_mm: Option<f64>,
    /// How barriers turn convex corners.
    pub corner_style: CornerStyle,
}

impl SceneOptions {
    /// stub
    #[must_use]
    pub fn new(clearance_mm: f64) -> Self {
        Self {
            roles: Roles::default(),
            join_tolerance_mm: 0.01,
            clearance_mm,
            work_area_clearance_mm: None,
            corner_style: CornerStyle::Round,
        }
    }
}

/// stub
///
/// # Errors
/// stub
pub fn scene_from_drawing(drawing: &Drawing, options: &SceneOptions) -> Result<SceneFromDrawing, SceneError> {
    let _: Vec<LayerPattern> = options.roles.unmatched(drawing.layers.iter().map(|l| l.name.as_str()));
    Ok(SceneFromDrawing {
        scene: Scene {
            work_area: None,
            obstacles: vec![],
            clearance_mm: options.clearance_mm,
            work_area_clearance_mm: options.work_area_clearance_mm,
            corner_style: options.corner_style,
        },
        report: SceneReport {
            unit: drawing.unit,
            unit_assumed: drawing.unit_assumed,
            layers: vec![],
            unmatched_patterns: vec![],
            findings: vec![],
            unused: drawing.unused.clone(),
        },
    })
}
