//! How far right of one section another has to stand, by their left edges.
//!
//! Of every two flanks, one of the left section looking right and one of the right section looking left, the distance
//! that they keep is a floor ([`crate::flank_meeting`]); the largest is the offset. Bands that may hold it come first, and what
//! can't exceed what was found is left out.

use crate::flank_meeting::meeting;
use crate::silhouette::{Band, Silhouette};
use crate::strided::Strided;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Finds floors of offsets.
pub(crate) struct LeastOffset<'a> {
    gap: f64,
    asked: Strided<'a>,
    /// Kept to spare memory its changes.
    candidates: Vec<Candidate>,
}

/// A pair of bands by what it may yield.
struct Candidate {
    most: f64,
    left: u32,
    right: u32,
}

impl<'a> LeastOffset<'a> {
    pub(crate) fn new(gap: f64, go_on: &'a dyn Fn() -> bool) -> Self {
        Self { gap, asked: Strided::new(go_on), candidates: Vec::new() }
    }

    /// A floor of the offset of left edges at which `right` stands right of `left`, as exact as rounding permits, or what was
    /// found once that is `enough`; minus infinity when nothing is in the way. None: given up. Cost: the bands that overlap, and
    /// in those that may matter pairs of flanks.
    pub(crate) fn between(&mut self, left: &Silhouette, right: &Silhouette, enough: f64) -> Option<f64> {
        // A heap and no sorted list: mostly the first few settle it.
        let mut candidates = self.candidates(left, right)?;
        let mut best = f64::NEG_INFINITY;
        while let Some(Candidate { most, left: i, right: j }) = candidates.pop() {
            self.asked.look()?;
            if most <= best || best >= enough {
                break;
            }
            let (one, other) = (&left.bands[i as usize], &right.bands[j as usize]);
            best = self.of_bands((left, one), (right, other), best, enough)?;
        }
        self.candidates = candidates.into_vec();
        Some(best)
    }

    /// All pairs of bands that are near enough.
    fn candidates(&mut self, left: &Silhouette, right: &Silhouette) -> Option<BinaryHeap<Candidate>> {
        let gap = self.gap;
        let mut candidates = std::mem::take(&mut self.candidates);
        candidates.clear();
        for (i, one) in left.bands.iter().enumerate() {
            let first = right.bands.partition_point(|other| one.low - other.high > gap);
            let near = right.bands.iter().enumerate().skip(first);
            for (j, other) in near.take_while(|(_, other)| other.low - one.high <= gap) {
                self.asked.look()?;
                let most = one.furthest + other.furthest + gap;
                candidates.push(Candidate { most, left: i as u32, right: j as u32 });
            }
        }
        Some(BinaryHeap::from(candidates))
    }

    fn of_bands(
        &mut self,
        (left, left_band): (&Silhouette, &Band),
        (right, right_band): (&Silhouette, &Band),
        so_far: f64,
        enough: f64,
    ) -> Option<f64> {
        let mut best = so_far;
        for (reach, one) in left.shown(left_band) {
            if reach + right_band.furthest + self.gap <= best {
                break;
            }
            for (other_reach, other) in right.shown(right_band) {
                self.asked.look()?;
                if reach + other_reach + self.gap <= best || best >= enough {
                    break;
                }
                if let Some(sum) = meeting(one, other, self.gap) {
                    best = best.max(sum);
                }
            }
        }
        Some(best)
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_place = || (other.left, other.right).cmp(&(self.left, self.right));
        self.most.total_cmp(&other.most).then_with(by_place)
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}
