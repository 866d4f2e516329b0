//! From a drawing to a scene: loops, what lies in what, obstacles, work area, parts and sections.

use crate::obstacles::{Shape, shapes_of, with_clearance};
use crate::role_loops::{RoleLoops, loops_by_role};
use crate::work_area::work_area_of;
use crate::{
    Drawing, JOIN_TOLERANCE_MM, LayerUse, Part, Role, Roles, SceneError, SceneFromDrawing, SceneReport,
    Section, Unused,
};
use std::collections::BTreeMap;
use traverse_geometry::{CornerStyle, Scene};

/// How a drawing becomes a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneOptions {
    /// What the curves stand for.
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

/// Makes a drawing a scene.
///
/// Curves are joined with those of their layer that have the same role. Of obstacles every outermost loop is one and
/// the loops directly inside it are its holes; loops inside a hole are obstacles of their own, and so on. Ids are
/// `LAYER/1`, `LAYER/2`, … in the order in which their outer loops were drawn, one selector's after the other's. Each layer stands for itself: loops of
/// one layer make no holes in another's. Loops that cross one another count as solid obstacles side by side. Parts
/// are made in the same way.
///
/// The one outermost loop of the work area's layers bounds the work area; the loops directly inside are its holes.
/// When nothing fits, there is no work area.
///
/// Where arcs and segments stand for an ellipse or a spline they run up to [`crate::Curve::deviation_mm`] beside it.
/// The clearance of such an obstacle, or of the border, is larger by as much: what is asked for is kept from the true
/// curve.
///
/// # Errors
/// When something should bound the work area but does not, or not clearly. Everything else is in the report: look at
/// [`SceneReport::is_complete`] before you trust that a path keeps clear of all that was drawn.
pub fn scene_from_drawing(drawing: &Drawing, options: &SceneOptions) -> Result<SceneFromDrawing, SceneError> {
    let mut report = SceneReport {
        unit: drawing.unit,
        unit_assumed: drawing.unit_assumed,
        layers: Vec::with_capacity(drawing.layers.len()),
        unmatched_selectors: options.roles.unmatched(drawing),
        findings: Vec::new(),
        lost: drawing.unused.iter().filter(|unused| may_be_missed(unused, &options.roles)).cloned().collect(),
        unused: drawing.unused.clone(),
        widest_deviation_mm: 0.0,
    };
    let (mut obstacles, mut parts, mut areas) = (Vec::new(), Vec::new(), Vec::new());
    let mut sections: BTreeMap<String, Section> = BTreeMap::new();
    let mut numbers: BTreeMap<(Role, String), usize> = BTreeMap::new();
    let mut number = |role: Role, layer: &str| {
        let last = numbers.entry((role, layer.to_owned())).or_default();
        *last += 1;
        format!("{layer}/{last}")
    };
    let wanted = |role| role != Role::None;
    for mut group in loops_by_role(drawing, &options.roles, options.join_tolerance_mm, wanted) {
        report.layers.push(group.layer_use(&options.roles));
        report.widest_deviation_mm = report.widest_deviation_mm.max(group.deviation());
        let found = std::mem::take(&mut group.findings);
        if group.chosen.role == Role::WorkArea {
            areas.push((group, found));
            continue;
        }
        report.findings.extend(found);
        match group.chosen.role {
            Role::Obstacle => {
                let role = &options.roles.obstacles[group.chosen.place];
                obstacles.extend(shapes_of(&group, &mut report.findings).into_iter().map(|shape| {
                    with_clearance(number(Role::Obstacle, group.layer), shape, role, options.clearance_mm)
                }));
            }
            Role::Part => {
                for Shape { polygon, deviation_mm } in shapes_of(&group, &mut report.findings) {
                    parts.push(Part { id: number(Role::Part, group.layer), shape: polygon, deviation_mm });
                }
            }
            Role::Section => {
                let section = sections.entry(group.chosen.name.clone()).or_default();
                section.id.clone_from(&group.chosen.name);
                for shape in shapes_of(&group, &mut report.findings) {
                    section.deviation_mm = section.deviation_mm.max(shape.deviation_mm);
                    section.shapes.push(shape.polygon);
                }
            }
            Role::WorkArea | Role::None => {}
        }
    }
    let work_area = work_area_of(areas, &mut report.findings)?;
    let asked = options.work_area_clearance_mm;
    let work_area_clearance_mm = match &work_area {
        Some(area) if area.deviation_mm > 0.0 => {
            Some(asked.unwrap_or(options.clearance_mm) + area.deviation_mm)
        }
        _ => asked,
    };
    let scene = Scene {
        work_area: work_area.map(|area| area.polygon),
        obstacles,
        clearance_mm: options.clearance_mm,
        work_area_clearance_mm,
        corner_style: options.corner_style,
    };
    Ok(SceneFromDrawing { scene, parts, sections: sections.into_values().collect(), report })
}

/// Whether a machine could meet it where something was chosen. What lies on an unknown layer may be anywhere.
fn may_be_missed(unused: &Unused, roles: &Roles) -> bool {
    unused.why.loses_something() && (unused.layer.is_empty() || roles.may_choose_on(&unused.layer))
}

impl RoleLoops<'_> {
    fn layer_use(&self, roles: &Roles) -> LayerUse {
        let obstacle = (self.chosen.role == Role::Obstacle).then(|| &roles.obstacles[self.chosen.place]);
        LayerUse {
            layer: self.layer.to_owned(),
            role: self.chosen.role,
            top_mm: obstacle.and_then(|role| role.top_mm),
            curve_count: self.curves.len(),
            loop_count: self.loops.len(),
        }
    }

    /// The widest deviation of any of its loops, millimetres.
    fn deviation(&self) -> f64 {
        self.loops.iter().map(|each| each.deviation_mm).fold(0.0, f64::max)
    }
}
