//! OrderSections' question.

use super::effort::duration;
use super::layout::WireLayout;
use super::reader::Reader;
use crate::{Limits, Refused, v1};
use std::time::Duration;
use traverse_geometry::{Finding, Reason, SectionLayout};
use traverse_layout_sequencing::{Algorithm, ContactList, EffectModel, InnerOverlap, OrderOptions};
use traverse_solve::{Budget, Seed};

/// What OrderSections asks. Every value is sound by itself; what they are to one another the engine looks at.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderQuestion {
    /// What is to be laid out.
    pub layout: SectionLayout,
    /// How.
    pub options: OrderOptions,
    /// Stop after this many steps. Absent: no limit.
    pub iteration_limit: Option<u64>,
    /// What to answer beside the order.
    pub returns: OrderReturns,
    /// Only say what is wrong.
    pub validate_only: bool,
}

/// What to answer beside the order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OrderReturns {
    /// The matrix of effects.
    pub joins: bool,
    /// What stopped each section.
    pub contacts: bool,
    /// Where each part lies.
    pub parts: bool,
    /// What certifies the bound.
    pub certificate: bool,
}

/// The time limit that a request names, if it names a sound one. Read before the request is validated: waiting for a core
/// counts.
#[must_use]
pub fn requested_order_time_limit(request: &v1::OrderSectionsRequest) -> Option<Duration> {
    duration(request.options.as_ref()?.time_limit.as_ref()?)
}

impl OrderQuestion {
    /// Reads and validates a request. `budget` is asked between its parts.
    ///
    /// # Errors
    /// Every finding at once; or that the budget ended.
    pub fn from_wire(
        request: v1::OrderSectionsRequest,
        limits: &Limits,
        budget: &Budget,
    ) -> Result<Self, Refused> {
        let mut reader = Reader::new(limits, budget);
        reader.layout_fits("", &request);
        reader.so_far()?;
        let question = reader.order_question(request);
        reader.finish(question)
    }
}

impl Reader<'_> {
    fn order_question(&mut self, mut request: v1::OrderSectionsRequest) -> Option<OrderQuestion> {
        let (layout, ids) = self.layout("", WireLayout::take(&mut request));
        let algorithm = self.section_algorithm(request.algorithm);
        let effect_model = self.effect_model(request.effect_model);
        let wire = request.options.unwrap_or_default();
        let iteration_limit = self.iteration_limit("options", &wire);
        let gap_limit =
            self.within("options.gap_limit", wire.gap_limit, |gap| (0.0..=1.0).contains(&gap), "0 to 1");
        let seed = self.not_negative("options.seed", wire.seed);
        let threads = self.not_negative("options.thread_count", i64::from(wire.thread_count));
        let initial_order = match request.initial_order.as_slice() {
            [] => Some(None),
            order => self.order("initial_order", order, &ids).map(Some),
        };
        let returns = OrderReturns {
            joins: request.return_joins,
            contacts: request.return_contacts,
            parts: request.return_parts,
            certificate: wire.return_certificate,
        };
        if let Some(layout) = &layout {
            self.returns_fit(layout, returns);
        }
        let options = OrderOptions {
            algorithm: algorithm?,
            effect_model: effect_model?,
            initial_order: initial_order?,
            inner_overlap: inner_overlap(request.allow_overlap_inside),
            contacts: if returns.contacts { ContactList::Listed } else { ContactList::Omitted },
            seed: Seed(seed?),
            threads: usize::try_from(threads?).unwrap_or(usize::MAX),
            gap_limit: gap_limit.filter(|&gap| gap > 0.0),
        };
        let validate_only = request.validate_only;
        Some(OrderQuestion { layout: layout?, options, iteration_limit, returns, validate_only })
    }

    /// Whether what is to be returned fits into an answer.
    fn returns_fit(&mut self, layout: &SectionLayout, returns: OrderReturns) {
        let sections = &layout.sections;
        if returns.joins {
            let items: usize = sections.iter().map(|section| section.poses.len()).sum();
            let entries = items.saturating_mul(items);
            self.returns_at_most("return_joins", "entries of the matrix", entries, self.limits.join_count);
        }
        if returns.parts {
            let parts = |quantity: u32, parts: usize| parts.saturating_mul(quantity as usize);
            let placed = sections.iter().map(|section| parts(section.quantity, section.parts.len()));
            let placed = placed.fold(0, usize::saturating_add);
            self.returns_at_most("return_parts", "parts of all copies", placed, self.limits.part_count);
        }
    }

    fn returns_at_most(&mut self, field: &str, what: &str, count: usize, limit: usize) {
        if count > limit {
            let message = format!("{count} {what} asked for, at most {limit} can be returned; leave it out");
            self.report(Finding::new(field, Reason::TooMany, count, message));
        }
    }

    fn not_negative(&mut self, field: &str, value: i64) -> Option<u64> {
        let read = u64::try_from(value).ok();
        if read.is_none() {
            self.out_of_range(field, value, "0 or more");
        }
        read
    }

    fn section_algorithm(&mut self, algorithm: i32) -> Option<Algorithm> {
        match v1::SectionAlgorithm::try_from(algorithm) {
            Ok(v1::SectionAlgorithm::Unspecified) => Some(Algorithm::Best),
            Ok(v1::SectionAlgorithm::GivenOrder) => Some(Algorithm::GivenOrder),
            Ok(v1::SectionAlgorithm::BranchAndBound) => Some(Algorithm::BranchAndBound),
            Ok(v1::SectionAlgorithm::AntColony) => Some(Algorithm::AntColony),
            Ok(v1::SectionAlgorithm::LocalImprovement) => Some(Algorithm::LocalImprovement),
            Err(_) => {
                let known = [
                    "SECTION_ALGORITHM_GIVEN_ORDER (1)",
                    "SECTION_ALGORITHM_BRANCH_AND_BOUND (2)",
                    "SECTION_ALGORITHM_ANT_COLONY (3)",
                    "SECTION_ALGORITHM_LOCAL_IMPROVEMENT (4)",
                ];
                self.unknown_enum_value("algorithm", algorithm, &known);
                None
            }
        }
    }

    fn effect_model(&mut self, model: i32) -> Option<EffectModel> {
        match v1::EffectModel::try_from(model) {
            Ok(v1::EffectModel::Unspecified | v1::EffectModel::Exact) => Some(EffectModel::Exact),
            Ok(v1::EffectModel::Published) => Some(EffectModel::Published),
            Err(_) => {
                let known = ["EFFECT_MODEL_EXACT (1)", "EFFECT_MODEL_PUBLISHED (2)"];
                self.unknown_enum_value("effect_model", model, &known);
                None
            }
        }
    }
}

/// Whether parts may overlap inside their section.
pub(crate) fn inner_overlap(allowed: bool) -> InnerOverlap {
    if allowed { InnerOverlap::Allowed } else { InnerOverlap::Refused }
}
