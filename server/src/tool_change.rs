//! PlaceToolChange's work.

use crate::call::Call;
use crate::config::Config;
use crate::engines::Engines;
use crate::planner_service::size_of;
use std::time::Instant;
use traverse_planner::ToolChangeAnswer;
use traverse_proto::v1::{PlaceToolChangeRequest, PlaceToolChangeResponse};
use traverse_proto::{Refused, ToolChangeQuestion, tool_change_answer};
use traverse_solve::Budget;

/// Reads, validates and answers one request.
pub(crate) fn place(
    config: &Config,
    engines: &dyn Engines,
    call: &Call,
    request: PlaceToolChangeRequest,
    budget: &Budget,
) -> Result<(PlaceToolChangeResponse, &'static str), Refused> {
    let question = ToolChangeQuestion::from_wire(request, &config.limits, budget)?;
    call.note(|facts| size_of(facts, &question.scene));
    let sound = || (PlaceToolChangeResponse { outcome: None, stats: None }, "valid");
    // One expanded node is enough to learn whether the ends are free, and not enough to search.
    let iterations = if question.validate_only { Some(1) } else { question.iteration_limit };
    let budget = Budget { iterations, ..budget.clone() };
    let prepare = call.arrival.elapsed();
    let search_began = Instant::now();
    let placed = engines.place_tool_change(&question.scene, &question.change, &budget);
    let search = search_began.elapsed();
    match placed {
        Ok(_) if question.validate_only => Ok(sound()),
        Ok((answer, stats)) => {
            let outcome = match &answer {
                ToolChangeAnswer::Plan(_) => "plan",
                ToolChangeAnswer::NoPath(_) => "no_path",
            };
            Ok((tool_change_answer(&answer, stats, prepare, search), outcome))
        }
        Err(refusals) => match Refused::by_planner(refusals) {
            Some(Refused::IterationLimitReached { .. }) if question.validate_only => Ok(sound()),
            Some(refused) => Err(refused),
            None => Err(crate::fault::of("the planner refused without a reason")),
        },
    }
}
