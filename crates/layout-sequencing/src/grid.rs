//! Lengths in whole numbers: what tours and searches count in.
//!
//! The unit is a nanometre; for sections so long that a join would exceed what tours take it is the power of ten above
//! that suffices. Offsets are rounded up, so that sections stand apart; widths that bounds use are rounded down, so
//! that bounds hold. A layout on the grid can be longer than the best one off the grid by less than a unit for each
//! section.

use traverse_tours::LARGEST_COST;

/// Units in a millimetre when sections are of ordinary size.
const UNITS_PER_MM: f64 = 1e6;

/// What part of a unit an offset may exceed a whole number by and still be rounded down to it: rounding errors of 1e-10
/// mm don't push sections apart.
const SLACK: f64 = 1e-4;

/// Whole numbers for lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    per_mm: f64,
}

impl Grid {
    /// The grid for offsets of at most `longest` millimetres.
    pub(crate) fn for_lengths_up_to(longest: f64) -> Self {
        let mut per_mm = UNITS_PER_MM;
        while longest * per_mm >= LARGEST_COST as f64 && per_mm > f64::MIN_POSITIVE {
            per_mm /= 10.0;
        }
        Self { per_mm }
    }

    /// The least whole number that is not below the length, but for rounding errors.
    #[inline]
    pub(crate) fn up(self, mm: f64) -> i64 {
        (mm * self.per_mm - SLACK).ceil() as i64
    }

    /// The largest whole number that is not above the length, but for rounding errors.
    #[inline]
    pub(crate) fn down(self, mm: f64) -> i64 {
        (mm * self.per_mm + SLACK).floor() as i64
    }

    /// Millimetres.
    #[inline]
    pub(crate) fn mm(self, units: i64) -> f64 {
        units as f64 / self.per_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_go_up_and_bounds_go_down() {
        let grid = Grid::for_lengths_up_to(1_000.0);
        assert_eq!((grid.up(6.0), grid.down(6.0)), (6_000_000, 6_000_000));
        assert_eq!((grid.up(0.1 + 0.2), grid.down(0.3 - 1e-16)), (300_000, 300_000));
        assert_eq!((grid.up(1.000_000_5), grid.down(1.000_000_5)), (1_000_001, 1_000_000));
        assert_eq!((grid.up(-1.000_000_5), grid.down(-1.000_000_5)), (-1_000_000, -1_000_001));
        assert_eq!(grid.mm(300_000), 0.3);
    }

    #[test]
    fn long_sections_get_a_coarser_unit() {
        let grid = Grid::for_lengths_up_to(2e6);
        assert!(grid.up(2e6) <= LARGEST_COST);
        assert_eq!(grid.mm(grid.up(1.5)), 1.5);
    }
}
