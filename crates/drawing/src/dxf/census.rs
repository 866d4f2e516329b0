//! What a DXF file holds, counted group by group before anything is built from it.

use super::groups::{Group, Groups};
use super::sniff::Spelling;
use crate::{ReadError, ReadOptions};
use std::collections::BTreeMap;
use std::ops::Range;

/// Entity types that are read.
pub(super) const READ_TYPES: [&str; 4] = ["LINE", "ARC", "CIRCLE", "LWPOLYLINE"];

/// Types that a machine can't meet.
pub(super) const ANNOTATION_TYPES: [&str; 15] = [
    "ARC_DIMENSION",
    "ATTDEF",
    "DIMENSION",
    "LARGE_RADIAL_DIMENSION",
    "LEADER",
    "LIGHT",
    "MLEADER",
    "MTEXT",
    "MULTILEADER",
    "POINT",
    "RAY",
    "TEXT",
    "TOLERANCE",
    "VIEWPORT",
    "XLINE",
];

/// Types that only continue the entity before them.
const CONTINUATIONS: [&str; 3] = ["VERTEX", "SEQEND", "ATTRIB"];

/// What a file holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Census {
    /// Bytes of the HEADER and ENTITIES sections, in file order.
    pub(super) sections: Vec<Range<usize>>,
    /// Entities by layer and type.
    pub(super) counts: BTreeMap<(String, String), usize>,
    /// Whether codes take two bytes in a binary file.
    pub(super) two_byte_codes: bool,
}

impl Census {
    /// How many entities of that type there are on all layers.
    pub(super) fn count_of(&self, entity: &str) -> usize {
        self.counts.iter().filter(|((_, name), _)| name == entity).map(|(_, count)| count).sum()
    }
}

/// Counts a file's entities and checks that it is whole.
pub(super) fn take_census(
    bytes: &[u8],
    spelling: Spelling,
    options: &ReadOptions,
) -> Result<Census, ReadError> {
    let mut groups = Groups::new(bytes, spelling);
    let mut census = Census { two_byte_codes: groups.two_byte_codes, ..Census::default() };
    let (mut entities, mut vertices) = (0, 0);
    // The section that is being read: where it began, and whether it is wanted and is ENTITIES.
    let mut section: Option<(usize, bool, bool)> = None;
    let mut record: Option<(String, String)> = None;
    loop {
        let group = groups.next_group()?;
        if group.code == 0 {
            census.close(record.take());
        }
        if group.opens("EOF") {
            return if section.is_none() { Ok(census) } else { Err(unexpected(&group, "ENDSEC")) };
        } else if group.opens("SECTION") {
            let name = groups.next_group()?;
            if section.is_some() || name.code != 2 {
                return Err(unexpected(&group, "the end of the section before"));
            }
            let is_entities = name.value == b"ENTITIES";
            section = Some((group.at, is_entities || name.value == b"HEADER", is_entities));
        } else if group.opens("ENDSEC") {
            let Some((start, wanted, _)) = section.take() else { return Err(unexpected(&group, "SECTION")) };
            if wanted {
                census.sections.push(start..groups.position());
            }
        } else if group.code == 0 && matches!(section, Some((_, _, true))) {
            entities += 1;
            if entities > options.entity_limit {
                return Err(ReadError::TooManyEntities { limit: options.entity_limit });
            }
            let name = group.text().to_ascii_uppercase();
            record = (!CONTINUATIONS.contains(&name.as_str())).then(|| (String::from("0"), name));
        } else if group.code == 0 && section.is_none() {
            return Err(unexpected(&group, "SECTION"));
        } else if let Some((layer, entity)) = &mut record {
            if group.code == 8 {
                *layer = group.text();
            } else if READ_TYPES.contains(&entity.as_str()) {
                check_number(&group, spelling)?;
                vertices += usize::from(group.code == 10);
                if vertices > options.vertex_limit {
                    return Err(ReadError::TooManyVertices { limit: options.vertex_limit });
                }
            }
        }
    }
}

impl Census {
    fn close(&mut self, record: Option<(String, String)>) {
        if let Some(key) = record {
            *self.counts.entry(key).or_default() += 1;
        }
    }
}

/// The `dxf` crate ends the section at a number that it can't read: such a file is refused, with the line.
fn check_number(group: &Group<'_>, spelling: Spelling) -> Result<(), ReadError> {
    let text = || std::str::from_utf8(group.value).unwrap_or_default();
    let readable = match group.code {
        _ if spelling != Spelling::Ascii => true,
        10..=59 | 210..=239 => text().parse::<f64>().is_ok(),
        60..=79 => text().parse::<i16>().is_ok(),
        90..=99 => text().parse::<i32>().is_ok(),
        _ => true,
    };
    if readable {
        return Ok(());
    }
    let shown: String = group.text().chars().take(40).collect();
    let message = format!("group {} should hold a number but holds `{shown}`", group.code);
    Err(ReadError::Malformed { line: group.line, message })
}

fn unexpected(group: &Group<'_>, expected: &str) -> ReadError {
    let shown: String = group.text().chars().take(40).collect();
    ReadError::Malformed { line: group.line, message: format!("{expected} was expected but 0/{shown} found") }
}
