//! `traverse order`: orders, writes, says, and has its own answer checked.

use crate::failure::Failure;
use crate::live_line::{WatchedEngines, has_terminal};
use crate::order_arguments::{Effects, Order, OrderMethod};
use crate::picture_file::write_picture;
use crate::rapid::{Output, kind_of};
use crate::serve::start_failure;
use crate::{input, order_table, planning, section_files};
use std::path::Path;
use std::time::Duration;
use traverse_drawing::{ShownLayout, picture_of_layout, write_layout_dxf};
use traverse_geometry::{PlacedSection, Point, SectionLayout};
use traverse_layout_sequencing::{Algorithm, EffectModel, InnerOverlap, OrderOptions};
use traverse_proto::{check_sections_request, order_from_wire, order_request, v1};
use traverse_server::{Caller, Config, Server, TraverseEngines};
use traverse_solve::Seed;

/// What the engine in process may take longer than asked.
const MARGIN: Duration = Duration::from_secs(5);

pub(crate) async fn run(arguments: Order) -> Result<(), Failure> {
    for output in &arguments.output {
        if let Output::Program = kind_of(output)? {
            let name = output.display();
            return Err(Failure::Input(format!("{name}: a layout is written to .svg, .png, .dxf or .json")));
        }
    }
    let layout = section_files::layout(&arguments)?;
    let request = request(&layout, &arguments);
    if let Some(path) = &arguments.request {
        input::write(path, planning::request_json("OrderSections", &request)?)?;
    }
    let caller = caller(&arguments)?;
    let (answer, text) = planning::order(&caller, &request).await?;
    if answer.no_order {
        return Err(Failure::NoPath(
            "forbidden joins, ends and precedences leave no order: proven".to_owned(),
        ));
    }
    if answer.order.is_empty() {
        return Err(Failure::NotNow(
            "the method found no order that is allowed; use --algorithm best".to_owned(),
        ));
    }
    let title = title(&arguments.files);
    for output in &arguments.output {
        match kind_of(output)? {
            Output::Json => input::write(output, &text)?,
            Output::Picture(kind) => {
                write_picture(output, kind, &picture(&layout, &answer, &title)?, arguments.width)?;
            }
            Output::Drawing | Output::Program => {
                let order = order_of(&layout, &answer)?;
                let dxf = write_layout_dxf(&layout, &order);
                input::write(
                    output,
                    dxf.map_err(|error| Failure::Input(format!("{}: {error}", output.display())))?,
                )?;
            }
        }
        say!("wrote {}", output.display());
    }
    for line in order_table::lines(&layout, &answer) {
        say!("{line}");
    }
    check(&caller, request, &answer).await
}

/// Has the checker look at the layout and at what certifies its bound, and says what it found.
async fn check(
    caller: &Caller,
    request: v1::OrderSectionsRequest,
    answer: &v1::OrderSectionsResponse,
) -> Result<(), Failure> {
    let question = check_sections_request(request, answer);
    let certified = answer.report.as_ref().is_some_and(|report| report.certificate.is_some());
    if certified && question.certificate.is_none() {
        say!("certificate      not recomputed: it is larger than checks take");
    }
    match planning::check_sections(caller, &question).await {
        Ok(found) if found.violations.is_empty() => {
            say!("{}", order_table::checked(&found));
            Ok(())
        }
        Ok(found) => Err(Failure::Violations(order_table::violated(&found))),
        // The layout is an answer all the same.
        Err(Failure::NotNow(why)) => {
            say!("checked          no: {why}");
            Ok(())
        }
        Err(failure) => Err(failure),
    }
}

/// The request that the command line asks for.
fn request(layout: &SectionLayout, arguments: &Order) -> v1::OrderSectionsRequest {
    let (algorithm, initial_order) = match arguments.algorithm {
        OrderMethod::Best => (Algorithm::Best, None),
        OrderMethod::GivenOrder => (Algorithm::GivenOrder, Some(as_drawn(layout))),
        OrderMethod::BranchAndBound => (Algorithm::BranchAndBound, None),
        OrderMethod::AntColony => (Algorithm::AntColony, None),
        OrderMethod::LocalImprovement => (Algorithm::LocalImprovement, None),
    };
    let options = OrderOptions {
        algorithm,
        effect_model: match arguments.effects {
            Effects::Exact => EffectModel::Exact,
            Effects::Published => EffectModel::Published,
        },
        initial_order,
        inner_overlap: if arguments.allow_overlap { InnerOverlap::Allowed } else { InnerOverlap::Refused },
        seed: Seed(arguments.seed.into()),
        ..OrderOptions::default()
    };
    let mut request = order_request(layout, &options);
    if let Some(options) = &mut request.options {
        options.time_limit = prost_types::Duration::try_from(arguments.time).ok();
        options.iteration_limit = arguments.iteration_limit;
        options.gap_limit = arguments.gap_limit;
        options.thread_count = arguments.threads;
        options.return_certificate = true;
    }
    request.return_contacts = true;
    request
}

/// The sections as they were drawn, every copy, in the first pose that it may have.
fn as_drawn(layout: &SectionLayout) -> Vec<PlacedSection> {
    let copies = |(section, of): (usize, &traverse_geometry::Section)| {
        let pose = of.poses.first().copied().unwrap_or_default();
        (0..of.quantity).map(move |copy| PlacedSection { section, copy, pose, x_mm: 0.0 })
    };
    layout.sections.iter().enumerate().flat_map(copies).collect()
}

fn caller(arguments: &Order) -> Result<Caller, Failure> {
    if let Some(address) = &arguments.server {
        return planning::caller(Some(address));
    }
    let mut config = Config::default();
    config.longest_time_limit = config.longest_time_limit.max(arguments.time.saturating_add(MARGIN));
    let server = match has_terminal() {
        true => Server::with_engines(config, WatchedEngines),
        false => Server::with_engines(config, TraverseEngines),
    };
    Ok(Caller::InProcess(Box::new(server.map_err(start_failure)?)))
}

fn title(files: &[std::path::PathBuf]) -> String {
    let name = |file: &Path| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    files.iter().map(|file| name(file)).collect::<Vec<_>>().join(", ")
}

/// The order of an answer.
pub(crate) fn order_of(
    layout: &SectionLayout,
    answer: &v1::OrderSectionsResponse,
) -> Result<Vec<PlacedSection>, Failure> {
    order_from_wire(&answer.order, layout).map_err(|refused| Failure::Internal(refused.message()))
}

/// The answer as a picture.
pub(crate) fn picture(
    layout: &SectionLayout,
    answer: &v1::OrderSectionsResponse,
    title: &str,
) -> Result<String, Failure> {
    let order = order_of(layout, answer)?;
    let point = |point: &Option<v1::Point>| point.as_ref().map(|p| Point::new(p.x_mm, p.y_mm));
    let contacts: Vec<(Point, Point)> = (answer.contacts.iter())
        .filter_map(|contact| point(&contact.point).zip(point(&contact.against_point)))
        .collect();
    let lower_bound_mm = answer.report.as_ref().and_then(|report| report.lower_bound);
    let shown = ShownLayout { layout, order: &order, contacts: &contacts, lower_bound_mm };
    Ok(picture_of_layout(&shown, title))
}
