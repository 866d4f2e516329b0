//! Refusals of items of a larger call.

use crate::text::shortened;
use crate::{Refused, v1};
use traverse_geometry::Finding;

/// Longest value that a finding repeats, bytes.
const VALUE_BYTES: usize = 400;

/// A refusal as an item of an answer carries it, with every finding. `parent` is where the item's fields stand, empty or
/// ending in a dot; findings of values have their whole paths already.
#[must_use]
pub fn problem(refused: &Refused, parent: &str) -> v1::Problem {
    let at = |field: &str, reason: &str, message: String| v1::Finding {
        field: format!("{parent}{field}"),
        reason: reason.to_owned(),
        message,
        value: String::new(),
    };
    let findings = match refused {
        Refused::InvalidRequest { findings } => findings.iter().map(finding).collect(),
        Refused::EndInsideBarrier { ends } => {
            ends.iter().map(|end| at(&end.field, refused.reason(), end.to_string())).collect()
        }
        Refused::EndShutIn { ends, inside } => {
            let shut_in = ends.iter().map(|end| at(&end.field, refused.reason(), end.to_string()));
            let inside = inside.iter().map(|end| at(&end.field, "END_INSIDE_BARRIER", end.to_string()));
            shut_in.chain(inside).collect()
        }
        Refused::PublishedMethodNotApplicable { .. } => {
            vec![at("rules.algorithm", refused.reason(), refused.message())]
        }
        Refused::NoRoomForDogLegs => vec![at("rules.motion", refused.reason(), refused.message())],
        _ => Vec::new(),
    };
    v1::Problem {
        code: refused.code().into(),
        reason: refused.reason().to_owned(),
        message: shortened(&refused.message(), 2 * VALUE_BYTES),
        findings,
    }
}

fn finding(finding: &Finding) -> v1::Finding {
    v1::Finding {
        field: shortened(&finding.field, VALUE_BYTES),
        reason: finding.reason.as_str().to_owned(),
        message: shortened(&finding.message, 2 * VALUE_BYTES),
        value: shortened(&finding.value, VALUE_BYTES),
    }
}
