//! `traverse check`: a rapid move or a layout of sections; the request says which.

use crate::arguments::Check;
use crate::failure::Failure;
use crate::{input, planning};
use traverse_proto::{check_sections_request, v1};

pub(crate) async fn run(arguments: Check) -> Result<(), Failure> {
    let bytes = input::read(&arguments.request)?;
    match planning::request::<v1::PlanRapidMoveRequest>("PlanRapidMove", &bytes) {
        Ok(request) => rapid(&arguments, request).await,
        Err(why) => match planning::request::<v1::OrderSectionsRequest>("OrderSections", &bytes) {
            Ok(request) => sections(&arguments, request).await,
            // What speaks of sections was meant as such.
            Err(of_sections) => {
                let is_layout = String::from_utf8_lossy(&bytes).contains("\"sections\"");
                Err(wrong(&arguments.request)(if is_layout { of_sections } else { why }))
            }
        },
    }
}

fn wrong(path: &std::path::Path) -> impl Fn(String) -> Failure + use<> {
    let path = path.display().to_string();
    move |why| Failure::Input(format!("{path}: {why}"))
}

async fn sections(arguments: &Check, request: v1::OrderSectionsRequest) -> Result<(), Failure> {
    let answer: v1::OrderSectionsResponse =
        planning::answer("OrderSections", &input::read(&arguments.plan)?).map_err(wrong(&arguments.plan))?;
    if answer.order.is_empty() {
        return Err(Failure::Input(format!("{} holds no layout to check", arguments.plan.display())));
    }
    let question = v1::CheckSectionsRequest {
        tolerance_mm: arguments.tolerance,
        ..check_sections_request(request, &answer)
    };
    let caller = planning::caller(arguments.server.as_deref())?;
    let found = planning::check_sections(&caller, &question).await?;
    say!("length, recomputed  {:.6} mm (the layout says {:.6})", found.length_mm, answer.length_mm);
    if let (Some(proven), Some(claimed)) = (found.certified_lower_bound_mm, question.claimed_lower_bound_mm) {
        say!("certified bound     {proven:.6} mm, recomputed (the layout says {claimed:.6})");
    }
    verdict(found.smallest_margin_mm, &found.violations)
}

fn verdict(smallest_margin_mm: Option<f64>, violations: &[v1::Violation]) -> Result<(), Failure> {
    if let Some(margin) = smallest_margin_mm {
        say!("smallest margin     {margin:.9} mm");
    }
    for violation in violations {
        say!("{} {}: {}", violation.reason, violation.field, violation.message);
    }
    if violations.is_empty() {
        say!("sound");
        return Ok(());
    }
    Err(Failure::Violations(format!("{} violations", violations.len())))
}

async fn rapid(arguments: &Check, request: v1::PlanRapidMoveRequest) -> Result<(), Failure> {
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
    verdict(found.smallest_margin_mm, &found.violations)
}
