//! Pictures as PNG: bounded, the same every time, with the text in them.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use resvg::tiny_skia::Pixmap;
use traverse_drawing::{LARGEST_PNG_WIDTH_PX, PngError, SMALLEST_PNG_WIDTH_PX, png_of_svg};

const PATH: &str = include_str!("golden/path.svg");

#[test]
fn a_picture_has_the_width_asked_for_and_its_proportions() {
    for width in [400, 1200, 3000] {
        let png = png_of_svg(PATH, width).unwrap();
        assert_eq!(png, png_of_svg(PATH, width).unwrap());
        let pixels = Pixmap::decode_png(&png).unwrap();
        let document = roxmltree::Document::parse(PATH).unwrap();
        let side = |name: &str| document.root_element().attribute(name).unwrap().parse::<f64>().unwrap();
        let height = f64::from(width) * side("height") / side("width");
        assert!(pixels.width() == width && (f64::from(pixels.height()) - height).abs() <= 1.0);
    }
}

#[test]
fn text_is_drawn() {
    let ink = |text: &str| {
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"30\">\
\n<text class=\"\" x=\"5.0\" y=\"20.0\">{text}</text>\n</svg>"
        );
        let pixels = Pixmap::decode_png(&png_of_svg(&svg, 200).unwrap()).unwrap();
        pixels.pixels().iter().filter(|pixel| pixel.alpha() > 100).count()
    };
    assert!(ink("").eq(&0) && ink("i") > 20 && ink("mmmm") > 5 * ink("i"));
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    for width_px in [0, SMALLEST_PNG_WIDTH_PX - 1, LARGEST_PNG_WIDTH_PX + 1, u32::MAX] {
        assert_eq!(png_of_svg(PATH, width_px), Err(PngError::WidthOutOfRange { width_px }));
    }
    for svg in ["", "<svg", "<html/>", "\u{0}", "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"-1\"/>"] {
        assert!(matches!(png_of_svg(svg, 400), Err(PngError::NotSvg { .. })), "{svg}");
    }
    let tall = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1\" height=\"1000000\"/>";
    assert!(matches!(png_of_svg(tall, 400), Err(PngError::TooManyPixels { .. })));
}

#[test]
fn no_file_is_read() {
    let file = format!("{}/tests/golden/path.svg", env!("CARGO_MANIFEST_DIR"));
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40\" height=\"40\"><image href=\"{file}\" width=\"40\" \
         height=\"40\"/></svg>"
    );
    let pixels = Pixmap::decode_png(&png_of_svg(&svg, 40).unwrap()).unwrap();
    assert!(pixels.pixels().iter().all(|pixel| pixel.alpha() == 0));
}
