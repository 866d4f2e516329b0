//! From the bytes of an SVG file to a drawing.

use super::bounds::check_bounds;
use super::budget::Budget;
use super::element::Element;
use super::encoding::decoded;
use super::layers::Layers;
use super::page::Page;
use super::style::Style;
use super::style_sheet::{StyleSheet, without_comments};
use super::unused_count::UnusedCount;
use super::walk::{LayerFrom, Surroundings, Walk};
use crate::read_drawing::bytes_up_to_limit;
use crate::sniff::{Looks, looks_like};
use crate::{Drawing, ReadError, ReadOptions};
use roxmltree::{Document, ParsingOptions};
use std::collections::HashMap;
use std::io::Read;

/// Reads an SVG file: every path, rect, circle, ellipse, line, polyline and polygon that is visible, with all
/// transforms, nested pages, symbols and uses. Everything else that draws is counted in [`Drawing::unused`].
///
/// Outlines are read, not their painting: no stroke width, dash, marker or fill. Circular arcs are exact; ellipses
/// and Bézier curves are within [`ReadOptions::fit_tolerance_mm`]. Clipped and masked elements are read whole.
///
/// Millimetres, y up, the origin at the lower left of the page; [`Drawing::mapping`] says how. Sizes in pixels count
/// [`ReadOptions::pixels_per_inch`]. A curve's layer is the innermost Inkscape layer around it; else the outermost
/// group with an id; else `0`.
///
/// # Errors
/// When the bytes are no whole SVG file, or one beyond the limits. See [`ReadError`].
pub fn read_svg(bytes: &[u8], options: &ReadOptions) -> Result<Drawing, ReadError> {
    if bytes.len() as u64 > options.byte_limit {
        return Err(ReadError::TooLong { limit: options.byte_limit });
    }
    let text = decoded_xml(bytes)?;
    check_bounds(&text, options)?;
    // Besides elements: text between them, comments, the document itself.
    let nodes_limit =
        u32::try_from(options.entity_limit.saturating_mul(4).saturating_add(64)).unwrap_or(u32::MAX);
    let parsing = || ParsingOptions { allow_dtd: true, nodes_limit, ..ParsingOptions::default() };
    let parsed = Document::parse_with_options(&text, parsing());
    let plain;
    let parsed = if matches!(parsed, Err(roxmltree::Error::InvalidComment(_))) {
        plain = with_blank_comments(&text);
        Document::parse_with_options(&plain, parsing())
    } else {
        parsed
    };
    let document = parsed.map_err(|error| match error {
        roxmltree::Error::NodesLimitReached => ReadError::TooManyEntities { limit: options.entity_limit },
        error => ReadError::Malformed { line: error.pos().row as usize, message: error.to_string() },
    })?;
    let not_svg = || ReadError::NotSvg { found: looks_like(bytes).name() };
    let root = Element::of(document.root_element()).ok_or_else(not_svg)?;
    if root.tag() != "svg" {
        return Err(not_svg());
    }

    let page = Page::of(&root, options.pixels_per_inch)?;
    let styles = style_text(&document);
    let mut walk = Walk {
        options,
        budget: Budget::new(options),
        sheet: StyleSheet::parse(&styles),
        ids: ids(&document),
        layers: Layers::default(),
        unused: UnusedCount::default(),
        groups: Vec::new(),
        drawn_group: None,
        groups_drawn: 0,
        uses: Vec::new(),
    };
    let around = Surroundings {
        to_mm: page.to_mm,
        lengths: page.lengths,
        style: Style::INITIAL,
        hidden: false,
        layer: walk.layers.number("0"),
        layer_from: LayerFrom::Nothing,
    };
    walk.outermost(root, &around)?;
    let unused = walk.unused.finished(&walk.layers, walk.sheet.unread);
    Ok(Drawing {
        unit: page.unit,
        unit_assumed: page.unit_assumed,
        layers: walk.layers.finished(),
        unused,
        mapping: Some(page.mapping),
    })
}

/// Reads an SVG file from a reader, up to the byte limit. See [`read_svg`].
///
/// # Errors
/// When reading fails, and as [`read_svg`].
pub fn read_svg_from(reader: impl Read, options: &ReadOptions) -> Result<Drawing, ReadError> {
    read_svg(&bytes_up_to_limit(reader, options)?, options)
}

/// The text, when it begins as XML does.
fn decoded_xml(bytes: &[u8]) -> Result<std::borrow::Cow<'_, str>, ReadError> {
    let not_svg = Err(ReadError::NotSvg { found: looks_like(bytes).name() });
    let starts = |text: &[u8]| text.trim_ascii_start().starts_with(b"<");
    let marked = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if marked.trim_ascii().is_empty() {
        return Err(ReadError::Empty);
    }
    if !super::is_utf16(bytes) && (!starts(marked) || looks_like(bytes) == Looks::WebPage) {
        return not_svg;
    }
    let text = decoded(bytes)?;
    if starts(text.as_bytes()) { Ok(text) } else { not_svg }
}

/// The text with the contents of comments made blanks, lines kept. Two hyphens in a comment are against the rules of
/// XML, but people write them, and programs read them.
fn with_blank_comments(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, comment)) = rest.split_once("<!--") {
        let Some((comment, after)) = comment.split_once("-->") else { break };
        plain.push_str(before);
        plain.push_str("<!--");
        plain.extend(comment.chars().map(|c| if c == '\n' { '\n' } else { ' ' }));
        plain.push_str("-->");
        rest = after;
    }
    plain.push_str(rest);
    plain
}

/// The text of all style sheets, without comments.
fn style_text(document: &Document<'_>) -> String {
    let mut text = String::new();
    let sheets = document.descendants().filter_map(Element::of).filter(|element| element.tag() == "style");
    for part in sheets.flat_map(|sheet| sheet.node.children()).filter_map(|node| node.text()) {
        text.push_str(part);
        text.push('\n');
    }
    without_comments(&text)
}

/// The elements by id; of several with one id the first.
fn ids<'a>(document: &'a Document<'a>) -> HashMap<&'a str, Element<'a>> {
    let mut ids = HashMap::new();
    for element in document.descendants().filter_map(Element::of) {
        if let Some(id) = element.id() {
            ids.entry(id).or_insert(element);
        }
    }
    ids
}
