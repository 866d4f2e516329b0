//! What a path costs, worked out anew.

use crate::curve::{Curve, normalized};
use crate::kinematics::seconds;
use traverse_geometry::{AxisSpeeds, Path, PathStep, TravelCost, Vector};

/// A step as costs see it.
pub(crate) struct Travelled {
    pub(crate) curve: Curve,
    /// By how much the height changes, signed.
    pub(crate) rise: f64,
}

/// The cost of all steps, in the cost's unit. An arc's radius is the mean of both distances from its centre.
pub(crate) fn cost(path: &Path, measure: &TravelCost) -> f64 {
    let steps = travelled(path);
    match measure {
        TravelCost::Length => steps.iter().map(|step| step.curve.length() + step.rise.abs()).sum(),
        TravelCost::AxisSpeeds(speeds) => steps.iter().map(|step| slower_axis(step, speeds)).sum(),
        TravelCost::Kinematics(limits) => seconds(&steps, limits),
    }
}

fn travelled(path: &Path) -> Vec<Travelled> {
    let mut from = path.start;
    let mut below = path.start_z_mm;
    let step = |step: &PathStep| {
        let start = std::mem::replace(&mut from, step.end);
        let height = std::mem::replace(&mut below, step.z_mm);
        let rise = height.zip(step.z_mm).map_or(0.0, |(from, to)| to - from);
        let curve = match step.arc {
            None => Curve::straight(start, step.end),
            Some(arc) => Curve::from_center(start, step.end, arc),
        };
        Travelled { curve, rise }
    };
    path.steps.iter().map(step).collect()
}

fn slower_axis(step: &Travelled, speeds: &AxisSpeeds) -> f64 {
    let vertical = if step.rise == 0.0 { 0.0 } else { step.rise.abs() / speeds.z_mm_per_s };
    vertical
        + match &step.curve {
            Curve::Straight(straight) => chord(straight.b - straight.a, speeds),
            Curve::Circular(_) => round(&step.curve, speeds),
        }
}

fn chord(by: Vector, speeds: &AxisSpeeds) -> f64 {
    f64::max(by.x.abs() / speeds.x_mm_per_s, by.y.abs() / speeds.y_mm_per_s)
}

/// An arc is cut where both axes are equally slow and where one turns back. Between two cuts the same axis is the slower
/// one all the way, so the chord takes as long as the arc.
fn round(curve: &Curve, speeds: &AxisSpeeds) -> f64 {
    let Curve::Circular(circular) = curve else { return 0.0 };
    let diagonal = normalized(Vector::new(speeds.x_mm_per_s, speeds.y_mm_per_s));
    let other = Vector::new(-diagonal.x, diagonal.y);
    let (x, y) = (Vector::new(1.0, 0.0), Vector::new(0.0, 1.0));
    // Where the direction of travel is one of these the spoke is at a right angle to it.
    let spokes = [diagonal, other, x, y].map(|along| Vector::new(-along.y, along.x));
    let mut cuts = vec![0.0, 1.0];
    for spoke in spokes.into_iter().flat_map(|spoke| [spoke, -spoke]) {
        cuts.extend(circular.fraction_of(spoke));
    }
    cuts.sort_by(f64::total_cmp);
    let at = |fraction: f64| {
        // On the mean circle, unlike the ends as they are given.
        let angle = circular.turn * circular.half * (2.0 * fraction - 1.0);
        let (sin, cos) = angle.sin_cos();
        let middle = circular.middle;
        Vector::new(cos * middle.x - sin * middle.y, sin * middle.x + cos * middle.y) * circular.radius
    };
    cuts.windows(2).map(|pair| chord(at(pair[1]) - at(pair[0]), speeds)).sum()
}
