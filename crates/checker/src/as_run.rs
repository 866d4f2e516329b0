//! A path as the machine runs it: straight level steps of machines whose axes each run at their own speed are dog-legs.

use std::borrow::Cow;
use traverse_geometry::{AxisSpeeds, Path, PathStep, Point, Vector};

/// Parts of a dog-leg shorter than this are left out, millimetres: rounding.
const SHORTEST_PART_MM: f64 = 1e-9;

/// A path as it is run, and which of its steps are whose.
pub(crate) struct AsRun<'a> {
    pub(crate) path: Cow<'a, Path>,
    /// Per step the index of the path's step that it is a part of; one for a path without steps.
    pub(crate) step_of: Vec<usize>,
}

impl<'a> AsRun<'a> {
    pub(crate) fn of(path: &'a Path, dog_leg: Option<AxisSpeeds>) -> Self {
        let Some(speeds) = dog_leg else {
            return Self { path: Cow::Borrowed(path), step_of: (0..path.steps.len().max(1)).collect() };
        };
        let mut run = Path { steps: Vec::new(), ..path.clone() };
        let mut step_of = Vec::new();
        for (index, step) in path.steps.iter().enumerate() {
            if step.arc.is_none()
                && let Some(turn) = turn(run.end(), step.end, &speeds)
            {
                run.steps.push(PathStep { end: turn, ..*step });
                step_of.push(index);
            }
            run.steps.push(*step);
            step_of.push(index);
        }
        if step_of.is_empty() {
            step_of.push(0);
        }
        Self { path: Cow::Owned(run), step_of }
    }
}

/// Where one axis has arrived and the other goes on alone; none where the way is a straight line.
fn turn(from: Point, to: Point, speeds: &AxisSpeeds) -> Option<Point> {
    let by = to - from;
    let seconds = f64::min(by.x.abs() / speeds.x_mm_per_s, by.y.abs() / speeds.y_mm_per_s);
    let both =
        Vector::new(speeds.x_mm_per_s.copysign(by.x) * seconds, speeds.y_mm_per_s.copysign(by.y) * seconds);
    let bends = both.norm() > SHORTEST_PART_MM && (by - both).norm() > SHORTEST_PART_MM;
    bends.then(|| from + both)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dog_legs_turn_where_one_axis_arrives() {
        let speeds = AxisSpeeds { x_mm_per_s: 20.0, y_mm_per_s: 10.0, z_mm_per_s: 0.0 };
        let mut path = Path::at(Point::new(0.0, 0.0));
        path.line_to(Point::new(10.0, -2.0));
        path.line_to(Point::new(10.0, 5.0));
        path.line_to(Point::new(6.0, 7.0));
        let run = AsRun::of(&path, Some(speeds));
        assert_eq!(run.step_of, [0, 0, 1, 2]);
        assert_eq!(run.path.steps[0].end, Point::new(4.0, -2.0));
        assert_eq!(AsRun::of(&path, None).step_of, [0, 1, 2]);
    }
}
