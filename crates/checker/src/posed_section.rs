//! A section in one of its poses, ready to be held against others: its parts are solids that keep the gap.

use crate::boundary::Boundary;
use crate::boundary_tree::BoundaryTree;
use crate::clearance::Surroundings;
use crate::witness::witnesses;
use traverse_geometry::{Bounds, CornerStyle, Motion, Obstacle, Point, Pose, Scene, Section, Vector};

/// A section in one pose. Its left edge lies at x = 0; y is as it was sent.
pub(crate) struct PosedSection {
    scene: Scene,
    pub(crate) boundary: Boundary,
    pub(crate) tree: BoundaryTree,
    /// Box round all parts.
    pub(crate) bounds: Bounds,
    /// Points well inside each part.
    pub(crate) witnesses: Vec<Vec<Point>>,
}

impl PosedSection {
    /// Makes `section` ready in `pose`, given up when `go_on` says no. Cost: O(n log n) for n vertices.
    pub(crate) fn new(section: &Section, pose: Pose, gap_mm: f64, go_on: &dyn Fn() -> bool) -> Option<Self> {
        let bounds = section.bounds();
        let motion = pose.motion(&bounds).then(&Motion::translation(Vector::new(-bounds.min.x, 0.0)));
        let mut obstacles = Vec::with_capacity(section.parts.len());
        for part in &section.parts {
            if !go_on() {
                return None;
            }
            let shape = part.shape.moved(&part.motion().then(&motion));
            obstacles.push(Obstacle { id: part.id.clone(), shape, clearance_mm: None, top_z_mm: None });
        }
        let witnesses = obstacles.iter().map(|part| witnesses(&part.shape)).collect();
        let scene = Scene {
            work_area: None,
            obstacles,
            clearance_mm: gap_mm,
            work_area_clearance_mm: None,
            corner_style: CornerStyle::Round,
        };
        let boundary = Boundary::of(&scene);
        let tree = BoundaryTree::over(&boundary, go_on)?;
        let size = bounds.size();
        let bounds = Bounds { min: Point::new(0.0, bounds.min.y), max: Point::new(size.x, bounds.max.y) };
        Some(Self { scene, boundary, tree, bounds, witnesses })
    }

    /// The id of a part.
    pub(crate) fn part_id(&self, solid: u32) -> &str {
        &self.scene.obstacles[solid as usize].id
    }

    /// Its parts, ready to be asked.
    pub(crate) fn around<'a>(&'a self, tolerance: f64, go_on: &'a dyn Fn() -> bool) -> Surroundings<'a> {
        // What comes near are borders of other sections: no steps.
        let step_of = &[];
        Surroundings {
            scene: &self.scene,
            boundary: &self.boundary,
            tree: &self.tree,
            tolerance,
            step_of,
            go_on,
        }
    }
}
