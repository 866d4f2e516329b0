//! The loops of a drawing by layer and role.

use crate::crossing_loops::{beside_what_they_cross, crossing_loops};
use crate::roles::Chosen;
use crate::{Curve, Drawing, DrawingFinding, Forest, Layer, Loop, Role, Roles, join_loops};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Loops of the curves of one layer that have the same role, with what lies in what.
pub(crate) struct RoleLoops<'a> {
    pub(crate) layer: &'a str,
    pub(crate) chosen: Chosen,
    pub(crate) curves: Cow<'a, [Curve]>,
    /// Curves, by place, that repeat others and were left out. Sorted.
    pub(crate) repeated_curves: Vec<usize>,
    pub(crate) loops: Vec<Loop>,
    pub(crate) forest: Forest,
    pub(crate) findings: Vec<DrawingFinding>,
}

/// Joins the curves, layer by layer and role by role. Curves whose role is not `wanted` are counted and not joined.
pub(crate) fn loops_by_role<'a>(
    drawing: &'a Drawing,
    roles: &Roles,
    tolerance_mm: f64,
    wanted: impl Fn(Role) -> bool,
) -> Vec<RoleLoops<'a>> {
    let wanted = &wanted;
    let of_layer = |layer: &'a Layer| {
        by_role(layer, roles).into_iter().map(move |(chosen, curves)| {
            let mut group = RoleLoops {
                layer: &layer.name,
                repeated_curves: Vec::new(),
                loops: Vec::new(),
                forest: Forest::of(&[]),
                findings: Vec::new(),
                chosen,
                curves,
            };
            if wanted(group.chosen.role) {
                let joined = join_loops(&layer.name, &group.curves, tolerance_mm);
                group.forest = Forest::of(&joined.loops);
                (group.loops, group.findings) = (joined.loops, joined.findings);
                group.repeated_curves = joined.repeated_curves;
                // Of a work area the larger one is the border whatever crosses it.
                if group.chosen.role != Role::WorkArea {
                    group.forest = beside_what_they_cross(&group);
                }
                let crossing = crossing_loops(&group);
                group.findings.extend(crossing);
            }
            group
        })
    };
    drawing.layers.iter().flat_map(of_layer).collect()
}

/// The layer's curves by what they stand for, in file order; a layer with one role is not copied.
fn by_role<'a>(layer: &'a Layer, roles: &Roles) -> BTreeMap<Chosen, Cow<'a, [Curve]>> {
    let mut places: BTreeMap<Chosen, Vec<usize>> = BTreeMap::new();
    for (place, curve) in layer.curves.iter().enumerate() {
        places.entry(roles.choose(&layer.name, &curve.source)).or_default().push(place);
    }
    let alone = places.len() == 1;
    let curves = |places: Vec<usize>| match alone {
        true => Cow::Borrowed(layer.curves.as_slice()),
        false => places.into_iter().map(|place| layer.curves[place].clone()).collect(),
    };
    places.into_iter().map(|(chosen, places)| (chosen, curves(places))).collect()
}
