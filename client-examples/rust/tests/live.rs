//! The example against a live server.

use std::time::Duration;
use tokio::net::TcpListener;
use tokio::sync::oneshot;
use traverse_client_example::traverse::PlanRapidMoveRequest;
use traverse_client_example::{
    connect, disc, open_session, plan_rapid_move, point, print_answer, print_refusal, print_step, rectangle,
    scene,
};
use traverse_server::{Config, Server};

const PATIENCE: Duration = Duration::from_secs(60);

/// Serves on `listener` until the sender is dropped.
fn serve(listener: TcpListener) -> oneshot::Sender<()> {
    let server = Server::new(Config::on_free_port()).expect("sound settings");
    let (stop, stopped) = oneshot::channel::<()>();
    tokio::spawn(server.serve(listener, async {
        stopped.await.ok();
    }));
    stop
}

async fn told(request: &PlanRapidMoveRequest) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a free port");
    let address = format!("http://{}", listener.local_addr().expect("bound"));
    let _stop = serve(listener);
    let mut text = Vec::new();
    match plan_rapid_move(&mut connect(&address).expect("an address"), request, PATIENCE).await {
        Ok(answer) => print_answer(&answer, &mut text),
        Err(status) => print_refusal(&status, &mut text),
    }
    .expect("written");
    String::from_utf8(text).expect("utf-8")
}

#[tokio::test]
async fn a_way_is_planned_and_printed() {
    let request = PlanRapidMoveRequest {
        scene: Some(scene(
            vec![rectangle("plate", 0.0, 0.0, 60.0, 40.0), disc("boss", 75.0, 30.0, 10.0)],
            3.0,
        )),
        start: Some(point(-10.0, 5.0)),
        target: Some(point(95.0, 30.0)),
        ..PlanRapidMoveRequest::default()
    };
    let text = told(&request).await;
    assert!(text.contains("proven") && text.contains("round plate"), "{text}");
    assert!(text.trim_end().ends_with("G0 X95.0000 Y30.0000"), "{text}");
}

#[tokio::test]
async fn no_way_is_an_answer() {
    let wall = |id: &str, x: f64, y: f64, width: f64, height: f64| rectangle(id, x, y, width, height);
    let ring = vec![
        wall("west", -20.0, -20.0, 5.0, 40.0),
        wall("east", 15.0, -20.0, 5.0, 40.0),
        wall("south", -20.0, -20.0, 40.0, 5.0),
        wall("north", -20.0, 15.0, 40.0, 5.0),
    ];
    let request = PlanRapidMoveRequest {
        scene: Some(scene(ring, 1.0)),
        start: Some(point(0.0, 0.0)),
        target: Some(point(50.0, 0.0)),
        ..PlanRapidMoveRequest::default()
    };
    let text = told(&request).await;
    assert!(text.contains("no way") && text.contains("north"), "{text}");
}

#[tokio::test]
async fn every_finding_is_printed() {
    let request = PlanRapidMoveRequest {
        scene: Some(scene(vec![], -1.0)),
        start: Some(point(f64::NAN, 0.0)),
        ..PlanRapidMoveRequest::default()
    };
    let text = told(&request).await;
    for part in
        ["INVALID_REQUEST", "start.x_mm", "NOT_FINITE", "target", "scene.clearance_mm", "OUT_OF_RANGE"]
    {
        assert!(text.contains(part), "{part} is not in {text}");
    }
}

#[tokio::test]
async fn a_server_that_comes_up_late_is_waited_for() {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a free port");
    let address = listener.local_addr().expect("bound");
    drop(listener);
    let mut client = connect(&format!("http://{address}")).expect("an address");
    let request = PlanRapidMoveRequest {
        start: Some(point(0.0, 0.0)),
        target: Some(point(3.0, 4.0)),
        ..PlanRapidMoveRequest::default()
    };
    let impatient = plan_rapid_move(&mut client, &request, Duration::from_millis(1)).await;
    assert_eq!(impatient.expect_err("nobody is there").code(), tonic::Code::Unavailable);
    let call = tokio::spawn(async move { plan_rapid_move(&mut client, &request, PATIENCE).await });
    let _stop = serve(TcpListener::bind(address).await.expect("still free"));
    assert!(call.await.expect("no panic").expect("it came up").outcome.is_some());
}

#[tokio::test]
async fn a_session_plans_while_the_scene_changes() {
    let listener = TcpListener::bind("127.0.0.1:0").await.expect("a free port");
    let address = format!("http://{}", listener.local_addr().expect("bound"));
    let _stop = serve(listener);
    let mut client = connect(&address).expect("an address");
    let (steps, mut answers) = open_session(&mut client).await.expect("opened");
    let sending = tokio::spawn(async move {
        steps.scene("set up", scene(vec![rectangle("plate", 0.0, 0.0, 60.0, 40.0)], 3.0)).await;
        steps.plan("round", point(-10.0, 5.0), point(70.0, 5.0)).await;
        steps.put("clamp on", disc("clamp", 30.0, -8.0, 6.0)).await;
        steps.plan("other way", point(-10.0, 5.0), point(70.0, 5.0)).await;
        steps.plan("inside", point(5.0, 5.0), point(70.0, 5.0)).await;
        steps.remove("plate off", "plate").await;
        steps.remove("clamp off", "clamp").await;
        steps.plan("straight", point(-10.0, 5.0), point(70.0, 5.0)).await;
    });
    let mut text = Vec::new();
    while let Some(answer) = answers.message().await.expect("no end") {
        print_step(&answer, &mut text).expect("written");
    }
    sending.await.expect("no panic");
    let text = String::from_utf8(text).expect("utf-8");
    for part in [
        "set up: the scene holds 1 obstacles now",
        "round: ",
        "clamp on: the scene holds 2 obstacles now",
        "other way: ",
        "inside: refused: END_INSIDE_BARRIER",
        "  query.start: ",
        "clamp off: the scene holds 0 obstacles now",
        "straight: 80.000 mm",
    ] {
        assert!(text.contains(part), "{part} is not in {text}");
    }
}
