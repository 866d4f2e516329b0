//! What is wrong with an order that was sent: copies that are missing or there twice, poses that are not allowed, rules
//! of the same question that it breaks.

use crate::findings::List;
use std::collections::HashMap;
use traverse_geometry::{PlacedSection, Reason, SectionLayout};

impl List {
    /// Every copy once, in allowed poses, as ends, precedences and forbidden joins ask.
    pub(crate) fn initial_order(&mut self, layout: &SectionLayout, order: &[PlacedSection]) {
        let mut first_use = HashMap::new();
        let mut sound = true;
        for (number, placed) in order.iter().enumerate() {
            let field = format!("initial_order[{number}]");
            if !self.known(&format!("{field}.section_id"), placed.section, layout.sections.len()) {
                sound = false;
                continue;
            }
            let section = &layout.sections[placed.section];
            let first = *first_use.entry((placed.section, placed.copy)).or_insert(number);
            if placed.copy >= section.quantity {
                let message = format!(
                    "{field}.copy is {}; {:?} has copies 0 to {}",
                    placed.copy,
                    section.id,
                    section.quantity.saturating_sub(1)
                );
                self.add(format!("{field}.copy"), Reason::OutOfRange, placed.copy, message);
                sound = false;
            } else if first != number {
                let message = format!(
                    "{field} is copy {} of {:?}, as is initial_order[{first}]",
                    placed.copy, section.id
                );
                self.add(field.clone(), Reason::DuplicateId, &section.id, message);
                sound = false;
            }
            if !section.poses.contains(&placed.pose) {
                let message = format!("{field}.pose is none of the allowed poses of {:?}", section.id);
                self.add(format!("{field}.pose"), Reason::OutOfRange, format!("{:?}", placed.pose), message);
            }
        }
        let copies: u64 = layout.sections.iter().map(|section| u64::from(section.quantity)).sum();
        if sound && order.len() as u64 != copies {
            let message =
                format!("initial_order has {} sections of {copies}; name every copy once", order.len());
            self.add("initial_order", Reason::MissingField, order.len(), message);
        } else if sound {
            self.order_against_rules(layout, order);
        }
    }

    fn order_against_rules(&mut self, layout: &SectionLayout, order: &[PlacedSection]) {
        let mut against = |field: &str, what: &str| {
            let message = format!("initial_order is not what {field} asks for: {what}; mend one of both");
            self.add("initial_order", Reason::PrecedenceContradiction, "", message);
        };
        let id = |section: usize| layout.sections[section].id.as_str();
        let (first, last) = (order.first().map(|p| p.section), order.last().map(|p| p.section));
        if let (Some(asked), Some(first)) = (layout.first, first)
            && asked != first
        {
            against("first_section_id", &format!("{:?} comes first", id(first)));
        }
        if let (Some(asked), Some(last)) = (layout.last, last)
            && asked != last
        {
            against("last_section_id", &format!("{:?} comes last", id(last)));
        }
        let mut range = vec![(usize::MAX, 0); layout.sections.len()];
        for (at, placed) in order.iter().enumerate() {
            let (begin, end) = &mut range[placed.section];
            (*begin, *end) = ((*begin).min(at), at);
        }
        for (number, &(before, after)) in layout.precedences.iter().enumerate() {
            if before < range.len() && after < range.len() && range[before].1 >= range[after].0 {
                let what = format!("a copy of {:?} comes before one of {:?}", id(after), id(before));
                against(&format!("precedences[{number}]"), &what);
            }
        }
        for pair in order.windows(2) {
            let join = (pair[0].section, pair[1].section);
            if let Some(number) = layout.forbidden_joins.iter().position(|&forbidden| forbidden == join) {
                let what = format!("{:?} stands beside {:?}", id(join.0), id(join.1));
                against(&format!("forbidden_joins[{number}]"), &what);
            }
        }
    }
}
