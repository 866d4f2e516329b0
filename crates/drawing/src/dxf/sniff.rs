//! Which kind of file this is, by its first bytes.

use crate::ReadError;

/// How a DXF file spells its groups.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spelling {
    /// Two lines of text per group.
    Ascii,
    /// Binary; the groups begin at this byte.
    Binary {
        /// After the sentinel.
        groups_at: usize,
    },
}

const BINARY_SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// Refuses what is no DXF file, saying what it looks like.
pub(super) fn sniff(bytes: &[u8]) -> Result<Spelling, ReadError> {
    if bytes.starts_with(BINARY_SENTINEL) {
        return Ok(Spelling::Binary { groups_at: BINARY_SENTINEL.len() });
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    if text.is_empty() {
        return Err(ReadError::Empty);
    }
    if is_utf_16(bytes) {
        return Err(ReadError::NotDxf { found: "text in UTF-16, which DXF never is" });
    }
    let first_line = text.split(|&b| b == b'\n').next().unwrap_or_default().trim_ascii();
    if std::str::from_utf8(first_line).is_ok_and(|line| line.parse::<u16>().is_ok()) {
        return Ok(Spelling::Ascii);
    }
    let start = text[..text.len().min(512)].to_ascii_lowercase();
    let holds = |mark: &[u8]| start.windows(mark.len()).any(|window| window == mark);
    let found = if start.starts_with(b"<!doctype html") || holds(b"<html") {
        "a web page (HTML)"
    } else if holds(b"<svg") {
        "an SVG drawing"
    } else if start.starts_with(b"<") {
        "an XML file"
    } else if start.starts_with(b"ac10") {
        "a DWG drawing"
    } else if start.starts_with(b"autocad binary dxf") {
        "a damaged binary DXF file"
    } else if start.starts_with(b"autocad dxb") {
        "a DXB drawing"
    } else if start.starts_with(b"%pdf") {
        "a PDF file"
    } else if start.starts_with(b"pk\x03\x04") || start.starts_with(b"\x1f\x8b") {
        "a compressed archive"
    } else if start.iter().any(|&b| b == 0 || b >= 0xf8) {
        "binary data"
    } else {
        "some other text"
    };
    Err(ReadError::NotDxf { found })
}

/// By its mark, or by every second byte of its first letters being zero.
fn is_utf_16(bytes: &[u8]) -> bool {
    let letter = |b: u8| b.is_ascii_graphic() || b.is_ascii_whitespace();
    match bytes {
        [0xff, 0xfe, _, second, ..] => *second < 0x20,
        [0xfe, 0xff, first, ..] => *first < 0x20,
        [a, 0, b, 0, c, 0, ..] | [0, a, 0, b, 0, c, ..] => letter(*a) && letter(*b) && letter(*c),
        _ => false,
    }
}
