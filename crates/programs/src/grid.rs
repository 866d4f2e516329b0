//! Positions as whole counts of the last decimal place that a program is written to.

use traverse_drawing::GcodeUnit;
use traverse_geometry::{Point, Vector};

/// The last decimal place, and where its counts begin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) unit: GcodeUnit,
    pub(crate) places: u8,
    /// Where the counts are 0, in the drawing: the program's zero, or the start of a move in increments.
    pub(crate) origin: Point,
    /// Larger counts are not read by the controller.
    pub(crate) largest: f64,
}

/// Two counts: a position or a difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Counts {
    pub(crate) x: i64,
    pub(crate) y: i64,
}

impl Counts {
    pub(crate) fn less(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Grid {
    fn per_unit(self) -> f64 {
        10_f64.powi(i32::from(self.places))
    }

    /// The last place, millimetres.
    pub(crate) fn step_mm(self) -> f64 {
        self.unit.millimetres() / self.per_unit()
    }

    fn count(self, mm: f64) -> Option<i64> {
        let count = (mm / self.unit.millimetres() * self.per_unit()).round();
        (count.abs() <= self.largest).then_some(count as i64)
    }

    /// The count nearest to a height.
    pub(crate) fn level(self, mm: f64) -> Option<i64> {
        self.count(mm)
    }

    /// The height of a count.
    pub(crate) fn level_mm(self, count: i64) -> f64 {
        count as f64 / self.per_unit() * self.unit.millimetres()
    }

    /// The counts nearest to a vector.
    pub(crate) fn counts(self, v: Vector) -> Option<Counts> {
        Some(Counts { x: self.count(v.x)?, y: self.count(v.y)? })
    }

    pub(crate) fn vector(self, counts: Counts) -> Vector {
        Vector::new(counts.x as f64, counts.y as f64) / self.per_unit() * self.unit.millimetres()
    }

    /// Where counts lie in the drawing.
    pub(crate) fn point(self, counts: Counts) -> Point {
        self.origin + self.vector(counts)
    }
}
