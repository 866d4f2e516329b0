//! Where a curve meets a line or a circle, and which parts of it lie within reach of another curve.
//!
//! Half angles come from sin²(α/2), not from cos α: a circle of a kilometre that touches is resolved as finely
//! as its points are.

use crate::curve::{Circular, Curve, Straight, normalized, right_of};
use traverse_geometry::{Point, Vector};

/// A part of a curve, by fractions of its way.
pub(crate) type Part = (f64, f64);

impl Curve {
    /// Adds the fractions where `normal` · (x − `origin`) is `offset`. `normal` has length 1.
    pub(crate) fn cut_by_line(&self, origin: Point, normal: Vector, offset: f64, cuts: &mut Vec<f64>) {
        match self {
            Self::Straight(Straight { a, b }) => {
                let rise = normal.dot(&(b - a));
                if rise != 0.0 {
                    push_within((offset - normal.dot(&(a - origin))) / rise, cuts);
                }
            }
            Self::Circular(circular) => {
                let height = offset - normal.dot(&(circular.center - origin));
                let square = (circular.radius - height) / (2.0 * circular.radius);
                circular.cut_at(normal, square, cuts);
            }
        }
    }

    /// Adds the fractions where the distance from `center` is `radius`.
    pub(crate) fn cut_by_circle(&self, center: Point, radius: f64, cuts: &mut Vec<f64>) {
        match self {
            Self::Straight(straight) => {
                let length = straight.length();
                if length == 0.0 {
                    return;
                }
                let along = straight.direction();
                let to_center = center - straight.a;
                let height = right_of(along).dot(&to_center);
                let square = (radius - height) * (radius + height);
                if square >= 0.0 {
                    let foot = along.dot(&to_center);
                    push_within((foot - square.sqrt()) / length, cuts);
                    push_within((foot + square.sqrt()) / length, cuts);
                }
            }
            Self::Circular(circular) => {
                let axis = center - circular.center;
                let distance = axis.norm();
                if distance == 0.0 || circular.radius == 0.0 {
                    return;
                }
                let gap = distance - circular.radius;
                let square = (radius - gap) * (radius + gap) / (4.0 * circular.radius * distance);
                circular.cut_at(axis / distance, square, cuts);
            }
        }
    }

    /// Adds the fractions where a circular curve is farthest along and against `direction`.
    pub(crate) fn cut_by_direction(&self, direction: Vector, cuts: &mut Vec<f64>) {
        if let Self::Circular(circular) = self {
            cuts.extend(circular.fraction_of(direction));
            cuts.extend(circular.fraction_of(-direction));
        }
    }

    /// The parts that lie within `reach` of `other`, in order and apart. Cost: constant.
    pub(crate) fn parts_within(&self, other: &Self, reach: f64) -> Vec<Part> {
        let mut cuts = vec![0.0, 1.0];
        match other {
            Self::Straight(straight) => {
                let normal = right_of(straight.direction());
                if normal != Vector::zeros() {
                    self.cut_by_line(straight.a, normal, reach, &mut cuts);
                    self.cut_by_line(straight.a, normal, -reach, &mut cuts);
                }
            }
            Self::Circular(circular) => {
                self.cut_by_circle(circular.center, circular.radius + reach, &mut cuts);
                if circular.radius > reach {
                    self.cut_by_circle(circular.center, circular.radius - reach, &mut cuts);
                }
            }
        }
        self.cut_by_circle(other.start(), reach, &mut cuts);
        self.cut_by_circle(other.end(), reach, &mut cuts);
        cuts.sort_by(f64::total_cmp);
        let mut parts: Vec<Part> = Vec::new();
        for pair in cuts.windows(2) {
            let (from, to) = (pair[0], pair[1]);
            if to <= from || other.distance_to_point(self.point_at((from + to) / 2.0)) > reach {
                continue;
            }
            match parts.last_mut() {
                Some(last) if last.1 == from => last.1 = to,
                _ => parts.push((from, to)),
            }
        }
        parts
    }
}

impl Circular {
    /// Adds the fractions of both directions at the angle α from `axis`, `square` being sin²(α/2).
    fn cut_at(&self, axis: Vector, square: f64, cuts: &mut Vec<f64>) {
        if !(0.0..=1.0).contains(&square) {
            return;
        }
        // cos α = 1 − 2 s², sin α = 2 s √(1 − s²)
        let cos = 1.0 - 2.0 * square;
        let sin = 2.0 * (square * (1.0 - square)).sqrt();
        for side in [sin, -sin] {
            cuts.extend(self.fraction_of(normalized(axis * cos + right_of(axis) * side)));
        }
    }
}

fn push_within(fraction: f64, cuts: &mut Vec<f64>) {
    if (0.0..=1.0).contains(&fraction) {
        cuts.push(fraction);
    }
}

/// What is left of [0, 1] without `parts`, dropping what is shorter than `shortest`.
pub(crate) fn remaining(mut parts: Vec<Part>, shortest: f64) -> Vec<Part> {
    parts.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut left = Vec::new();
    let mut reached = 0.0;
    for (from, to) in parts.into_iter().chain([(1.0, 1.0)]) {
        if from - reached > shortest {
            left.push((reached, from));
        }
        reached = f64::max(reached, to);
    }
    left
}
