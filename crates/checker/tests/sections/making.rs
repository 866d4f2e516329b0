//! Sections and layouts in a few words.

use traverse_checker::{SectionsCheck, ViolationReason, check_sections};
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, Part, PlacedSection, Point, Polygon, Pose, Ring, Section, SectionLayout,
};

pub(crate) const TOLERANCE: f64 = CONTACT_TOLERANCE_MM;

/// A part where its coordinates say.
pub(crate) fn part(id: &str, xy: &[f64], bulges: &[f64]) -> Part {
    let ring = Ring::from_xy(xy, bulges).expect("the ring is valid");
    let shape = Polygon::from_ring(ring);
    Part { id: id.into(), shape, pole: Point::origin(), rotation_rad: 0.0, mirrored: false }
}

pub(crate) fn rectangle(id: &str, x0: f64, y0: f64, x1: f64, y1: f64) -> Part {
    part(id, &[x0, y0, x1, y0, x1, y1, x0, y1], &[])
}

pub(crate) fn disc(id: &str, x: f64, y: f64, radius: f64) -> Part {
    part(id, &[x - radius, y, x + radius, y], &[1.0, 1.0])
}

/// In every pose, once.
pub(crate) fn section(id: &str, parts: Vec<Part>) -> Section {
    Section { id: id.into(), parts, quantity: 1, poses: Pose::ALL.to_vec() }
}

pub(crate) fn layout(sections: Vec<Section>) -> SectionLayout {
    SectionLayout::new(sections)
}

/// Section, as it was sent, at x.
pub(crate) fn at(section: usize, x_mm: f64) -> PlacedSection {
    PlacedSection { section, copy: 0, pose: Pose::AsIs, x_mm }
}

pub(crate) fn check(layout: &SectionLayout, order: &[PlacedSection]) -> SectionsCheck {
    check_sections(layout, order, TOLERANCE)
}

pub(crate) fn reasons(layout: &SectionLayout, order: &[PlacedSection]) -> Vec<ViolationReason> {
    check(layout, order).violations.into_iter().map(|violation| violation.reason).collect()
}
