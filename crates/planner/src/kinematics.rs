//! Seconds of a path under limits of speed and acceleration, worked out exactly: what corners and steps permit, then a
//! pass backwards and one forwards so that the next limit can always be met, then a trapezoid of speed for each step
//! (look-ahead as in motion planners of controllers; corner speeds by junction deviation, as in S. Jeon's grbl, 2011).
//!
//! Cost: linear in the steps.

use nalgebra::Vector3;
use traverse_geometry::{Edge, Kinematics, Path, Vector, left_of, unit};

/// Directions that differ by less than this go straight on into each other, radians: rounding of tangents.
const STRAIGHT_ON_RAD: f64 = 1e-6;

/// One step as it is run.
struct Run {
    length: f64,
    /// Top speed, squared.
    most: f64,
    /// Directions of travel where it begins and ends.
    first: Vector3<f64>,
    last: Vector3<f64>,
}

/// Seconds of `path` from rest to rest.
pub(crate) fn seconds(path: &Path, limits: &Kinematics) -> f64 {
    let runs = runs(path, limits);
    let acceleration = limits.acceleration_mm_per_s2;
    // Squared speeds where runs begin; the path ends at rest.
    let mut speeds = vec![0.0; runs.len() + 1];
    for i in 1..runs.len() {
        let corner = corner_speed(&runs[i - 1].last, &runs[i].first, limits);
        speeds[i] = corner.min(runs[i - 1].most).min(runs[i].most);
    }
    for i in (0..runs.len()).rev() {
        speeds[i] = f64::min(speeds[i], speeds[i + 1] + 2.0 * acceleration * runs[i].length);
    }
    let mut seconds = 0.0;
    for (i, run) in runs.iter().enumerate() {
        speeds[i + 1] = f64::min(speeds[i + 1], speeds[i] + 2.0 * acceleration * run.length);
        let (from, to) = (speeds[i], speeds[i + 1]);
        let top = f64::midpoint(from, to) + acceleration * run.length;
        let peak = top.min(run.most);
        let cruise = ((top - peak) / acceleration).max(0.0);
        let speed = peak.sqrt();
        let changes = (speed - from.sqrt()).max(0.0) + (speed - to.sqrt()).max(0.0);
        seconds += changes / acceleration + cruise / speed;
    }
    seconds
}

/// What speeding up from rest and slowing down to rest adds to top speeds at least, where a path has `level_mm` in the plane
/// and `vertical_mm` up and down: as much as for the lower of both speeds.
pub(crate) fn rest_seconds(limits: &Kinematics, level_mm: f64, vertical_mm: f64) -> f64 {
    let mut speed = f64::INFINITY;
    if level_mm > 0.0 {
        speed = speed.min(fastest(limits));
    }
    if vertical_mm > 0.0 {
        speed = speed.min(limits.z_mm_per_s);
    }
    let (length, acceleration) = (level_mm + vertical_mm, limits.acceleration_mm_per_s2);
    if length <= 0.0 {
        0.0
    } else if length >= speed * speed / acceleration {
        speed / acceleration
    } else {
        2.0 * (length / acceleration).sqrt() - length / speed
    }
}

/// What vertical steps take at top speed.
pub(crate) fn vertical_seconds(limits: &Kinematics, vertical_mm: f64) -> f64 {
    if vertical_mm > 0.0 { vertical_mm / limits.z_mm_per_s } else { 0.0 }
}

/// The top speed in the plane.
pub(crate) fn fastest(limits: &Kinematics) -> f64 {
    limits.speed_mm_per_s.max(limits.arc_speed_mm_per_s())
}

fn runs(path: &Path, limits: &Kinematics) -> Vec<Run> {
    let mut below = path.start_z_mm;
    let steps = path.steps.iter().zip(path.edges());
    let runs = steps.map(|(step, edge)| {
        let rise = below.zip(step.z_mm).map_or(0.0, |(from, to)| to - from);
        below = step.z_mm;
        run(&edge, rise, limits)
    });
    runs.filter(|run| run.length > 0.0).collect()
}

fn run(edge: &Edge, rise: f64, limits: &Kinematics) -> Run {
    let level = |direction: Vector| Vector3::new(direction.x, direction.y, 0.0);
    match edge {
        Edge::Arc(arc) => {
            let speed = limits.arc_speed_mm_per_s();
            let tangent = |angle: f64| level(left_of(unit(angle)) * arc.sweep.signum());
            Run {
                length: arc.length(),
                most: (speed * speed).min(limits.acceleration_mm_per_s2 * arc.radius),
                first: tangent(arc.start_angle),
                last: tangent(arc.start_angle + arc.sweep),
            }
        }
        Edge::Segment(segment) => {
            let by = segment.vector();
            let by = Vector3::new(by.x, by.y, rise);
            let speed = if rise == 0.0 { limits.speed_mm_per_s } else { limits.z_mm_per_s };
            let direction = by.try_normalize(0.0).unwrap_or_default();
            Run { length: by.norm(), most: speed * speed, first: direction, last: direction }
        }
    }
}

/// The squared speed that a corner permits. The sine of half the angle that both steps enclose is half the length of the
/// sum of their directions.
fn corner_speed(before: &Vector3<f64>, after: &Vector3<f64>, limits: &Kinematics) -> f64 {
    let apart = (before - after).norm();
    if apart < STRAIGHT_ON_RAD {
        return f64::INFINITY;
    }
    let sine = (before + after).norm() / 2.0;
    let rest = apart * apart / 4.0 / (1.0 + sine);
    limits.acceleration_mm_per_s2 * limits.junction_deviation_mm * sine / rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::Point;

    fn limits() -> Kinematics {
        Kinematics {
            speed_mm_per_s: 200.0,
            z_mm_per_s: 50.0,
            acceleration_mm_per_s2: 1000.0,
            junction_deviation_mm: 0.02,
            feed_mm_per_s: 80.0,
        }
    }

    fn line(xs: &[f64]) -> Path {
        let mut path = Path::at(Point::new(0.0, 0.0));
        xs.iter().for_each(|&x| path.line_to(Point::new(x, 0.0)));
        path
    }

    fn least_seconds(level_mm: f64, vertical_mm: f64) -> f64 {
        let limits = limits();
        level_mm / fastest(&limits)
            + vertical_seconds(&limits, vertical_mm)
            + rest_seconds(&limits, level_mm, vertical_mm)
    }

    #[test]
    fn a_line_is_a_trapezoid_however_it_is_cut_up() {
        // 0.2 s to 200 mm/s over 20 mm, 60 mm at top speed, 0.2 s down.
        assert!((seconds(&line(&[100.0]), &limits()) - 0.7).abs() < 1e-12);
        assert!((seconds(&line(&[1.0, 7.0, 30.0, 99.9, 100.0]), &limits()) - 0.7).abs() < 1e-12);
        // Too short for the top speed: 0.1 s up over 5 mm, 0.1 s down.
        assert!((seconds(&line(&[10.0]), &limits()) - 0.2).abs() < 1e-12);
        assert_eq!(seconds(&line(&[]), &limits()), 0.0);
        assert!((least_seconds(100.0, 0.0) - 0.7).abs() < 1e-12);
        assert!((least_seconds(10.0, 0.0) - 0.2).abs() < 1e-12);
    }

    #[test]
    fn corners_slow_down_and_turning_back_stops() {
        let mut corner = line(&[100.0]);
        corner.line_to(Point::new(100.0, 100.0));
        let sine = std::f64::consts::FRAC_1_SQRT_2;
        let slow = (1000.0 * 0.02 * sine / (1.0 - sine)).sqrt();
        let half = |v: f64| (200.0 - v) / 1000.0 + 0.2 + (100.0 - (80_000.0 - v * v) / 2000.0) / 200.0;
        assert!((seconds(&corner, &limits()) - 2.0 * half(slow)).abs() < 1e-12);
        let stops = Kinematics { junction_deviation_mm: 0.0, ..limits() };
        assert!((seconds(&corner, &stops) - 1.4).abs() < 1e-12);
        assert!((seconds(&line(&[100.0, 0.0]), &limits()) - 1.4).abs() < 1e-12);
    }

    #[test]
    fn arcs_are_fed_and_small_ones_slower_and_z_has_its_own_speed() {
        // Straight on into a half circle of radius 10, and on: 100 mm/s by turning, 80 by the feed.
        let mut arc = line(&[100.0]);
        arc.arc_to(Point::new(100.0, 20.0), Point::new(100.0, 10.0), std::f64::consts::PI);
        arc.line_to(Point::new(0.0, 20.0));
        let before = 0.2 + 0.12 + (100.0 - 20.0 - (40_000.0 - 6400.0) / 2000.0) / 200.0;
        let expected = 2.0 * before + 10.0 * std::f64::consts::PI / 80.0;
        assert!((seconds(&arc, &limits()) - expected).abs() < 1e-12);
        let turning = Kinematics { feed_mm_per_s: 0.0, ..limits() };
        let before = 0.2 + 0.1 + (100.0 - 20.0 - (40_000.0 - 10_000.0) / 2000.0) / 200.0;
        let expected = 2.0 * before + 10.0 * std::f64::consts::PI / 100.0;
        assert!((seconds(&arc, &turning) - expected).abs() < 1e-12);
        let mut up = Path::at_height(Point::new(0.0, 0.0), 0.0);
        up.height_to(25.0);
        assert!((seconds(&up, &limits()) - (0.1 + 22.5 / 50.0)).abs() < 1e-12);
        assert!((least_seconds(0.0, 25.0) - seconds(&up, &limits())).abs() < 1e-12);
    }
}
