//! Pictures of plans and of drawings: SVG files, y up, legible in colour and in print.
//!
//! Sizes follow the extent: the drawing fills a canvas of fixed width, lines and letters keep their size on it. Text
//! stands above and below the drawing; labels in it are put where neither path nor marks are, and what finds no room
//! is told below it. Barriers need no offset curves: an obstacle's border stroked with twice its clearance, beneath
//! the obstacle, is its barrier. Cost: linear, but for placing labels.

mod change_place;
mod drawing_picture;
mod extent;
mod finding_list;
mod frame;
mod gap;
mod header;
mod ids;
mod label;
mod layer_style;
mod layers;
mod layout_picture;
mod legend;
mod lettering;
mod markers;
mod outline;
mod plan_words;
mod route;
mod scale_bar;
mod shapes;
mod shown;
mod sign;
mod square_cut;
mod style;
mod text;
mod text_line;

pub use drawing_picture::picture_of_drawing;
pub use layout_picture::{ShownLayout, picture_of_layout};
pub use markers::MARKED_FINDINGS;
pub use shown::Shown;

pub(crate) use lettering::Lettering;
pub(crate) use text_line::TextLine;

use frame::Frame;
use traverse_geometry::Scene;

/// Free border of the drawing, as a share of its extent.
const AIR: f64 = 0.025;

/// The picture of a plan as an SVG file. `title` stands on top; it may be empty.
///
/// Equal arguments give equal text, byte for byte.
#[must_use]
pub fn picture_of_plan(scene: &Scene, shown: Shown<'_>, title: &str) -> String {
    let header = plan_words::header(scene, &shown, title);
    let frame = Frame::new(extent::of_scene(scene, &shown), AIR, header.height());
    let mut body = String::new();
    shapes::draw(&mut body, scene, &shown, &frame);
    change_place::draw_permitted(&mut body, &shown, &frame);
    route::draw(&mut body, &shown, &frame);
    change_place::draw_place(&mut body, &shown, &frame);
    let unnamed = ids::draw(&mut body, scene, &shown, &frame);
    let entries = plan_words::legend(scene, &shown);
    let legend = legend::Legend::new(entries, plan_words::unnamed(&unnamed, scene.obstacles.len()), &frame);
    file(&header, &frame, &body, &legend, legend.bottom(), "")
}

/// The whole file: header, drawing, scale bar, legend, and what stands below.
fn file(
    header: &header::Header,
    frame: &Frame,
    body: &str,
    legend: &legend::Legend,
    bottom: f64,
    below: &str,
) -> String {
    let mut svg = style::opening(frame::WIDTH, (bottom + frame::MARGIN).ceil(), &header.summary());
    svg.push_str(body);
    header.draw(&mut svg);
    scale_bar::draw(&mut svg, frame);
    legend.draw(&mut svg);
    svg.push_str(below);
    svg.push_str("</svg>\n");
    svg
}
