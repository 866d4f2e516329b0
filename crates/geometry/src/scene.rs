//! What a tool must keep away from: the question that planner and checker share.

use crate::{Polygon, Ring};

/// Obstacles, work area, and the distances that the tool's centre keeps from them.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Where the tool may be at all. Absent: the whole plane.
    pub work_area: Option<Polygon>,
    /// What is in the way. Ids are unique.
    pub obstacles: Vec<Obstacle>,
    /// Distance from obstacles that do not name their own, millimetres: 0, or within
    /// [`crate::SMALLEST_CLEARANCE_MM`] and [`crate::LARGEST_CLEARANCE_MM`].
    pub clearance_mm: f64,
    /// Distance from the work area's border, millimetres. Absent: `clearance_mm`.
    pub work_area_clearance_mm: Option<f64>,
    /// How barriers turn convex corners.
    pub corner_style: CornerStyle,
}

/// One thing in the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Unique in the scene.
    pub id: String,
    /// What it covers.
    pub shape: Polygon,
    /// Overrides the scene's clearance, millimetres.
    pub clearance_mm: Option<f64>,
    /// Height of its top, millimetres; it reaches down without end. Absent: it can't be passed over.
    pub top_z_mm: Option<f64>,
}

/// How a barrier (the obstacle grown by the clearance) turns a convex corner.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CornerStyle {
    /// By a circular arc: the true distance.
    #[default]
    Round,
    /// By parallel lines that meet in a control point, as published in 2008. Circular edges grow as circular
    /// edges. The barriers count as a union.
    Miter {
        /// Control point's distance over clearance, at least 1, beyond which the corner is cut square to its
        /// bisector. Absent: [`MITER_RATIO_LIMIT`].
        limit: Option<f64>,
    },
}

/// Beyond this ratio of control point distance to clearance every mitred corner is cut square: a needle's
/// control point would lie infinitely far away.
pub const MITER_RATIO_LIMIT: f64 = 1000.0;

/// The id that stands for the work area's border where plans and findings name obstacles; no obstacle may carry it.
pub const WORK_AREA_ID: &str = "work_area";

impl Scene {
    /// The clearance that is kept from `obstacle`, millimetres.
    #[must_use]
    pub fn clearance_of(&self, obstacle: &Obstacle) -> f64 {
        obstacle.clearance_mm.unwrap_or(self.clearance_mm)
    }

    /// The clearance that is kept from the work area's border, millimetres.
    #[must_use]
    pub fn border_clearance(&self) -> f64 {
        self.work_area_clearance_mm.unwrap_or(self.clearance_mm)
    }

    /// Count of vertices of work area and obstacles.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.obstacles
            .iter()
            .map(|obstacle| &obstacle.shape)
            .chain(&self.work_area)
            .map(Polygon::vertex_count)
            .sum()
    }

    /// Every ring of the scene: obstacles first, then the border.
    pub fn rings(&self) -> impl Iterator<Item = &Ring> {
        self.obstacles.iter().map(|obstacle| &obstacle.shape).chain(&self.work_area).flat_map(Polygon::rings)
    }
}
