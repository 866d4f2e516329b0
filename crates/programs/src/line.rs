//! Lines of a program, by place: their bytes are never copied.

/// One line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Line {
    /// Counted from 1.
    pub(crate) number: u32,
    /// Where it begins.
    pub(crate) start: usize,
    /// Where what is written on it ends.
    pub(crate) end: usize,
    /// Where the next line begins.
    pub(crate) next: usize,
}

/// What editors may put before the first character; it belongs to no line, so nothing is inserted before it.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The lines of `bytes` behind a byte order mark: ended by LF, CR LF or CR. Cost: linear.
pub(crate) fn lines(bytes: &[u8]) -> impl Iterator<Item = Line> + '_ {
    let mut at = if bytes.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
    let mut number = 0;
    std::iter::from_fn(move || {
        let rest = bytes.get(at..).filter(|rest| !rest.is_empty())?;
        let start = at;
        number += 1;
        let length = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        let ending = match &rest[length..] {
            [b'\r', b'\n', ..] => 2,
            [] => 0,
            _ => 1,
        };
        at += length + ending;
        Some(Line { number, start, end: start + length, next: at })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_ending_ends_a_line() {
        let text = b"G0\nG1\r\n\rG2";
        let found: Vec<&[u8]> = lines(text).map(|line| &text[line.start..line.end]).collect();
        assert_eq!(found, [&b"G0"[..], b"G1", b"", b"G2"]);
        assert_eq!(lines(text).last().map(|line| (line.number, line.next)), Some((4, text.len())));
        assert_eq!(lines(b"").count(), 0);
        let marked = lines(b"\xef\xbb\xbfG0\n").next();
        assert_eq!(marked.map(|line| (line.start, line.end, line.number)), Some((3, 5, 1)));
    }
}
