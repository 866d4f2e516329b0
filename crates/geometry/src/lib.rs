//! The plane as Traverse sees it: points, edges (straight and circular), rings, polygons, paths and scenes.
//!
//! Right-handed, seen from above: x to the right, y up, angles and bulges positive counter-clockwise. Lengths are
//! millimetres, angles radians. No I/O, no clock, no wire types.

mod arc;
mod arc_crossing;
mod area;
mod bounds;
mod box_tree;
mod chain_crossing;
mod chain_input;
mod crossing;
mod edge;
mod edge_distance;
mod finding;
mod finding_list;
mod location;
mod loops;
mod nearest;
mod orientation;
mod path;
mod point;
mod polygon;
mod polygon_validation;
mod polyline;
mod ring;
mod ring_index;
mod ring_validation;
mod scene;
mod scene_findings;
mod segment;
mod tolerance;

pub use arc::Arc;
pub use bounds::Bounds;
pub use edge::Edge;
pub use finding::{Finding, Reason};
pub use location::Location;
pub use orientation::{Orientation, orientation};
pub use path::{Path, PathArc, PathStep};
pub use point::{Point, Vector, cross, left_of, positive_angle, unit};
pub use polygon::Polygon;
pub use polyline::Polyline;
pub use ring::Ring;
pub use scene::{CornerStyle, MITER_RATIO_LIMIT, Obstacle, Scene, WORK_AREA_ID};
pub use segment::Segment;
pub use tolerance::{
    ARC_RADIUS_RATIO, CONTACT_TOLERANCE_MM, COORDINATE_LIMIT_MM, CROSSING_WORK_LIMIT, FINDINGS_LIMIT,
    FLAT_ARC_MM, LARGEST_CLEARANCE_MM, RADIUS_LIMIT_MM, SMALLEST_CLEARANCE_MM,
};
