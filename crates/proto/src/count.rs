//! Counts what an encoded message holds before it is decoded.
//!
//! An empty obstacle is two bytes on the wire and a hundred in memory: decoding first and counting afterwards would let
//! a message at the size limit claim fifty times its size. One pass over the bytes, no allocation for what is within the limits.

use crate::{Limits, Refused};
use prost_reflect::{FieldDescriptor, Kind, MessageDescriptor};
use traverse_geometry::{Finding, Reason};

/// Deeper messages than this are left to the decoder, which refuses them.
const DEPTH: usize = 50;

/// Refuses an encoded message that holds more items than `limits` permit. Bytes that are not a message pass: the decoder
/// says what is wrong with them. Stops at the first item too many, so its cost is bounded by the limits.
///
/// # Errors
/// One finding: the field that holds too many.
pub fn check_counts(message: &MessageDescriptor, bytes: &[u8], limits: &Limits) -> Result<(), Refused> {
    let mut tally = Tally { limits, counts: Vec::new(), messages: 0 };
    match tally.message(message, bytes, None, DEPTH) {
        Err(Stop::TooMany(finding)) => Err(Refused::findings_of(vec![finding])),
        Ok(()) | Err(Stop::Malformed) => Ok(()),
    }
}

/// Why counting ends early.
enum Stop {
    /// The decoder will say why.
    Malformed,
    TooMany(Finding),
}

/// A field on the way down, and the one that holds it.
struct Step<'a> {
    field: &'a FieldDescriptor,
    parent: Option<&'a Step<'a>>,
}

impl Step<'_> {
    fn path(&self) -> String {
        let name = self.field.name();
        self.parent.map_or_else(|| name.to_owned(), |parent| format!("{}.{name}", parent.path()))
    }
}

struct Tally<'a> {
    limits: &'a Limits,
    /// Seen so far, of each field that is a list of messages.
    counts: Vec<(FieldDescriptor, usize)>,
    /// Messages of every kind: fields that are none of a list may be repeated by who means harm.
    messages: usize,
}

impl Tally<'_> {
    fn message(
        &mut self,
        message: &MessageDescriptor,
        mut bytes: &[u8],
        parent: Option<&Step<'_>>,
        depth: usize,
    ) -> Result<(), Stop> {
        let depth = depth.checked_sub(1).ok_or(Stop::Malformed)?;
        while !bytes.is_empty() {
            let key = varint(&mut bytes).ok_or(Stop::Malformed)?;
            let skipped = match key & 7 {
                0 => varint(&mut bytes).map(drop),
                1 => take(&mut bytes, 8).map(drop),
                5 => take(&mut bytes, 4).map(drop),
                2 => {
                    let length = varint(&mut bytes).and_then(|length| usize::try_from(length).ok());
                    let inner = length.and_then(|length| take(&mut bytes, length)).ok_or(Stop::Malformed)?;
                    let field = u32::try_from(key >> 3).ok().and_then(|number| message.get_field(number));
                    if let Some((field, Kind::Message(kind))) =
                        field.as_ref().map(|field| (field, field.kind()))
                    {
                        let step = Step { field, parent };
                        self.count(&step)?;
                        self.message(&kind, inner, Some(&step), depth)?;
                    }
                    Some(())
                }
                _ => None,
            };
            skipped.ok_or(Stop::Malformed)?;
        }
        Ok(())
    }

    fn count(&mut self, step: &Step<'_>) -> Result<(), Stop> {
        self.messages += 1;
        let limits = self.limits;
        let all = limits.obstacle_count.saturating_mul(4).saturating_add(limits.step_count.saturating_mul(4));
        // A part holds its shape, its rings and its pole.
        let sections =
            limits.section_count.saturating_mul(4).saturating_add(limits.part_count.saturating_mul(4));
        let sections = sections.saturating_add(limits.rule_count().saturating_mul(2));
        let all = all.saturating_add(sections).saturating_add(limits.vertex_count).saturating_add(100);
        if self.messages > all {
            return Err(too_many(step.path(), "messages", all));
        }
        if !step.field.is_list() {
            return Ok(());
        }
        let seen = match self.counts.iter_mut().find(|(field, _)| field == step.field) {
            Some((_, seen)) => {
                *seen += 1;
                *seen
            }
            None => {
                self.counts.push((step.field.clone(), 1));
                1
            }
        };
        let limit = match step.field.full_name() {
            "traverse.v1.Scene.obstacles" => limits.obstacle_count,
            "traverse.v1.Path.steps" => limits.step_count,
            "traverse.v1.OrderSectionsRequest.sections"
            | "traverse.v1.OrderSectionsRequest.initial_order"
            | "traverse.v1.CheckSectionsRequest.order" => limits.section_count,
            "traverse.v1.Section.parts" => limits.part_count,
            "traverse.v1.OrderSectionsRequest.precedences"
            | "traverse.v1.OrderSectionsRequest.forbidden_joins" => limits.rule_count(),
            // A ring has at least one vertex.
            _ => limits.vertex_count,
        };
        if seen > limit { Err(too_many(step.path(), step.field.name(), limit)) } else { Ok(()) }
    }
}

fn too_many(path: String, what: &str, limit: usize) -> Stop {
    let message =
        format!("more than {limit} {what} given, at most {limit} permitted; send fewer or split the request");
    Stop::TooMany(Finding::new(path, Reason::TooMany, format!("more than {limit}"), message))
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (taken, rest) = bytes.split_at_checked(count)?;
    *bytes = rest;
    Some(taken)
}

fn varint(bytes: &mut &[u8]) -> Option<u64> {
    let mut value = 0;
    for shift in (0..70).step_by(7) {
        let byte = *take(bytes, 1)?.first()?;
        value |= u64::from(byte & 0x7f).checked_shl(shift).unwrap_or(0);
        if byte & 0x80 == 0 {
            return Some(value);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Procedure, v1};
    use prost::Message;

    fn check(request: &v1::PlanRapidMoveRequest, limits: &Limits) -> Result<(), Refused> {
        let input = Procedure::named("PlanRapidMove").expect("in the contract").input();
        check_counts(&input, &request.encode_to_vec(), limits)
    }

    #[test]
    fn counts_are_known_before_decoding() {
        let limits = Limits { obstacle_count: 3, vertex_count: 5, ..Limits::default() };
        let holes = vec![v1::Ring::default(); 2];
        let shape = v1::Polygon { outer: None, holes };
        let obstacle = v1::Obstacle { shape: Some(shape), ..Default::default() };
        let request = |count| v1::PlanRapidMoveRequest {
            scene: Some(v1::Scene { obstacles: vec![obstacle.clone(); count], ..Default::default() }),
            ..Default::default()
        };
        assert_eq!(check(&request(2), &limits), Ok(()));
        for (count, limits, field) in [
            (4, Limits { obstacle_count: 3, ..Limits::default() }, "scene.obstacles"),
            (4, Limits { vertex_count: 5, ..Limits::default() }, "scene.obstacles.shape.holes"),
        ] {
            let refused = check(&request(count), &limits).unwrap_err();
            let fields: Vec<&str> = refused.findings().iter().map(|finding| finding.field.as_str()).collect();
            assert_eq!(fields, [field]);
        }
    }

    #[test]
    fn a_field_that_is_no_list_can_not_be_repeated_without_end() {
        let empty_scenes = [0x0a, 0x00].repeat(1_000_000);
        let input = Procedure::named("PlanRapidMove").expect("in the contract").input();
        let refused = check_counts(&input, &empty_scenes, &Limits::default()).unwrap_err();
        assert_eq!(refused.findings().first().map(|finding| finding.field.as_str()), Some("scene"));
    }

    #[test]
    fn hostile_bytes_are_left_to_the_decoder() {
        let input = Procedure::named("CheckRapidMove").expect("in the contract").input();
        for bytes in
            [&[0x0a, 0xff, 0xff, 0xff, 0xff, 0x0f][..], &[0xff; 40], &[0x0b, 0x0c], &[0x0a, 0x05, 0x01]]
        {
            assert_eq!(check_counts(&input, bytes, &Limits::default()), Ok(()));
        }
    }
}
