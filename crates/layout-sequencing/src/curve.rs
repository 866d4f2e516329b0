//! A border seen from the right: x as a function of y, straight or circular, and the heights at which two such curves
//! cross or their sum is largest. All in closed form.

use traverse_geometry::Point;

/// x as a function of y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Curve {
    /// x + slope · (y − `at`.y).
    Line {
        /// A point of the line.
        at: Point,
        /// Change of x for each millimetre of y.
        slope: f64,
    },
    /// One half of a circle.
    Arc {
        center: Point,
        radius: f64,
        /// 1 for the right half, which bulges right, −1 for the left one.
        side: f64,
    },
}

impl Curve {
    /// The line through two points of different heights.
    pub(crate) fn line(from: Point, to: Point) -> Self {
        Self::Line { at: from, slope: (to.x - from.x) / (to.y - from.y) }
    }

    /// x at height y. Heights beyond a circle's are those of its lowest and highest point.
    #[inline]
    pub(crate) fn x(&self, y: f64) -> f64 {
        match *self {
            Self::Line { at, slope } => at.x + slope * (y - at.y),
            Self::Arc { center, radius, side } => {
                let rise = y - center.y;
                center.x + side * ((radius - rise) * (radius + rise)).max(0.0).sqrt()
            }
        }
    }

    /// The same curve further right.
    pub(crate) fn shifted(self, by: f64) -> Self {
        match self {
            Self::Line { at, slope } => Self::Line { at: Point::new(at.x + by, at.y), slope },
            Self::Arc { center, radius, side } => {
                Self::Arc { center: Point::new(center.x + by, center.y), radius, side }
            }
        }
    }

    /// The same curve upside down: what was at y is at `whole` − y.
    pub(crate) fn flipped(self, whole: f64) -> Self {
        match self {
            Self::Line { at, slope } => Self::Line { at: Point::new(at.x, whole - at.y), slope: -slope },
            Self::Arc { center, radius, side } => {
                Self::Arc { center: Point::new(center.x, whole - center.y), radius, side }
            }
        }
    }

    /// Heights strictly between `low` and `high` at which both may have the same x, in ascending order; others may be
    /// among them.
    pub(crate) fn crossings(&self, other: &Self, low: f64, high: f64) -> impl Iterator<Item = f64> + use<> {
        let mut heights = match (*self, *other) {
            (Self::Line { at, slope }, Self::Line { at: b, slope: other_slope }) => {
                let apart = at.x - (b.x + other_slope * (at.y - b.y));
                [at.y - apart / (slope - other_slope), f64::NAN]
            }
            (Self::Line { at, slope }, Self::Arc { center, radius, .. })
            | (Self::Arc { center, radius, .. }, Self::Line { at, slope }) => {
                line_and_circle(at, slope, center, radius)
            }
            (
                Self::Arc { center, radius, .. },
                Self::Arc { center: other_center, radius: other_radius, .. },
            ) => circles(center, radius, other_center, other_radius),
        };
        if heights[0] > heights[1] {
            heights.swap(0, 1);
        }
        heights.into_iter().filter(move |&y| low < y && y < high)
    }

    /// The height at which the sum of both is stationary and may be largest; anything, NaN too, where there is none.
    #[inline]
    pub(crate) fn crest(&self, other: &Self) -> Option<f64> {
        match (*self, *other) {
            (Self::Line { .. }, Self::Line { .. }) => None,
            (Self::Line { slope, .. }, Self::Arc { center, radius, side })
            | (Self::Arc { center, radius, side }, Self::Line { slope, .. }) => {
                (side > 0.0).then(|| center.y + radius * slope / slope.hypot(1.0))
            }
            (
                Self::Arc { center, radius, side },
                Self::Arc { center: other_center, radius: other_radius, side: other_side },
            ) => {
                // Equal steepness on either side is equal share of the radius, up to sign.
                let (own, foreign) = (side * radius, other_side * other_radius);
                (side > 0.0 || other_side > 0.0)
                    .then(|| (center.y * foreign + other_center.y * own) / (own + foreign))
            }
        }
    }
}

/// Heights at which a line meets a circle.
fn line_and_circle(at: Point, slope: f64, center: Point, radius: f64) -> [f64; 2] {
    let apart = at.x + slope * (center.y - at.y) - center.x;
    let steep = 1.0 + slope * slope;
    let root = (radius * radius * steep - apart * apart).sqrt();
    [center.y + (-apart * slope - root) / steep, center.y + (-apart * slope + root) / steep]
}

/// Heights at which two circles meet.
fn circles(a: Point, a_radius: f64, b: Point, b_radius: f64) -> [f64; 2] {
    let between = b - a;
    let square = between.norm_squared();
    let along = (square + (a_radius - b_radius) * (a_radius + b_radius)) / (2.0 * square);
    let across = (a_radius * a_radius / square - along * along).sqrt();
    [a.y + along * between.y - across * between.x, a.y + along * between.y + across * between.x]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(x: f64, y: f64, radius: f64, side: f64) -> Curve {
        Curve::Arc { center: Point::new(x, y), radius, side }
    }

    #[test]
    fn lines_and_circles_cross_where_they_have_the_same_x() {
        let line = Curve::line(Point::new(-2.0, -3.0), Point::new(6.0, 5.0));
        let flat = Curve::line(Point::new(-20.0, -1.0), Point::new(20.0, 1.5));
        let curves = [line, flat, arc(0.0, 0.0, 5.0, 1.0), arc(3.0, 1.0, 4.0, 1.0), arc(6.0, 1.0, 4.0, -1.0)];
        for a in curves {
            for b in curves.into_iter().filter(|&b| b != a) {
                let apart = |y: f64| a.x(y) - b.x(y);
                let steps: Vec<f64> = (0..=10_000).map(|i| -2.9 + 6.8 * f64::from(i) / 10_000.0).collect();
                let changes = steps.windows(2).filter(|y| apart(y[0]) * apart(y[1]) < 0.0).count();
                let found = a.crossings(&b, -2.9, 3.9).filter(|&y| apart(y).abs() < 1e-9).count();
                assert_eq!(found, changes, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn crests_are_where_sums_are_largest() {
        let line = Curve::line(Point::new(0.0, 0.0), Point::new(3.0, 4.0));
        let (right, small, hollow) =
            (arc(0.0, 0.0, 5.0, 1.0), arc(0.0, 2.0, 2.5, 1.0), arc(9.0, -1.0, 9.0, -1.0));
        for (a, b) in [(line, right), (right, line), (right, small), (hollow, right), (small, hollow)] {
            let y = a.crest(&b).unwrap();
            let sum = |y: f64| a.x(y) + b.x(y);
            assert!(sum(y) > sum(y - 1e-3) && sum(y) > sum(y + 1e-3), "{a:?} {b:?} {y}");
        }
        assert_eq!(line.crest(&hollow), None);
        assert_eq!(line.crest(&line), None);
    }
}
