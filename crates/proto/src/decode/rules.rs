//! Rules of rapid moves.

use super::cost::cost;
use super::reader::Reader;
use crate::v1;
use traverse_geometry::{EndRule, HeightRule, RapidRules, Vector};

impl Reader<'_> {
    /// Rules for costs, heights, clearances and ends; what is wrong with them is reported.
    pub(crate) fn rules(&mut self, field: &str, rules: v1::RapidRules) -> RapidRules {
        let rules = RapidRules {
            cost: cost(rules.cost),
            motion: self.motion(&format!("{field}.motion"), rules.motion),
            arcs: self.arcs(&format!("{field}.arcs"), rules.arcs),
            heights: rules.heights.map(|rule| HeightRule {
                start_z_mm: rule.start_z_mm + 0.0,
                target_z_mm: rule.target_z_mm + 0.0,
                highest_z_mm: rule.highest_z_mm + 0.0,
                clearance_z_mm: rule.clearance_z_mm + 0.0,
            }),
            clearances_mm: rules.clearances_mm.into_iter().map(|mm| mm + 0.0).collect(),
            leave: end_rule(rules.leave),
            enter: end_rule(rules.enter),
        };
        self.report_under(field, rules.findings());
        rules
    }
}

fn end_rule(rule: Option<v1::EndRule>) -> EndRule {
    match rule.and_then(|rule| rule.rule) {
        None | Some(v1::end_rule::Rule::Refuse(_)) => EndRule::Refuse,
        Some(v1::end_rule::Rule::Nearest(_)) => EndRule::Nearest,
        Some(v1::end_rule::Rule::Direction(v1::Point { x_mm, y_mm })) => {
            EndRule::Direction(Vector::new(x_mm, y_mm))
        }
    }
}
