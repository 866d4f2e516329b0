//! What a file looks like by its first bytes, for messages and for the choice of a reader.

/// So many bytes at the start are looked at.
const SNIFFED_BYTES: usize = 1024;

/// What a file looks like that is none of those that a reader was asked for.
pub(crate) fn looks_like(bytes: &[u8]) -> &'static str {
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    let start = text[..text.len().min(SNIFFED_BYTES)].to_ascii_lowercase();
    let place =
        |mark: &[u8]| start.windows(mark.len()).position(|window| window == mark).unwrap_or(usize::MAX);
    let (html, svg) =
        (place(b"<html").min(place(b"<!doctype html")), place(b"<svg").min(place(b"<!doctype svg")));
    if html < svg {
        "a web page (HTML)"
    } else if svg < html {
        "an SVG drawing"
    } else if start.starts_with(b"<") {
        "an XML file"
    } else if start.starts_with(b"ac10") {
        "a DWG drawing"
    } else if bytes.starts_with(b"AutoCAD Binary DXF\r\n\x1a\0") {
        "a DXF drawing"
    } else if start.starts_with(b"autocad binary dxf") {
        "a damaged binary DXF file"
    } else if start.starts_with(b"autocad dxb") {
        "a DXB drawing"
    } else if start.starts_with(b"%pdf") {
        "a PDF file"
    } else if start.starts_with(b"%!ps") {
        "a PostScript file"
    } else if start.starts_with(b"\x1f\x8b") || start.starts_with(b"pk\x03\x04") {
        "a compressed archive"
    } else if begins_with_group_code(text) {
        "a DXF drawing"
    } else if start.iter().any(|&b| b == 0 || b >= 0xf8) {
        "binary data"
    } else {
        "some other text"
    }
}

/// Whether the first line is a group code, as in an ASCII DXF file. Blanks before it are cut off already.
pub(crate) fn begins_with_group_code(text: &[u8]) -> bool {
    let first_line = text.split(|&b| b == b'\n').next().unwrap_or_default().trim_ascii();
    std::str::from_utf8(first_line).is_ok_and(|line| line.parse::<u16>().is_ok())
}
