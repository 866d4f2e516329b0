//! Rings and polygons.

use super::reader::Reader;
use crate::v1;
use traverse_geometry::{Polygon, Ring};

impl Reader<'_> {
    /// A polygon that must be there.
    pub(crate) fn polygon(&mut self, field: &str, polygon: Option<v1::Polygon>) -> Option<Polygon> {
        if !self.goes_on() {
            return None;
        }
        let Some(polygon) = polygon else {
            self.missing(field, "a polygon with an outer ring");
            return None;
        };
        let outer = self.ring(&format!("{field}.outer"), polygon.outer);
        let holes: Vec<Option<Ring>> = (polygon.holes.into_iter().enumerate())
            .map(|(index, hole)| self.ring(&format!("{field}.holes[{index}]"), Some(hole)))
            .collect();
        let holes: Option<Vec<Ring>> = holes.into_iter().collect();
        match Polygon::new_while(outer?, holes?, &|| self.wanted()) {
            Ok(polygon) => Some(polygon),
            Err(findings) => {
                // What was given up says nothing about the request.
                if self.goes_on() {
                    self.report_under(field, findings);
                }
                None
            }
        }
    }

    fn ring(&mut self, field: &str, ring: Option<v1::Ring>) -> Option<Ring> {
        if !self.goes_on() {
            return None;
        }
        let Some(ring) = ring else {
            self.missing(field, "a ring with xy_mm");
            return None;
        };
        match Ring::from_xy_while(&ring.xy_mm, &ring.bulges, &|| self.wanted()) {
            Ok(ring) => Some(ring),
            Err(findings) => {
                // What was given up says nothing about the request.
                if self.goes_on() {
                    self.report_under(field, findings);
                }
                None
            }
        }
    }
}

/// Vertices of a polygon on the wire, and its rings: each counts as one vertex at least.
pub(crate) fn wire_vertices(polygon: &v1::Polygon) -> usize {
    polygon
        .outer
        .iter()
        .chain(&polygon.holes)
        .map(|ring| (ring.xy_mm.len() / 2).max(ring.bulges.len()).max(1))
        .sum()
}
