//! What can be seen from every feature that a search has come by, and how edits change it.

use super::link::Link;
use super::sight::{Looked, Sight, line, link, look_towards, may_matter, sight};
use super::terrain::Terrain;
use crate::barrier::Side;
use rustc_hash::FxHashMap;
use traverse_geometry::Bounds;
use traverse_solve::{Budget, Interrupt};

/// Sights that are behind by more edits than this are worked out anew.
const EDITS_KEPT: usize = 256;

/// Edits that are noted at most; then all that was seen is forgotten.
const EDITS_NOTED: usize = 1 << 16;

/// Links that are kept at most unless more are asked for: 32 MB.
pub(super) const LINKS_KEPT: usize = 1_000_000;

/// Sights by feature and side, worked out when first asked for.
pub(super) struct Sights {
    /// Per feature on the left and on the right.
    known: Vec<[Option<Box<Kept>>; 2]>,
    edits: Vec<Edit>,
    /// Per owner by which of the edits it was added last.
    added: FxHashMap<usize, usize>,
    looked: Looked,
    link_count: usize,
    /// Beyond so many links all are forgotten, and worked out again as they are needed.
    links_kept: usize,
}

/// A sight, and how many edits it has taken in.
struct Kept {
    sight: Sight,
    edits: usize,
}

/// A change of the scene.
struct Edit {
    owner: usize,
    kind: EditKind,
    bounds: Bounds,
    /// Which of the edits had added the owner, if it was removed; none: it was there before them.
    since: Option<usize>,
}

impl Edit {
    /// Whether a sight that misses the edits from `first` on can do without this one: its owner came and went in between.
    fn is_idle(&self, terrain: &Terrain, first: usize) -> bool {
        match self.kind {
            EditKind::Added => !terrain.there.has(self.owner),
            EditKind::Removed => self.since.is_some_and(|since| since >= first),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum EditKind {
    Added,
    Removed,
}

impl Sights {
    /// Nothing seen yet; of what will be, about `links_kept` links are kept.
    pub(super) fn keeping(links_kept: usize) -> Self {
        let (known, edits, added) = (Vec::new(), Vec::new(), FxHashMap::default());
        Self { known, edits, added, looked: Looked::default(), link_count: 0, links_kept }
    }

    /// How many links are kept at most, about.
    pub(super) fn links_kept(&self) -> usize {
        self.links_kept
    }

    fn forget(&mut self) {
        self.known.clear();
        self.edits.clear();
        self.added.clear();
        self.link_count = 0;
    }

    /// Takes note that an owner was added or removed.
    pub(super) fn note(&mut self, terrain: &Terrain, owner: usize, kind: EditKind) {
        if self.edits.len() >= EDITS_NOTED {
            self.forget();
        }
        let Some(bounds) = terrain.owned(owner).bounds else { return };
        let since = match kind {
            EditKind::Added => self.added.insert(owner, self.edits.len()),
            EditKind::Removed => self.added.get(&owner).copied(),
        };
        self.edits.push(Edit { owner, kind, bounds, since });
    }

    /// Makes sure that the sight from a feature is known and up to date.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn see(
        &mut self,
        terrain: &Terrain,
        feature: u32,
        side: Side,
        budget: &Budget,
    ) -> Result<(), Interrupt> {
        let at = feature as usize;
        if self.link_count > self.links_kept {
            self.forget();
        }
        if self.known.len() <= at {
            self.known.resize_with(terrain.features.len(), Default::default);
        }
        let now = self.edits.len();
        if let Some(kept) = &mut self.known[at][side as usize]
            && now - kept.edits <= EDITS_KEPT
        {
            if now == kept.edits {
                return Ok(());
            }
            let before = kept.sight.links.len();
            let first = kept.edits;
            let mut missed = self.edits[first..].iter().filter(|edit| !edit.is_idle(terrain, first));
            let is_up_to_date = missed.try_fold(true, |is_up_to_date, edit| {
                let looked = &mut self.looked;
                Ok(is_up_to_date && update(terrain, (feature, side), &mut kept.sight, edit, looked, budget)?)
            });
            self.link_count = self.link_count - before + kept.sight.links.len();
            match is_up_to_date {
                Ok(true) => {
                    kept.sight.sort();
                    kept.edits = now;
                    return Ok(());
                }
                Ok(false) => {}
                Err(interrupt) => {
                    // It has taken in some of the edits, and must not take those for idle later on.
                    self.link_count -= kept.sight.links.len();
                    self.known[at][side as usize] = None;
                    return Err(interrupt);
                }
            }
        }
        let sight = sight(terrain, feature, side, &mut self.looked, budget)?;
        self.link_count += sight.links.len();
        let replaced = self.known[at][side as usize].replace(Box::new(Kept { sight, edits: now }));
        self.link_count -= replaced.map_or(0, |kept| kept.sight.links.len());
        Ok(())
    }

    /// The links from a feature that was seen from.
    pub(super) fn links(&self, feature: u32, side: Side) -> &[Link] {
        let kept = self.known.get(feature as usize).and_then(|sides| sides[side as usize].as_ref());
        kept.map_or(&[], |kept| &kept.sight.links)
    }

    /// What was seen from there, once that was worked out.
    pub(super) fn sight(&self, feature: u32, side: Side) -> Option<&Sight> {
        self.known.get(feature as usize)?[side as usize].as_ref().map(|kept| &kept.sight)
    }

    /// How many links are kept.
    pub(super) fn link_count(&self) -> usize {
        self.link_count
    }
}

/// Takes an edit into a sight; false when it has to be worked out anew.
///
/// # Errors
/// The budget ended.
fn update(
    terrain: &Terrain,
    (feature, side): (u32, Side),
    sight: &mut Sight,
    edit: &Edit,
    looked: &mut Looked,
    budget: &Budget,
) -> Result<bool, Interrupt> {
    if !may_matter(terrain, feature, side, sight.reach, &edit.bounds) {
        return Ok(true);
    }
    if edit.kind == EditKind::Removed {
        sight.links.retain(|kept| terrain.is_there(kept.feature()));
        return look_towards(terrain, feature, side, &edit.bounds, sight, looked, budget);
    }
    sight.links.retain(|kept| {
        line(terrain, feature, side, kept)
            .is_some_and(|(from, to)| !terrain.is_blocked_by(edit.owner, from, to))
    });
    if terrain.there.has(edit.owner) {
        for other in terrain.owned(edit.owner).features.clone() {
            for other_side in [Side::Left, Side::Right] {
                let Some(link) = link(terrain, feature, side, other as u32, other_side) else { continue };
                sight.add(link);
            }
        }
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::barrier::Clearance;
    use rand::RngExt;
    use traverse_geometry::{CornerStyle, Obstacle, Point, Polygon, Ring, Scene, unit};
    use traverse_solve::{CancelToken, Seed};

    fn shape(random: &mut impl RngExt) -> Polygon {
        let corners = random.random_range(3..7);
        let middle = Point::new(random.random_range(0.0..60.0), random.random_range(0.0..60.0));
        let step = std::f64::consts::TAU / f64::from(corners);
        let size = random.random_range(2.0..8.0);
        let at = |i: i32| middle + unit(step * f64::from(i)) * size;
        Polygon::from_ring(Ring::new((0..corners).map(at).collect(), vec![]).expect("convex"))
    }

    /// What a sight missed is taken in the next time also when the budget ended while it was worked out.
    #[test]
    fn sights_that_were_interrupted_show_what_new_ones_do() {
        let (mut compared, mut interrupted) = (0, 0);
        let unlimited = Budget::unlimited();
        let cancel = CancelToken::new();
        cancel.cancel();
        let over = Budget { cancel, ..Budget::unlimited() };
        for seed in 0..30 {
            let mut random = Seed(seed).stream();
            let obstacles = (0..8).map(|i| Obstacle {
                id: format!("o{i}"),
                shape: shape(&mut random),
                clearance_mm: None,
                top_z_mm: None,
            });
            let style = CornerStyle::Round;
            let scene = Scene {
                work_area: None,
                obstacles: obstacles.collect(),
                clearance_mm: 0.0,
                work_area_clearance_mm: None,
                corner_style: style,
            };
            let mut terrain = Terrain::new(&scene, &unlimited).expect("no limit");
            let first = terrain.features.len() as u32;
            let mut sights = Sights::keeping(LINKS_KEPT);
            let mut there: Vec<usize> = (0..8).collect();
            let mut count = there.len();
            for step in 0..40 {
                for _ in 0..random.random_range(0..3) {
                    if random.random_bool(0.5) && there.len() > 4 {
                        let owner = there.swap_remove(random.random_range(0..there.len()));
                        terrain.remove(owner);
                        sights.note(&terrain, owner, EditKind::Removed);
                    } else {
                        let owner = count;
                        count += 1;
                        let clearance = Clearance { asked: 0.0, style };
                        terrain.push(&shape(&mut random), clearance, &unlimited).expect("no limit");
                        sights.note(&terrain, owner, EditKind::Added);
                        there.push(owner);
                    }
                }
                let mut fresh = Sights::keeping(LINKS_KEPT);
                for (feature, side) in (0..first).flat_map(|it| [(it, Side::Left), (it, Side::Right)]) {
                    if !terrain.is_there(feature) || random.random_bool(0.3) {
                        continue;
                    }
                    if random.random_bool(0.3) {
                        interrupted += u32::from(sights.see(&terrain, feature, side, &over).is_err());
                        continue;
                    }
                    let seen = [&mut sights, &mut fresh].map(|sights| {
                        sights.see(&terrain, feature, side, &unlimited).expect("no limit");
                        let links = sights.links(feature, side);
                        let mut seen: Vec<_> =
                            links.iter().map(|link| (link.feature(), link.side() as u32)).collect();
                        seen.sort_unstable();
                        seen
                    });
                    assert_eq!(seen[0], seen[1], "seed {seed} step {step}: {feature} {side:?}");
                    compared += 1;
                }
            }
            let kept = sights.known.iter().flatten().flatten();
            assert_eq!(sights.link_count(), kept.map(|kept| kept.sight.links.len()).sum::<usize>());
        }
        assert!(compared > 1000 && interrupted > 100, "{compared} {interrupted}");
    }
}
