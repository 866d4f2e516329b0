//! What a picture of a plan shows besides the scene.

use traverse_geometry::{Obstacle, Path, Point, Polygon, Ring, Scene};

/// What comes nearer than the clearance by less than this touches the barrier, millimetres.
const TOUCH_MM: f64 = 1e-3;

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
    /// A path, and other ways from its start to its target: drawn thin and grey.
    Choice {
        /// The path.
        path: &'a Path,
        /// The other ways.
        others: &'a [Path],
    },
    /// Where the tool is changed, and where it may be.
    ToolChange {
        /// Where it may be changed.
        regions: &'a [Polygon],
        /// Where else.
        points: &'a [Point],
        /// Start and target.
        ends: (Point, Point),
        /// The moves to the place and on; empty: there is no place.
        moves: &'a [Path],
        /// Ids of the obstacles that keep start or target from every place.
        separating: &'a [String],
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
            Self::Path(path) | Self::Choice { path, .. } => std::slice::from_ref(path),
            Self::Paths(paths)
            | Self::Change { after: paths, .. }
            | Self::ToolChange { moves: paths, .. } => paths,
            Self::Scene | Self::NoPath { .. } => &[],
        }
    }

    /// The moves as they were, or as they could be: drawn thin.
    pub(super) fn before(&self) -> &'a [Path] {
        match *self {
            Self::Change { before: paths, .. } | Self::Choice { others: paths, .. } => paths,
            _ => &[],
        }
    }

    /// Start and target of each move.
    pub(super) fn ends(&self) -> Vec<(Point, Point)> {
        match *self {
            Self::NoPath { start, target, .. } | Self::ToolChange { ends: (start, target), .. } => {
                vec![(start, target)]
            }
            _ => self.paths().iter().map(|path| (path.start, path.end())).collect(),
        }
    }

    /// Whether a move passes over the obstacle: not below its top, and where its barrier would be.
    pub(super) fn passes_over(&self, scene: &Scene, obstacle: &Obstacle) -> bool {
        let Some(top) = obstacle.top_z_mm else { return false };
        let reach = scene.clearance_of(obstacle) - TOUCH_MM;
        let bounds = obstacle.shape.bounds().grown(reach.max(0.0));
        self.paths().iter().any(|path| {
            let mut from = path.start_z_mm;
            path.edges().zip(&path.steps).any(|(edge, step)| {
                let below = std::mem::replace(&mut from, step.z_mm);
                let above = below.zip(step.z_mm).is_some_and(|(from, to)| from.min(to) >= top);
                let near = || {
                    let border = obstacle.shape.rings().flat_map(Ring::edges);
                    obstacle.shape.contains(edge.start())
                        || border.map(|other| other.distance(&edge)).any(|distance| distance < reach)
                };
                above && edge.bounds().meets(&bounds) && near()
            })
        })
    }

    /// The height at which the only move travels, where it has heights.
    pub(super) fn level(&self) -> Option<f64> {
        let [path] = self.paths() else { return None };
        let heights = path.steps.iter().map(|step| step.z_mm).chain([path.start_z_mm]);
        heights.flatten().max_by(f64::total_cmp)
    }

    /// Whether the obstacle parts start from target.
    pub(super) fn parts(&self, id: &str) -> bool {
        match self {
            Self::NoPath { separating, .. } | Self::ToolChange { separating, .. } => {
                separating.iter().any(|each| each == id)
            }
            _ => false,
        }
    }

    /// Where the tool may be changed: regions and points.
    pub(super) fn permitted(&self) -> (&'a [Polygon], &'a [Point]) {
        match *self {
            Self::ToolChange { regions, points, .. } => (regions, points),
            _ => (&[], &[]),
        }
    }

    /// Where the tool is changed.
    pub(super) fn place(&self) -> Option<Point> {
        match *self {
            Self::ToolChange { moves, .. } => moves.first().map(Path::end),
            _ => None,
        }
    }
}
