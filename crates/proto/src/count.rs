//! Counts what an encoded message holds before it is decoded.
//!
//! An empty obstacle is two bytes on the wire and a hundred in memory: decoding first and counting afterwards would let
//! a message at the size limit claim fifty times its size. One pass over the bytes, no allocation per item.

use crate::{Limits, Refused};
use prost_reflect::{Kind, MessageDescriptor};
use traverse_geometry::{Finding, Reason};

/// Deeper messages than this are left to the decoder, which refuses them.
const DEPTH: usize = 50;

/// Refuses an encoded message that holds more items than `limits` permit. Bytes that are not a message pass: the decoder says
/// what is wrong with them.
///
/// # Errors
/// One finding for each field that holds too many.
pub fn check_counts(message: &MessageDescriptor, bytes: &[u8], limits: &Limits) -> Result<(), Refused> {
    let mut tally = Tally { limits, counts: Vec::new() };
    // A malformed message ends the count early.
    let _ = tally.message(message, bytes, "", DEPTH);
    let findings: Vec<Finding> = tally.counts.iter().filter_map(Count::finding).collect();
    if findings.is_empty() { Ok(()) } else { Err(Refused::findings_of(findings)) }
}

struct Count {
    full_name: String,
    path: String,
    seen: usize,
    limit: usize,
}

impl Count {
    fn finding(&self) -> Option<Finding> {
        (self.seen > self.limit).then(|| {
            let message = format!("{} given, at most {} permitted: send fewer or split the request", self.seen, self.limit);
            Finding::new(self.path.clone(), Reason::TooMany, self.seen, message)
        })
    }
}

struct Tally<'a> {
    limits: &'a Limits,
    counts: Vec<Count>,
}

impl Tally<'_> {
    fn message(&mut self, message: &MessageDescriptor, mut bytes: &[u8], path: &str, depth: usize) -> Option<()> {
        let depth = depth.checked_sub(1)?;
        while !bytes.is_empty() {
            let key = varint(&mut bytes)?;
            match key & 7 {
                0 => drop(varint(&mut bytes)?),
                1 => drop(take(&mut bytes, 8)?),
                5 => drop(take(&mut bytes, 4)?),
                2 => {
                    let length = usize::try_from(varint(&mut bytes)?).ok()?;
                    let inner = take(&mut bytes, length)?;
                    let field = message.get_field(u32::try_from(key >> 3).ok()?);
                    if let Some((field, Kind::Message(kind))) = field.map(|field| (field.clone(), field.kind())) {
                        let path = if path.is_empty() { field.name().to_owned() } else { format!("{path}.{}", field.name()) };
                        if field.is_list() {
                            self.count(field.full_name(), &path);
                        }
                        self.message(&kind, inner, &path, depth)?;
                    }
                }
                _ => return None,
            }
        }
        Some(())
    }

    fn count(&mut self, full_name: &str, path: &str) {
        if let Some(count) = self.counts.iter_mut().find(|count| count.full_name == full_name) {
            count.seen += 1;
            return;
        }
        let limit = match full_name {
            "traverse.v1.Scene.obstacles" => self.limits.obstacle_count,
            "traverse.v1.Path.steps" => self.limits.step_count,
            // A ring has at least one vertex.
            _ => self.limits.vertex_count,
        };
        self.counts.push(Count { full_name: full_name.to_owned(), path: path.to_owned(), seen: 1, limit });
    }
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
        let refused = check(&request(4), &limits).unwrap_err();
        let fields: Vec<&str> = refused.findings().iter().map(|finding| finding.field.as_str()).collect();
        assert_eq!(fields, ["scene.obstacles", "scene.obstacles.shape.holes"]);
    }

    #[test]
    fn hostile_bytes_are_left_to_the_decoder() {
        let input = Procedure::named("CheckRapidMove").expect("in the contract").input();
        for bytes in [&[0x0a, 0xff, 0xff, 0xff, 0xff, 0x0f][..], &[0xff; 40], &[0x0b, 0x0c], &[0x0a, 0x05, 0x01]] {
            assert_eq!(check_counts(&input, bytes, &Limits::default()), Ok(()));
        }
    }
}
