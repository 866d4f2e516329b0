//! What can be seen from every feature that a search has come by, and how edits change it.

use super::link::Link;
use super::sight::{Looked, Sight, line, link, look_towards, may_matter, sight};
use super::terrain::Terrain;
use crate::barrier::Side;
use traverse_geometry::Bounds;
use traverse_solve::{Budget, Interrupt};

/// Sights that are behind by more edits than this are worked out anew.
const EDITS_KEPT: usize = 256;

/// Sights by feature and side, worked out when first asked for.
#[derive(Default)]
pub(super) struct Sights {
    /// Per feature on the left and on the right.
    known: Vec<[Option<Kept>; 2]>,
    edits: Vec<Edit>,
    looked: Looked,
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
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum EditKind {
    Added,
    Removed,
}

impl Sights {
    /// Takes note that an owner was added or removed.
    pub(super) fn note(&mut self, terrain: &Terrain, owner: usize, kind: EditKind) {
        if let Some(bounds) = terrain.owned(owner).bounds {
            self.edits.push(Edit { owner, kind, bounds });
        }
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
            let mut is_up_to_date = true;
            for edit in &self.edits[kept.edits..] {
                is_up_to_date =
                    update(terrain, (feature, side), &mut kept.sight, edit, &mut self.looked, budget)?;
                if !is_up_to_date {
                    break;
                }
            }
            if is_up_to_date {
                kept.sight.sort();
                kept.edits = now;
                return Ok(());
            }
        }
        let sight = sight(terrain, feature, side, &mut self.looked, budget)?;
        self.known[at][side as usize] = Some(Kept { sight, edits: now });
        Ok(())
    }

    /// The links from a feature that was seen from.
    #[allow(dead_code, reason = "for searches from one end to many")]
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
        self.known.iter().flatten().flatten().map(|kept| kept.sight.links.len()).sum()
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
