//! Numbers of a program as whole multiples of the last decimal place.

use super::dialect::GcodeDialect;
use super::settings::GcodeUnit;

/// The last decimal place that a program is written to. Counting in it makes text and value agree exactly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    pub(crate) unit: GcodeUnit,
    pub(crate) decimals: u8,
    pub(crate) dialect: GcodeDialect,
}

impl Grid {
    fn places(self) -> f64 {
        10_f64.powi(i32::from(self.decimals))
    }

    /// The last place, millimetres.
    pub(crate) fn step_mm(self) -> f64 {
        self.unit.millimetres() / self.places()
    }

    /// The nearest multiple; none beyond what the controller reads.
    pub(crate) fn count(self, mm: f64) -> Option<i64> {
        let count = (mm / self.unit.millimetres() * self.places()).round();
        (count.abs() <= self.dialect.largest_count() as f64).then_some(count as i64)
    }

    pub(crate) fn mm(self, count: i64) -> f64 {
        count as f64 / self.places() * self.unit.millimetres()
    }

    /// The largest number that the controller reads, in the program's unit.
    pub(crate) fn limit(self) -> f64 {
        self.dialect.largest_count() as f64 / self.places()
    }

    /// As few characters as say it: `-0.5`, `10`, for Fanuc `10.`.
    pub(crate) fn text(self, count: i64) -> String {
        let width = usize::from(self.decimals) + 1;
        let digits = format!("{:0width$}", count.unsigned_abs());
        let (whole, part) = digits.split_at(digits.len() - usize::from(self.decimals));
        let sign = if count < 0 { "-" } else { "" };
        with_point(&format!("{sign}{whole}.{}", part.trim_end_matches('0')), self.dialect)
    }

    /// A feed of the profile, to 0.1 mm or 0.01 inch per minute, at least that.
    pub(crate) fn feed_text(self, mm_per_min: f64) -> String {
        let decimals = match self.unit {
            GcodeUnit::Millimetres => 1,
            GcodeUnit::Inches => 2,
        };
        let grid = Self { decimals, ..self };
        grid.text(grid.count(mm_per_min).unwrap_or(self.dialect.largest_count()).max(1))
    }

    /// A feed as the program around gave it, in its unit per minute: every digit.
    pub(crate) fn exact_feed_text(self, feed: f64) -> String {
        let text = feed.to_string();
        if text.contains('.') { text } else { with_point(&format!("{text}."), self.dialect) }
    }
}

fn with_point(text: &str, dialect: GcodeDialect) -> String {
    let whole = text.strip_suffix('.').filter(|_| !dialect.keeps_point());
    whole.unwrap_or(text).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        let grid = |dialect| Grid { unit: GcodeUnit::Millimetres, decimals: 3, dialect };
        for (count, plain, fanuc) in [
            (0, "0", "0."),
            (-1, "-0.001", "-0.001"),
            (10_000, "10", "10."),
            (-123_450, "-123.45", "-123.45"),
            (999, "0.999", "0.999"),
        ] {
            assert_eq!(grid(GcodeDialect::LinuxCnc).text(count), plain);
            assert_eq!(grid(GcodeDialect::Fanuc).text(count), fanuc);
        }
        assert_eq!(grid(GcodeDialect::Grbl).count(-0.000_4), Some(0));
        assert_eq!(grid(GcodeDialect::Grbl).count(1e6), None);
        assert_eq!(grid(GcodeDialect::Fanuc).exact_feed_text(1234.567), "1234.567");
        assert_eq!(grid(GcodeDialect::Fanuc).exact_feed_text(500.0), "500.");
    }
}
