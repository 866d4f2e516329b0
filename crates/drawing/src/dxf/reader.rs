//! From the bytes of a DXF file to a drawing.

use super::explode::explode;
use super::file::read_file;
use super::sniff::sniff;
use super::totals::check_totals;
use crate::{Drawing, ReadError, ReadOptions};
use std::io::Read;

/// Reads a DXF file, ASCII or binary, R12 to R2018: LINE, ARC, CIRCLE, ELLIPSE, LWPOLYLINE, POLYLINE and SPLINE in
/// model space, on every layer whether switched on, off or frozen, and in blocks as often as INSERT draws them.
/// Everything else is counted in [`Drawing::unused`].
///
/// All is taken as seen from above: what climbs is counted and read so, and what faces down (extrusion −Z) is mirrored.
/// Of a polyline with a width the centre line is read, and the width is counted as lost. Things on layer 0 of
/// a block lie on the layer of the INSERT. Ellipses, splines, and arcs in blocks that are stretched more one way become
/// arcs and segments within [`ReadOptions::fit_tolerance_mm`]. Limits count the entities and vertices that come out,
/// with one entity for every block that is drawn.
///
/// # Errors
/// When the bytes are no whole DXF file, or one beyond the limits. See [`ReadError`].
pub fn read_dxf(bytes: &[u8], options: &ReadOptions) -> Result<Drawing, ReadError> {
    if bytes.len() as u64 > options.byte_limit {
        return Err(ReadError::TooLong { limit: options.byte_limit });
    }
    let file = read_file(bytes, sniff(bytes)?, options)?;
    check_totals(&file.blocks, options)?;
    let unit = file.unit.unwrap_or(options.default_unit);
    let (layers, unused) = explode(&file, unit.millimetres, options)?;
    Ok(Drawing { unit, unit_assumed: file.unit.is_none(), layers, unused, mapping: None })
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
