//! A line of text in a picture, as it is written and read back.

use super::text::escaped;
use std::fmt::Write;

const CLASS: &str = "<text class=\"";
const X: &str = "\" x=\"";
const Y: &str = "\" y=\"";
const END: &str = "</text>\n";

/// What XML needs written otherwise; the ampersand last, for reading back.
const ESCAPES: [(&str, &str); 4] = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&amp;", "&")];

/// A line of text: `class` names its style.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TextLine<'a> {
    pub(crate) class: &'a str,
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) text: String,
}

/// Writes a text element, a line by itself.
pub(super) fn push_text(svg: &mut String, class: &str, x: f64, y: f64, text: &str) {
    let _ = write!(svg, "{CLASS}{class}{X}{x:.1}{Y}{y:.1}\">{}{END}", escaped(text));
}

impl<'a> TextLine<'a> {
    /// What [`push_text`] wrote; none when a line is something else.
    pub(crate) fn of(line: &'a str) -> Option<Self> {
        let (class, rest) = line.strip_prefix(CLASS)?.split_once(X)?;
        let (x, rest) = rest.split_once(Y)?;
        let (y, rest) = rest.split_once("\">")?;
        let escaped = rest.strip_suffix(END)?;
        let text = ESCAPES.iter().fold(escaped.to_owned(), |text, (from, to)| text.replace(from, to));
        Some(Self { class, x: x.parse().ok()?, y: y.parse().ok()?, text })
    }
}

#[cfg(test)]
mod tests {
    use super::{TextLine, push_text};

    #[test]
    fn what_is_written_is_read_back() {
        for text in ["", "a < b & c > \"d\" &amp;lt;", "</text>", "Öl × 3"] {
            let mut svg = String::new();
            push_text(&mut svg, "id strong", 1.5, -20.0, text);
            let expected = TextLine { class: "id strong", x: 1.5, y: -20.0, text: text.to_owned() };
            assert_eq!(TextLine::of(&svg), Some(expected));
        }
        assert_eq!(TextLine::of("<path class=\"id\"/>\n"), None);
    }
}
