//! What a picture of a plan shows besides the scene.

use traverse_geometry::{Path, Point};

/// What a picture shows besides the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown<'a> {
    /// Nothing.
    Scene,
    /// A path, its ends and its length.
    Path(&'a Path),
    /// Several moves through one scene, with the sum of their lengths.
    Paths(&'a [Path]),
    /// Moves as they were and as they are now, with the sums of their lengths and what is saved.
    Change {
        /// As they were: drawn thin and grey.
        before: &'a [Path],
        /// As they are: drawn as a plan.
        after: &'a [Path],
    },
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
    /// The moves as they are.
    pub(super) fn paths(&self) -> &'a [Path] {
        match *self {
            Self::Path(path) => std::slice::from_ref(path),
            Self::Paths(paths) | Self::Change { after: paths, .. } => paths,
            Self::Scene | Self::NoPath { .. } => &[],
        }
    }

    /// The moves as they were.
    pub(super) fn before(&self) -> &'a [Path] {
        match *self {
            Self::Change { before, .. } => before,
            _ => &[],
        }
    }

    /// Start and target of each move.
    pub(super) fn ends(&self) -> Vec<(Point, Point)> {
        match *self {
            Self::NoPath { start, target, .. } => vec![(start, target)],
            _ => self.paths().iter().map(|path| (path.start, path.end())).collect(),
        }
    }

    /// Whether the obstacle parts start from target.
    pub(super) fn parts(&self, id: &str) -> bool {
        matches!(self, Self::NoPath { separating, .. } if separating.iter().any(|each| each == id))
    }
}
