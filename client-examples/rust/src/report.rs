//! What came of a call, as text.

use crate::traverse::plan_rapid_move_response::Outcome;
use crate::traverse::plan_rapid_moves_response::Outcome as StepOutcome;
use crate::traverse::{NoPath, PathStep, PlanRapidMoveResponse, PlanRapidMovesResponse, RapidPlan};
use std::io::{self, Write};
use tonic::Status;
use tonic_types::StatusExt;

/// Prints the way step by step, or what is in the way.
///
/// # Errors
/// It can't be written.
pub fn print_answer(answer: &PlanRapidMoveResponse, to: &mut impl Write) -> io::Result<()> {
    match &answer.outcome {
        Some(Outcome::Plan(plan)) => print_plan(plan, to),
        Some(Outcome::NoPath(no_path)) => print_no_path(no_path, to),
        None => writeln!(to, "the request is sound"),
    }
}

/// Prints what came of a session's step.
///
/// # Errors
/// It can't be written.
pub fn print_step(answer: &PlanRapidMovesResponse, to: &mut impl Write) -> io::Result<()> {
    write!(to, "{}: ", answer.step_id)?;
    match &answer.outcome {
        Some(StepOutcome::Plan(plan)) => print_plan(plan, to),
        Some(StepOutcome::NoPath(no_path)) => print_no_path(no_path, to),
        Some(StepOutcome::SceneChanged(changed)) => {
            writeln!(to, "the scene holds {} obstacles now", changed.obstacle_count)
        }
        // Of this step alone; the session goes on.
        Some(StepOutcome::Problem(problem)) => {
            writeln!(to, "refused: {}: {}", problem.reason, problem.message)?;
            problem.findings.iter().try_for_each(|finding| {
                writeln!(to, "  {}: {} ({})", finding.field, finding.message, finding.reason)
            })
        }
        None => writeln!(to, "answered with what this client does not know: generate it anew"),
    }
}

fn print_plan(plan: &RapidPlan, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "{:.3} mm, proven not to be shorter than {:.3} mm", plan.cost, plan.lower_bound)?;
    writeln!(to, "round {}", plan.bending_obstacle_ids.join(", "))?;
    let steps = plan.path.as_ref().map_or(&[][..], |path| &path.steps);
    steps.iter().try_for_each(|step| print_move(step, to))
}

/// An answer, not an error: no tool can get there.
fn print_no_path(no_path: &NoPath, to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "there is no way: {} part start from target", no_path.separating_obstacle_ids.join(", "))
}

fn print_move(step: &PathStep, to: &mut impl Write) -> io::Result<()> {
    let end = step.end.unwrap_or_default();
    match &step.arc {
        None => writeln!(to, "  G0 X{:.4} Y{:.4}", end.x_mm, end.y_mm),
        Some(arc) => {
            let center = arc.center.unwrap_or_default();
            let code = if arc.clockwise { "G2" } else { "G3" };
            writeln!(
                to,
                "  {code} X{:.4} Y{:.4} about ({:.4}, {:.4})",
                end.x_mm, end.y_mm, center.x_mm, center.y_mm
            )
        }
    }
}

/// Prints why a call was refused: a reason for programs, and every finding with its field. docs/errors.md explains each reason.
///
/// # Errors
/// It can't be written.
pub fn print_refusal(status: &Status, to: &mut impl Write) -> io::Result<()> {
    let reason = status.get_details_error_info().map(|info| info.reason).unwrap_or_default();
    writeln!(to, "refused: {:?} {reason}: {}", status.code(), status.message())?;
    let findings =
        status.get_details_bad_request().map(|request| request.field_violations).unwrap_or_default();
    for finding in findings {
        writeln!(to, "  {}: {} ({})", finding.field, finding.description, finding.reason)?;
    }
    Ok(())
}
