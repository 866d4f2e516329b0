//! What a file looks like by its first bytes, for messages and for the choice of a reader.

use crate::svg::is_utf16;

/// So many bytes at the start are looked at.
const SNIFFED_BYTES: usize = 1024;

/// What a file looks like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Looks {
    /// ASCII or binary.
    Dxf,
    DamagedBinaryDxf,
    Svg,
    /// Of an unknown kind.
    Xml,
    WebPage,
    /// In words.
    Other(&'static str),
}

/// First bytes, in lower case, by which files are known that have no reader here.
const MARKS: [(&[u8], &str); 7] = [
    (b"ac10", "a DWG drawing"),
    (b"autocad dxb", "a DXB drawing"),
    (b"%pdf", "a PDF file"),
    (b"%!ps", "a PostScript file"),
    (b"\x1f\x8b", "a compressed archive"),
    (b"pk\x03\x04", "a compressed archive"),
    (b"\x89png", "a picture (PNG)"),
];

impl Looks {
    /// For messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Dxf => "a DXF drawing",
            Self::DamagedBinaryDxf => "a damaged binary DXF file",
            Self::Svg => "an SVG drawing",
            Self::Xml => "an XML file",
            Self::WebPage => "a web page (HTML)",
            Self::Other(name) => name,
        }
    }
}

/// What a file looks like.
pub(crate) fn looks_like(bytes: &[u8]) -> Looks {
    let letters: Vec<u8>;
    let bytes = if is_utf16(bytes) {
        // Of Latin letters every second byte is zero.
        letters = bytes[2..].iter().copied().filter(|&b| b != 0).take(SNIFFED_BYTES).collect();
        &letters
    } else {
        bytes
    };
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let start = text[..text.len().min(SNIFFED_BYTES)].to_ascii_lowercase();
    let place =
        |mark: &[u8]| start.windows(mark.len()).position(|window| window == mark).unwrap_or(usize::MAX);
    let (html, svg) =
        (place(b"<html").min(place(b"<!doctype html")), place(b"<svg").min(place(b"<!doctype svg")));
    if html < svg {
        Looks::WebPage
    } else if svg < html {
        Looks::Svg
    } else if start.starts_with(b"<") {
        Looks::Xml
    } else if bytes.starts_with(b"AutoCAD Binary DXF\r\n\x1a\0") {
        Looks::Dxf
    } else if start.starts_with(b"autocad binary dxf") {
        Looks::DamagedBinaryDxf
    } else if let Some((_, name)) = MARKS.iter().find(|(mark, _)| start.starts_with(mark)) {
        Looks::Other(name)
    } else if begins_with_group_code(text) {
        Looks::Dxf
    } else if start.iter().any(|&b| b == 0 || b >= 0xf8) {
        Looks::Other("binary data")
    } else {
        Looks::Other("some other text")
    }
}

/// Whether the first line is a group code, as in an ASCII DXF file. Blanks before it are cut off already.
pub(crate) fn begins_with_group_code(text: &[u8]) -> bool {
    let first_line = text.split(|&b| b == b'\n').next().unwrap_or_default().trim_ascii();
    std::str::from_utf8(first_line).is_ok_and(|line| line.parse::<u16>().is_ok())
}
