//! Sums whose rounding is known: what each addition loses is added up beside.

/// The sum of two numbers as it is rounded, and what rounding took from it, exactly.
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let back = sum - a;
    (sum, (a - (sum - back)) + (b - back))
}

/// A sum with what rounding took from it.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ExactSum {
    sum: f64,
    lost: f64,
    /// Sum of absolute values.
    size: f64,
}

impl ExactSum {
    /// Adds a number.
    pub(crate) fn add(&mut self, value: f64) {
        let (sum, lost) = two_sum(self.sum, value);
        self.lost += lost;
        self.sum = sum;
        self.size += value.abs();
    }

    /// Adds a product, as it is rounded.
    pub(crate) fn add_product(&mut self, count: f64, value: f64) {
        self.add(count * value);
    }

    /// Not more than the true sum, of products too.
    pub(crate) fn at_most(&self) -> f64 {
        self.sum + self.lost - 4.0 * f64::EPSILON * self.size
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cancels_is_not_lost() {
        let mut sum = ExactSum::default();
        for value in [1e12, 1.0, -1e12, 1e-3] {
            sum.add(value);
        }
        let found = sum.at_most();
        assert!(found <= 1.001 && found > 1.0 - 0.01, "{found}");
        let mut small = ExactSum::default();
        (0..1000).for_each(|_| small.add_product(3.0, 0.1));
        assert!(small.at_most() <= 300.0 && small.at_most() > 300.0 - 1e-9);
    }
}
