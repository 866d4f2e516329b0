//! `traverse check`.

use crate::arguments::Check;
use crate::failure::Failure;
use crate::{input, planning};
use traverse_proto::v1;

pub(crate) async fn run(arguments: Check) -> Result<(), Failure> {
    let wrong = |path: &std::path::Path| {
        let path = path.display().to_string();
        move |why: String| Failure::Input(format!("{path}: {why}"))
    };
    let request: v1::PlanRapidMoveRequest =
        planning::request("PlanRapidMove", &input::read(&arguments.request)?)
            .map_err(wrong(&arguments.request))?;
    let response: v1::PlanRapidMoveResponse =
        planning::answer("PlanRapidMove", &input::read(&arguments.plan)?).map_err(wrong(&arguments.plan))?;
    let Some(v1::plan_rapid_move_response::Outcome::Plan(plan)) = response.outcome else {
        return Err(Failure::Input(format!("{} holds no plan to check", arguments.plan.display())));
    };
    let question = v1::CheckRapidMoveRequest {
        request: Some(request),
        path: plan.path,
        tolerance_mm: arguments.tolerance,
    };
    let found = planning::check(&planning::caller(arguments.server.as_deref())?, &question).await?;
    let unit = if found.cost_unit() == v1::CostUnit::Seconds { "s" } else { "mm" };
    say!("cost, recomputed    {:.6} {unit} (the plan says {:.6})", found.cost, plan.cost);
    if let Some(margin) = found.smallest_margin_mm {
        say!("smallest margin     {margin:.9} mm");
    }
    for violation in &found.violations {
        say!("{} {}: {}", violation.reason, violation.field, violation.message);
    }
    if found.violations.is_empty() {
        say!("sound");
        return Ok(());
    }
    Err(Failure::Violations(format!("{} violations", found.violations.len())))
}
