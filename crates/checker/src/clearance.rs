//! How near one step comes to each solid, and how deep it lies inside.

use crate::arc_distance::{Nearest, nearest};
use crate::boundary::Boundary;
use crate::boundary_tree::{BoundaryTree, StepBox};
use crate::curve::Curve;
use crate::curve_cuts::{Part, remaining};
use crate::inside::is_inside;
use crate::mitre::band_margin;
use std::collections::BTreeMap;
use traverse_geometry::Scene;

/// Places along a part inside a solid at which its depth is measured, the middle among them.
const DEPTH_SAMPLES: u32 = 9;

/// Whether to go on is asked once for so many edges.
const EDGES_BETWEEN_QUESTIONS: usize = 256;

/// How far ahead of a fold of a border it is asked whether that is material, millimetres.
const FOLD_PROBE_MM: f64 = 1e-6;

/// What is known of a step and one solid that it comes near.
#[derive(Clone, Debug)]
pub(crate) struct Approach {
    /// Least margin: distance less clearance, and where.
    pub(crate) worst: Option<Nearest>,
    /// Edges within the tolerance of the step.
    pub(crate) touched: Vec<u32>,
}

/// Borders, ready to be asked.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) boundary: &'a Boundary,
    pub(crate) tree: &'a BoundaryTree,
    pub(crate) tolerance: f64,
    /// Which of the path's steps each step is a part of.
    pub(crate) step_of: &'a [usize],
    /// Whether anybody waits for the answer; after a no what is found does not matter.
    pub(crate) go_on: &'a dyn Fn() -> bool,
}

impl Surroundings<'_> {
    /// Every solid whose barrier comes within the tolerance of `step`. Cost: O(log n + hits).
    pub(crate) fn approaches(&self, step: &Curve) -> BTreeMap<u32, Approach> {
        let mut found: BTreeMap<u32, Approach> = BTreeMap::new();
        self.tree.near(&StepBox::of(step), self.tolerance, |edge| {
            let curve = self.boundary.curve(edge);
            let approach = nearest(step, &curve);
            let entry = found
                .entry(self.boundary.solid_of(edge))
                .or_insert(Approach { worst: None, touched: Vec::new() });
            if approach.distance <= self.tolerance {
                entry.touched.push(edge);
            }
            entry.worst = nearer(entry.worst, self.margin(step, edge, &curve, approach));
        });
        found
    }

    /// The least margin between `step` and any edge of solids that count, if it is below `most`. Cost: O(log n + edges
    /// nearly as near).
    pub(crate) fn least_margin(&self, step: &Curve, most: f64, counts: &dyn Fn(u32) -> bool) -> Option<f64> {
        self.tree.least_margin(&StepBox::of(step), most, |edge| {
            if !counts(self.boundary.solid_of(edge)) {
                return None;
            }
            let curve = self.boundary.curve(edge);
            self.margin(step, edge, &curve, nearest(step, &curve)).map(|margin| margin.distance)
        })
    }

    /// The margin between a step and what one edge and the corner after it keep free.
    fn margin(&self, step: &Curve, edge: u32, curve: &Curve, approach: Nearest) -> Option<Nearest> {
        let solid = self.boundary.solid(edge);
        let Some(limit) = solid.mitred() else {
            return Some(Nearest { distance: approach.distance - solid.clearance, ..approach });
        };
        let band = band_margin(step, curve, solid.clearance);
        let corner = self.boundary.corner_after(edge).filter(|corner| {
            let ahead = corner.at + corner.arriving * FOLD_PROBE_MM;
            !(corner.reversal && is_inside(self.boundary, self.tree, ahead, self.boundary.solid_of(edge)))
        });
        nearer(band, corner.and_then(|corner| corner.margin(step, solid.clearance, limit)))
    }

    /// The parts of `step` inside `solid` and farther than the tolerance from its border, of which the step
    /// touches the edges `touched`.
    pub(crate) fn parts_inside(&self, step: &Curve, solid: u32, touched: &[u32]) -> Vec<Part> {
        let length = step.length();
        let shortest = if length > 0.0 { 1e-3 * self.tolerance / length } else { 0.0 };
        let touched = touched.chunks(EDGES_BETWEEN_QUESTIONS).take_while(|_| (self.go_on)()).flatten();
        let near_border =
            touched.flat_map(|&edge| step.parts_within(&self.boundary.curve(edge), self.tolerance));
        remaining(near_border.collect(), shortest)
            .into_iter()
            .take_while(|_| (self.go_on)())
            .filter(|part| is_inside(self.boundary, self.tree, step.point_at((part.0 + part.1) / 2.0), solid))
            .collect()
    }

    /// The least margin inside `solid`: minus depth less clearance, at the deepest of a few places of each part.
    pub(crate) fn deepest(&self, step: &Curve, solid: u32, parts: &[Part]) -> Option<Nearest> {
        let solid = &self.boundary.solids[solid as usize];
        parts
            .iter()
            .flat_map(|part| {
                (0..DEPTH_SAMPLES).map(move |sample| {
                    let share = (f64::from(sample) + 0.5) / f64::from(DEPTH_SAMPLES);
                    step.point_at(part.0 + (part.1 - part.0) * share)
                })
            })
            .take_while(|_| (self.go_on)())
            .filter_map(|at| {
                let depth = self.tree.distance_among(self.boundary, at, &solid.edges)?;
                Some(Nearest { distance: -depth - solid.clearance, at })
            })
            .min_by(|one, other| one.distance.total_cmp(&other.distance))
    }
}

/// The one with the smaller distance.
pub(crate) fn nearer(one: Option<Nearest>, other: Option<Nearest>) -> Option<Nearest> {
    match (one, other) {
        (Some(one), Some(other)) => Some(if other.distance < one.distance { other } else { one }),
        (one, other) => one.or(other),
    }
}
