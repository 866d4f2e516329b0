//! How far right of one section another has to stand, by their left edges.
//!
//! Of every two flanks, one of the left section looking right and one of the right section looking left, the distance
//! that they keep is a floor ([`crate::flank_meeting`]); the largest is the offset. Bands that may hold it come first, and what
//! can't exceed what was found is left out.

use crate::flank_meeting::meeting;
use crate::silhouette::{Band, Silhouette};

/// Finds floors of offsets.
pub(crate) struct LeastOffset<'a> {
    pub(crate) gap: f64,
    pub(crate) go_on: &'a dyn Fn() -> bool,
    /// Pairs of bands by what they may yield, kept to spare memory its changes.
    candidates: Vec<(f64, u32, u32)>,
}

impl<'a> LeastOffset<'a> {
    pub(crate) fn new(gap: f64, go_on: &'a dyn Fn() -> bool) -> Self {
        Self { gap, go_on, candidates: Vec::new() }
    }

    /// A floor of the offset of left edges at which `right` stands right of `left`, as exact as rounding permits, or what was
    /// found once that is `enough`; minus infinity when nothing is in the way. None: given up. Cost: the bands that overlap, and
    /// in those that may matter pairs of flanks.
    pub(crate) fn between(&mut self, left: &Silhouette, right: &Silhouette, enough: f64) -> Option<f64> {
        let gap = self.gap;
        self.candidates.clear();
        for (i, one) in left.bands.iter().enumerate() {
            let first = right.bands.partition_point(|other| one.low - other.high > gap);
            let near = right.bands.iter().enumerate().skip(first);
            for (j, other) in near.take_while(|(_, other)| other.low - one.high <= gap) {
                self.candidates.push((one.furthest + other.furthest + gap, i as u32, j as u32));
            }
        }
        self.candidates.sort_unstable_by(|one, other| other.0.total_cmp(&one.0));
        let mut best = f64::NEG_INFINITY;
        for &(most, i, j) in &self.candidates {
            if most <= best || best >= enough {
                break;
            }
            let (one, other) = (&left.bands[i as usize], &right.bands[j as usize]);
            best = best.max(self.of_bands(one, other, best, enough)?);
        }
        Some(best)
    }

    fn of_bands(&self, left: &Band, right: &Band, so_far: f64, enough: f64) -> Option<f64> {
        let mut best = so_far;
        for (reach, one) in &left.flanks {
            if !(self.go_on)() {
                return None;
            }
            if reach + right.furthest + self.gap <= best {
                break;
            }
            for (other_reach, other) in &right.flanks {
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
