//! What is wrong with a question: everything at once.

use crate::inner_overlap::overlapping_parts;
use crate::options::{InnerOverlap, OrderOptions};
use std::collections::HashMap;
use traverse_geometry::{
    COORDINATE_LIMIT_MM, FINDINGS_LIMIT, Finding, LARGEST_CLEARANCE_MM, Part, Reason, SMALLEST_CLEARANCE_MM,
    Section, SectionLayout,
};
use traverse_solve::{Budget, Interrupt};
use traverse_tours::LARGEST_VISITS;

/// The most copies of all sections together.
pub const LARGEST_COPIES: usize = LARGEST_VISITS;

/// The most copies that a method of 2009 orders: it solves once for every copy, on a matrix of all pairs.
pub const LARGEST_PUBLISHED_COPIES: usize = 1_000;

/// Everything that is wrong with a question; none for one that [`crate::order_sections`] takes. Fields are relative to
/// the request: `sections[3].quantity`, `gap_mm`, `first_section_id`, `precedences[1].before_section_id`,
/// `forbidden_joins[0].left_section_id`, `options.gap_limit`, `initial_order[2].section_id`. At most
/// [`FINDINGS_LIMIT`] and one that says how many more there are.
///
/// # Errors
/// When the budget ends first: looking for parts that overlap costs O(n · parts beside each other).
pub fn layout_findings(
    layout: &SectionLayout,
    options: &OrderOptions,
    budget: &Budget,
) -> Result<Vec<Finding>, Interrupt> {
    let mut list = List { findings: vec![], unlisted: None };
    list.sections(layout, budget)?;
    list.strip(layout);
    list.ends_and_order(layout);
    list.options(layout, options);
    if options.inner_overlap == InnerOverlap::Refused {
        for (number, section) in layout.sections.iter().enumerate() {
            if section.parts.iter().all(lies_somewhere) {
                list.inner_overlaps(number, section, budget)?;
            }
        }
    }
    Ok(list.into_findings())
}

pub(crate) struct List {
    findings: Vec<Finding>,
    unlisted: Option<(Reason, usize)>,
}

impl List {
    pub(crate) fn add(
        &mut self,
        field: impl Into<String>,
        reason: Reason,
        value: impl ToString,
        message: impl Into<String>,
    ) {
        if self.findings.len() < FINDINGS_LIMIT {
            self.findings.push(Finding::new(field, reason, value, message));
        } else {
            let (first, count) = self.unlisted.unwrap_or((reason, 0));
            self.unlisted = Some((first, count + 1));
        }
    }

    fn into_findings(mut self) -> Vec<Finding> {
        if let Some((reason, count)) = self.unlisted {
            let message = format!(
                "{count} more findings are not listed; mend the first {FINDINGS_LIMIT} and send it again"
            );
            self.findings.push(Finding::new("sections", reason, count, message));
        }
        self.findings
    }

    fn sections(&mut self, layout: &SectionLayout, budget: &Budget) -> Result<(), Interrupt> {
        if layout.sections.is_empty() {
            let message = "sections is empty; send one section at least";
            self.add("sections", Reason::MissingField, "", message);
        }
        let mut first_use = HashMap::new();
        let mut copies = 0_u64;
        for (number, section) in layout.sections.iter().enumerate() {
            budget.check(0)?;
            let field = format!("sections[{number}]");
            let first = *first_use.entry(section.id.as_str()).or_insert(number);
            self.id(&format!("{field}.id"), &section.id, &format!("sections[{first}].id"), first != number);
            self.section(&field, section, layout.strip_height_mm);
            copies += u64::from(section.quantity);
        }
        if copies > LARGEST_COPIES as u64 {
            let message = format!(
                "sections ask for {copies} copies in all; send at most {LARGEST_COPIES}, for example in several layouts"
            );
            self.add("sections", Reason::TooMany, copies, message);
        }
        Ok(())
    }

    fn id(&mut self, field: &str, id: &str, first_field: &str, used_before: bool) {
        if id.is_empty() {
            self.add(
                field,
                Reason::MissingField,
                "",
                format!("{field} is empty; give each an id of its own"),
            );
        } else if used_before {
            let message = format!("{field} is {id:?}, as is {first_field}; give each an id of its own");
            self.add(field, Reason::DuplicateId, id, message);
        }
    }

    fn section(&mut self, field: &str, section: &Section, strip_height: Option<f64>) {
        if section.quantity == 0 {
            let message = format!("{field}.quantity is 0; send 1 or more, or leave the section out");
            self.add(format!("{field}.quantity"), Reason::OutOfRange, 0, message);
        }
        for (number, pose) in section.poses.iter().enumerate() {
            if section.poses[..number].contains(pose) {
                let name = format!("{field}.allowed_poses[{number}]");
                let message = format!("{name} is there before; name each pose once");
                self.add(name, Reason::DuplicateId, format!("{pose:?}"), message);
            }
        }
        if section.poses.is_empty() {
            let message = format!("{field}.allowed_poses is empty; allow one pose at least");
            self.add(format!("{field}.allowed_poses"), Reason::MissingField, "", message);
        }
        if section.parts.is_empty() {
            let message = format!("{field}.parts is empty; send one part at least, or leave the section out");
            self.add(format!("{field}.parts"), Reason::MissingField, "", message);
            return;
        }
        let mut first_use = HashMap::new();
        for (number, part) in section.parts.iter().enumerate() {
            let name = format!("{field}.parts[{number}]");
            let first = *first_use.entry(part.id.as_str()).or_insert(number);
            let first_field = format!("{field}.parts[{first}].id");
            self.id(&format!("{name}.id"), &part.id, &first_field, first != number);
            self.part(&name, part);
        }
        if !section.parts.iter().all(lies_somewhere) {
            return;
        }
        let bounds = section.bounds();
        let (height, strip) = (bounds.size().y, strip_height.unwrap_or(f64::INFINITY));
        if height > strip + traverse_geometry::CONTACT_TOLERANCE_MM {
            let message = format!(
                "{field} is {height:?} mm high, the strip {strip:?} mm; raise strip_height_mm or send a lower section"
            );
            self.add(field, Reason::OutOfRange, format!("{height:?}"), message);
        }
        let furthest =
            [bounds.min, bounds.max].iter().flat_map(|p| [p.x.abs(), p.y.abs()]).fold(0.0, f64::max);
        if furthest > COORDINATE_LIMIT_MM {
            let message = format!(
                "{field} reaches to {furthest:?} mm; keep its parts within ±{COORDINATE_LIMIT_MM:?} mm"
            );
            self.add(field, Reason::CoordinateTooLarge, format!("{furthest:?}"), message);
        }
    }

    fn part(&mut self, field: &str, part: &Part) {
        for (name, value) in
            [("pole.x_mm", part.pole.x), ("pole.y_mm", part.pole.y), ("rotation_rad", part.rotation_rad)]
        {
            if !value.is_finite() {
                let message = format!("{field}.{name} is {value:?}; send a finite number");
                self.add(format!("{field}.{name}"), Reason::NotFinite, format!("{value:?}"), message);
            }
        }
    }

    fn strip(&mut self, layout: &SectionLayout) {
        let gap = layout.gap_mm;
        if !gap.is_finite() {
            let message = format!("gap_mm is {gap:?}; send a finite number of millimetres, 0 for none");
            self.add("gap_mm", Reason::NotFinite, format!("{gap:?}"), message);
        } else if gap != 0.0 && !(SMALLEST_CLEARANCE_MM..=LARGEST_CLEARANCE_MM).contains(&gap) {
            let message = format!(
                "gap_mm is {gap:?} mm; send 0, or {SMALLEST_CLEARANCE_MM:?} to {LARGEST_CLEARANCE_MM:?} mm"
            );
            self.add("gap_mm", Reason::OutOfRange, format!("{gap:?}"), message);
        }
        let Some(height) = layout.strip_height_mm else { return };
        if !height.is_finite() {
            let message = format!("strip_height_mm is {height:?}; send a finite number, or leave it out");
            self.add("strip_height_mm", Reason::NotFinite, format!("{height:?}"), message);
        } else if height <= 0.0 {
            let message = format!("strip_height_mm is {height:?} mm; send more than 0, or leave it out");
            self.add("strip_height_mm", Reason::OutOfRange, format!("{height:?}"), message);
        }
    }

    pub(crate) fn known(&mut self, field: &str, section: usize, count: usize) -> bool {
        if section >= count {
            let message = format!("{field} names section number {section} of {count}; name one that is sent");
            self.add(field, Reason::OutOfRange, section, message);
        }
        section < count
    }

    fn ends_and_order(&mut self, layout: &SectionLayout) {
        let count = layout.sections.len();
        let mut known = true;
        let ends = [("first_section_id", layout.first), ("last_section_id", layout.last)];
        for (field, section) in ends.into_iter().filter_map(|(field, end)| Some((field, end?))) {
            known &= self.known(field, section, count);
        }
        for (number, &(before, after)) in layout.precedences.iter().enumerate() {
            known &= self.known(&format!("precedences[{number}].before_section_id"), before, count);
            known &= self.known(&format!("precedences[{number}].after_section_id"), after, count);
        }
        for (number, &(left, right)) in layout.forbidden_joins.iter().enumerate() {
            known &= self.known(&format!("forbidden_joins[{number}].left_section_id"), left, count);
            known &= self.known(&format!("forbidden_joins[{number}].right_section_id"), right, count);
        }
        if !known {
            return;
        }
        if let (Some(first), Some(last)) = (layout.first, layout.last)
            && first == last
            && layout.sections[first].quantity == 1
            && count > 1
        {
            let id = &layout.sections[first].id;
            let message = format!("{id:?} is to come first and last; it has one copy only, name another");
            self.add("last_section_id", Reason::PrecedenceContradiction, id, message);
        }
        let id = |section: usize| layout.sections[section].id.as_str();
        for (number, &(before, after)) in layout.precedences.iter().enumerate() {
            let field = format!("precedences[{number}]");
            if layout.first == Some(after) {
                let message = format!(
                    "{field} puts {:?} before {:?}, which is to come first; drop one of both",
                    id(before),
                    id(after)
                );
                self.add(field, Reason::PrecedenceContradiction, id(after), message);
            } else if layout.last == Some(before) {
                let message = format!(
                    "{field} puts {:?} after {:?}, which is to come last; drop one of both",
                    id(after),
                    id(before)
                );
                self.add(field, Reason::PrecedenceContradiction, id(before), message);
            }
        }
        if let Some(section) = on_a_circle(count, &layout.precedences) {
            let message = format!(
                "precedences put {:?} before itself, directly or through others; drop one pair of the circle",
                id(section)
            );
            self.add("precedences", Reason::PrecedenceContradiction, id(section), message);
        }
    }

    fn options(&mut self, layout: &SectionLayout, options: &OrderOptions) {
        if let Some(limit) = options.gap_limit
            && !(0.0..=1.0).contains(&limit)
        {
            let message = format!("options.gap_limit is {limit:?}; send 0 to 1");
            self.add("options.gap_limit", Reason::OutOfRange, format!("{limit:?}"), message);
        }
        if options.algorithm.is_published() {
            if !layout.precedences.is_empty() {
                let message =
                    "precedences: the methods of 2009 keep none; leave algorithm out or the precedences";
                self.add("precedences", Reason::NotApplicable, layout.precedences.len(), message);
            }
            let copies: u64 = layout.sections.iter().map(|section| u64::from(section.quantity)).sum();
            if copies > LARGEST_PUBLISHED_COPIES as u64 && copies <= LARGEST_COPIES as u64 {
                let message = format!(
                    "sections ask for {copies} copies in all; the methods of 2009 take {LARGEST_PUBLISHED_COPIES}: \
                     leave algorithm out"
                );
                self.add("sections", Reason::TooMany, copies, message);
            }
        }
        match &options.initial_order {
            None if options.algorithm == crate::Algorithm::GivenOrder => {
                let message = "initial_order is empty; send the order that is to be evaluated";
                self.add("initial_order", Reason::MissingField, "", message);
            }
            None => {}
            Some(order) => self.initial_order(layout, order),
        }
    }

    fn inner_overlaps(&mut self, number: usize, section: &Section, budget: &Budget) -> Result<(), Interrupt> {
        for (first, second, place) in overlapping_parts(section, budget)? {
            let field = format!("sections[{number}].parts[{second}]");
            let message = format!(
                "{field} ({:?}) overlaps parts[{first}] ({:?}); move one of both, or set allow_overlap_inside",
                section.parts[second].id, section.parts[first].id
            );
            self.add(field, Reason::PartsOverlap, &section.parts[second].id, message);
            if let Some(finding) = self.findings.last_mut().filter(|_| self.unlisted.is_none()) {
                finding.place = Some(place);
            }
        }
        Ok(())
    }
}

fn lies_somewhere(part: &Part) -> bool {
    part.pole.x.is_finite() && part.pole.y.is_finite() && part.rotation_rad.is_finite()
}

/// A section that comes before itself.
fn on_a_circle(count: usize, precedences: &[(usize, usize)]) -> Option<usize> {
    let mut after = vec![vec![]; count];
    let mut waits_for = vec![0; count];
    for &(a, b) in precedences {
        after[a].push(b);
        waits_for[b] += 1;
    }
    let mut ready: Vec<usize> = (0..count).filter(|&at| waits_for[at] == 0).collect();
    while let Some(at) = ready.pop() {
        for &next in &after[at] {
            waits_for[next] -= 1;
            if waits_for[next] == 0 {
                ready.push(next);
            }
        }
    }
    (0..count).find(|&at| waits_for[at] > 0)
}
