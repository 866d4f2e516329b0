//! Numbers and points: finite, within their range, −0 made 0.

use super::reader::Reader;
use crate::v1;
use traverse_geometry::{
    COORDINATE_LIMIT_MM, Finding, LARGEST_CLEARANCE_MM, Point, Reason, SMALLEST_CLEARANCE_MM,
};

impl Reader<'_> {
    /// A finite number.
    pub(crate) fn finite(&mut self, field: &str, value: f64) -> Option<f64> {
        if value.is_finite() {
            return Some(value + 0.0);
        }
        let message = format!("{value} is not a finite number; send one");
        self.report(Finding::new(field, Reason::NotFinite, value, message));
        None
    }

    /// A finite number for which `holds`.
    pub(crate) fn within(
        &mut self,
        field: &str,
        value: f64,
        holds: impl Fn(f64) -> bool,
        range: &str,
    ) -> Option<f64> {
        let value = self.finite(field, value)?;
        if holds(value) {
            return Some(value);
        }
        self.out_of_range(field, value, range);
        None
    }

    /// A clearance: 0, or within its range.
    pub(crate) fn clearance(&mut self, field: &str, value: f64) -> Option<f64> {
        let holds = |mm: f64| mm == 0.0 || (SMALLEST_CLEARANCE_MM..=LARGEST_CLEARANCE_MM).contains(&mm);
        let range = format!("0, or {SMALLEST_CLEARANCE_MM} to {LARGEST_CLEARANCE_MM} mm");
        self.within(field, value, holds, &range)
    }

    /// A coordinate or height within the limit.
    pub(crate) fn coordinate(&mut self, field: &str, value: f64) -> Option<f64> {
        let value = self.finite(field, value)?;
        if value.abs() <= COORDINATE_LIMIT_MM {
            return Some(value);
        }
        let message = format!(
            "{} mm is beyond ±{COORDINATE_LIMIT_MM} mm; move the drawing towards the origin or check its unit",
            shown(value)
        );
        self.report(Finding::new(field, Reason::CoordinateTooLarge, value, message));
        None
    }

    /// A point that must be there.
    pub(crate) fn point(&mut self, field: &str, point: Option<v1::Point>) -> Option<Point> {
        let Some(v1::Point { x_mm, y_mm }) = point else {
            self.missing(field, "a point with x_mm and y_mm");
            return None;
        };
        let x = self.coordinate(&format!("{field}.x_mm"), x_mm);
        let y = self.coordinate(&format!("{field}.y_mm"), y_mm);
        Some(Point::new(x?, y?))
    }
}

/// Numbers from here on are written with their power of ten.
const LARGEST_WRITTEN_OUT: f64 = 1e15;

/// A finite number in a few letters.
fn shown(value: f64) -> String {
    if value.abs() >= LARGEST_WRITTEN_OUT { format!("{value:e}") } else { value.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_numbers_take_few_letters() {
        assert_eq!(shown(-1e308), "-1e308");
        assert_eq!(shown(1_000_000.5), "1000000.5");
        assert_eq!(shown(999_999_999_999_999.0), "999999999999999");
    }
}
