//! Plans one rapid move round a plate with a disc beside it and prints the way.
//!
//! `cargo run -p traverse-client-example -- http://127.0.0.1:50051`

use std::process::ExitCode;
use std::time::Duration;
use traverse_client_example::traverse::PlanRapidMoveRequest;
use traverse_client_example::{
    connect, disc, plan_rapid_move, point, print_answer, print_refusal, rectangle, scene,
};

#[tokio::main(flavor = "current_thread")]
async fn main() -> Result<ExitCode, Box<dyn std::error::Error>> {
    let address = std::env::args().nth(1).unwrap_or_else(|| "http://127.0.0.1:50051".to_owned());
    let mut client = connect(&address)?;
    let request = PlanRapidMoveRequest {
        scene: Some(scene(
            vec![rectangle("plate", 0.0, 0.0, 60.0, 40.0), disc("boss", 75.0, 30.0, 10.0)],
            3.0,
        )),
        start: Some(point(-10.0, 5.0)),
        target: Some(point(95.0, 30.0)),
        ..PlanRapidMoveRequest::default()
    };
    let mut out = std::io::stdout();
    match plan_rapid_move(&mut client, &request, Duration::from_secs(5)).await {
        Ok(answer) => {
            print_answer(&answer, &mut out)?;
            Ok(ExitCode::SUCCESS)
        }
        Err(status) => {
            print_refusal(&status, &mut out)?;
            Ok(ExitCode::FAILURE)
        }
    }
}
