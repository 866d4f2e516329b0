//! Mitred barriers: how far a step lies outside the part of a barrier that one edge or one corner makes.
//!
//! The barrier is the union of the obstacle, a band along each edge and a kite at each convex corner. Inside the
//! strip of an edge the gauge is the perpendicular distance; inside the cone of a corner it is the greater of the
//! distances from both lines. They agree where strip and cone meet. The gauge's least value along a step lies
//! at an end, at the border of strip or cone, at a turning point or where two distances are equal: all are tried.

use crate::arc_distance::Nearest;
use crate::curve::{Curve, cross, normalized, right_of};
use traverse_geometry::{Orientation, Point, Vector, orientation};

/// How far outside strip or cone a place may lie to count as on its border, millimetres: the rounding of
/// coordinates up to a kilometre.
const REGION_SLACK_MM: f64 = 1e-9;

/// Below this sine two opposite directions count as a reversal.
const REVERSAL_SINE: f64 = 1e-9;

/// A convex corner of an obstacle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) at: Point,
    /// Direction of the edge that arrives.
    pub(crate) arriving: Vector,
    /// Direction of the edge that leaves.
    pub(crate) leaving: Vector,
    /// The edges fold back on each other: the tip of an antenna, or the end of a slit, which is no corner.
    pub(crate) reversal: bool,
}

impl Corner {
    /// The corner between two consecutive edges, unless it is concave or straight. A reversal is returned.
    pub(crate) fn between(arriving: &Curve, leaving: &Curve) -> Option<Self> {
        let (from, to) = (arriving.direction_at(1.0), leaving.direction_at(0.0));
        let at = arriving.end();
        let sine = cross(from, to);
        let straight = matches!((arriving, leaving), (Curve::Straight(_), Curve::Straight(_)));
        let side = if straight {
            orientation(arriving.start(), at, leaving.end())
        } else if from.dot(&to) < 0.0 && sine.abs() <= REVERSAL_SINE {
            Orientation::Straight
        } else if sine > 0.0 {
            Orientation::Left
        } else {
            Orientation::Right
        };
        let reversal = side == Orientation::Straight && from.dot(&to) < 0.0;
        (side == Orientation::Left || reversal).then_some(Self { at, arriving: from, leaving: to, reversal })
    }

    fn normals(&self) -> (Vector, Vector) {
        (right_of(self.arriving), right_of(self.leaving))
    }

    /// Unit vector from the corner to its control point.
    fn bisector(&self) -> Vector {
        let (n1, n2) = self.normals();
        if self.arriving.dot(&self.leaving) < 0.0 {
            normalized(self.arriving - self.leaving)
        } else {
            normalized(n1 + n2)
        }
    }

    /// Distance of the control point over clearance.
    fn ratio(&self) -> f64 {
        let (n1, n2) = self.normals();
        2.0 / (n1 + n2).norm()
    }

    /// The vertices of its kite, or of its pentagon when `limit` cuts it.
    pub(crate) fn outline(&self, clearance: f64, limit: f64) -> Vec<Point> {
        let (n1, n2) = self.normals();
        let mut outline = vec![self.at, self.at + n1 * clearance, self.at + n2 * clearance];
        let (bisector, ratio) = (self.bisector(), self.ratio());
        if ratio <= limit {
            outline.push(self.at + bisector * (ratio * clearance));
        } else {
            // The cut meets the parallels where bisector · x = limit · clearance.
            let along = clearance * (limit - 1.0 / ratio) / bisector.dot(&self.arriving);
            outline.push(self.at + n1 * clearance + self.arriving * along);
            outline.push(self.at + n2 * clearance - self.leaving * along);
        }
        outline
    }

    /// How far `step` stays outside the kite, at its nearest in the corner's cone; none: it is never there.
    pub(crate) fn margin(&self, step: &Curve, clearance: f64, limit: f64) -> Option<Nearest> {
        let (n1, n2) = self.normals();
        let bisector = self.bisector();
        let mut lines = vec![(n1, clearance), (n2, clearance)];
        if self.ratio() > limit {
            lines.push((bisector, limit * clearance));
        }
        let mut places = vec![0.0, 1.0];
        step.cut_by_line(self.at, self.arriving, 0.0, &mut places);
        step.cut_by_line(self.at, self.leaving, 0.0, &mut places);
        for (i, &(normal, reach)) in lines.iter().enumerate() {
            step.cut_by_direction(normal, &mut places);
            for &(other, other_reach) in &lines[..i] {
                let difference = normal - other;
                let length = difference.norm();
                if length > 0.0 {
                    step.cut_by_line(
                        self.at,
                        difference / length,
                        (reach - other_reach) / length,
                        &mut places,
                    );
                }
            }
        }
        least(step, places, |x| {
            let d = x - self.at;
            // The bisector keeps a corner of nearly nothing from holding what lies behind it.
            let in_cone = self.arriving.dot(&d) >= -REGION_SLACK_MM
                && self.leaving.dot(&d) <= REGION_SLACK_MM
                && bisector.dot(&d) >= -REGION_SLACK_MM;
            in_cone
                .then(|| lines.iter().map(|&(n, reach)| n.dot(&d) - reach).fold(f64::NEG_INFINITY, f64::max))
        })
    }
}

/// How far `step` stays outside the band of `edge`, at its nearest beside the edge; none: it is never there.
pub(crate) fn band_margin(step: &Curve, edge: &Curve, clearance: f64) -> Option<Nearest> {
    let mut places = vec![0.0, 1.0];
    match edge {
        Curve::Straight(edge) => {
            let (along, length) = (edge.direction(), edge.length());
            let outward = right_of(along);
            step.cut_by_line(edge.a, along, 0.0, &mut places);
            step.cut_by_line(edge.b, along, 0.0, &mut places);
            step.cut_by_line(edge.a, outward, 0.0, &mut places);
            step.cut_by_direction(outward, &mut places);
            least(step, places, |x| {
                let d = x - edge.a;
                let (beside, height) = (along.dot(&d), outward.dot(&d));
                let in_strip = beside >= -REGION_SLACK_MM
                    && beside <= length + REGION_SLACK_MM
                    && height >= -REGION_SLACK_MM;
                in_strip.then_some(height - clearance)
            })
        }
        Curve::Circular(edge) => {
            for end in [edge.a, edge.b] {
                step.cut_by_line(edge.center, right_of(normalized(end - edge.center)), 0.0, &mut places);
            }
            step.cut_by_circle(edge.center, edge.radius, &mut places);
            match step {
                Curve::Straight(_) => places.push(step.nearest_fraction(edge.center)),
                Curve::Circular(arc) => step.cut_by_direction(edge.center - arc.center, &mut places),
            }
            least(step, places, |x| {
                let spoke = x - edge.center;
                let distance = spoke.norm();
                let height = edge.turn * (distance - edge.radius);
                let in_sector = edge.angle_of(spoke).abs() <= edge.half + REGION_SLACK_MM / distance
                    && height >= -REGION_SLACK_MM;
                in_sector.then_some(height - clearance)
            })
        }
    }
}

/// The least of `margin` over the places of `step` where it has a value.
fn least(step: &Curve, places: Vec<f64>, margin: impl Fn(Point) -> Option<f64>) -> Option<Nearest> {
    places
        .into_iter()
        .filter_map(|fraction| {
            let at = step.point_at(fraction);
            margin(at).map(|distance| Nearest { distance, at })
        })
        .min_by(|one, other| one.distance.total_cmp(&other.distance))
}
