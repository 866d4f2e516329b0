//! A drawing file of any format that is read.

use crate::dxf::read_dxf;
use crate::sniff::{Looks, looks_like};
use crate::svg::{is_utf16, read_svg};
use crate::{Drawing, ReadError, ReadOptions};
use std::io::Read;

/// Reads a DXF or SVG file; its content says which, not its name. See [`crate::read_dxf`] and [`crate::read_svg`].
///
/// # Errors
/// When the bytes are neither, and as the readers of both.
pub fn read_drawing(bytes: &[u8], options: &ReadOptions) -> Result<Drawing, ReadError> {
    match looks_like(bytes) {
        Looks::Dxf | Looks::DamagedBinaryDxf => read_dxf(bytes, options),
        Looks::Svg | Looks::Xml => read_svg(bytes, options),
        Looks::Other(_) if is_utf16(bytes) => {
            Err(ReadError::NotDrawing { found: "some other text in UTF-16" })
        }
        _ if bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii().is_empty() => {
            Err(ReadError::Empty)
        }
        other => Err(ReadError::NotDrawing { found: other.name() }),
    }
}

/// Reads a DXF or SVG file from a reader, up to the byte limit. See [`read_drawing`].
///
/// # Errors
/// When reading fails, and as [`read_drawing`].
pub fn read_drawing_from(reader: impl Read, options: &ReadOptions) -> Result<Drawing, ReadError> {
    read_drawing(&bytes_up_to_limit(reader, options)?, options)
}

/// What the reader gives, one byte beyond the limit at most.
pub(crate) fn bytes_up_to_limit(reader: impl Read, options: &ReadOptions) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    reader
        .take(options.byte_limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|error| ReadError::Io { message: error.to_string() })?;
    if bytes.len() as u64 > options.byte_limit {
        return Err(ReadError::TooLong { limit: options.byte_limit });
    }
    Ok(bytes)
}
