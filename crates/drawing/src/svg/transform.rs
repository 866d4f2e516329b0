//! The map that an element's `transform` stands for, attribute or style, about its `transform-origin`.

use super::affine::Affine;
use super::element::{Element, LengthContext};
use super::length::Length;
use super::properties::Properties;
use crate::ReadError;

/// Units of style sheets that mean what a bare number means in an attribute.
const UNITS: [&str; 2] = ["deg", "px"];

/// The map of an element; a style goes before the attribute.
///
/// Of a style what an attribute could say too is read, with `px` and `deg`; everything else is refused, as is a
/// `transform-box` other than the page.
pub(super) fn transform(
    element: &Element<'_>,
    properties: &Properties<'_>,
    lengths: &LengthContext,
) -> Result<Affine, ReadError> {
    let attribute = element.attribute("transform").map(|text| ("transform", text.to_owned()));
    let style = properties.style_transform.map(|text| ("style", without_units(text)));
    let Some((said_by, text)) = style.or(attribute).filter(|(_, text)| text.trim() != "none") else {
        return Ok(Affine::translation(0.0, 0.0));
    };
    if let Some(text) = properties.transform_box.filter(|&text| text != "view-box") {
        return Err(element.bad("transform-box", text, "only view-box is read; apply the transform"));
    }
    let map = Affine::parse(&text).map_err(|error| element.bad(said_by, &text, error))?;
    let Some(text) = properties.transform_origin else { return Ok(map) };
    let Some((x, y)) = origin(text, lengths) else {
        return Err(element.bad("transform-origin", text, "this is no point; apply the transform"));
    };
    Ok(Affine::translation(x, y).after(&map).after(&Affine::translation(-x, -y)))
}

fn without_units(text: &str) -> String {
    UNITS.iter().fold(text.to_ascii_lowercase(), |text, unit| text.replace(unit, ""))
}

/// The point that a `transform-origin` names: one to three words, across before down unless they say otherwise.
fn origin(text: &str, lengths: &LengthContext) -> Option<(f64, f64)> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let (first, second) = match words[..] {
        [one @ ("top" | "bottom")] => ("center", one),
        [one] => (one, "center"),
        [down @ ("top" | "bottom"), across, ..] | [down, across @ ("left" | "right"), ..] => (across, down),
        [across, down, ..] => (across, down),
        [] => return None,
    };
    let along = |word: &str, [low, high]: [&str; 2], whole: f64| match word {
        _ if word == low => Some(0.0),
        _ if word == high => Some(whole),
        "center" => Some(whole / 2.0),
        _ => Some(Length::parse(word)?.user_units(whole, lengths.pixels_per_inch)),
    };
    let x = along(first, ["left", "right"], lengths.width)?;
    let y = along(second, ["top", "bottom"], lengths.height)?;
    (words.len() <= 3 && x.is_finite() && y.is_finite()).then_some((x, y))
}
