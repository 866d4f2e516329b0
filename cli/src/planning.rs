//! Typed calls over [`Caller`]: from domain types to JSON and back.

use crate::failure::Failure;
use crate::serve::start_failure;
use prost::Message;
use traverse_proto::{Procedure, json, v1};
use traverse_server::{Caller, Config, Server};

/// A server's address, or the engines in process.
pub(crate) fn caller(server: Option<&str>) -> Result<Caller, Failure> {
    Ok(match server {
        Some(address) => Caller::remote(address)?,
        None => Caller::InProcess(Box::new(Server::new(Config::default()).map_err(start_failure)?)),
    })
}

/// A request as the JSON that goes over the wire.
pub(crate) fn request_json(method: &str, request: &impl Message) -> Result<Vec<u8>, Failure> {
    json::request_to_json(&procedure(method)?, &request.encode_to_vec()).map_err(internal)
}

/// PlanRapidMove; answers the message and its JSON text.
pub(crate) async fn plan(
    caller: &Caller,
    request: &v1::PlanRapidMoveRequest,
) -> Result<(v1::PlanRapidMoveResponse, String), Failure> {
    call(caller, "PlanRapidMove", request).await
}

/// CheckRapidMove.
pub(crate) async fn check(
    caller: &Caller,
    request: &v1::CheckRapidMoveRequest,
) -> Result<v1::CheckRapidMoveResponse, Failure> {
    call(caller, "CheckRapidMove", request).await.map(|(answer, _)| answer)
}

/// OrderSections; answers the message and its JSON text.
pub(crate) async fn order(
    caller: &Caller,
    request: &v1::OrderSectionsRequest,
) -> Result<(v1::OrderSectionsResponse, String), Failure> {
    call(caller, "OrderSections", request).await
}

/// CheckSections.
pub(crate) async fn check_sections(
    caller: &Caller,
    request: &v1::CheckSectionsRequest,
) -> Result<v1::CheckSectionsResponse, Failure> {
    call(caller, "CheckSections", request).await.map(|(answer, _)| answer)
}

/// Any call; answers the message and its JSON text.
pub(crate) async fn call<A: Message + Default>(
    caller: &Caller,
    method: &str,
    request: &impl Message,
) -> Result<(A, String), Failure> {
    let text = caller.call(method, request_json(method, request)?).await?;
    let answer = answer(method, text.as_bytes()).map_err(Failure::Internal)?;
    Ok((answer, text))
}

/// An answer from its JSON text.
pub(crate) fn answer<A: Message + Default>(method: &str, text: &[u8]) -> Result<A, String> {
    let procedure = procedure(method).map_err(|failure| failure.to_string())?;
    let bytes = json::answer_from_json(&procedure, text).map_err(|refused| refused.message())?;
    A::decode(&*bytes).map_err(|error| error.to_string())
}

/// A request from its JSON text.
pub(crate) fn request<R: Message + Default>(method: &str, text: &[u8]) -> Result<R, String> {
    let procedure = procedure(method).map_err(|failure| failure.to_string())?;
    let limits = traverse_proto::Limits::default();
    let bytes = json::request_from_json(&procedure, text, &limits).map_err(|refused| refused.message())?;
    R::decode(&*bytes).map_err(|error| error.to_string())
}

fn procedure(method: &str) -> Result<Procedure, Failure> {
    Procedure::named(method).ok_or_else(|| Failure::Internal(format!("the contract has no {method}")))
}

fn internal(refused: traverse_proto::Refused) -> Failure {
    Failure::Internal(refused.message())
}
