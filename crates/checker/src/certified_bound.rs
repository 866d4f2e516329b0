//! The length below which no layout is, as far as a certificate proves it: recomputed from the sections themselves.

use crate::certificate::{LayoutCertificate, certificate_findings};
use crate::exact_sum::ExactSum;
use crate::extent::Extent;
use crate::facing::Facing;
use crate::flank::Flank;
use crate::join_prices::bound_by_prices;
use traverse_geometry::{Pose, Section, SectionLayout};

/// A bound of the engine counts in steps of this share of the longest join, or in nanometres where those are more.
const ENGINE_STEP_RATIO: f64 = 1e-10;

/// Roundings of a width that are taken off a thickness.
const THICKNESS_ROUNDINGS: f64 = 8.0;

/// The lower bound that `certificate` proves of every layout that answers `layout` and is reached by sliding, millimetres, 0 or more; 0 as well where
/// [`crate::certificate_findings`] has something to say, and for what is no layout: without sections, of no copies, in no pose.
/// It shares no joins with the solver: of each two sections it
/// measures, flank against flank, how far they keep each other apart. Rounding lowers it, never raises it: coordinates are
/// the numbers that [`traverse_geometry::Part::in_section`] gives, sections turn about the centre of
/// [`traverse_geometry::Section::bounds`], and all else counts as little as it may be.
///
/// Cost: for duals of n sections n² pairs in each two of their poses; for a height or a width linear.
#[must_use]
pub fn certified_bound_mm(layout: &SectionLayout, certificate: &LayoutCertificate) -> f64 {
    certified_bound_mm_while(layout, certificate, &|| true).expect("invariant: only a no gives up")
}

/// As [`certified_bound_mm`], given up when `go_on`, asked between its parts, says no: then there is no answer.
#[must_use]
pub fn certified_bound_mm_while(
    layout: &SectionLayout,
    certificate: &LayoutCertificate,
    go_on: &dyn Fn() -> bool,
) -> Option<f64> {
    let mut is_sound = layout.gap_mm.is_finite() && layout.gap_mm >= 0.0 && !layout.sections.is_empty();
    for section in &layout.sections {
        if !go_on() {
            return None;
        }
        let bounds = section.bounds();
        let is_somewhere = [bounds.min, bounds.max].iter().all(|p| (p.x + p.y).is_finite());
        is_sound &= is_somewhere && !section.poses.is_empty() && section.quantity > 0;
    }
    if !is_sound || !certificate_findings(layout, certificate).is_empty() {
        return go_on().then_some(0.0);
    }
    match certificate {
        LayoutCertificate::Joins(prices) => bound_by_prices(layout, prices, go_on),
        LayoutCertificate::Height { y_mm } => bound_by_height(layout, *y_mm, go_on),
        LayoutCertificate::Width { section } => {
            Extent::of(&layout.sections[*section], go_on).map(|extent| extent.width_mm.max(0.0))
        }
    }
}

/// By how much a bound that is claimed may exceed what is recomputed, millimetres: `tolerance_mm` for each join and each
/// end, or the step in which lengths are counted where joins are so long that it is more.
#[must_use]
pub fn claim_tolerance_mm(layout: &SectionLayout, tolerance_mm: f64) -> f64 {
    let widths = layout.sections.iter().map(|section| section.bounds().size().x);
    let longest = widths.fold(0.0, f64::max) + layout.gap_mm;
    let copies: f64 = layout.sections.iter().map(|section| f64::from(section.quantity)).sum();
    tolerance_mm.max(longest * ENGINE_STEP_RATIO) * (copies + 1.0)
}

/// At a height all sections that reach it stand side by side, a gap between each two.
fn bound_by_height(layout: &SectionLayout, y: f64, go_on: &dyn Fn() -> bool) -> Option<f64> {
    let mut sum = ExactSum::default();
    for section in &layout.sections {
        if let Some(thickness) = thickness(section, y, go_on)? {
            sum.add_product(f64::from(section.quantity), thickness);
            sum.add_product(f64::from(section.quantity), layout.gap_mm);
        }
    }
    sum.add(-layout.gap_mm);
    Some(sum.at_most().max(0.0))
}

/// From the leftmost to the rightmost point at a height, least of all poses; the inner none: one leaves the height free.
#[expect(clippy::option_option, reason = "the outer one: it was not given up")]
fn thickness(section: &Section, y: f64, go_on: &dyn Fn() -> bool) -> Option<Option<f64>> {
    let width = section.bounds().size().x;
    let mut least = f64::INFINITY;
    for &pose in &section.poses {
        let right = reach(section, pose, Facing::Right, y, go_on)?;
        let left = reach(section, pose, Facing::Left, y, go_on)?;
        let Some((right, left)) = right.zip(left) else { return Some(None) };
        least = least.min(right + left - THICKNESS_ROUNDINGS * f64::EPSILON * width);
    }
    Some(Some(least.max(0.0)))
}

/// How far a section reaches at a height, not more than it does; the inner none: it may leave the height free. Cost: linear,
/// without bands: one height is asked once.
#[expect(clippy::option_option, reason = "the outer one: it was not given up")]
fn reach(
    section: &Section,
    pose: Pose,
    facing: Facing,
    y: f64,
    go_on: &dyn Fn() -> bool,
) -> Option<Option<f64>> {
    let mut furthest: Option<f64> = None;
    let see = |flank: Flank| {
        if flank.low <= y && y <= flank.high {
            let reach = flank.reach(y);
            furthest = Some(furthest.map_or(reach, |furthest| furthest.max(reach)));
        }
    };
    facing.flanks(section, pose, go_on, see)?;
    Some(furthest)
}
