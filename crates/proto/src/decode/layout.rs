//! Layouts of sections: gap, strip, ends, precedences, forbidden joins, slide rule; and orders of their copies.

use super::reader::Reader;
use super::section::Ids;
use crate::v1;
use traverse_geometry::{PlacedSection, SectionLayout, SlideRule};

/// What a layout consists of, as it is on the wire.
pub(crate) struct WireLayout {
    pub(crate) sections: Vec<v1::Section>,
    pub(crate) gap_mm: f64,
    pub(crate) strip_height_mm: Option<f64>,
    pub(crate) first_section_id: String,
    pub(crate) last_section_id: String,
    pub(crate) precedences: Vec<v1::Precedence>,
    pub(crate) forbidden_joins: Vec<v1::ForbiddenJoin>,
    pub(crate) slide_rule: i32,
}

impl WireLayout {
    /// Takes the layout out of a request.
    pub(crate) fn take(request: &mut v1::OrderSectionsRequest) -> Self {
        Self {
            sections: std::mem::take(&mut request.sections),
            gap_mm: request.gap_mm,
            strip_height_mm: request.strip_height_mm,
            first_section_id: std::mem::take(&mut request.first_section_id),
            last_section_id: std::mem::take(&mut request.last_section_id),
            precedences: std::mem::take(&mut request.precedences),
            forbidden_joins: std::mem::take(&mut request.forbidden_joins),
            slide_rule: request.slide_rule,
        }
    }
}

impl Reader<'_> {
    /// Whether the layout is small enough to be read. Cheap: nothing is validated yet.
    pub(crate) fn layout_fits(&mut self, parent: &str, request: &v1::OrderSectionsRequest) {
        self.sections_fit(&format!("{parent}sections"), &request.sections);
        let most = self.limits.rule_count();
        self.at_most(&format!("{parent}precedences"), "precedences", request.precedences.len(), most);
        let joins = request.forbidden_joins.len();
        self.at_most(&format!("{parent}forbidden_joins"), "forbidden joins", joins, most);
        let copies = request.initial_order.len();
        self.at_most(&format!("{parent}initial_order"), "sections", copies, self.limits.section_count);
    }

    /// A layout standing at `parent` (empty, or ending in a dot), and the ids of its sections.
    pub(crate) fn layout(&mut self, parent: &str, wire: WireLayout) -> (Option<SectionLayout>, Ids) {
        let gap_mm = self.clearance(&format!("{parent}gap_mm"), wire.gap_mm);
        let strip = self.strip_height(&format!("{parent}strip_height_mm"), wire.strip_height_mm);
        let slide_rule = self.slide_rule(&format!("{parent}slide_rule"), wire.slide_rule);
        let (sections, ids) = self.sections(&format!("{parent}sections"), wire.sections);
        let first = self.end(&format!("{parent}first_section_id"), &wire.first_section_id, &ids);
        let last = self.end(&format!("{parent}last_section_id"), &wire.last_section_id, &ids);
        let mut pairs = |name: &str, ends: [&str; 2], listed: Vec<[String; 2]>| {
            let mut read = Vec::with_capacity(listed.len());
            for (index, [one, other]) in listed.into_iter().enumerate() {
                let field = format!("{parent}{name}[{index}]");
                let one = self.section_named(&format!("{field}.{}", ends[0]), &one, &ids);
                let other = self.section_named(&format!("{field}.{}", ends[1]), &other, &ids);
                read.extend(one.zip(other));
            }
            read
        };
        let precedences = wire.precedences.into_iter().map(|it| [it.before_section_id, it.after_section_id]);
        let precedences =
            pairs("precedences", ["before_section_id", "after_section_id"], precedences.collect());
        let joins = wire.forbidden_joins.into_iter().map(|it| [it.left_section_id, it.right_section_id]);
        let forbidden_joins =
            pairs("forbidden_joins", ["left_section_id", "right_section_id"], joins.collect());
        let layout = || {
            Some(SectionLayout {
                sections: sections?,
                gap_mm: gap_mm?,
                strip_height_mm: strip?,
                first: first?,
                last: last?,
                precedences,
                forbidden_joins,
                slide_rule: slide_rule?,
            })
        };
        (layout(), ids)
    }

    #[expect(clippy::option_option, reason = "the outer one: it was read")]
    fn strip_height(&mut self, field: &str, height: Option<f64>) -> Option<Option<f64>> {
        match height {
            None => Some(None),
            Some(mm) => self.within(field, mm, |mm| mm > 0.0, "more than 0, or leave it out").map(Some),
        }
    }

    #[expect(clippy::option_option, reason = "the outer one: it was read")]
    fn end(&mut self, field: &str, id: &str, ids: &Ids) -> Option<Option<usize>> {
        if id.is_empty() { Some(None) } else { self.section_named(field, id, ids).map(Some) }
    }

    fn slide_rule(&mut self, field: &str, rule: i32) -> Option<SlideRule> {
        match v1::SlideRule::try_from(rule) {
            Ok(v1::SlideRule::Unspecified | v1::SlideRule::KeepOrder) => Some(SlideRule::KeepOrder),
            Ok(v1::SlideRule::Free) => Some(SlideRule::Free),
            Err(_) => {
                self.unknown_enum_value(field, rule, &["SLIDE_RULE_KEEP_ORDER (1)", "SLIDE_RULE_FREE (2)"]);
                None
            }
        }
    }

    /// An order of copies, left to right.
    pub(crate) fn order(
        &mut self,
        field: &str,
        order: &[v1::PlacedSection],
        ids: &Ids,
    ) -> Option<Vec<PlacedSection>> {
        let mut read = Vec::with_capacity(order.len());
        for (index, placed) in order.iter().enumerate() {
            let field = format!("{field}[{index}]");
            let section = self.section_named(&format!("{field}.section_id"), &placed.section_id, ids);
            let pose = self.pose(&format!("{field}.pose"), placed.pose);
            let x_mm = self.coordinate_of_layout(&format!("{field}.x_mm"), placed.x_mm);
            let copy = u32::try_from(placed.copy).ok();
            if copy.is_none() {
                self.out_of_range(&format!("{field}.copy"), placed.copy, "0 or more");
            }
            if let (Some(section), Some(pose), Some(x_mm), Some(copy)) = (section, pose, x_mm, copy) {
                read.push(PlacedSection { section, copy, pose, x_mm });
            }
        }
        (read.len() == order.len()).then_some(read)
    }

    /// Layouts may be longer than drawings.
    fn coordinate_of_layout(&mut self, field: &str, x_mm: f64) -> Option<f64> {
        const MOST_MM: f64 = 1e9;
        self.within(field, x_mm, |x| x.abs() <= MOST_MM, &format!("within ±{MOST_MM} mm"))
    }
}
