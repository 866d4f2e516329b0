//! `traverse demo`: the whole way on bundled drawings. A server on a free port, gRPC over its socket, the checker on
//! every plan, a table, pictures.

use crate::arguments::Demo;
use crate::demo_sections;
use crate::failure::Failure;
use crate::input;
use crate::rapid::{duration, picture};
use crate::serve::start_failure;
use std::time::{Duration, Instant};
use tonic::transport::Channel;
use traverse_drawing::{ReadOptions, SceneOptions, read_dxf, scene_from_drawing};
use traverse_geometry::{CornerStyle, Point, RapidRules, Scene};
use traverse_planner::{Algorithm, RapidMove};
use traverse_proto::v1::plan_rapid_move_response::Outcome;
use traverse_proto::v1::planner_service_client::PlannerServiceClient;
use traverse_proto::{plan_request, v1};
use traverse_server::{Config, Server};

/// One rapid move through a bundled drawing.
struct Move {
    drawing: &'static str,
    dxf: &'static [u8],
    /// Names the picture.
    name: &'static str,
    from: (f64, f64),
    to: (f64, f64),
    clearance_mm: f64,
    corner_style: CornerStyle,
}

macro_rules! bundled {
    ($name:literal) => {
        include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../drawings/", $name))
    };
}

const VISE: &[u8] = bundled!("vise-and-clamps.dxf");
const SHAFT: &[u8] = bundled!("turned-shaft.dxf");
const HIDE: &[u8] = bundled!("leather-hide.dxf");
const MITER: CornerStyle = CornerStyle::Miter { limit: None };

const fn rapid(
    (drawing, dxf): (&'static str, &'static [u8]),
    name: &'static str,
    from: (f64, f64),
    to: (f64, f64),
    clearance_mm: f64,
    corner_style: CornerStyle,
) -> Move {
    Move { drawing, dxf, name, from, to, clearance_mm, corner_style }
}

const MOVES: [Move; 8] = [
    rapid(
        ("vise-and-clamps.dxf", VISE),
        "mill-across",
        (30.0, 150.0),
        (570.0, 150.0),
        5.0,
        CornerStyle::Round,
    ),
    rapid(("vise-and-clamps.dxf", VISE), "mill-across-mitred", (30.0, 150.0), (570.0, 150.0), 5.0, MITER),
    rapid(
        ("vise-and-clamps.dxf", VISE),
        "mill-into-the-stop",
        (230.0, 155.0),
        (300.0, 80.0),
        5.0,
        CornerStyle::Round,
    ),
    rapid(
        ("vise-and-clamps.dxf", VISE),
        "mill-shut-in",
        (110.0, 155.0),
        (570.0, 150.0),
        5.0,
        CornerStyle::Round,
    ),
    rapid(
        ("turned-shaft.dxf", SHAFT),
        "lathe-undercut",
        (100.0, 38.0),
        (206.0, 38.0),
        4.0,
        CornerStyle::Round,
    ),
    rapid(
        ("turned-shaft.dxf", SHAFT),
        "lathe-to-tailstock",
        (70.0, 60.0),
        (310.0, 30.0),
        4.0,
        CornerStyle::Round,
    ),
    rapid(
        ("leather-hide.dxf", HIDE),
        "hide-across",
        (210.0, 300.0),
        (1120.0, 480.0),
        6.0,
        CornerStyle::Round,
    ),
    rapid(
        ("leather-hide.dxf", HIDE),
        "hide-out-of-the-nest",
        (303.0, 430.0),
        (1000.0, 640.0),
        4.0,
        CornerStyle::Round,
    ),
];

pub(crate) async fn run(arguments: Demo) -> Result<(), Failure> {
    let server = Server::new(Config::on_free_port()).map_err(start_failure)?;
    let listener = server.bind().await.map_err(start_failure)?;
    let address = listener.local_addr().map_err(|error| Failure::Internal(error.to_string()))?;
    let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
    let serving = tokio::spawn(server.serve(listener, async move { stopped.await.unwrap_or_default() }));
    say!("A server listens on http://{address}; every question below goes to it over gRPC and back.\n");
    let mut client = PlannerServiceClient::connect(format!("http://{address}"))
        .await
        .map_err(|error| Failure::Unreachable(format!("{address}: {error}")))?;
    say!("{HEADER}");
    for wanted in &MOVES {
        let row = show(wanted, &mut client, &arguments).await?;
        say!("{row}");
    }
    say!(
        "\nLengths in mm. Proven: no collision-free path is shorter. Checked: by code that shares nothing with the"
    );
    say!("planner. Search: in the engine; call: until the answer was here.");
    say!("\nSections of a cutting layout, ordered so that they join tightest:\n");
    demo_sections::run(&mut client, &arguments.out).await?;
    say!("\nPictures: {}/*.svg", arguments.out.display());
    drop(client);
    stop.send(()).ok();
    serving
        .await
        .map_err(|error| Failure::Internal(error.to_string()))?
        .map_err(|error| Failure::Internal(error.to_string()))
}

const HEADER: &str = "move                  obstacles  vertices   straight       path  proven  checked  goes round                            search      call";

async fn show(
    wanted: &Move,
    client: &mut PlannerServiceClient<Channel>,
    arguments: &Demo,
) -> Result<String, Failure> {
    let scene = scene_of(wanted)?;
    let query = RapidMove {
        start: at(wanted.from),
        target: at(wanted.to),
        algorithm: Algorithm::Exact,
        rules: RapidRules::default(),
    };
    let request = plan_request(&scene, &query);
    let sent = Instant::now();
    let answer = client.plan_rapid_move(request.clone()).await.map_err(refused)?.into_inner();
    let call = sent.elapsed();
    let checked = match &answer.outcome {
        Some(Outcome::Plan(plan)) => {
            let question = v1::CheckRapidMoveRequest {
                request: Some(request.clone()),
                path: plan.path.clone(),
                tolerance_mm: None,
            };
            let found = client.check_rapid_move(question).await.map_err(refused)?.into_inner();
            if found.violations.is_empty() { "sound" } else { "REFUSED" }
        }
        _ => "–",
    };
    let title = format!("{}: {}", wanted.drawing, wanted.name.replace('-', " "));
    let file = arguments.out.join(format!("{}.svg", wanted.name));
    input::write(&file, picture(&scene, &request, &RapidRules::default(), &answer, &title)?)?;
    Ok(row(wanted, &scene, &answer, checked, call))
}

fn row(
    wanted: &Move,
    scene: &Scene,
    answer: &v1::PlanRapidMoveResponse,
    checked: &str,
    call: Duration,
) -> String {
    let straight = (at(wanted.to) - at(wanted.from)).norm();
    let (length, proven, round) = match &answer.outcome {
        Some(Outcome::Plan(plan)) => {
            let proven = if plan.lower_bound == plan.cost { "yes" } else { "no" };
            (format!("{:.3}", plan.cost), proven, plan.bending_obstacle_ids.join(" "))
        }
        Some(Outcome::NoPath(no_path)) => {
            ("no path".to_owned(), "yes", format!("parted by {}", no_path.separating_obstacle_ids.join(" ")))
        }
        None => ("?".to_owned(), "no", String::new()),
    };
    let search =
        answer.stats.and_then(|stats| stats.search_duration).map(|time| duration(&time)).unwrap_or_default();
    let mut round: String = if round.chars().count() > 34 { round.chars().take(33).collect() } else { round };
    if round.chars().count() == 33 {
        round.push('…');
    }
    format!(
        "{:<21} {:>9} {:>9} {straight:>10.3} {length:>10}  {proven:<6}  {checked:<7}  {round:<34}  {:>7} µs {:>6} µs",
        wanted.name,
        scene.obstacles.len(),
        scene.vertex_count(),
        search.as_micros(),
        call.as_micros(),
    )
}

fn scene_of(wanted: &Move) -> Result<Scene, Failure> {
    let internal = |why: String| Failure::Internal(format!("{}: {why}", wanted.drawing));
    let drawing =
        read_dxf(wanted.dxf, &ReadOptions::default()).map_err(|error| internal(error.to_string()))?;
    let options =
        SceneOptions { corner_style: wanted.corner_style, ..SceneOptions::new(wanted.clearance_mm) };
    let found = scene_from_drawing(&drawing, &options).map_err(|error| internal(error.to_string()))?;
    if found.report.is_complete() { Ok(found.scene) } else { Err(internal(found.report.to_string())) }
}

fn at((x, y): (f64, f64)) -> Point {
    Point::new(x, y)
}

fn refused(status: tonic::Status) -> Failure {
    Failure::Internal(format!("{:?}: {}", status.code(), status.message()))
}
