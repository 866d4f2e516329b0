//! Shapes with holes from the loops of one layer and role.

use crate::role_loops::RoleLoops;
use crate::{DrawingFinding, Fault, Loop, ObstacleRole};
use traverse_geometry::{Finding, Obstacle, Point, Polygon, Ring};

/// A polygon, and how far at most it runs from what was drawn.
pub(crate) struct Shape {
    pub(crate) polygon: Polygon,
    pub(crate) deviation_mm: f64,
}

/// An obstacle of that shape and top. It keeps a clearance of its own where one is asked for, or where it deviates from what
/// was drawn.
pub(crate) fn with_clearance(id: String, shape: Shape, role: &ObstacleRole, clearance_mm: f64) -> Obstacle {
    let clearance_mm = role.clearance_mm.unwrap_or(clearance_mm);
    let widened = (shape.deviation_mm > 0.0).then_some(clearance_mm + shape.deviation_mm);
    Obstacle { id, shape: shape.polygon, clearance_mm: widened.or(role.clearance_mm), top_z_mm: role.top_mm }
}

/// The shapes of a layer, outermost loops and islands, in the order in which they were drawn.
pub(crate) fn shapes_of(layer: &RoleLoops<'_>, findings: &mut Vec<DrawingFinding>) -> Vec<Shape> {
    let mut shapes: Vec<(usize, Polygon)> = Vec::new();
    let mut outers: Vec<usize> = layer.forest.roots().collect();
    while let Some(outer) = outers.pop() {
        let children = &layer.forest.children[outer];
        let Some(outer_ring) = layer.ring(outer, findings) else {
            // What lies in a loop that is no ring stands for itself.
            outers.extend(children);
            continue;
        };
        let mut holes = Vec::new();
        let mut hole_loops = Vec::new();
        for &child in children {
            let Some(hole) = layer.ring(child, findings) else {
                outers.extend(&layer.forest.children[child]);
                continue;
            };
            match Polygon::new(outer_ring.clone(), vec![hole.clone()]) {
                Ok(_) => {
                    outers.extend(&layer.forest.children[child]);
                    holes.push(hole);
                    hole_loops.push(child);
                }
                Err(why) => {
                    let fault = |finding| Fault::CrossingLoops { finding };
                    findings.extend(layer.findings_at(outer, &[child], why, fault));
                    outers.push(child);
                }
            }
        }
        let shape = Polygon::new(outer_ring.clone(), holes).unwrap_or_else(|why| {
            // Holes that cross one another: none is taken, so that nothing drawn becomes passable by accident.
            let fault = |finding| Fault::CrossingLoops { finding };
            findings.extend(layer.findings_at(outer, &hole_loops, why, fault));
            Polygon::from_ring(outer_ring)
        });
        shapes.push((outer, shape));
    }
    shapes.sort_by_key(|(outer, _)| *outer);
    let deviation = |outer: usize| {
        let inside = layer.forest.children[outer].iter().chain([&outer]);
        inside.map(|&each| layer.loops[each].deviation_mm).fold(0.0, f64::max)
    };
    shapes.into_iter().map(|(outer, polygon)| Shape { polygon, deviation_mm: deviation(outer) }).collect()
}

impl RoleLoops<'_> {
    /// The loop as a valid ring; otherwise everything that is wrong is a finding.
    pub(crate) fn ring(&self, each: usize, findings: &mut Vec<DrawingFinding>) -> Option<Ring> {
        let found = &self.loops[each];
        let straight = found.bulges.iter().all(|&bulge| bulge == 0.0);
        let bulges = if straight { Vec::new() } else { found.bulges.clone() };
        Ring::new(found.vertices.clone(), bulges)
            .map_err(|why| {
                findings.extend(self.findings_at(each, &[], why, |finding| Fault::InvalidLoop { finding }));
            })
            .ok()
    }

    /// What geometry says of the loop `each` with the holes `holes`, with the layer and the place.
    pub(crate) fn findings_at(
        &self,
        each: usize,
        holes: &[usize],
        why: Vec<Finding>,
        fault: impl Fn(Finding) -> Fault,
    ) -> Vec<DrawingFinding> {
        let finding = |finding: Finding| {
            // Without a place of its own it is meant as a whole.
            let meant = &self.loops[holes.first().copied().unwrap_or(each)];
            let place = finding.place.unwrap_or(meant.vertices[0]);
            self.finding(meant, place, fault(finding))
        };
        why.into_iter().map(finding).collect()
    }

    /// Something wrong with a loop.
    pub(crate) fn finding(&self, meant: &Loop, place: Point, fault: Fault) -> DrawingFinding {
        DrawingFinding::new(self.layer, &self.curves[meant.first_curve].source, place, fault)
    }
}
