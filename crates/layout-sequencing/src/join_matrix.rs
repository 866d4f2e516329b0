//! The effects of all ordered pairs of sections in their poses.

use crate::join::effect;
use crate::meeting::meeting;
use crate::offsets::filled;
use crate::options::EffectModel;
use crate::profile::{Profile, Silhouette};
use crate::published_effect::Facing;
use traverse_geometry::{Pose, SectionLayout};
use traverse_solve::{Budget, Interrupt};

/// One section in one pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct JoinItem {
    /// Which section.
    pub section: usize,
    /// How it is turned.
    pub pose: Pose,
}

/// The effects of all ordered pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct JoinMatrix {
    /// Every section in each of its poses, in the order of the layout.
    pub items: Vec<JoinItem>,
    /// `effects_mm[i · n + j]`: how far item j slides into item i standing on its left, as
    /// [`crate::Join::effect_mm`].
    pub effects_mm: Vec<f64>,
}

/// The effects of all ordered pairs of (section, pose), also of each with another copy of itself, on `threads` threads.
/// Cost: linear in the vertices of both for each pair; 8 bytes for each pair.
///
/// # Errors
/// When the budget ends first.
pub fn joins(
    layout: &SectionLayout,
    model: EffectModel,
    threads: usize,
    budget: &Budget,
) -> Result<JoinMatrix, Interrupt> {
    let mut items = vec![];
    let mut profiles: Vec<Profile> = vec![];
    let mut facings = vec![];
    for (number, section) in layout.sections.iter().enumerate() {
        budget.check(0)?;
        items.extend(section.poses.iter().map(|&pose| JoinItem { section: number, pose }));
        match model {
            EffectModel::Exact => {
                let silhouette = Silhouette::of(section, layout.gap_mm);
                profiles.extend(section.poses.iter().map(|&pose| silhouette.profile(pose)));
            }
            EffectModel::Published => {
                facings.extend(section.poses.iter().map(|&pose| Facing::of(section, pose)));
            }
        }
    }
    let row = |left: usize, row: &mut [f64]| match model {
        EffectModel::Exact => {
            let stands = &profiles[left];
            for (slides, saved) in profiles.iter().zip(row) {
                let offset = meeting(&stands.grown_right, &slides.left).map(|met| met.offset);
                *saved = effect(stands, offset, layout.gap_mm);
            }
        }
        EffectModel::Published => {
            for (slides, saved) in facings.iter().zip(row) {
                *saved = facings[left].effect(slides);
            }
        }
    };
    let effects_mm = filled(items.len(), 0.0, threads, budget, row)?;
    Ok(JoinMatrix { items, effects_mm })
}
