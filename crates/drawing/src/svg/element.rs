//! An element of the XML tree, and what is wrong with its attributes.

use super::length::Length;
use crate::ReadError;
use roxmltree::Node;

const SVG: &str = "http://www.w3.org/2000/svg";
const XLINK: &str = "http://www.w3.org/1999/xlink";
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// So much of a value is shown in messages.
const SHOWN_CHARACTERS: usize = 40;

/// What percentages of lengths are of, and what a pixel is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LengthContext {
    /// Size of the innermost page, user units.
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) pixels_per_inch: f64,
}

/// An element of SVG.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element<'a> {
    pub(super) node: Node<'a, 'a>,
}

impl<'a> Element<'a> {
    /// None when the node is no element, or one of another vocabulary. A file without namespaces is taken for SVG.
    pub(super) fn of(node: Node<'a, 'a>) -> Option<Self> {
        let ours = node.is_element() && matches!(node.tag_name().namespace(), None | Some(SVG));
        ours.then_some(Self { node })
    }

    pub(super) fn tag(&self) -> &'a str {
        self.node.tag_name().name()
    }

    pub(super) fn id(&self) -> Option<&'a str> {
        self.attribute("id").filter(|id| !id.is_empty())
    }

    pub(super) fn attribute(&self, name: &str) -> Option<&'a str> {
        self.node.attribute(name)
    }

    /// The id that it refers to, without `#`; empty when it refers to something outside.
    pub(super) fn reference(&self) -> &'a str {
        let href = self.attribute("href").or_else(|| self.node.attribute((XLINK, "href")));
        href.and_then(|href| href.trim().strip_prefix('#')).unwrap_or_default()
    }

    /// What Inkscape shows for it.
    pub(super) fn label(&self) -> Option<&'a str> {
        self.node.attribute((INKSCAPE, "label")).filter(|label| !label.is_empty())
    }

    /// Whether Inkscape takes it for a layer.
    pub(super) fn is_inkscape_layer(&self) -> bool {
        self.node.attribute((INKSCAPE, "groupmode")) == Some("layer")
    }

    /// Elements inside it, in order.
    pub(super) fn children(&self) -> impl Iterator<Item = Element<'a>> + use<'a> {
        self.node.children().filter_map(Element::of)
    }

    /// Bytes of its attributes.
    pub(super) fn attribute_bytes(&self) -> usize {
        self.node.attributes().map(|attribute| attribute.value().len()).sum()
    }

    /// Line of the file, counted from 1. Takes as long as the file is: for errors only.
    pub(super) fn line(&self) -> usize {
        self.node.document().text_pos_at(self.node.range().start).row as usize
    }

    pub(super) fn bad(&self, attribute: &'static str, value: &str, problem: impl ToString) -> ReadError {
        let shown = |text: &str| text.chars().take(SHOWN_CHARACTERS).collect::<String>();
        let id = self.id().map(|id| format!(" id=\"{}\"", shown(id))).unwrap_or_default();
        ReadError::BadAttribute {
            line: self.line(),
            element: format!("<{}{id}>", shown(self.tag())),
            attribute,
            value: shown(value),
            problem: problem.to_string(),
        }
    }

    /// A length in user units; none when there is no such attribute or it is `auto`.
    pub(super) fn length_if_any(
        &self,
        name: &'static str,
        context: &LengthContext,
    ) -> Result<Option<f64>, ReadError> {
        let Some(text) = self.attribute(name).filter(|text| text.trim() != "auto") else { return Ok(None) };
        let length = Length::parse(text).ok_or_else(|| self.bad(name, text, "this is no length"))?;
        let whole = match name {
            "x" | "x1" | "x2" | "cx" | "rx" | "width" => context.width,
            "y" | "y1" | "y2" | "cy" | "ry" | "height" => context.height,
            _ => context.width.hypot(context.height) / std::f64::consts::SQRT_2,
        };
        Ok(Some(length.user_units(whole, context.pixels_per_inch)))
    }

    /// A length in user units, 0 when there is none.
    pub(super) fn length(&self, name: &'static str, context: &LengthContext) -> Result<f64, ReadError> {
        Ok(self.length_if_any(name, context)?.unwrap_or(0.0))
    }
}
