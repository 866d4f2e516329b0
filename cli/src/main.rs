//! `traverse`: rapid moves from drawings, orders from matrices, in process or against a server; `traverse serve` starts one.

/// Writes a line to standard output; whoever closed it does not want to know.
macro_rules! say {
    ($($line:tt)*) => {{
        use std::io::Write;
        writeln!(std::io::stdout(), $($line)*).ok();
    }};
}

mod arguments;
mod call;
mod check;
mod clock;
mod demo;
mod demo_sections;
mod drawing_scene;
mod failure;
mod input;
mod inspect;
mod live_line;
mod motion_arguments;
mod order;
mod order_arguments;
mod order_table;
mod picture_file;
mod planning;
mod program;
mod program_table;
mod rapid;
mod section_files;
mod serve;
mod solve;
mod tool_change;

use arguments::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let runtime = match tokio::runtime::Runtime::new() {
        Ok(runtime) => runtime,
        Err(error) => return Failure::Internal(format!("can't start: {error}")).report(),
    };
    let done = runtime.block_on(async {
        match arguments.command {
            Command::Serve(serve) => serve::run(serve).await,
            Command::Rapid(rapid) => rapid::run(*rapid).await,
            Command::ToolChange(change) => tool_change::run(*change).await,
            Command::Inspect(inspect) => inspect::run(&inspect),
            Command::Order(order) => order::run(*order).await,
            Command::Solve(solve) => solve::run(&solve),
            Command::Check(check) => check::run(check).await,
            Command::Call(call) => call::run(call).await,
            Command::Demo(demo) => demo::run(demo).await,
        }
    });
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
