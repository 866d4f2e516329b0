//! Part sets of the cutting and packing literature as JSON (the ESICUP collection and others): pieces with a demand and allowed
//! turns, and the height of the strip.
//!
//! `{"name", "strip_height", "items": [{"id", "demand", "allowed_orientations": [degrees], "shape": {"data": [[x, y], …]}}]}`;
//! unknown fields are passed over. Winding is free, the last vertex may repeat the first.

use serde::Deserialize;
use traverse_geometry::{Motion, Polygon, Ring};

/// Longest file that is read, bytes.
const BYTE_LIMIT: usize = 16 << 20;
/// Most pieces of a set, demand counted.
const PIECE_LIMIT: u64 = 100_000;

/// A set of pieces to be cut out of a strip.
#[derive(Clone, Debug, PartialEq)]
pub struct PartSet {
    /// As the file says; may be empty.
    pub name: String,
    /// Fixed extent of the strip in y, in the unit of the file, which counts as millimetres.
    pub strip_height_mm: f64,
    /// The kinds of pieces.
    pub pieces: Vec<Piece>,
}

/// A kind of piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Unique in the set.
    pub id: String,
    /// How many are wanted, at least 1.
    pub demand: u32,
    /// How it may be turned, degrees. Absent: in any way.
    pub orientations_deg: Option<Vec<f64>>,
    /// Its outline, the lower left corner of its box at the origin.
    pub shape: Polygon,
}

/// Why a part set can't be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PartSetError {
    /// Longer than it may be.
    #[error("the part set is longer than {BYTE_LIMIT} bytes; split it")]
    TooLong,
    /// No JSON of a part set.
    #[error(
        "this is no part set: {message}; send JSON with strip_height and items, each with demand and shape.data"
    )]
    Malformed {
        /// What is wrong, and where.
        message: String,
    },
    /// A value that can't be used.
    #[error("{field}: {message}")]
    Value {
        /// Such as `items[3].shape.data`.
        field: String,
        /// What is wrong and what to do.
        message: String,
    },
}

#[derive(Deserialize)]
struct WireSet {
    #[serde(default)]
    name: String,
    strip_height: f64,
    items: Vec<WireItem>,
}

#[derive(Deserialize)]
struct WireItem {
    id: Option<WireId>,
    demand: Option<u32>,
    allowed_orientations: Option<Vec<f64>>,
    shape: WireShape,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum WireId {
    Number(u64),
    Text(String),
}

#[derive(Deserialize)]
struct WireShape {
    data: Vec<[f64; 2]>,
}

/// Reads a part set.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn read_part_set(bytes: &[u8]) -> Result<PartSet, PartSetError> {
    if bytes.len() > BYTE_LIMIT {
        return Err(PartSetError::TooLong);
    }
    let mut reader = serde_json::Deserializer::from_slice(bytes);
    let malformed = |message: String| PartSetError::Malformed { message };
    let wire: WireSet =
        serde_path_to_error::deserialize(&mut reader).map_err(|error| malformed(error.to_string()))?;
    reader.end().map_err(|error| malformed(error.to_string()))?;
    let value = |field: &str, message: String| PartSetError::Value { field: field.to_owned(), message };
    if !(wire.strip_height.is_finite() && wire.strip_height > 0.0) {
        return Err(value(
            "strip_height",
            format!("{} is no height; send a number above 0", wire.strip_height),
        ));
    }
    if wire.items.is_empty() {
        return Err(value("items", "there are none; send at least one".to_owned()));
    }
    let total: u64 = wire.items.iter().map(|item| u64::from(item.demand.unwrap_or(1))).sum();
    if total > PIECE_LIMIT {
        return Err(value(
            "items",
            format!("{total} pieces are wanted, at most {PIECE_LIMIT} can be; split the set"),
        ));
    }
    let pieces = wire.items.into_iter().enumerate().map(|(index, item)| piece(index, item));
    let pieces: Vec<Piece> = pieces.collect::<Result<_, _>>()?;
    let mut ids: Vec<&str> = pieces.iter().map(|piece| piece.id.as_str()).collect();
    ids.sort_unstable();
    if let Some(pair) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(value("items", format!("the id {} stands for two items; send each once", pair[0])));
    }
    Ok(PartSet { name: wire.name, strip_height_mm: wire.strip_height, pieces })
}

fn piece(index: usize, item: WireItem) -> Result<Piece, PartSetError> {
    let field = |name: &str| format!("items[{index}].{name}");
    let id = match item.id {
        None => index.to_string(),
        Some(WireId::Number(number)) => number.to_string(),
        Some(WireId::Text(text)) => text,
    };
    let demand = item.demand.unwrap_or(1);
    if demand == 0 {
        let message = "it is 0; leave the item out, or ask for 1 or more".to_owned();
        return Err(PartSetError::Value { field: field("demand"), message });
    }
    if let Some(angle) = item.allowed_orientations.iter().flatten().find(|angle| !angle.is_finite()) {
        let message = format!("{angle} is no angle; send degrees");
        return Err(PartSetError::Value { field: field("allowed_orientations"), message });
    }
    let mut vertices = item.shape.data;
    if vertices.len() > 1 && vertices.first() == vertices.last() {
        vertices.pop();
    }
    let ring = Ring::from_xy(&vertices.concat(), &[]).map_err(|findings| {
        let why = findings.first().map(ToString::to_string).unwrap_or_default();
        PartSetError::Value { field: field("shape.data"), message: why }
    })?;
    let shape = Polygon::from_ring(ring);
    let shape = shape.moved(&Motion::translation(-shape.bounds().min.coords));
    let orientations_deg = item.allowed_orientations.filter(|angles| !angles.is_empty());
    Ok(Piece { id, demand, orientations_deg, shape })
}
