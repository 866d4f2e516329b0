//! `traverse call`.

use crate::arguments::Call;
use crate::failure::Failure;
use crate::{input, planning};
use std::io::Write;

pub(crate) async fn run(arguments: Call) -> Result<(), Failure> {
    let request = input::read(&arguments.request)?;
    let answer = planning::caller(arguments.server.as_deref())?.call(&arguments.method, request).await;
    // The whole error, with every finding, is worth more than its first line.
    if let Err(traverse_server::CallError::Refused { body, .. }) = &answer {
        eprintln!("{body}");
    }
    let answer = answer?;
    let mut out = std::io::stdout().lock();
    writeln!(out, "{answer}").map_err(|error| Failure::Input(format!("can't write the answer: {error}")))
}
