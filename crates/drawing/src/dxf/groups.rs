//! The groups of a DXF file: a code and a value each. Cost: linear, no copies.

use super::sniff::Spelling;
use crate::ReadError;
use std::num::NonZeroU64;

/// A code and its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<'a> {
    pub(super) code: i32,
    /// Text without line end and blanks; of a binary file's numbers their bytes.
    pub(super) value: &'a [u8],
    /// Line of the value, counted from 1; 0 in a binary file.
    pub(super) line: usize,
    /// Whether numbers are bytes, not text.
    binary: bool,
}

/// Runs through the groups of a file.
#[derive(Clone, Debug)]
pub(super) struct Groups<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    spelling: Spelling,
    /// Binary files since R13 spell codes with two bytes.
    two_byte_codes: bool,
    /// A group that was read but belongs to the next record.
    ahead: Option<Group<'a>>,
}

impl<'a> Groups<'a> {
    pub(super) fn new(bytes: &'a [u8], spelling: Spelling) -> Self {
        let (at, two_byte_codes) = match spelling {
            Spelling::Ascii => (if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 }, false),
            // The first group is 0/SECTION: a second zero byte belongs to the code.
            Spelling::Binary { groups_at } => (groups_at, bytes.get(groups_at + 1) == Some(&0)),
        };
        Self { bytes, at, line: 0, spelling, two_byte_codes, ahead: None }
    }

    /// The next group. The end of the file is an error: a whole file ends with 0/EOF.
    pub(super) fn next_group(&mut self) -> Result<Group<'a>, ReadError> {
        if let Some(group) = self.ahead.take() {
            return Ok(group);
        }
        let (binary, (code, value)) = match self.spelling {
            Spelling::Ascii => (false, self.text_group()?),
            Spelling::Binary { .. } => (true, self.binary_group()?),
        };
        Ok(Group { code, value, line: self.line, binary })
    }

    /// The next group of the record that is being read; none at the group that ends it, which comes next.
    pub(super) fn next_in_record(&mut self) -> Result<Option<Group<'a>>, ReadError> {
        let group = self.next_group()?;
        if group.code == 0 {
            self.put_back(group);
            return Ok(None);
        }
        Ok(Some(group))
    }

    /// Lets a group that was read come next once more.
    pub(super) fn put_back(&mut self, group: Group<'a>) {
        self.ahead = Some(group);
    }

    fn text_group(&mut self) -> Result<(i32, &'a [u8]), ReadError> {
        let line = self.text_line()?;
        let code = std::str::from_utf8(line).ok().and_then(|text| text.parse().ok());
        let Some(code) = code.filter(|&code| value_kind(code).is_some()) else {
            if self.bytes[self.at..].trim_ascii().is_empty() {
                return Err(ReadError::Truncated { line: self.line });
            }
            let text: String = String::from_utf8_lossy(line).chars().take(40).collect();
            let message = format!("a group code was expected but `{text}` found");
            return Err(ReadError::Malformed { line: self.line, message });
        };
        Ok((code, self.text_line()?))
    }

    fn text_line(&mut self) -> Result<&'a [u8], ReadError> {
        let rest = &self.bytes[self.at..];
        if rest.is_empty() {
            return Err(ReadError::Truncated { line: self.line });
        }
        let length = rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        self.line += 1;
        Ok(rest[..length].trim_ascii())
    }

    fn binary_group(&mut self) -> Result<(i32, &'a [u8]), ReadError> {
        let mut code = i32::from(self.take(1)?[0]);
        if self.two_byte_codes {
            code += i32::from(self.take(1)?[0]) << 8;
        } else if code == 255 {
            let long = self.take(2)?;
            code = i32::from(long[0]) + (i32::from(long[1]) << 8);
        }
        let value = match value_kind(code) {
            Some(Kind::Text) => {
                let rest = &self.bytes[self.at..];
                let length = rest.iter().position(|&b| b == 0).ok_or(ReadError::Truncated { line: 0 })?;
                self.at += length + 1;
                rest[..length].trim_ascii()
            }
            Some(Kind::Chunk) => {
                let length = usize::from(self.take(1)?[0]);
                self.take(length)?
            }
            Some(Kind::Boolean) => self.take(if self.two_byte_codes { 1 } else { 2 })?,
            Some(Kind::Bytes(count)) => self.take(count)?,
            None => {
                let message = format!("byte {}: {code} is no group code", self.at);
                return Err(ReadError::Malformed { line: 0, message });
            }
        };
        Ok((code, value))
    }

    fn take(&mut self, count: usize) -> Result<&'a [u8], ReadError> {
        let value = self.bytes.get(self.at..self.at + count).ok_or(ReadError::Truncated { line: 0 })?;
        self.at += count;
        Ok(value)
    }
}

/// How a binary file stores a value.
enum Kind {
    Text,
    Boolean,
    Chunk,
    Bytes(usize),
}

/// By code, as the DXF reference lists them.
fn value_kind(code: i32) -> Option<Kind> {
    Some(match code {
        0..=9 | 100..=102 | 105 | 300..=309 | 320..=369 | 390..=399 | 410..=419 => Kind::Text,
        430..=439 | 470..=481 | 999..=1003 | 1005..=1009 => Kind::Text,
        10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Kind::Bytes(8),
        60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => Kind::Bytes(2),
        90..=99 | 420..=429 | 440..=459 | 1071 => Kind::Bytes(4),
        160..=169 => Kind::Bytes(8),
        290..=299 => Kind::Boolean,
        310..=319 | 1004 => Kind::Chunk,
        _ => return None,
    })
}

impl Group<'_> {
    /// Whether the group opens a record of that name.
    pub(super) fn opens(&self, name: &str) -> bool {
        self.code == 0 && self.value.eq_ignore_ascii_case(name.as_bytes())
    }

    /// The number.
    pub(super) fn real(&self) -> Result<f64, ReadError> {
        let number =
            if self.binary { self.value.try_into().ok().map(f64::from_le_bytes) } else { self.text_as() };
        number.ok_or_else(|| self.not_a_number())
    }

    /// The whole number.
    pub(super) fn integer(&self) -> Result<i64, ReadError> {
        let number = match (self.binary, self.value) {
            (false, _) => self.text_as(),
            (true, &[a, b]) => Some(i64::from(i16::from_le_bytes([a, b]))),
            (true, &[a, b, c, d]) => Some(i64::from(i32::from_le_bytes([a, b, c, d]))),
            (true, _) => None,
        };
        number.ok_or_else(|| self.not_a_number())
    }

    /// The handle of an object, hexadecimal; none for 0 and for what is no handle.
    pub(super) fn handle(&self) -> Option<NonZeroU64> {
        let text = std::str::from_utf8(self.value).ok()?;
        NonZeroU64::new(u64::from_str_radix(text, 16).ok()?)
    }

    /// Refuses the file: something else should stand here.
    pub(super) fn unexpected(&self, expected: &str) -> ReadError {
        let message = format!("{expected} was expected but {}/{} found", self.code, self.shown());
        ReadError::Malformed { line: self.line, message }
    }

    fn text_as<T: std::str::FromStr>(&self) -> Option<T> {
        std::str::from_utf8(self.value).ok()?.parse().ok()
    }

    fn not_a_number(&self) -> ReadError {
        let message = format!("group {} should hold a number but holds `{}`", self.code, self.shown());
        ReadError::Malformed { line: self.line, message }
    }

    /// The beginning of the value.
    fn shown(&self) -> String {
        String::from_utf8_lossy(self.value).chars().take(40).collect()
    }
}
