//! OrderSections' answer.

use super::layout::{placed_parts, placed_section, pose};
use super::path::point;
use crate::{OrderQuestion, v1};
use std::time::Duration;
use traverse_geometry::SectionLayout;
use traverse_layout_sequencing::{BoundCertificate, Contact, Ending, JoinMatrix, LayoutAnswer, LayoutPlan};
use traverse_solve::Interrupt;

/// What is known of a search beside its answer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SearchFacts {
    /// What the engine took.
    pub duration: Duration,
    /// Which time limit counted: the one of the request's options, otherwise the call's deadline or the server's.
    pub time_limit: CountedLimit,
    /// Better plans and bounds, in order.
    pub improvements: Vec<Improvement>,
}

/// Which time limit counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CountedLimit {
    /// That of the request's options.
    Requested,
    /// The call's deadline, or the server's limit.
    #[default]
    Deadline,
}

/// A better plan or bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Improvement {
    /// Since the engine began.
    pub after: Duration,
    /// The best cost then.
    pub cost: Option<f64>,
    /// The best bound then.
    pub lower_bound: Option<f64>,
}

/// The engine's answer as its message. `joins` are answered when they are given.
#[must_use]
pub fn order_answer(
    question: &OrderQuestion,
    answer: &LayoutAnswer,
    joins: Option<&JoinMatrix>,
    facts: &SearchFacts,
) -> v1::OrderSectionsResponse {
    let plan = answer.plan.as_ref();
    let lengths = |of: fn(&LayoutPlan) -> f64| plan.map_or(0.0, of);
    v1::OrderSectionsResponse {
        order: plan.map(|plan| order(question, plan)).unwrap_or_default(),
        length_mm: lengths(|plan| plan.length_mm),
        bounding_box_length_mm: lengths(|plan| plan.bounding_box_length_mm),
        published_length_mm: lengths(|plan| plan.published_length_mm),
        report: Some(report(question, answer, facts)),
        joins: joins.map(|joins| join_matrix(joins, &question.layout)),
        contacts: plan
            .filter(|_| question.returns.contacts)
            .map(|plan| plan.contacts.iter().map(contact).collect())
            .unwrap_or_default(),
        no_order: answer.ending == Ending::ProvenInfeasible,
    }
}

/// The answer to a sound request that was only to be validated.
#[must_use]
pub fn sound_order_answer() -> v1::OrderSectionsResponse {
    v1::OrderSectionsResponse::default()
}

fn order(question: &OrderQuestion, plan: &LayoutPlan) -> Vec<v1::PlacedSection> {
    let layout = &question.layout;
    (plan.order.iter())
        .map(|placed| {
            let mut wire = placed_section(placed, layout);
            if let (true, Some(section)) = (question.returns.parts, layout.sections.get(placed.section)) {
                wire.parts = placed_parts(placed, section);
            }
            wire
        })
        .collect()
}

fn report(question: &OrderQuestion, answer: &LayoutAnswer, facts: &SearchFacts) -> v1::SolveReport {
    let cost = answer.plan.as_ref().map(|plan| plan.length_mm);
    let gap_ratio = match cost {
        Some(cost) if cost > 0.0 => ((cost - answer.lower_bound_mm) / cost).clamp(0.0, 1.0),
        // No plan, and not proven that there is none: nothing is known.
        None if !answer.is_proven() => 1.0,
        _ => 0.0,
    };
    let certificate =
        (question.returns.certificate).then(|| certificate(&answer.certificate, &question.layout));
    let has_certificate = answer.certificate != BoundCertificate::None;
    v1::SolveReport {
        cost: cost.unwrap_or(0.0),
        cost_unit: v1::CostUnit::Mm.into(),
        lower_bound: Some(answer.lower_bound_mm),
        gap_ratio,
        proven_optimal: answer.is_proven(),
        certified_lower_bound: has_certificate.then_some(answer.certified_lower_bound_mm),
        certificate: certificate.flatten(),
        stop_reason: stop_reason(answer.ending, facts.time_limit).into(),
        algorithm: answer.algorithm.to_owned(),
        solve_duration: facts.duration.try_into().ok(),
        iteration_count: i64::try_from(answer.iterations).unwrap_or(i64::MAX),
        improvements: facts.improvements.iter().map(improvement).collect(),
    }
}

fn stop_reason(ending: Ending, limit: CountedLimit) -> v1::StopReason {
    match ending {
        Ending::ProvenOptimal | Ending::ProvenInfeasible => v1::StopReason::ProvenOptimal,
        Ending::GapReached => v1::StopReason::GapLimit,
        Ending::Exhausted => v1::StopReason::Converged,
        Ending::Interrupted(Interrupt::Iterations) => v1::StopReason::IterationLimit,
        Ending::Interrupted(Interrupt::Memory) => v1::StopReason::MemoryLimit,
        Ending::Interrupted(Interrupt::Deadline | Interrupt::Cancelled) => match limit {
            CountedLimit::Requested => v1::StopReason::TimeLimit,
            CountedLimit::Deadline => v1::StopReason::Deadline,
        },
    }
}

fn certificate(certificate: &BoundCertificate, layout: &SectionLayout) -> Option<v1::Certificate> {
    let empty = v1::Certificate::default();
    match certificate {
        BoundCertificate::None => None,
        BoundCertificate::Joins(duals) => Some(v1::Certificate {
            row_duals: duals.row_mm.clone(),
            column_duals: duals.column_mm.clone(),
            sets: (duals.sets.iter())
                .map(|(nodes, weight)| v1::DualSet {
                    nodes: nodes.iter().map(|&node| i32::try_from(node).unwrap_or(i32::MAX)).collect(),
                    weight: *weight,
                })
                .collect(),
            ..empty
        }),
        BoundCertificate::Height { y_mm } => Some(v1::Certificate { height_mm: Some(*y_mm), ..empty }),
        BoundCertificate::Width { section } => {
            let section_id = layout.sections.get(*section)?.id.clone();
            Some(v1::Certificate { section_id, ..empty })
        }
    }
}

fn improvement(improvement: &Improvement) -> v1::Improvement {
    v1::Improvement {
        seconds: improvement.after.as_secs_f64(),
        cost: improvement.cost,
        lower_bound: improvement.lower_bound,
    }
}

fn join_matrix(joins: &JoinMatrix, layout: &SectionLayout) -> v1::JoinMatrix {
    let items = joins.items.iter().map(|item| v1::JoinItem {
        section_id: layout.sections.get(item.section).map(|section| section.id.clone()).unwrap_or_default(),
        pose: pose(item.pose).into(),
    });
    v1::JoinMatrix { items: items.collect(), effect_mm: joins.effects_mm.clone() }
}

fn contact(contact: &Contact) -> v1::JoinContact {
    let place = |index: usize| i32::try_from(index).unwrap_or(i32::MAX);
    v1::JoinContact {
        index: place(contact.index),
        against_index: place(contact.against),
        point: Some(point(contact.point)),
        against_point: Some(point(contact.against_point)),
    }
}
