//! Better plans and bounds with their times, thinned.

use std::time::Instant;
use traverse_proto::Improvement;
use traverse_solve::Observer;

/// Most improvements of one answer.
const MOST: usize = 1000;

/// Hears an engine and notes when.
pub(crate) struct Improvements {
    begun: Instant,
    cost: Option<f64>,
    lower_bound: Option<f64>,
    list: Vec<Improvement>,
}

impl Improvements {
    pub(crate) fn since(begun: Instant) -> Self {
        Self { begun, cost: None, lower_bound: None, list: Vec::new() }
    }

    /// Every so-many-th, the last one among them.
    pub(crate) fn thinned(mut self) -> Vec<Improvement> {
        while self.list.len() > MOST {
            thin(&mut self.list);
        }
        self.list
    }

    fn note(&mut self) {
        let (cost, lower_bound) = (self.cost, self.lower_bound);
        self.list.push(Improvement { after: self.begun.elapsed(), cost, lower_bound });
        if self.list.len() >= 2 * MOST {
            thin(&mut self.list);
        }
    }
}

/// Keeps every second one, counted from the last.
fn thin(list: &mut Vec<Improvement>) {
    let last = list.len().saturating_sub(1);
    let mut place = 0;
    list.retain(|_| {
        place += 1;
        (last + 1 - place).is_multiple_of(2)
    });
}

impl Observer for Improvements {
    fn better_cost(&mut self, cost: f64) {
        self.cost = Some(cost);
        self.note();
    }

    fn better_bound(&mut self, lower_bound: f64) {
        self.lower_bound = Some(lower_bound);
        self.note();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_are_thinned_and_the_last_stays() {
        for count in [1, 999, 1000, 1001, 5000, 100_003] {
            let mut improvements = Improvements::since(Instant::now());
            for i in 0..count {
                improvements.better_cost(f64::from(count - i));
            }
            let list = improvements.thinned();
            assert!(
                list.len() <= MOST && list.len() >= (count as usize).min(MOST / 2),
                "{count}: {}",
                list.len()
            );
            assert_eq!(list.last().and_then(|last| last.cost), Some(1.0));
            assert!(list.is_sorted_by(|a, b| a.cost > b.cost && a.after <= b.after));
        }
    }
}
