//! What is said of one element's looks, before inheritance.

use super::element::Element;
use super::style_sheet::StyleSheet;

/// The properties that matter here and may be attributes, by name. `transform` is read apart.
const READ: [&str; 9] = [
    "fill",
    "stroke",
    "color",
    "display",
    "visibility",
    "clip-path",
    "mask",
    "transform-origin",
    "transform-box",
];

/// What it costs to look at a rule, in bytes of text gone through.
const RULE_BYTES: usize = 32;

/// The properties that matter here, each as written; none where nothing is said.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Properties<'a> {
    pub(super) fill: Option<&'a str>,
    pub(super) stroke: Option<&'a str>,
    pub(super) color: Option<&'a str>,
    pub(super) display: Option<&'a str>,
    pub(super) visibility: Option<&'a str>,
    pub(super) clip_path: Option<&'a str>,
    pub(super) mask: Option<&'a str>,
    /// Said in a style, not in the attribute of that name.
    pub(super) style_transform: Option<&'a str>,
    pub(super) transform_origin: Option<&'a str>,
    pub(super) transform_box: Option<&'a str>,
}

impl<'a> Properties<'a> {
    /// Those of an element: its attributes, overruled by the style sheet, overruled by its `style`; `!important` rules
    /// of the sheet overrule all. With it, how many bytes of rules were gone through.
    pub(super) fn of(element: &Element<'a>, sheet: &StyleSheet<'a>) -> (Self, usize) {
        let mut properties = Self::default();
        for name in READ {
            properties.set(name, element.attribute(name));
        }
        let (rules, looked_at) = sheet.rules_for(element);
        for rule in &rules {
            properties.declare(rule.declarations, false);
        }
        properties.declare(element.attribute("style").unwrap_or_default(), false);
        for rule in &rules {
            properties.declare(rule.declarations, true);
        }
        let bytes: usize = rules.iter().map(|rule| rule.declarations.len()).sum();
        (properties, bytes + RULE_BYTES * looked_at)
    }

    /// Takes over what `name: value; …` says.
    fn declare(&mut self, declarations: &'a str, only_important: bool) {
        for declaration in declarations.split(';') {
            let Some((name, value)) = declaration.split_once(':') else { continue };
            let (value, important) = match value.split_once('!') {
                Some((value, mark)) => (value, mark.trim().eq_ignore_ascii_case("important")),
                None => (value, false),
            };
            if important || !only_important {
                self.set(name.trim(), Some(value));
            }
        }
    }

    fn set(&mut self, name: &str, value: Option<&'a str>) {
        let Some(value) = value.map(str::trim).filter(|value| !value.is_empty()) else { return };
        let place = match name {
            "fill" => &mut self.fill,
            "stroke" => &mut self.stroke,
            "color" => &mut self.color,
            "display" => &mut self.display,
            "visibility" => &mut self.visibility,
            "clip-path" => &mut self.clip_path,
            "mask" => &mut self.mask,
            "transform" => &mut self.style_transform,
            "transform-origin" => &mut self.transform_origin,
            "transform-box" => &mut self.transform_box,
            _ => return,
        };
        *place = Some(value);
    }

    /// Whether part of it is cut off in the picture.
    pub(super) fn is_clipped(&self) -> bool {
        [self.clip_path, self.mask].iter().flatten().any(|&value| value != "none")
    }
}
