//! The page of the outermost element: what its coordinates are in millimetres.

use super::affine::Affine;
use super::element::{Element, LengthContext};
use super::length::{Length, Measure};
use super::viewport::{into_box, view_box};
use crate::{LengthUnit, PageMapping, ReadError};
use traverse_geometry::COORDINATE_LIMIT_MM;

/// The outermost page.
pub(super) struct Page {
    /// From user units, y down, to millimetres, y up.
    pub(super) to_mm: Affine,
    pub(super) lengths: LengthContext,
    pub(super) mapping: PageMapping,
    /// Unit of the page's size.
    pub(super) unit: LengthUnit,
    /// Whether the size is in pixels, or not given.
    pub(super) unit_assumed: bool,
}

impl Page {
    /// The page of the outermost `svg` element.
    ///
    /// Its size is `width` and `height`; where one is missing, or a percentage, it follows from the view box, whose
    /// unit is then the pixel.
    pub(super) fn of(root: &Element<'_>, pixels_per_inch: f64) -> Result<Self, ReadError> {
        // Without a usable resolution pixels are no number of millimetres: what is in pixels is out of range.
        let usable = pixels_per_inch.is_finite() && pixels_per_inch > 0.0;
        let mm_per_pixel = if usable { 25.4 / pixels_per_inch } else { f64::NAN };
        let (width, width_unit) = size(root, "width", mm_per_pixel)?;
        let (height, height_unit) = size(root, "height", mm_per_pixel)?;
        let view = view_box(root)?;
        let (page, inner, map) = if let Some(view) = view {
            let page = match (width, height) {
                (Some(width), Some(height)) => (width, height),
                (Some(width), None) => (width, width * view.h / view.w),
                (None, Some(height)) => (height * view.w / view.h, height),
                (None, None) => (view.w * mm_per_pixel, view.h * mm_per_pixel),
            };
            (page, (view.w, view.h), into_box(root, &view, page)?)
        } else {
            let page = (width.unwrap_or(0.0), height.unwrap_or(0.0));
            let inner = (page.0 / mm_per_pixel, page.1 / mm_per_pixel);
            (page, inner, Affine::scaling(mm_per_pixel, mm_per_pixel))
        };
        let within = |value: f64| value.abs() <= COORDINATE_LIMIT_MM;
        if !within(page.0) || !within(page.1) {
            let shown = format!("{} x {} mm", page.0, page.1);
            return Err(root.bad("size", &shown, format!("outside ±{COORDINATE_LIMIT_MM} mm")));
        }
        let to_mm = Affine::new(1.0, 0.0, 0.0, -1.0, 0.0, page.1).after(&map);
        let mapping = PageMapping {
            mm_per_unit_x: map.x.x,
            mm_per_unit_y: map.y.y,
            left: 0.0 - map.origin.x / map.x.x,
            top: 0.0 - map.origin.y / map.y.y,
            page_width_mm: page.0,
            page_height_mm: page.1,
        };
        let stated = width_unit.or(height_unit);
        Ok(Self {
            to_mm,
            lengths: LengthContext { width: inner.0, height: inner.1, pixels_per_inch },
            mapping,
            unit: stated.unwrap_or(LengthUnit { name: "pixels", millimetres: mm_per_pixel }),
            unit_assumed: stated.is_none(),
        })
    }
}

/// A size in millimetres, and its unit when that is a physical one.
fn size(
    root: &Element<'_>,
    name: &'static str,
    mm_per_pixel: f64,
) -> Result<(Option<f64>, Option<LengthUnit>), ReadError> {
    let Some(text) = root.attribute(name).filter(|text| text.trim() != "auto") else {
        return Ok((None, None));
    };
    let length = Length::parse(text).ok_or_else(|| root.bad(name, text, "this is no length"))?;
    let positive = length.number > 0.0;
    let found = match length.measure {
        Measure::Percent => (None, None),
        Measure::Physical(name, millimetres) => {
            (Some(length.number * millimetres), Some(LengthUnit { name, millimetres }))
        }
        Measure::Pixels => (Some(length.number * mm_per_pixel), None),
        Measure::Letters(pixels) => (Some(length.number * pixels * mm_per_pixel), None),
    };
    if positive { Ok(found) } else { Err(root.bad(name, text, "it is not above 0")) }
}
