//! Pictures as files, SVG or PNG by their ending.

use crate::failure::Failure;
use crate::input;
use std::path::Path;
use traverse_drawing::png_of_svg;

/// How a picture is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PictureKind {
    Svg,
    Png,
}

impl PictureKind {
    /// By the ending of the file's name.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        Self::known(path).ok_or_else(|| {
            Failure::Input(format!("{}: write pictures to a file that ends in .svg or .png", path.display()))
        })
    }

    /// The same; none when the name ends otherwise.
    pub(crate) fn known(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "svg" => Some(Self::Svg),
            "png" => Some(Self::Png),
            _ => None,
        }
    }
}

/// Writes the picture `svg`; `width_px` is a PNG's.
pub(crate) fn write_picture(path: &Path, kind: PictureKind, svg: &str, width_px: u32) -> Result<(), Failure> {
    match kind {
        PictureKind::Svg => input::write(path, svg),
        PictureKind::Png => {
            let png = png_of_svg(svg, width_px);
            input::write(path, png.map_err(|why| Failure::Input(format!("{}: {why}", path.display())))?)
        }
    }
}
