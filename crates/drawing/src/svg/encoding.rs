//! From bytes to text.

use crate::ReadError;
use std::borrow::Cow;

/// Whether the bytes begin with a mark of UTF-16.
pub(crate) fn is_utf16(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff")
}

/// The text of an XML file: UTF-8, UTF-16 with a byte order mark, or Latin-1 when it says so.
pub(super) fn decoded(bytes: &[u8]) -> Result<Cow<'_, str>, ReadError> {
    if is_utf16(bytes) {
        let little = bytes[0] == 0xff;
        let units = bytes[2..].chunks_exact(2).map(|pair| {
            let pair = [pair[0], pair[1]];
            if little { u16::from_le_bytes(pair) } else { u16::from_be_bytes(pair) }
        });
        let text: Result<String, _> = char::decode_utf16(units).collect();
        return text.map(Cow::Owned).map_err(|_| malformed(1, "its UTF-16 is damaged"));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(Cow::Borrowed(text)),
        Err(_) if says_latin_1(bytes) => Ok(Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect())),
        Err(error) => {
            let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
            Err(malformed(line, "its text is not UTF-8"))
        }
    }
}

fn says_latin_1(bytes: &[u8]) -> bool {
    let start = bytes[..bytes.len().min(200)].to_ascii_lowercase();
    let declaration = start.split(|&b| b == b'>').next().unwrap_or_default();
    [b"iso-8859-1".as_slice(), b"windows-1252", b"latin1"]
        .iter()
        .any(|name| declaration.windows(name.len()).any(|window| window == *name))
}

fn malformed(line: usize, message: &str) -> ReadError {
    ReadError::Malformed { line, message: message.to_owned() }
}
