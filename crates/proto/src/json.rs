//! Canonical proto3 JSON for every message of the contract.
//!
//! Written: default-valued scalars and empty lists too, so that a reader sees every field; absent messages, `optional`
//! fields and oneofs are left out; 64-bit integers are strings. Read: names as in the proto file or in lowerCamelCase; an
//! unknown name is refused with its path.

use crate::{Limits, Procedure, Refused, schema::error_detail};
use prost::Message;
use prost_reflect::{DeserializeOptions, DynamicMessage, Kind, MessageDescriptor, SerializeOptions};
use serde_json::value::RawValue;

/// The encoded request that JSON text stands for.
///
/// # Errors
/// What is wrong with the text, and where; or that it holds more values than `limits` let any request have.
pub fn request_from_json(procedure: &Procedure, text: &[u8], limits: &Limits) -> Result<Vec<u8>, Refused> {
    let values = count_values(text);
    let most = most_values(limits);
    if values > most {
        let detail = format!("it holds {values} values and no request has more than {most} within GetLimits");
        return Err(Refused::MalformedJson { detail });
    }
    from_json(procedure.input(), text).map(|message| message.encode_to_vec())
}

/// JSON text of an encoded answer, names in lowerCamelCase.
///
/// # Errors
/// Never for bytes that the service encoded.
pub fn answer_to_json(procedure: &Procedure, bytes: &[u8]) -> Result<Vec<u8>, Refused> {
    to_json(procedure.output(), bytes)
}

/// JSON text of an encoded request: what a client sends.
///
/// # Errors
/// The bytes are no such request.
pub fn request_to_json(procedure: &Procedure, bytes: &[u8]) -> Result<Vec<u8>, Refused> {
    to_json(procedure.input(), bytes)
}

/// The encoded answer that JSON text stands for: what a client reads.
///
/// # Errors
/// What is wrong with the text, and where.
pub fn answer_from_json(procedure: &Procedure, text: &[u8]) -> Result<Vec<u8>, Refused> {
    from_json(procedure.output(), text).map(|message| message.encode_to_vec())
}

/// An error detail, such as `google.rpc.BadRequest`, as JSON. Absent when its type is not known here.
#[must_use]
pub fn error_detail_to_json(type_name: &str, bytes: &[u8]) -> Option<Box<RawValue>> {
    let text = to_json(error_detail(type_name)?, bytes).ok()?;
    RawValue::from_string(String::from_utf8(text).ok()?).ok()
}

fn from_json(kind: MessageDescriptor, text: &[u8]) -> Result<DynamicMessage, Refused> {
    let malformed = |detail: String| Refused::MalformedJson { detail };
    let mut reader = serde_json::Deserializer::from_slice(text);
    let mut track = serde_path_to_error::Track::new();
    let options = DeserializeOptions::new().deny_unknown_fields(true);
    let tracked = serde_path_to_error::Deserializer::new(&mut reader, &mut track);
    let message = DynamicMessage::deserialize_with_options(kind.clone(), tracked, &options);
    let message = message.map_err(|error| {
        let path = track.path().to_string();
        let known = match error.classify() {
            serde_json::error::Category::Data => known_at(kind, &path).unwrap_or_default(),
            _ => String::new(),
        };
        malformed(if path == "." { format!("{error}{known}") } else { format!("{path}: {error}{known}") })
    })?;
    reader.end().map_err(|error| malformed(error.to_string()))?;
    Ok(message)
}

/// What may stand at a path such as `scene.obstacles[0].shape`: the fields of a message, the values of an enumeration.
fn known_at(root: MessageDescriptor, path: &str) -> Option<String> {
    let mut kind = Kind::Message(root);
    for part in path.split('.').filter(|part| !part.is_empty()) {
        let name = part.split('[').next().unwrap_or(part);
        let Kind::Message(message) = &kind else { return None };
        let field = message.get_field_by_json_name(name).or_else(|| message.get_field_by_name(name));
        // What is not known itself: its message says what is.
        let Some(field) = field else { break };
        kind = field.kind();
    }
    let (what, names): (_, Vec<String>) = match kind {
        Kind::Message(message) => {
            ("fields", message.fields().map(|field| field.json_name().to_owned()).collect())
        }
        Kind::Enum(values) => ("values", values.values().map(|value| value.name().to_owned()).collect()),
        _ => return None,
    };
    Some(format!("; known {what} are {}", names.join(", ")))
}

fn to_json(kind: MessageDescriptor, bytes: &[u8]) -> Result<Vec<u8>, Refused> {
    let malformed = |detail: String| Refused::MalformedMessage { detail };
    let message = DynamicMessage::decode(kind, bytes).map_err(|error| malformed(error.to_string()))?;
    let mut text = Vec::new();
    let options = SerializeOptions::new().skip_default_fields(false);
    message
        .serialize_with_options(&mut serde_json::Serializer::new(&mut text), &options)
        .map_err(|error| malformed(error.to_string()))?;
    Ok(text)
}

/// An upper bound on the values in JSON text, without parsing it. Parsing costs some seventy bytes of memory for a value that
/// takes two on the wire.
fn count_values(text: &[u8]) -> usize {
    let mut count = 1;
    let mut in_string = false;
    let mut escaped = false;
    for byte in text {
        match (in_string, byte) {
            (true, _) if escaped => escaped = false,
            (true, b'\\') => escaped = true,
            (_, b'"') => in_string = !in_string,
            (false, b',' | b'[' | b'{') => count += 1,
            _ => {}
        }
    }
    count
}

/// Values of the largest request within `limits`, generously: three numbers per vertex, and every field of each message.
fn most_values(limits: &Limits) -> usize {
    let items = limits.vertex_count.saturating_mul(4);
    let obstacles = limits.obstacle_count.saturating_mul(16);
    let steps = limits.step_count.saturating_mul(16);
    // A section with its copies in a given order, a part with its pole.
    let sections =
        limits.section_count.saturating_mul(32).saturating_add(limits.part_count.saturating_mul(16));
    let rules = limits.rule_count().saturating_mul(8);
    let scene = items.saturating_add(obstacles).saturating_add(steps);
    scene.saturating_add(sections).saturating_add(rules).saturating_add(1000)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::v1;

    fn plan() -> Procedure {
        Procedure::named("PlanRapidMove").expect("in the contract")
    }

    fn request(text: &str) -> Result<v1::PlanRapidMoveRequest, Refused> {
        let bytes = request_from_json(&plan(), text.as_bytes(), &Limits::default())?;
        Ok(v1::PlanRapidMoveRequest::decode(bytes.as_slice()).expect("encoded just now"))
    }

    #[test]
    fn both_spellings_of_a_name_are_read() {
        let snake = request(r#"{"start":{"x_mm":1,"y_mm":"NaN"},"validate_only":true}"#).expect("valid");
        let camel = request(r#"{"start":{"xMm":1,"yMm":"NaN"},"validateOnly":true}"#).expect("valid");
        assert_eq!(snake.encode_to_vec(), camel.encode_to_vec());
    }

    #[test]
    fn what_is_wrong_is_named_with_its_path() {
        for (text, path, what) in [
            (r#"{"scene":{"obstacles":[{"shape":{"outre":{}}}]}}"#, "scene.obstacles[0].shape", "outre"),
            (r#"{"start":{"x_mm":"far"}}"#, "start.x_mm", "invalid float"),
            (r#"{"start":{"x_mm":1e999}}"#, "start.x_mm", "out of range"),
            (r#"{"scene":{"obstacles":[{"shape":{"outre":{}}}]}}"#, "shape", "known fields are outer, holes"),
            (r#"{"scene":{"cornerStyle":"FOO"}}"#, "scene.cornerStyle", "CORNER_STYLE_ROUND"),
            (r#"{"sceen":{}}"#, "", "known fields are scene, start"),
            ("", "", "EOF"),
            ("<html>", "", "expected value"),
            (r#"{} {}"#, "", "trailing"),
        ] {
            let Err(Refused::MalformedJson { detail }) = request(text) else { panic!("{text} was read") };
            assert!(detail.contains(path) && detail.contains(what), "{text}: {detail}");
        }
    }

    #[test]
    fn default_valued_scalars_are_written_and_absent_messages_are_not() {
        let answer = v1::PlanRapidMoveResponse {
            stats: Some(v1::RapidStats { expanded_node_count: 7, ..Default::default() }),
            outcome: None,
        };
        let text = answer_to_json(&plan(), &answer.encode_to_vec()).expect("just encoded");
        assert_eq!(
            String::from_utf8(text).expect("utf-8"),
            r#"{"stats":{"barrierVertexCount":"0","expandedNodeCount":"7"}}"#
        );
    }

    #[test]
    fn too_many_values_are_refused_before_parsing() {
        let limits = Limits {
            vertex_count: 10,
            obstacle_count: 1,
            step_count: 1,
            section_count: 1,
            part_count: 1,
            ..Limits::default()
        };
        let text = format!(r#"{{"scene":[{}0]}}"#, "0,".repeat(2000));
        let refused = request_from_json(&plan(), text.as_bytes(), &limits).unwrap_err();
        assert_eq!(refused.reason(), "MALFORMED_JSON");
        assert!(refused.message().contains("2003 values"), "{}", refused.message());
    }
}
