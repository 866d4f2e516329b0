//! `traverse call`.

use crate::arguments::Call;
use crate::failure::Failure;
use crate::{input, planning};
use std::io::Write;
use traverse_server::{CallError, is_session};

pub(crate) async fn run(arguments: Call) -> Result<(), Failure> {
    let caller = planning::caller(arguments.server.as_deref())?;
    let called = if is_session(&arguments.method) {
        let steps = input::lines(&arguments.request)?;
        caller.session(&arguments.method, steps, print).await
    } else {
        let request = input::read(&arguments.request)?;
        caller.call(&arguments.method, request).await.map(|answer| print(&answer))
    };
    // The whole error, with every finding, is worth more than its first line.
    if let Err(CallError::Refused { body, .. }) = &called {
        eprintln!("{body}");
    }
    Ok(called?)
}

/// Prints an answer at once; whoever closed standard output does not want to know.
fn print(answer: &str) {
    let mut out = std::io::stdout().lock();
    writeln!(out, "{answer}").and_then(|()| out.flush()).ok();
}
