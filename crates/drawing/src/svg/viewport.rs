//! A page within a page: how the coordinates of a `viewBox` come to lie in a box.

use super::affine::Affine;
use super::element::Element;
use crate::ReadError;
use std::str::FromStr;
use svgtypes::{Align, AspectRatio, ViewBox};

/// The `viewBox` of an element; none when it has none.
pub(super) fn view_box(element: &Element<'_>) -> Result<Option<ViewBox>, ReadError> {
    let Some(text) = element.attribute("viewBox") else { return Ok(None) };
    let bad = |problem: &str| element.bad("viewBox", text, problem);
    let read = ViewBox::from_str(text).map_err(|error| bad(&error.to_string()))?;
    let usable = [read.x, read.y, read.w, read.h].iter().all(|number| number.abs() <= 1e12)
        && read.w.min(read.h) >= 1e-12;
    if usable { Ok(Some(read)) } else { Err(bad("its numbers are too large or too small")) }
}

/// The map of the view box into a box of that size with its corner at 0, as `preserveAspectRatio` says.
pub(super) fn into_box(element: &Element<'_>, from: &ViewBox, size: (f64, f64)) -> Result<Affine, ReadError> {
    let text = element.attribute("preserveAspectRatio").unwrap_or("xMidYMid");
    let aspect =
        AspectRatio::from_str(text).map_err(|error| element.bad("preserveAspectRatio", text, error))?;
    let (fit_x, fit_y) = (size.0 / from.w, size.1 / from.h);
    let (x, y) = match (aspect.align, aspect.slice) {
        (Align::None, _) => (fit_x, fit_y),
        (_, false) => (fit_x.min(fit_y), fit_x.min(fit_y)),
        (_, true) => (fit_x.max(fit_y), fit_x.max(fit_y)),
    };
    let (share_x, share_y) = shares(aspect.align);
    let left = share_x * (size.0 - from.w * x);
    let top = share_y * (size.1 - from.h * y);
    Ok(Affine::new(x, 0.0, 0.0, y, left - from.x * x, top - from.y * y))
}

/// Which share of the room that is left over lies before the picture.
fn shares(align: Align) -> (f64, f64) {
    match align {
        Align::None | Align::XMinYMin => (0.0, 0.0),
        Align::XMidYMin => (0.5, 0.0),
        Align::XMaxYMin => (1.0, 0.0),
        Align::XMinYMid => (0.0, 0.5),
        Align::XMidYMid => (0.5, 0.5),
        Align::XMaxYMid => (1.0, 0.5),
        Align::XMinYMax => (0.0, 1.0),
        Align::XMidYMax => (0.5, 1.0),
        Align::XMaxYMax => (1.0, 1.0),
    }
}
