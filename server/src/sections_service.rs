//! OrderSections and CheckSections: what a worker does with them.

use crate::call::Call;
use crate::config::Config;
use crate::engines::Engines;
use crate::improvements::Improvements;
use std::time::{Duration, Instant};
use traverse_geometry::{Finding, SectionLayout};
use traverse_layout_sequencing::{LayoutAnswer, layout_findings};
use traverse_proto::v1::{
    CheckSectionsRequest, CheckSectionsResponse, OrderSectionsRequest, OrderSectionsResponse,
};
use traverse_proto::{
    CheckSectionsQuestion, CountedLimit, OrderQuestion, Refused, SearchFacts, check_sections_answer,
    order_answer, sound_order_answer,
};
use traverse_solve::{Budget, Interrupt};

/// Kept of the time limit, so that the best layout found until then is an answer and no error: the engine may take this long to
/// stop. Of short limits a quarter is kept.
const STOP_RESERVE: Duration = Duration::from_millis(60);
/// The same for each vertex of all copies: contacts, published length and the answer's bytes are worked out after the search.
const RESERVE_PER_VERTEX: Duration = Duration::from_micros(4);

/// OrderSections.
pub(crate) fn order(
    config: &Config,
    engines: &dyn Engines,
    call: &Call,
    limit: CountedLimit,
    request: OrderSectionsRequest,
    budget: &Budget,
) -> Result<(OrderSectionsResponse, &'static str), Refused> {
    let mut question = OrderQuestion::from_wire(request, &config.limits, budget)?;
    note_size(call, &question.layout);
    let reserve = stop_reserve(&question.layout, config.limits.vertex_count);
    if question.validate_only {
        let findings = layout_findings(&question.layout, &question.options, budget);
        return match findings {
            Ok(findings) if findings.is_empty() => Ok((sound_order_answer(), "valid")),
            Ok(findings) => Err(Refused::findings_of(findings)),
            Err(interrupt) => Err(Refused::interrupted(interrupt, None)),
        };
    }
    question.options.threads = question.options.threads.clamp(1, config.workers.max(1));
    let begun = Instant::now();
    let joins = match question.returns.joins {
        true => {
            Some(engines.section_joins(&question, budget).map_err(|why| Refused::interrupted(why, None))?)
        }
        false => None,
    };
    let searched = Budget {
        deadline: budget.deadline.map(|deadline| less_reserve(deadline, begun, reserve)),
        iterations: question.iteration_limit,
        ..budget.clone()
    };
    let mut improvements = Improvements::since(begun);
    let answer = engines.order_sections(&question, &searched, &mut improvements);
    let answer = answer.map_err(|findings| refused(findings, &searched))?;
    if let Some(refused) = without_plan(&answer) {
        return Err(refused);
    }
    let outcome = if answer.plan.is_some() { "plan" } else { "no_order" };
    let facts =
        SearchFacts { duration: begun.elapsed(), time_limit: limit, improvements: improvements.thinned() };
    Ok((order_answer(&question, &answer, joins.as_ref(), &facts), outcome))
}

/// CheckSections.
pub(crate) fn check(
    config: &Config,
    engines: &dyn Engines,
    call: &Call,
    request: CheckSectionsRequest,
    budget: &Budget,
) -> Result<(CheckSectionsResponse, &'static str), Refused> {
    let question = CheckSectionsQuestion::from_wire(request, &config.limits, budget)?;
    note_size(call, &question.layout);
    let found = engines
        .check_sections(&question, budget)
        .ok_or_else(|| Refused::interrupted(budget.check(0).err().unwrap_or(Interrupt::Deadline), None))?;
    let outcome = if found.violations.is_empty() { "sound" } else { "violations" };
    Ok((check_sections_answer(&found), outcome))
}

/// Findings, or, where there are none, that the budget ended while they were looked for.
fn refused(findings: Vec<Finding>, budget: &Budget) -> Refused {
    if findings.is_empty() {
        return Refused::interrupted(budget.check(0).err().unwrap_or(Interrupt::Deadline), None);
    }
    Refused::findings_of(findings)
}

/// An answer without a plan, unless it is an answer all the same: proven that there is none.
fn without_plan(answer: &LayoutAnswer) -> Option<Refused> {
    use traverse_layout_sequencing::Ending;
    match (&answer.plan, answer.ending) {
        (None, Ending::Interrupted(interrupt)) => {
            Some(Refused::interrupted(interrupt, Some(answer.lower_bound_mm)))
        }
        _ => None,
    }
}

/// When the engine has to stop, so that its answer is there at `deadline`.
fn less_reserve(deadline: Instant, now: Instant, reserve: Duration) -> Instant {
    let left = deadline.saturating_duration_since(now);
    now + left.saturating_sub(reserve.min(left / 4))
}

/// How long the engine may take to say what it found.
fn stop_reserve(layout: &SectionLayout, most_vertices: usize) -> Duration {
    let vertices = |section: &traverse_geometry::Section| {
        let own: usize = section.parts.iter().map(|part| part.shape.vertex_count()).sum();
        own.saturating_mul(section.quantity as usize)
    };
    let all = layout.sections.iter().map(vertices).fold(0, usize::saturating_add).min(most_vertices);
    STOP_RESERVE + RESERVE_PER_VERTEX * u32::try_from(all).unwrap_or(u32::MAX)
}

fn note_size(call: &Call, layout: &SectionLayout) {
    let parts = layout.sections.iter().flat_map(|section| &section.parts);
    let vertices = parts.map(|part| part.shape.vertex_count()).sum();
    call.note(|facts| facts.vertices = vertices);
}
