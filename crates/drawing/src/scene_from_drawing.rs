//! From a drawing to a scene: loops, what lies in what, obstacles and work area.

use crate::obstacles::obstacles_of;
use crate::work_area::work_area_of;
use crate::{
    Drawing, Forest, JOIN_TOLERANCE_MM, LayerRole, LayerUse, Loop, Roles, SceneError, SceneFromDrawing,
    SceneReport, join_loops,
};
use traverse_geometry::{CornerStyle, Scene};

/// How a drawing becomes a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneOptions {
    /// What the layers stand for.
    pub roles: Roles,
    /// Ends of lines and arcs that are no farther apart are joined, millimetres. Default: [`JOIN_TOLERANCE_MM`].
    pub join_tolerance_mm: f64,
    /// The scene's clearance, millimetres.
    pub clearance_mm: f64,
    /// Clearance from the work area's border, millimetres. Absent: `clearance_mm`.
    pub work_area_clearance_mm: Option<f64>,
    /// How barriers turn convex corners. Default: round.
    pub corner_style: CornerStyle,
}

impl SceneOptions {
    /// Default roles and joining, round corners, and this clearance everywhere.
    #[must_use]
    pub fn new(clearance_mm: f64) -> Self {
        Self {
            roles: Roles::default(),
            join_tolerance_mm: JOIN_TOLERANCE_MM,
            clearance_mm,
            work_area_clearance_mm: None,
            corner_style: CornerStyle::default(),
        }
    }
}

/// Loops of one layer that has a role, with what lies in what.
pub(crate) struct LayerLoops<'a> {
    pub(crate) layer: &'a str,
    pub(crate) loops: Vec<Loop>,
    pub(crate) forest: Forest,
}

/// Makes a drawing a scene.
///
/// On a layer of obstacles every outermost loop is an obstacle and the loops directly inside it are its holes; loops
/// inside a hole are obstacles of their own, and so on. Ids are `LAYER/1`, `LAYER/2`, … in the order in which their
/// outer loops were drawn. Each layer stands for itself: loops of one layer make no holes in another's. Loops that
/// cross one another count as solid obstacles side by side.
///
/// The one outermost loop of the work area's layers bounds the work area; the loops directly inside are its holes.
/// When no layer fits, there is no work area.
///
/// # Errors
/// When a layer should bound the work area but does not, or not clearly. Everything else is in the report: look at
/// [`SceneReport::is_complete`] before you trust that a path keeps clear of all that was drawn.
pub fn scene_from_drawing(drawing: &Drawing, options: &SceneOptions) -> Result<SceneFromDrawing, SceneError> {
    let names = drawing.layers.iter().map(|layer| layer.name.as_str());
    let mut report = SceneReport {
        unit: drawing.unit,
        unit_assumed: drawing.unit_assumed,
        layers: Vec::with_capacity(drawing.layers.len()),
        unmatched_patterns: options.roles.unmatched(names),
        findings: Vec::new(),
        unused: drawing.unused.clone(),
    };
    let mut obstacles = Vec::new();
    let mut areas = Vec::new();
    for layer in &drawing.layers {
        let role = options.roles.of(&layer.name);
        let mut loop_count = 0;
        if role != LayerRole::None {
            let joined = join_loops(&layer.name, &layer.curves, options.join_tolerance_mm);
            let forest = Forest::of(&joined.loops);
            loop_count = joined.loops.len();
            let loops = LayerLoops { layer: &layer.name, loops: joined.loops, forest };
            if role == LayerRole::WorkArea {
                areas.push((loops, joined.findings));
            } else {
                report.findings.extend(joined.findings);
                obstacles.extend(obstacles_of(&loops, &mut report.findings));
            }
        }
        let curve_count = layer.curves.len();
        report.layers.push(LayerUse { layer: layer.name.clone(), role, curve_count, loop_count });
    }
    let work_area = work_area_of(areas, &mut report.findings)?;
    let scene = Scene {
        work_area,
        obstacles,
        clearance_mm: options.clearance_mm,
        work_area_clearance_mm: options.work_area_clearance_mm,
        corner_style: options.corner_style,
    };
    Ok(SceneFromDrawing { scene, report })
}
