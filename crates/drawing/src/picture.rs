//! stub
use traverse_geometry::{Path, Point, Scene};

/// What a picture shows besides the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown<'a> {
    /// Nothing.
    Scene,
    /// A path with its length.
    Path(&'a Path),
    /// Several moves through one scene.
    Paths(&'a [Path]),
    /// That there is no path.
    NoPath {
        /// Where the tool is.
        start: Point,
        /// Where it should go.
        target: Point,
        /// Ids of the obstacles that part both; `work_area` stands for the border.
        separating: &'a [String],
    },
}

/// stub
#[must_use]
pub fn picture_of_plan(scene: &Scene, shown: Shown<'_>, title: &str) -> String {
    let _ = (scene, shown, title);
    String::new()
}
