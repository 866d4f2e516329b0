//! Which curves of a drawing are meant: by layer, id, group or colour.

use crate::Source;
use crate::pattern::Pattern;
use std::fmt;

/// Chooses curves of a drawing by one of their names. `*` stands for any text; upper and lower case are alike.
///
/// Written `layer:CLAMPS*`, `id:stop-*`, `group:fixture`, `color:#ff0000` or `color:red`; without one of these words in
/// front it is a layer. Every text is a selector.
///
/// ```
/// use traverse_drawing::{Selector, Source};
/// let clamps = Selector::new("group:clamp*");
/// assert!(clamps.chooses("0", &Source { groups: vec!["Clamp left".to_owned()], ..Source::default() }));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Selector {
    text: String,
    by: By,
    pattern: Pattern,
}

/// What a selector looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum By {
    Layer,
    Id,
    Group,
    Color,
}

const PREFIXES: [(&str, By); 5] = [
    ("layer:", By::Layer),
    ("id:", By::Id),
    ("group:", By::Group),
    ("color:", By::Color),
    ("colour:", By::Color),
];

/// Colours that may be named: those that every CAD program offers first.
const NAMED_COLORS: [(&str, &str); 8] = [
    ("red", "#ff0000"),
    ("yellow", "#ffff00"),
    ("green", "#00ff00"),
    ("cyan", "#00ffff"),
    ("blue", "#0000ff"),
    ("magenta", "#ff00ff"),
    ("black", "#000000"),
    ("white", "#ffffff"),
];

impl Selector {
    /// The selector that `text` stands for.
    #[must_use]
    pub fn new(text: &str) -> Self {
        let lower = text.to_ascii_lowercase();
        let prefix = PREFIXES.into_iter().find(|(prefix, _)| lower.starts_with(prefix));
        let (by, name) = prefix.map_or((By::Layer, text), |(prefix, by)| (by, &text[prefix.len()..]));
        let named =
            NAMED_COLORS.into_iter().find(|(word, _)| by == By::Color && name.eq_ignore_ascii_case(word));
        let pattern = Pattern::new(named.map_or(name, |(_, hex)| hex));
        Self { text: text.to_owned(), by, pattern }
    }

    /// Whether a curve on that layer, of that source, is meant. What the file does not say fits nothing.
    #[must_use]
    pub fn chooses(&self, layer: &str, source: &Source) -> bool {
        self.name_chosen(layer, source).is_some()
    }

    /// Whether something on that layer, of which no more is known, may be meant.
    pub(crate) fn may_choose_on(&self, layer: &str) -> bool {
        self.by != By::Layer || self.pattern.fits(layer)
    }

    /// The name by which the curve is meant.
    pub(crate) fn name_chosen(&self, layer: &str, source: &Source) -> Option<String> {
        let fits = |name: &&String| self.pattern.fits(name);
        match self.by {
            By::Layer => self.pattern.fits(layer).then(|| layer.to_owned()),
            By::Id => source.id.as_ref().filter(fits).cloned(),
            By::Group => source.groups.iter().find(fits).cloned(),
            By::Color => source.color.map(|color| color.to_string()).filter(|name| self.pattern.fits(name)),
        }
    }

    /// Whether it chooses nothing because it names nothing.
    pub(crate) fn is_empty(&self) -> bool {
        self.pattern == Pattern::new("")
    }
}

impl From<&str> for Selector {
    fn from(text: &str) -> Self {
        Self::new(text)
    }
}

impl fmt::Display for Selector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;

    #[test]
    fn curves_are_chosen_by_each_of_their_names() {
        let source = Source {
            id: Some("stop-3".to_owned()),
            groups: vec!["Fixture".to_owned(), "left".to_owned()],
            color: Some(Color { red: 255, green: 0, blue: 0 }),
            ..Source::default()
        };
        for (text, chosen) in [
            ("CLAMPS", true),
            ("layer:cl*", true),
            ("Stop-3", false),
            ("id:STOP-*", true),
            ("id:stop", false),
            ("group:left", true),
            ("GROUP:fix*", true),
            ("group:clamps", false),
            ("color:red", true),
            ("colour:#FF0000", true),
            ("color:#00*", false),
        ] {
            assert_eq!(Selector::new(text).chooses("clamps", &source), chosen, "{text}");
            assert_eq!(Selector::new(text).to_string(), text);
        }
        for text in ["id:*", "group:*", "color:*"] {
            assert!(!Selector::new(text).chooses("clamps", &Source::default()), "{text}");
        }
    }
}
