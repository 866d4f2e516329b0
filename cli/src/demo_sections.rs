//! Sections in the demo: the bundled layout ordered over gRPC, as drawn and with all poses, checked, pictured.

use crate::failure::Failure;
use crate::input;
use crate::order::picture;
use std::path::Path;
use std::time::{Duration, Instant};
use tonic::transport::Channel;
use traverse_drawing::{ReadOptions, SectionOptions, read_svg, sections_from_drawing};
use traverse_geometry::{Pose, SectionLayout};
use traverse_layout_sequencing::OrderOptions;
use traverse_proto::v1::planner_service_client::PlannerServiceClient;
use traverse_proto::{check_sections_request, order_request, v1};

const SECTIONS: &[u8] = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../drawings/shoe-sections.svg"));
const NAME: &str = "shoe-sections.svg";

/// How long each question may take.
const TIME_LIMIT: Duration = Duration::from_secs(10);

pub(crate) const HEADER: &str =
    "sections              count   by boxes     joined   saved  lower bound  proven  checked        call";

/// One question about the bundled sections.
struct Question {
    /// Names the picture.
    name: &'static str,
    poses: &'static [Pose],
    gap_mm: f64,
}

const QUESTIONS: [Question; 3] = [
    Question { name: "sections-as-drawn", poses: &[Pose::AsIs], gap_mm: 0.0 },
    Question { name: "sections-gap-of-4", poses: &[Pose::AsIs], gap_mm: 4.0 },
    Question { name: "sections-half-turns", poses: &[Pose::AsIs, Pose::HalfTurn], gap_mm: 4.0 },
];

/// Orders, checks and draws; says one row for each question.
pub(crate) async fn run(client: &mut PlannerServiceClient<Channel>, out: &Path) -> Result<(), Failure> {
    say!("{HEADER}");
    for question in &QUESTIONS {
        let row = show(question, client, out).await?;
        say!("{row}");
    }
    Ok(())
}

async fn show(
    question: &Question,
    client: &mut PlannerServiceClient<Channel>,
    out: &Path,
) -> Result<String, Failure> {
    let layout = layout(question)?;
    let mut request = order_request(&layout, &OrderOptions::default());
    request.return_contacts = true;
    if let Some(options) = &mut request.options {
        options.return_certificate = true;
        options.time_limit = prost_types::Duration::try_from(TIME_LIMIT).ok();
    }
    let sent = Instant::now();
    let answer = client.order_sections(request.clone()).await.map_err(refused)?.into_inner();
    let call = sent.elapsed();
    let check = check_sections_request(request, &answer);
    let found = client.check_sections(check).await.map_err(refused)?.into_inner();
    let checked = if found.violations.is_empty() { "sound" } else { "REFUSED" };
    let title = format!("{NAME}: {}", question.name.replace('-', " "));
    input::write(&out.join(format!("{}.svg", question.name)), picture(&layout, &answer, &title)?)?;
    Ok(row(question, &answer, checked, call))
}

fn row(question: &Question, answer: &v1::OrderSectionsResponse, checked: &str, call: Duration) -> String {
    let (boxes, length) = (answer.bounding_box_length_mm, answer.length_mm);
    let report = answer.report.clone().unwrap_or_default();
    let proven = if report.proven_optimal { "yes" } else { "no" };
    format!(
        "{:<21} {:>5} {boxes:>10.3} {length:>10.3} {:>5.1} % {:>12.3}  {proven:<6}  {checked:<7} {:>8} ms",
        question.name,
        answer.order.len(),
        100.0 * (boxes - length) / boxes.max(1e-9),
        report.lower_bound.unwrap_or_default(),
        call.as_millis(),
    )
}

fn layout(question: &Question) -> Result<SectionLayout, Failure> {
    let internal = |why: String| Failure::Internal(format!("{NAME}: {why}"));
    let drawing = read_svg(SECTIONS, &ReadOptions::default()).map_err(|error| internal(error.to_string()))?;
    let options = SectionOptions { poses: question.poses.to_vec(), ..SectionOptions::default() };
    let made = sections_from_drawing(&drawing, &options).map_err(|error| internal(error.to_string()))?;
    if !made.is_complete() {
        return Err(internal(made.report.to_string()));
    }
    Ok(SectionLayout { gap_mm: question.gap_mm, ..SectionLayout::new(made.sections) })
}

fn refused(status: tonic::Status) -> Failure {
    Failure::Internal(format!("{:?}: {}", status.code(), status.message()))
}
