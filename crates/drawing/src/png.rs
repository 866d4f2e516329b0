//! Pictures as PNG, the same on every machine.
//!
//! Letters are those of a font that this crate brings along, so that no machine has to have one. Nothing is read from
//! disk.

mod letters;

#[cfg(test)]
pub(crate) use letters::width_of;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{ImageHrefResolver, Options, Tree};

/// Smallest width of a PNG picture, pixels.
pub const SMALLEST_PNG_WIDTH_PX: u32 = 16;
/// Greatest width of a PNG picture, pixels.
pub const LARGEST_PNG_WIDTH_PX: u32 = 8_000;
/// Most pixels of a PNG picture: they take four bytes each while it is drawn, twice that where parts are clipped.
pub const LARGEST_PNG_PIXELS: u64 = 64_000_000;
/// Longest SVG text that is drawn, bytes.
pub const LARGEST_SVG_BYTES: usize = 64 << 20;

/// Why a picture can't be made a PNG.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PngError {
    /// The width is outside its range.
    #[error("width_px is {width_px}; choose {SMALLEST_PNG_WIDTH_PX} to {LARGEST_PNG_WIDTH_PX}")]
    WidthOutOfRange {
        /// As asked for.
        width_px: u32,
    },
    /// A picture of this width and the SVG's proportions has too many pixels.
    #[error(
        "a picture of {width_px} × {height_px} pixels is more than {LARGEST_PNG_PIXELS} pixels; choose a smaller width"
    )]
    TooManyPixels {
        /// As asked for.
        width_px: u32,
        /// As the SVG's proportions ask for.
        height_px: u64,
    },
    /// The SVG text is too long.
    #[error("the SVG has {bytes} bytes, more than {LARGEST_SVG_BYTES}; draw fewer curves")]
    SvgTooLong {
        /// Its length.
        bytes: usize,
    },
    /// The text is no SVG.
    #[error("the text is no SVG that can be drawn: {why}; give a picture as this crate makes it")]
    NotSvg {
        /// What the reader says.
        why: String,
    },
    /// The pixels can't be written as PNG.
    #[error("the pixels can't be written as PNG: {why}; choose a smaller width")]
    NotWritten {
        /// What the writer says.
        why: String,
    },
}

/// Draws an SVG as a PNG file of that width; its height follows from the proportions.
///
/// It is meant for pictures of this crate: text is drawn as they write it, an element to a line; other text is left
/// out. Equal arguments give equal bytes. Characters that the font brought along lacks are drawn as empty boxes.
///
/// # Errors
/// When the width is outside its range, the picture would be too large, or the text is no SVG.
pub fn png_of_svg(svg: &str, width_px: u32) -> Result<Vec<u8>, PngError> {
    if !(SMALLEST_PNG_WIDTH_PX..=LARGEST_PNG_WIDTH_PX).contains(&width_px) {
        return Err(PngError::WidthOutOfRange { width_px });
    }
    if svg.len() > LARGEST_SVG_BYTES {
        return Err(PngError::SvgTooLong { bytes: svg.len() });
    }
    let too_long = PngError::SvgTooLong { bytes: svg.len() };
    let drawn = letters::with_letters_as_paths(svg, 2 * LARGEST_SVG_BYTES).ok_or(too_long)?;
    let tree = Tree::from_str(&drawn, &options()).map_err(|why| PngError::NotSvg { why: why.to_string() })?;
    let scale = f64::from(width_px) / f64::from(tree.size().width());
    let height_px = (f64::from(tree.size().height()) * scale).ceil().max(1.0) as u64;
    let too_many = PngError::TooManyPixels { width_px, height_px };
    if u64::from(width_px).saturating_mul(height_px) > LARGEST_PNG_PIXELS {
        return Err(too_many);
    }
    let height = u32::try_from(height_px).map_err(|_| too_many.clone())?;
    let mut pixels = Pixmap::new(width_px, height).ok_or(too_many)?;
    let scale = scale as f32;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    pixels.encode_png().map_err(|why| PngError::NotWritten { why: why.to_string() })
}

/// No pictures within the picture, so that no file is read.
fn options() -> Options<'static> {
    Options {
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    }
}
