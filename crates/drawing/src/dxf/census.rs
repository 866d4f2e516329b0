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

/// Header variables that are read.
const READ_VARIABLES: [&str; 3] = ["$ACADVER", "$DWGCODEPAGE", "$INSUNITS"];

/// What a file holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Census {
    /// Bytes of what is read, in file order: the frame of HEADER and ENTITIES, and in them what is named above.
    pub(super) wanted: Vec<Range<usize>>,
    /// Entities by layer and type.
    pub(super) counts: BTreeMap<(String, String), usize>,
    /// Whether codes take two bytes in a binary file.
    pub(super) two_byte_codes: bool,
}

/// The section that is being read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Section {
    Header,
    Entities,
    Other,
}

/// The entity or header variable that is being read.
#[derive(Debug)]
struct Record {
    start: usize,
    name: String,
    layer: String,
    wanted: bool,
    counts: bool,
}

impl Census {
    /// How many entities of that type there are on all layers.
    pub(super) fn count_of(&self, entity: &str) -> usize {
        self.counts.iter().filter(|((_, name), _)| name == entity).map(|(_, count)| count).sum()
    }

    fn keep(&mut self, bytes: Range<usize>) {
        match self.wanted.last_mut() {
            Some(last) if last.end == bytes.start => last.end = bytes.end,
            _ => self.wanted.push(bytes),
        }
    }

    fn close(&mut self, record: Option<Record>, end: usize) {
        let Some(record) = record else { return };
        if record.wanted {
            self.keep(record.start..end);
        }
        if record.counts {
            *self.counts.entry((record.layer, record.name)).or_default() += 1;
        }
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
    let mut section: Option<Section> = None;
    let mut record: Option<Record> = None;
    loop {
        let group = groups.next_group()?;
        let variable = group.code == 9 && section == Some(Section::Header);
        if group.code == 0 || variable {
            census.close(record.take(), group.at);
        }
        if variable {
            let name = group.text();
            let wanted = READ_VARIABLES.contains(&name.as_str());
            record = Some(Record { start: group.at, name, layer: String::new(), wanted, counts: false });
        } else if group.opens("EOF") {
            return if section.is_none() { Ok(census) } else { Err(unexpected(&group, "ENDSEC")) };
        } else if group.opens("SECTION") {
            let name = groups.next_group()?;
            if section.is_some() || name.code != 2 {
                return Err(unexpected(&group, "the end of the section before"));
            }
            section = Some(match name.value {
                b"HEADER" => Section::Header,
                b"ENTITIES" => Section::Entities,
                _ => Section::Other,
            });
            if section != Some(Section::Other) {
                census.keep(group.at..groups.position());
            }
        } else if group.opens("ENDSEC") {
            match section.take() {
                None => return Err(unexpected(&group, "SECTION")),
                Some(Section::Other) => {}
                Some(_) => census.keep(group.at..groups.position()),
            }
        } else if group.code == 0 && section.is_none() {
            return Err(unexpected(&group, "SECTION"));
        } else if group.code == 0 && section == Some(Section::Entities) {
            entities += 1;
            if entities > options.entity_limit {
                return Err(ReadError::TooManyEntities { limit: options.entity_limit });
            }
            let name = group.text().to_ascii_uppercase();
            let wanted = READ_TYPES.contains(&name.as_str());
            let counts = !CONTINUATIONS.contains(&name.as_str());
            record = Some(Record { start: group.at, name, layer: String::from("0"), wanted, counts });
        } else if let Some(record) = &mut record {
            if group.code == 8 {
                record.layer = group.text();
            } else if record.wanted {
                check_number(&group, spelling)?;
                vertices += usize::from(group.code == 10);
                if vertices > options.vertex_limit {
                    return Err(ReadError::TooManyVertices { limit: options.vertex_limit });
                }
            }
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
