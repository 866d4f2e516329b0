//! The picture of a plan: an SVG file, y up, legible in colour and in print.
//!
//! Sizes follow the scene's extent: the drawing fills a canvas of fixed width, lines and letters keep their size on
//! it. Text stands above and below the drawing; the ids of obstacles are put where neither path nor marks are.
//! Barriers need no offset curves: an obstacle's border stroked with twice its clearance, beneath the obstacle, is
//! its barrier. Cost: linear, but for placing ids.

mod frame;
mod header;
mod ids;
mod label;
mod legend;
mod outline;
mod route;
mod scale_bar;
mod shapes;
mod style;
mod text;

use frame::Frame;
use traverse_geometry::{Path, Point, Scene};

/// What a picture shows besides the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown<'a> {
    /// Nothing.
    Scene,
    /// A path, its ends and its length.
    Path(&'a Path),
    /// Several moves through one scene, with the sum of their lengths.
    Paths(&'a [Path]),
    /// That there is no path: the obstacles that part start from target stand out.
    NoPath {
        /// Where the tool is.
        start: Point,
        /// Where it should go.
        target: Point,
        /// Ids of the obstacles that part both; `work_area` stands for the border.
        separating: &'a [String],
    },
}

impl<'a> Shown<'a> {
    fn paths(&self) -> &'a [Path] {
        match *self {
            Self::Path(path) => std::slice::from_ref(path),
            Self::Paths(paths) => paths,
            Self::Scene | Self::NoPath { .. } => &[],
        }
    }

    /// Start and target of each move.
    fn ends(&self) -> Vec<(Point, Point)> {
        match *self {
            Self::NoPath { start, target, .. } => vec![(start, target)],
            _ => self.paths().iter().map(|path| (path.start, path.end())).collect(),
        }
    }

    fn parts(&self, id: &str) -> bool {
        matches!(self, Self::NoPath { separating, .. } if separating.iter().any(|each| each == id))
    }
}

/// The picture of a plan as an SVG file. `title` stands on top; it may be empty.
///
/// Equal arguments give equal text, byte for byte.
#[must_use]
pub fn picture_of_plan(scene: &Scene, shown: Shown<'_>, title: &str) -> String {
    let header = header::Header::new(scene, &shown, title);
    let frame = Frame::new(scene, &shown, header.height());
    let legend = legend::Legend::new(scene, &shown, &frame);
    let height = legend.bottom() + frame::MARGIN;
    let mut svg = style::opening(frame::WIDTH, height, &header.summary());
    shapes::draw(&mut svg, scene, &shown, &frame);
    route::draw(&mut svg, &shown, &frame);
    ids::draw(&mut svg, scene, &shown, &frame);
    header.draw(&mut svg);
    scale_bar::draw(&mut svg, &frame);
    legend.draw(&mut svg);
    svg.push_str("</svg>\n");
    svg
}
