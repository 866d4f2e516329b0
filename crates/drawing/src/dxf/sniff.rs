//! Which kind of file this is, by its first bytes.

use crate::ReadError;
use crate::sniff::{begins_with_group_code, looks_like};

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
    if begins_with_group_code(text) {
        return Ok(Spelling::Ascii);
    }
    Err(ReadError::NotDxf { found: looks_like(bytes).name() })
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
