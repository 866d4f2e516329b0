//! Local search on the true length: blocks change places and sections turn, at random but for a leaning towards joins
//! that fit, and changes that make the layout longer are kept the more rarely the longer it gets (Kirkpatrick, Gelatt,
//! Vecchi 1983). In rounds, each cooled from warm to cold and begun with the best layout so far.

use crate::instance::Instance;
use crate::moves::Change;
use crate::neighbours::Neighbours;
use crate::pace::Pace;
use crate::places::Places;
use crate::progress::Progress;
use crate::sequence::Sequence;
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use traverse_solve::{Budget, Interrupt, Seed};

/// Trials of the first round for each section; every further round has twice as many.
const FIRST_TRIALS: u64 = 1_000;
/// The most trials of a round for each section.
const MOST_TRIALS: u64 = 64_000;
/// How much longer, in parts of the mean width, a layout may get and still be kept often: at the beginning of a round,
/// and at its end.
const WARM: f64 = 0.05;
const COLD: f64 = 0.000_5;
/// Trials that are counted together. The clock is looked at within them, too.
const BURST: u64 = 64;
/// One trial in so many begins where a section is held off by another than its neighbour.
const HELD_OFF_EVERY: u32 = 4;

/// Local search on the true length.
pub(crate) struct Improvement<'a> {
    instance: &'a Instance,
    neighbours: Neighbours,
    seed: Seed,
    rounds: u64,
}

impl<'a> Improvement<'a> {
    pub(crate) fn new(instance: &'a Instance, seed: Seed, budget: &Budget) -> Result<Self, Interrupt> {
        Ok(Self { instance, neighbours: Neighbours::of(instance, budget)?, seed, rounds: 0 })
    }

    /// One more round. Whether it found anything better, whose left edges are kept in `places`.
    pub(crate) fn round(
        &mut self,
        progress: &mut Progress<'_>,
        places: &mut Places,
        budget: &Budget,
    ) -> Result<bool, Interrupt> {
        let Some((best, before)) = progress.best() else { return Ok(false) };
        let mut sequence = Sequence::new(self.instance, best.to_vec(), budget)?;
        let mut pace = Pace::of(budget);
        let count = sequence.items().len();
        let mut chance = self.seed.part(self.rounds).stream();
        let doubled = FIRST_TRIALS.saturating_mul(1 << self.rounds.min(30)).min(MOST_TRIALS);
        let trials = doubled * count as u64;
        self.rounds += 1;
        let width: i64 = sequence.items().iter().map(|&item| self.instance.items[item].width).sum();
        let mean = width as f64 / count as f64;
        // Long layouts begin cooler: they are local everywhere, and a round can't visit every place often.
        let warm = if self.rounds == 1 { COLD * 4.0 } else { WARM };
        let mut change = Change::default();
        let mut done = 0;
        let mut shortest = before;
        while done < trials {
            let outcome = budget.check(progress.iterations());
            if outcome.is_err() || progress.is_close_enough() {
                outcome?;
                break;
            }
            let temperature = mean * warm * (COLD / warm).powf(done as f64 / trials as f64);
            for _ in 0..BURST {
                let place = self.place(&sequence, &mut chance);
                let beside = self.neighbours.beside(&sequence, place, &mut chance);
                if !change.draw(self.instance, sequence.items(), place, beside, &mut chance) {
                    continue;
                }
                let length = sequence.length_of(&change.spans, &mut pace)?;
                let longer = (length - sequence.length()) as f64;
                let kept =
                    longer <= 0.0 || longer < temperature * -chance.random_range(f64::MIN_POSITIVE..1.0).ln();
                if kept {
                    sequence.apply(&change.spans, &mut pace)?;
                    debug_assert_eq!(sequence.length(), length, "a trial's length is that of its layout");
                    if length < shortest {
                        shortest = length;
                        progress.offer(sequence.items(), length);
                        places.keep(sequence.items(), sequence.left_edges());
                    }
                }
            }
            done += BURST;
            progress.add_iterations(BURST);
        }
        Ok(shortest < before)
    }

    /// Where the next change begins: anywhere, or before a section that something further back holds off.
    fn place(&self, sequence: &Sequence<'_>, chance: &mut Xoshiro256PlusPlus) -> usize {
        let count = sequence.items().len();
        let place = chance.random_range(0..count);
        if !chance.random_ratio(1, HELD_OFF_EVERY) {
            return place;
        }
        let held =
            (0..count.min(16)).map(|step| (place + step) % count).find(|&at| sequence.held_off(at) > 0);
        held.map_or(place, |at| at.saturating_sub(chance.random_range(0..=1)))
    }
}
