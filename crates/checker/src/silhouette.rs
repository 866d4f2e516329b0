//! How far a section reaches to one side at each height: the flanks of its parts that may show there, in bands of equal
//! height. Flanks that lie behind others over a whole band are left out of it, and what shows nowhere is forgotten.
//!
//! Bands are made one after the other, lowest first, and hold indices of flanks. Where flanks are so long, or so many of them
//! show, that bands would hold more than a few times as many as there are, there are fewer bands: memory is linear in
//! flanks, whatever they are like.

use crate::facing::Facing;
use crate::flank::Flank;
use crate::strided::Strided;
use traverse_geometry::{Pose, Section};

/// About so many flanks share a band.
const FLANKS_IN_BAND: usize = 6;

/// Most bands of one section.
const MOST_BANDS: usize = 1024;

/// In so many bands each flank is looked at, on average: bounds the time.
const LOOKED_AT: usize = 64;

/// In so many bands each flank shows, on average: bounds the memory.
const SHOWN: usize = 4;

/// A range of heights and what may show in it.
#[derive(Clone, Debug)]
pub(crate) struct Band {
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Nothing in the band reaches further.
    pub(crate) furthest: f64,
    /// Where its flanks stand in the list of those that show.
    from: u32,
    to: u32,
}

/// How far a section reaches to one side.
#[derive(Clone, Debug)]
pub(crate) struct Silhouette {
    /// From the lowest to the highest; a flank may lie in several.
    pub(crate) bands: Vec<Band>,
    /// Band by band how far each flank reaches there, and its index; the furthest first.
    shown: Vec<(f64, u32)>,
    flanks: Vec<Flank>,
}

impl Silhouette {
    /// How far `section` in `pose` reaches when it is looked at as [`Facing::flanks`] does. Given up when `go_on` says no.
    /// Cost: O(n log n) for n vertices; memory O(n).
    pub(crate) fn of(
        section: &Section,
        pose: Pose,
        facing: Facing,
        go_on: &dyn Fn() -> bool,
    ) -> Option<Self> {
        let mut flanks = Vec::new();
        facing.flanks(section, pose, go_on, |flank| flanks.push(flank))?;
        Self::banded(flanks, go_on)
    }

    fn banded(mut flanks: Vec<Flank>, go_on: &dyn Fn() -> bool) -> Option<Self> {
        let mut asked = Strided::new(go_on);
        flanks.sort_unstable_by(|one, other| one.low.total_cmp(&other.low));
        asked.ask()?;
        let mut ruler = Ruler::over(&flanks);
        while ruler.count > 1 && ruler.places(&flanks, &mut asked)? > LOOKED_AT * flanks.len() {
            ruler.count /= 2;
        }
        let mut silhouette = Self { bands: Vec::new(), shown: Vec::new(), flanks };
        while !silhouette.fill(&ruler, &mut asked)? {
            ruler.count /= 2;
        }
        silhouette.forget_hidden();
        Some(silhouette)
    }

    /// Fills all bands; false: they would hold too many flanks.
    fn fill(&mut self, ruler: &Ruler, asked: &mut Strided<'_>) -> Option<bool> {
        self.bands.clear();
        self.shown.clear();
        let (mut next, mut there): (usize, Vec<u32>) = (0, Vec::new());
        for number in 0..ruler.count {
            let (low, high) = (ruler.border(number), ruler.border(number + 1));
            there.retain(|&at| self.flanks[at as usize].high >= low);
            while next < self.flanks.len() && self.flanks[next].low <= high {
                if self.flanks[next].high >= low {
                    there.push(next as u32);
                }
                next += 1;
            }
            self.add_band(low, high, &there, asked)?;
            if ruler.count > 1 && self.shown.len() > SHOWN * self.flanks.len() {
                return Some(false);
            }
        }
        Some(true)
    }

    /// Adds a band of those flanks that may show in it; nothing when there are none.
    fn add_band(&mut self, low: f64, high: f64, there: &[u32], asked: &mut Strided<'_>) -> Option<()> {
        let curtain = Curtain::of(&self.flanks, low, high, there, asked)?;
        let from = self.shown.len();
        for &at in there {
            asked.look()?;
            let flank = &self.flanks[at as usize];
            let furthest = flank.furthest(flank.low.max(low), flank.high.min(high));
            if furthest >= curtain.least && !curtain.hides(&self.flanks, at) {
                self.shown.push((furthest, at));
            }
        }
        let shown = &mut self.shown[from..];
        shown.sort_unstable_by(|one, other| other.0.total_cmp(&one.0));
        if let Some(&(furthest, _)) = shown.first() {
            self.bands.push(Band { low, high, furthest, from: from as u32, to: self.shown.len() as u32 });
        }
        asked.ask()
    }

    fn forget_hidden(&mut self) {
        let mut shows = vec![false; self.flanks.len()];
        self.shown.iter().for_each(|&(_, at)| shows[at as usize] = true);
        let mut kept = 0;
        let number = |&shows: &bool| {
            kept += u32::from(shows);
            kept.saturating_sub(1)
        };
        let numbers: Vec<u32> = shows.iter().map(number).collect();
        let mut of_flank = shows.into_iter();
        self.flanks.retain(|_| of_flank.next().unwrap_or(false));
        self.flanks.shrink_to_fit();
        self.shown.iter_mut().for_each(|(_, at)| *at = numbers[*at as usize]);
        self.shown.shrink_to_fit();
        self.bands.shrink_to_fit();
    }

    /// What may show in a band and how far it reaches there, the furthest first.
    pub(crate) fn shown(&self, band: &Band) -> impl Iterator<Item = (f64, &Flank)> {
        let entries = &self.shown[band.from as usize..band.to as usize];
        entries.iter().map(|&(reach, at)| (reach, &self.flanks[at as usize]))
    }
}

/// Where bands begin and end.
struct Ruler {
    low: f64,
    high: f64,
    count: usize,
}

impl Ruler {
    fn over(flanks: &[Flank]) -> Self {
        let low = flanks.iter().map(|flank| flank.low).fold(f64::INFINITY, f64::min);
        let high = flanks.iter().map(|flank| flank.high).fold(f64::NEG_INFINITY, f64::max);
        let count = if low < high { (flanks.len() / FLANKS_IN_BAND).clamp(1, MOST_BANDS) } else { 1 };
        Self { low, high, count }
    }

    fn border(&self, at: usize) -> f64 {
        match at == self.count {
            true => self.high,
            false => self.low + (self.high - self.low) * (at as f64 / self.count as f64),
        }
    }

    /// How many bands all flanks together lie in, about.
    fn places(&self, flanks: &[Flank], asked: &mut Strided<'_>) -> Option<usize> {
        let scale = self.count as f64 / (self.high - self.low);
        let of = |flank: &Flank| ((flank.high - flank.low) * scale) as usize + 1;
        let mut places = 0;
        for flank in flanks {
            asked.look()?;
            places += of(flank);
        }
        Some(places)
    }
}

/// What hides others in a band: what is there at all its heights.
struct Curtain {
    low: f64,
    high: f64,
    /// At each height something reaches as far as this.
    least: f64,
    /// A flank that nothing hides which is behind it.
    front: Option<u32>,
}

impl Curtain {
    fn of(flanks: &[Flank], low: f64, high: f64, there: &[u32], asked: &mut Strided<'_>) -> Option<Self> {
        let mut curtain = Self { low, high, least: f64::NEG_INFINITY, front: None };
        let mut front_reach = f64::NEG_INFINITY;
        for &at in there {
            asked.look()?;
            let flank = &flanks[at as usize];
            if flank.low > low || high > flank.high {
                continue;
            }
            curtain.least = curtain.least.max(flank.least(low, high));
            let reach = flank.reach(low) + flank.reach(high);
            if flank.is_beyond_chord() && reach > front_reach {
                (curtain.front, front_reach) = (Some(at), reach);
            }
        }
        Some(curtain)
    }

    /// Whether a flank lies behind the front at all heights that it has in the band.
    fn hides(&self, flanks: &[Flank], at: u32) -> bool {
        let Some(front) = self.front.filter(|&front| front != at) else { return false };
        let (front, flank) = (&flanks[front as usize], &flanks[at as usize]);
        let ends = [flank.low.max(self.low), flank.high.min(self.high)];
        flank.is_within_chord() && ends.into_iter().all(|y| flank.reach(y) <= front.reach(y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;
    use traverse_geometry::{Part, Point, Polygon, Ring};

    /// Upright teeth side by side on a bar, each leaning by `lean`.
    fn comb(teeth: usize, lean: f64) -> Section {
        let mut xy = Vec::new();
        for tooth in 0..teeth {
            let x = 2.0 * tooth as f64;
            xy.extend([x, 0.0, x + lean, 1000.0, x + 1.0 + lean, 1000.0, x + 1.0, 0.0]);
        }
        xy.extend([2.0 * teeth as f64, -1.0, 0.0, -1.0]);
        let ring = Ring::from_xy(&xy, &[]).expect("a ring");
        let shape = Polygon::from_ring(ring);
        let part = Part { id: "p".into(), shape, pole: Point::origin(), rotation_rad: 0.0, mirrored: false };
        Section { id: "s".into(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
    }

    #[test]
    fn teeth_behind_teeth_take_no_memory() {
        for (teeth, lean) in [(10_000, 0.0), (10_000, 30_000.0), (10_000, -1e6)] {
            let section = comb(teeth, lean);
            for (pose, facing) in [(Pose::AsIs, Facing::Right), (Pose::HalfTurn, Facing::Left)] {
                let silhouette = Silhouette::of(&section, pose, facing, &|| true).expect("not given up");
                let vertices = 4 * teeth + 2;
                assert!(silhouette.flanks.len() <= vertices);
                assert!(silhouette.shown.capacity() <= SHOWN * vertices, "{}", silhouette.shown.len());
                assert!(silhouette.bands.len() > 1, "{lean}");
            }
        }
    }

    #[test]
    fn it_is_asked_all_along_whether_to_go_on() {
        let section = comb(10_000, 30_000.0);
        let asked = Cell::new(0);
        let until = |last: usize| {
            asked.set(0);
            let go_on = || {
                asked.set(asked.get() + 1);
                asked.get() <= last
            };
            Silhouette::of(&section, Pose::AsIs, Facing::Right, &go_on).is_some()
        };
        assert!(until(usize::MAX));
        // At each few hundred vertices, and at each few hundred flanks in bands.
        let in_all = asked.get();
        assert!(in_all > 40_000 / 256 * 3, "{in_all}");
        for last in [0, 1, in_all / 4, in_all / 2, in_all - 1] {
            assert!(!until(last));
            assert_eq!(asked.get(), last + 1, "asked again after a no");
        }
    }
}
