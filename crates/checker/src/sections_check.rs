//! Checks a layout of sections: copies, poses, order, places, and the distance between parts of different sections.

use crate::message::millimetres;
use crate::order_rules::{at_index, order_violations};
use crate::posed_section::PosedSection;
use crate::rapid_check::{SMALLEST_TOLERANCE_MM, VIOLATION_LIMIT};
use crate::section_pair::{Meeting, SectionPair, apart};
use crate::{Violation, ViolationReason};
use std::collections::BTreeMap;
use traverse_geometry::{Bounds, PlacedSection, Point, Pose, SectionLayout, Vector};

/// What checking a layout found.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionsCheck {
    /// What is wrong, at most [`VIOLATION_LIMIT`]; empty: the layout is sound. Once the list is full no more sections are
    /// held against each other.
    pub violations: Vec<Violation>,
    /// From the strip's start to the right end of what reaches furthest, recomputed, millimetres.
    pub length_mm: f64,
    /// The least distance between parts of two sections, less the gap asked for; where one lies in the other, minus
    /// the depth less the gap. None: fewer than two sections, or nothing could be measured.
    pub smallest_margin_mm: Option<f64>,
    /// The length below which no layout is, as far as the certificate that was checked with it proves, millimetres. None:
    /// there was none.
    pub certified_bound_mm: Option<f64>,
}

impl SectionsCheck {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.violations.is_empty()
    }
}

/// Checks `order`, from left to right, against `layout`. Parts of different sections that come less than `tolerance_mm`
/// nearer than the gap count as placed right; [`traverse_geometry::CONTACT_TOLERANCE_MM`] is what layouts are made for.
/// That no shorter layout exists, or that sections could not slide further left, is not checked; what a
/// certificate proves of it is ([`crate::check_certified_sections_while`]).
///
/// Cost: O(n log n) for n vertices of all sections in all poses that occur, and for each pair of sections near each other
/// the edges that are near.
#[must_use]
pub fn check_sections(layout: &SectionLayout, order: &[PlacedSection], tolerance_mm: f64) -> SectionsCheck {
    check_sections_while(layout, order, tolerance_mm, &|| true).expect("invariant: only a no gives up")
}

/// As [`check_sections`], given up when `go_on`, asked between its parts, says no: then there is no answer.
#[must_use]
pub fn check_sections_while(
    layout: &SectionLayout,
    order: &[PlacedSection],
    tolerance_mm: f64,
    go_on: &dyn Fn() -> bool,
) -> Option<SectionsCheck> {
    let mut violations = Vec::new();
    let mut report = |violation: Violation| {
        if violations.len() < VIOLATION_LIMIT {
            violations.push(violation);
        }
    };
    if !tolerance_mm.is_finite() || !order.iter().all(|placed| placed.x_mm.is_finite()) {
        let wrong = order.iter().enumerate().filter(|(_, placed)| !placed.x_mm.is_finite());
        for (index, placed) in wrong {
            let message = format!("{} is not a finite number", placed.x_mm);
            report(at_index(index, "x_mm", ViolationReason::NotFinite, message, 0.0));
        }
        if !tolerance_mm.is_finite() {
            let message = format!("the tolerance {tolerance_mm} is not a finite number");
            report(Violation {
                field: "tolerance_mm".into(),
                ..at_index(0, "", ViolationReason::NotFinite, message, 0.0)
            });
        }
        return Some(SectionsCheck {
            violations,
            length_mm: 0.0,
            smallest_margin_mm: None,
            certified_bound_mm: None,
        });
    }
    let tolerance = tolerance_mm.max(SMALLEST_TOLERANCE_MM);
    order_violations(layout, order, tolerance, &mut report);
    let mut strip = Strip { layout, order, posed: BTreeMap::new(), tolerance, go_on };
    strip.make_ready()?;
    strip.heights(&mut report);
    let smallest_margin_mm = strip.distances(&mut violations)?;
    Some(SectionsCheck {
        length_mm: strip.length(),
        violations,
        smallest_margin_mm,
        certified_bound_mm: None,
    })
}

/// The strip and what lies on it.
struct Strip<'a> {
    layout: &'a SectionLayout,
    order: &'a [PlacedSection],
    /// Every section in every pose that occurs.
    posed: BTreeMap<(usize, Pose), PosedSection>,
    tolerance: f64,
    go_on: &'a dyn Fn() -> bool,
}

impl Strip<'_> {
    fn make_ready(&mut self) -> Option<()> {
        for placed in self.order {
            let Some(section) = self.layout.sections.get(placed.section) else { continue };
            let key = (placed.section, placed.pose);
            if !self.posed.contains_key(&key) {
                let posed = PosedSection::new(section, placed.pose, self.layout.gap_mm, self.go_on)?;
                self.posed.insert(key, posed);
            }
        }
        Some(())
    }

    fn of(&self, index: usize) -> Option<&PosedSection> {
        let placed = &self.order[index];
        self.posed.get(&(placed.section, placed.pose))
    }

    /// The box of a placed section.
    fn bounds(&self, index: usize) -> Option<Bounds> {
        let (bounds, by) = (self.of(index)?.bounds, Vector::new(self.order[index].x_mm, 0.0));
        Some(Bounds { min: bounds.min + by, max: bounds.max + by })
    }

    fn length(&self) -> f64 {
        (0..self.order.len())
            .filter_map(|index| self.bounds(index))
            .map(|bounds| bounds.max.x)
            .fold(0.0, f64::max)
    }

    fn heights(&self, report: &mut impl FnMut(Violation)) {
        let Some(strip) = self.layout.strip_height_mm else { return };
        for index in 0..self.order.len() {
            let Some(posed) = self.of(index) else { continue };
            let amount = posed.bounds.size().y - strip;
            if amount > self.tolerance {
                let id = &self.layout.sections[self.order[index].section].id;
                let message = format!(
                    "section {id} is {} mm high, {} mm higher than the strip",
                    millimetres(posed.bounds.size().y),
                    millimetres(amount)
                );
                report(at_index(index, "", ViolationReason::HigherThanStrip, message, amount));
            }
        }
    }

    /// Holds every section against those that come near it, from left to right; the least margin of all.
    #[expect(clippy::option_option, reason = "the outer one: it was not given up")]
    fn distances(&self, violations: &mut Vec<Violation>) -> Option<Option<f64>> {
        let mut from_left: Vec<(usize, Bounds)> =
            (0..self.order.len()).filter_map(|index| Some((index, self.bounds(index)?))).collect();
        from_left.sort_by(|one, other| one.1.min.x.total_cmp(&other.1.min.x));
        let mut smallest = f64::INFINITY;
        let mut active: Vec<(usize, Bounds)> = Vec::new();
        for (index, bounds) in from_left {
            // Margins beyond the smallest so far say nothing new.
            let reach = |smallest: f64| self.layout.gap_mm + smallest.max(self.tolerance);
            active.retain(|(_, earlier)| earlier.max.x + reach(smallest) >= bounds.min.x);
            for &(other, at) in &active {
                if !(self.go_on)() {
                    return None;
                }
                if violations.len() >= VIOLATION_LIMIT {
                    return Some(Some(smallest).filter(|margin| margin.is_finite()));
                }
                if apart(&at, &bounds) > reach(smallest) {
                    continue;
                }
                let Some(meeting) = self.meeting(other, index, smallest) else { continue };
                smallest = smallest.min(meeting.nearest.distance);
                if meeting.nearest.distance < -self.tolerance {
                    violations.push(self.violation(other, index, &meeting));
                }
            }
            active.push((index, bounds));
        }
        (self.go_on)().then_some(Some(smallest).filter(|margin| margin.is_finite()))
    }

    /// The worst between two placed sections.
    fn meeting(&self, one: usize, other: usize, most: f64) -> Option<Meeting> {
        let shift = self.order[other].x_mm - self.order[one].x_mm;
        let (first, second) = (self.of(one)?, self.of(other)?);
        SectionPair { first, second, shift, tolerance: self.tolerance, go_on: self.go_on }.worst(most)
    }

    /// Reported at the one that comes later in the list.
    fn violation(&self, one: usize, other: usize, meeting: &Meeting) -> Violation {
        let at = meeting.nearest.at + Vector::new(self.order[one].x_mm, 0.0);
        let amount = -meeting.nearest.distance;
        let gap = self.layout.gap_mm;
        let name = |index: usize, part: u32| {
            let section = &self.layout.sections[self.order[index].section].id;
            let part = self.of(index).map_or("", |posed| posed.part_id(part));
            format!("part {part} of section {section} (order[{index}])")
        };
        let [part_of_one, part_of_other] = meeting.parts;
        let ((late, late_part), (early, early_part)) = match one < other {
            true => ((other, part_of_other), (one, part_of_one)),
            false => ((one, part_of_one), (other, part_of_other)),
        };
        let (late_name, early_name) = (name(late, late_part), name(early, early_part));
        let (reason, message) = if meeting.is_overlap {
            let depth = millimetres(amount - gap);
            (ViolationReason::SectionsOverlap, format!("{late_name} lies {depth} mm inside {early_name}"))
        } else {
            let (found, asked) = (millimetres(gap - amount), millimetres(gap));
            let message =
                format!("{late_name} comes within {found} mm of {early_name}; asked are {asked} mm");
            (ViolationReason::SectionsTooClose, message)
        };
        let obstacle = Some(self.layout.sections[self.order[early].section].id.clone());
        Violation {
            at: Some(Point::new(at.x, at.y)),
            obstacle,
            ..at_index(late, "", reason, message, amount)
        }
    }
}
