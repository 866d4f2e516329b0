//! Calls on one layout as it is: place a given order, measure it, say what touches what.

use crate::contact::Contact;
use crate::instance::{Instance, profile_of};
use crate::join::nearest_point;
use crate::meeting::meeting;
use crate::placing::Placing;
use crate::profile::Profile;
use crate::published_effect::Facing;
use rustc_hash::FxHashMap;
use traverse_geometry::{PlacedSection, Point, Pose, SectionLayout};
use traverse_solve::{Budget, Interrupt};

/// Places an order exactly: each section as far left as the slide rule lets it go. `order` names known sections in
/// allowed poses; any part of the copies will do, and `x_mm` is not read. Copies and poses come back as they went in.
#[must_use]
pub fn place(layout: &SectionLayout, order: &[PlacedSection]) -> Vec<PlacedSection> {
    let unlimited = Budget::unlimited();
    let Ok(instance) = Instance::of_order(layout, order, &unlimited) else { return vec![] };
    let sequence: Vec<usize> =
        order.iter().map(|placed| instance.item_of(placed.section, placed.pose)).collect();
    let Ok(placing) = Placing::of(&instance, &sequence, &unlimited) else { return vec![] };
    let places = order.iter().zip(&placing.x);
    places.map(|(placed, &x)| PlacedSection { x_mm: instance.grid.mm(x), ..*placed }).collect()
}

/// Places an order as the published model has it, by published effects of neighbours alone: sections may overlap.
#[must_use]
pub fn place_as_published(layout: &SectionLayout, order: &[PlacedSection]) -> Vec<PlacedSection> {
    placed_as_published(layout, order, &Budget::unlimited()).unwrap_or_default()
}

fn placed_as_published(
    layout: &SectionLayout,
    order: &[PlacedSection],
    budget: &Budget,
) -> Result<Vec<PlacedSection>, Interrupt> {
    let mut facings: FxHashMap<(usize, Pose), Facing> = FxHashMap::default();
    for placed in order {
        budget.check(0)?;
        facings
            .entry((placed.section, placed.pose))
            .or_insert_with(|| Facing::of(&layout.sections[placed.section], placed.pose));
    }
    let mut x_mm = 0.0;
    let mut places = vec![];
    for (at, placed) in order.iter().enumerate() {
        budget.check(0)?;
        if let Some(before) = at.checked_sub(1).map(|before| &order[before]) {
            let (left, right) =
                (&facings[&(before.section, before.pose)], &facings[&(placed.section, placed.pose)]);
            x_mm += layout.sections[before.section].bounds().size().x + layout.gap_mm - left.effect(right);
        }
        places.push(PlacedSection { x_mm, ..*placed });
    }
    Ok(places)
}

/// The right end of what reaches furthest, millimetres; 0 for nothing.
#[must_use]
pub fn layout_length_mm(layout: &SectionLayout, placed: &[PlacedSection]) -> f64 {
    let mut widths: FxHashMap<usize, f64> = FxHashMap::default();
    let ends = placed.iter().map(|placed| {
        let width =
            widths.entry(placed.section).or_insert_with(|| layout.sections[placed.section].bounds().size().x);
        placed.x_mm + *width
    });
    ends.fold(0.0, f64::max)
}

/// The same order joined by bounding boxes, the gap between each two, millimetres.
pub(crate) fn bounding_box_length_mm(layout: &SectionLayout, order: &[PlacedSection]) -> f64 {
    let width = |section: usize| layout.sections[section].bounds().size().x;
    let widths: f64 = order.iter().map(|placed| width(placed.section)).sum();
    widths + layout.gap_mm * order.len().saturating_sub(1) as f64
}

/// What stopped each section of a layout as [`place`] gives it: of several contacts the one with the nearest section
/// before. Sections that nothing but the start of the strip or the slide rule stopped have none.
#[must_use]
pub fn contacts(layout: &SectionLayout, placed: &[PlacedSection]) -> Vec<Contact> {
    let mut profiles: FxHashMap<(usize, Pose), Profile> = FxHashMap::default();
    for section in placed {
        profiles
            .entry((section.section, section.pose))
            .or_insert_with(|| profile_of(&layout.sections[section.section], section.pose, layout.gap_mm));
    }
    let profile = |at: usize| &profiles[&(placed[at].section, placed[at].pose)];
    contacts_by(layout, placed, profile, &Budget::unlimited()).unwrap_or_default()
}

/// The same with the profiles of the placed sections at hand. Cost: the joins of each section with those that reach it,
/// up to the one that it touches.
pub(crate) fn contacts_by<'p>(
    layout: &SectionLayout,
    placed: &[PlacedSection],
    profile: impl Fn(usize) -> &'p Profile,
    budget: &Budget,
) -> Result<Vec<Contact>, Interrupt> {
    let mut found = vec![];
    // The furthest that anything up to here can touch, and that each can.
    let (mut reach, mut own_reach): (Vec<f64>, Vec<f64>) = (vec![], vec![]);
    for index in 0..placed.len() {
        budget.check(0)?;
        let x = placed[index].x_mm;
        let slides = profile(index);
        for against in (0..index).rev() {
            if reach[against] < x - CONTACT_MM {
                break;
            }
            if own_reach[against] < x - CONTACT_MM {
                continue;
            }
            let met = meeting(&profile(against).grown_right, &slides.left);
            let Some(met) = met.filter(|met| placed[against].x_mm + met.offset > x - CONTACT_MM) else {
                continue;
            };
            let point = Point::new(x - slides.left.x(met.y).unwrap_or_default(), met.y);
            let other = placed[against];
            let seen = Point::new(point.x - other.x_mm, point.y);
            let nearest = nearest_point(&layout.sections[other.section], other.pose, seen);
            let against_point = Point::new(nearest.x + other.x_mm, nearest.y);
            found.push(Contact { index, against, point, against_point });
            break;
        }
        let own = x + slides.width + layout.gap_mm;
        own_reach.push(own);
        reach.push(reach.last().map_or(own, |&before| own.max(before)));
    }
    Ok(found)
}

/// A section stands at most this far from what stopped it, millimetres: its place is rounded up to the grid.
const CONTACT_MM: f64 = 2e-6;

/// The sum of widths and gaps less the published effects of neighbours, millimetres.
pub(crate) fn published_length_mm(
    layout: &SectionLayout,
    order: &[PlacedSection],
    budget: &Budget,
) -> Result<f64, Interrupt> {
    let placed = placed_as_published(layout, order, budget)?;
    Ok(placed.last().map_or(0.0, |last| last.x_mm + layout.sections[last.section].bounds().size().x))
}
