//! What searches with one goal took so far: whether many ways from one end are found sooner one by one, or all at once.

/// A search in all directions is begun when the others are expected to look into so many times as many labels: its labels
/// have more links, and it asks for what can be seen from everywhere.
const WORTH: f64 = 4.0;

/// So many single searches are made before what they take is trusted.
const SAMPLE: u64 = 4;

/// How many labels single searches have looked into so far.
#[derive(Default)]
pub(super) struct SingleSearches {
    count: u64,
    labels: u64,
}

impl SingleSearches {
    /// Takes note of a single search.
    pub(super) fn note(&mut self, labels: u64) {
        self.count += 1;
        self.labels += labels;
    }

    /// Whether one search in all directions pays for so many goals, in a scene of so many corners and arcs, of which it looks
    /// into both sides.
    pub(super) fn is_spread_worth_it(&self, goal_count: usize, feature_count: usize) -> bool {
        if self.count < SAMPLE {
            return false;
        }
        let one_by_one = self.labels as f64 / self.count as f64 * goal_count as f64;
        one_by_one > WORTH * 2.0 * feature_count as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_goals_among_few_corners_are_found_at_once() {
        let mut singles = SingleSearches::default();
        assert!(!singles.is_spread_worth_it(1_000_000, 10));
        (0..SAMPLE).for_each(|_| singles.note(30));
        assert!(singles.is_spread_worth_it(1_000, 800));
        assert!(!singles.is_spread_worth_it(100, 7_000));
    }
}
