//! What a path costs, and what its parts cost at least.

use crate::kinematics::{fastest, rest_seconds, seconds, vertical_seconds};
use crate::measure::{AxisTime, Measure};
use traverse_geometry::{Edge, Path, TravelCost, Vector};

/// A cost above a bound by no more than this share is the bound: rounding of sums of many steps.
const ROUNDING_RATIO: f64 = 1e-11;

/// What `path` costs, in the cost's unit. By limits of speed and acceleration: from rest to rest.
#[must_use]
pub fn travel_cost(path: &Path, cost: &TravelCost) -> f64 {
    match cost {
        TravelCost::Length => path.length(),
        TravelCost::AxisSpeeds(_) => in_plane(path, cost) + vertical(vertical_mm(path), cost),
        TravelCost::Kinematics(limits) => seconds(path, limits),
    }
}

/// What going along `path` in the plane costs at least, beside what [`at_rest`] says.
pub(crate) fn in_plane(path: &Path, cost: &TravelCost) -> f64 {
    match cost {
        TravelCost::Length => path.length(),
        TravelCost::AxisSpeeds(speeds) => {
            let time = AxisTime::new(speeds);
            let step = |edge: Edge| match edge {
                Edge::Segment(segment) => time.along(segment.vector()),
                Edge::Arc(arc) => time.arc(arc.radius, arc.start_angle, arc.sweep),
            };
            path.edges().map(step).sum()
        }
        TravelCost::Kinematics(limits) => {
            path.edges().map(|edge| edge.length()).sum::<f64>() / fastest(limits)
        }
    }
}

/// What going straight along `by` costs at least, beside what [`at_rest`] says.
pub(crate) fn straight(by: Vector, cost: &TravelCost) -> f64 {
    match cost {
        TravelCost::Length => by.norm(),
        TravelCost::AxisSpeeds(speeds) => AxisTime::new(speeds).along(by),
        TravelCost::Kinematics(limits) => by.norm() / fastest(limits),
    }
}

/// What rising or sinking costs, beside what [`at_rest`] says.
pub(crate) fn vertical(mm: f64, cost: &TravelCost) -> f64 {
    match cost {
        TravelCost::Length => mm,
        TravelCost::AxisSpeeds(_) if mm == 0.0 => 0.0,
        TravelCost::AxisSpeeds(speeds) => mm / speeds.z_mm_per_s,
        TravelCost::Kinematics(limits) => vertical_seconds(limits, mm),
    }
}

/// What beginning and ending at rest adds, where a path is at least so long.
pub(crate) fn at_rest(level_mm: f64, vertical_mm: f64, cost: &TravelCost) -> f64 {
    match cost {
        TravelCost::Kinematics(limits) => rest_seconds(limits, level_mm, vertical_mm),
        _ => 0.0,
    }
}

/// A bound of a search's part of the way, in the cost's unit.
pub(crate) fn of_search(bound: f64, cost: &TravelCost) -> f64 {
    match cost {
        // Such ways are searched for by length.
        TravelCost::Kinematics(limits) => bound / fastest(limits),
        TravelCost::Length | TravelCost::AxisSpeeds(_) => bound,
    }
}

/// The bound, or the cost where only rounding sets them apart.
pub(crate) fn bound_of(cost: f64, bound: f64) -> f64 {
    if cost <= bound * (1.0 + ROUNDING_RATIO) { cost } else { bound }
}

fn vertical_mm(path: &Path) -> f64 {
    let mut below = path.start_z_mm;
    let rise = |z_mm: Option<f64>| {
        let from = std::mem::replace(&mut below, z_mm);
        from.zip(z_mm).map_or(0.0, |(from, to)| (to - from).abs())
    };
    path.steps.iter().map(|step| step.z_mm).map(rise).sum()
}
