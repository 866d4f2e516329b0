//! How far a section reaches to one side at each height: the flanks of its parts that may show there, sorted into bands
//! of equal height. Flanks that lie behind others over a whole band are left out of it.

use crate::curve::Curve;
use crate::flank::Flank;
use traverse_geometry::{Point, Pose, Section};

/// About so many flanks share a band.
const FLANKS_IN_BAND: usize = 6;

/// Most bands of one section.
const MOST_BANDS: usize = 1024;

/// Which way a section looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Facing {
    Right,
    Left,
}

/// A range of heights and what may show in it.
#[derive(Clone, Debug)]
pub(crate) struct Band {
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Nothing in the band reaches further.
    pub(crate) furthest: f64,
    /// How far each reaches there, and itself; the furthest first.
    pub(crate) flanks: Vec<(f64, Flank)>,
}

/// How far a section reaches to one side.
#[derive(Clone, Debug)]
pub(crate) struct Silhouette {
    /// From the lowest to the highest; a flank may lie in several.
    pub(crate) bands: Vec<Band>,
}

impl Silhouette {
    /// How far `section` in `pose` reaches beyond its left edge (looking right), or how far its left edge lies from where
    /// it begins, as a negative number (looking left). Given up when `go_on` says no. Cost: O(n log n) for n vertices that spread over the height.
    pub(crate) fn of(
        section: &Section,
        pose: Pose,
        facing: Facing,
        go_on: &dyn Fn() -> bool,
    ) -> Option<Self> {
        let bounds = section.bounds();
        let is_mirrored = matches!(pose, Pose::MirrorX | Pose::HalfTurn);
        let is_upside_down = matches!(pose, Pose::MirrorY | Pose::HalfTurn);
        // Both sides look to the right; what is turned round twice is not turned.
        let turned = is_mirrored != (facing == Facing::Left);
        let edge = match facing {
            Facing::Right if is_mirrored => bounds.max.x,
            Facing::Right => -bounds.min.x,
            Facing::Left if is_mirrored => -bounds.max.x,
            Facing::Left => bounds.min.x,
        };
        let place = |p: Point| {
            let x = if turned { edge - p.x } else { p.x + edge };
            Point::new(x, if is_upside_down { bounds.min.y + bounds.max.y - p.y } else { p.y })
        };
        let mut flanks = Vec::new();
        for part in &section.parts {
            if !go_on() {
                return None;
            }
            let shape = part.in_section();
            let (ring, count) = (shape.outer(), shape.outer().len());
            for at in 0..count {
                let (a, b) = (place(ring.vertices()[at]), place(ring.vertices()[(at + 1) % count]));
                let bulge = ring.bulges().get(at).copied().unwrap_or(0.0);
                let bulge = if turned == is_upside_down { bulge } else { -bulge };
                Flank::add(&Curve::from_bulge(a, b, bulge), &mut flanks);
            }
        }
        Self::banded(flanks, go_on)
    }

    fn banded(flanks: Vec<Flank>, go_on: &dyn Fn() -> bool) -> Option<Self> {
        let low = flanks.iter().map(|flank| flank.low).fold(f64::INFINITY, f64::min);
        let high = flanks.iter().map(|flank| flank.high).fold(f64::NEG_INFINITY, f64::max);
        let count = (flanks.len() / FLANKS_IN_BAND).clamp(1, MOST_BANDS);
        let border = |at: usize| match at == count {
            true => high,
            false => low + (high - low) * (at as f64 / count as f64),
        };
        let at = |y: f64| ((y - low) / (high - low) * count as f64) as usize;
        let mut members: Vec<Vec<Flank>> = vec![Vec::new(); count];
        for flank in flanks {
            // One more on either side: rounding decides nothing.
            let (first, last) = (at(flank.low).saturating_sub(1), (at(flank.high) + 1).min(count - 1));
            for (band, members) in members.iter_mut().enumerate().take(last + 1).skip(first) {
                if flank.low <= border(band + 1) && border(band) <= flank.high {
                    members.push(flank);
                }
            }
        }
        let mut bands = Vec::with_capacity(count);
        for (number, members) in members.into_iter().enumerate() {
            if !go_on() {
                return None;
            }
            bands.extend(Band::of(border(number), border(number + 1), members));
        }
        Some(Self { bands })
    }

    /// How far it reaches at a height, not more than it does; none: it leaves the height free. Cost: its bands.
    pub(crate) fn reach(&self, y: f64) -> Option<f64> {
        let bands = self.bands.iter().filter(|band| band.low <= y && y <= band.high);
        let there = bands.flat_map(|band| &band.flanks).map(|(_, flank)| flank);
        there.filter(|flank| flank.low <= y && y <= flank.high).map(|flank| flank.reach(y)).reduce(f64::max)
    }
}

impl Band {
    /// A band of those flanks that may show in it; nothing when there are none.
    fn of(low: f64, high: f64, members: Vec<Flank>) -> Option<Self> {
        let within = |flank: &Flank| (flank.low.max(low), flank.high.min(high));
        let hides = members.iter().filter(|flank| flank.low <= low && high <= flank.high);
        let hidden = hides.map(|flank| flank.least(low, high)).fold(f64::NEG_INFINITY, f64::max);
        let mut shown: Vec<(f64, Flank)> = (members.into_iter())
            .map(|flank| {
                let (from, to) = within(&flank);
                (flank.furthest(from, to), flank)
            })
            .filter(|(furthest, _)| *furthest >= hidden)
            .collect();
        shown.sort_by(|one, other| other.0.total_cmp(&one.0));
        let furthest = shown.first()?.0;
        Some(Self { low, high, furthest, flanks: shown })
    }
}
