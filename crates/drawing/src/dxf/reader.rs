//! From the bytes of a DXF file to a drawing.

use super::census::{ANNOTATION_TYPES, Census, READ_TYPES, take_census};
use super::entity::{Taken, take_entity};
use super::sniff::{Spelling, sniff};
use crate::{Drawing, Layer, LengthUnit, ReadError, ReadOptions, Unused, WhyUnused};
use std::collections::{BTreeMap, HashMap};
use std::io::{Cursor, Read};

/// Reads a DXF file, ASCII or binary, R12 to R2018: LINE, ARC, CIRCLE and LWPOLYLINE in model space, on every layer
/// whether switched on, off or frozen. Everything else is counted in [`Drawing::unused`].
///
/// Lines and arcs are taken as seen from above: z is ignored. Contents of blocks are not read; an INSERT is counted
/// as unused.
///
/// # Errors
/// When the bytes are no whole DXF file, or one beyond the limits. See [`ReadError`].
pub fn read_dxf(bytes: &[u8], options: &ReadOptions) -> Result<Drawing, ReadError> {
    if bytes.len() as u64 > options.byte_limit {
        return Err(ReadError::TooLong { limit: options.byte_limit });
    }
    let spelling = sniff(bytes)?;
    let census = take_census(bytes, spelling, options)?;
    let wanted = wanted_file(bytes, spelling, &census);
    let file = dxf::Drawing::load(&mut Cursor::new(wanted))
        .map_err(|error| ReadError::Library { message: error.to_string() })?;

    let stated = LengthUnit::from_insunits(file.header.default_drawing_units as i16);
    let unit = stated.unwrap_or(options.default_unit);
    let mut layers = Layers::default();
    let mut unused: BTreeMap<(String, String, WhyUnused), usize> = BTreeMap::new();
    let mut delivered: BTreeMap<&'static str, usize> = BTreeMap::new();
    for entity in file.entities() {
        let layer = layer_name(&entity.common.layer, spelling);
        let (name, taken) = match take_entity(entity, unit.millimetres)? {
            Taken::Curve(name, curve) => {
                layers.of(&layer).curves.push(curve);
                (name, None)
            }
            Taken::Unusable(name, why) => (name, Some(why)),
            Taken::OtherType => continue,
        };
        *delivered.entry(name).or_default() += 1;
        if let Some(why) = taken {
            *unused.entry((layer, name.to_owned(), why)).or_default() += 1;
        }
    }
    for name in READ_TYPES {
        let (found, read) = (census.count_of(name), delivered.get(name).copied().unwrap_or(0));
        if found != read {
            let message = format!("of {found} {name} entities {read} were read");
            return Err(ReadError::Library { message });
        }
    }
    for ((layer, entity), count) in census.counts {
        if !READ_TYPES.contains(&entity.as_str()) {
            let annotation = ANNOTATION_TYPES.contains(&entity.as_str());
            let why = if annotation { WhyUnused::Annotation } else { WhyUnused::Type };
            *unused.entry((layer, entity, why)).or_default() += count;
        }
    }
    let unused = unused
        .into_iter()
        .map(|((layer, entity, why), count)| Unused { layer, entity, why, count })
        .collect();
    Ok(Drawing { unit, unit_assumed: stated.is_none(), layers: layers.list, unused, mapping: None })
}

/// Reads a DXF file from a reader, up to the byte limit. See [`read_dxf`].
///
/// # Errors
/// When reading fails, and as [`read_dxf`].
pub fn read_dxf_from(reader: impl Read, options: &ReadOptions) -> Result<Drawing, ReadError> {
    let mut bytes = Vec::new();
    reader
        .take(options.byte_limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|error| ReadError::Io { message: error.to_string() })?;
    read_dxf(&bytes, options)
}

/// The `dxf` crate takes each byte of a binary file's text for a letter: what was UTF-8 is made UTF-8 again.
fn layer_name(name: &str, spelling: Spelling) -> String {
    let name = name.trim();
    if spelling != Spelling::Ascii {
        let bytes: Result<Vec<u8>, _> = name.chars().map(u8::try_from).collect();
        if let Some(text) = bytes.ok().and_then(|bytes| String::from_utf8(bytes).ok()) {
            return text;
        }
    }
    name.to_owned()
}

/// A file of what is read, and nothing else: what else there is (previews, hatches, styles) can do no harm, and takes no
/// memory.
fn wanted_file(bytes: &[u8], spelling: Spelling, census: &Census) -> Vec<u8> {
    let mut wanted = Vec::with_capacity(bytes.len().min(1 << 20));
    if let Spelling::Binary { groups_at } = spelling {
        wanted.extend_from_slice(&bytes[..groups_at]);
    }
    for range in &census.wanted {
        wanted.extend_from_slice(&bytes[range.clone()]);
    }
    wanted.extend_from_slice(match spelling {
        Spelling::Ascii => b"0\nEOF\n".as_slice(),
        Spelling::Binary { .. } if census.two_byte_codes => b"\0\0EOF\0",
        Spelling::Binary { .. } => b"\0EOF\0",
    });
    wanted
}

/// Layers by name, upper and lower case alike, in the order of their first entity.
#[derive(Default)]
struct Layers {
    list: Vec<Layer>,
    places: HashMap<String, usize>,
}

impl Layers {
    fn of(&mut self, name: &str) -> &mut Layer {
        let next = self.list.len();
        let place = *self.places.entry(name.to_lowercase()).or_insert(next);
        if place == next {
            self.list.push(Layer { name: name.to_owned(), curves: Vec::new() });
        }
        &mut self.list[place]
    }
}
