//! The plane as Traverse sees it: points, edges (straight and circular), rings, polygons, paths and scenes.
//!
//! Right-handed, seen from above: x to the right, y up, angles and bulges positive counter-clockwise. Lengths are
//! millimetres, angles radians. No I/O, no clock, no wire types.
//!
//! What can be built is valid: constructors report everything that is wrong at once.
//!
//! ```
//! use traverse_geometry::{Location, Point, Polygon, Reason, Ring};
//!
//! // A plate of 40 × 20 mm with a hole of 10 mm: two half circles.
//! let plate = Ring::from_xy(&[0.0, 0.0, 40.0, 0.0, 40.0, 20.0, 0.0, 20.0], &[])?;
//! let hole = Ring::from_xy(&[15.0, 10.0, 25.0, 10.0], &[1.0, 1.0])?;
//! let part = Polygon::new(plate, vec![hole])?;
//! assert!((part.area() - (800.0 - 25.0 * std::f64::consts::PI)).abs() < 1e-9);
//! assert_eq!(part.locate(Point::new(20.0, 10.0)), Location::Outside);
//! assert_eq!(part.distance_to_border(Point::new(20.0, 10.0)), 5.0);
//!
//! let findings = Ring::from_xy(&[0.0, 0.0, 4.0, 4.0, 4.0, 0.0, 0.0, 3.0], &[]).unwrap_err();
//! assert_eq!(findings[0].reason, Reason::EdgesCross);
//! assert_eq!(findings[0].field, "xy_mm");
//! # Ok::<(), Vec<traverse_geometry::Finding>>(())
//! ```

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
mod flatten;
mod location;
mod loops;
mod motion;
mod nearest;
mod orientation;
mod path;
mod point;
mod polygon;
mod polygon_validation;
mod polyline;
mod rapid_rules;
mod ring;
mod ring_index;
mod ring_validation;
mod scene;
mod scene_findings;
mod section;
mod segment;
mod tolerance;
mod travel_cost;

pub use arc::Arc;
pub use bounds::Bounds;
pub use edge::Edge;
pub use finding::{Finding, Reason};
pub use flatten::{Chords, FlattenSide};
pub use location::Location;
pub use motion::Motion;
pub use orientation::{Orientation, orientation};
pub use path::{Path, PathArc, PathStep};
pub use point::{Point, Vector, cross, left_of, positive_angle, unit};
pub use polygon::Polygon;
pub use polyline::Polyline;
pub use rapid_rules::{
    ARC_CHORD_TOLERANCE_MM, ArcOutput, CLEARANCE_CHOICES, EndRule, HeightRule, RapidMotion, RapidRules,
};
pub use ring::Ring;
pub use scene::{CornerStyle, MITER_RATIO_LIMIT, Obstacle, Scene, WORK_AREA_ID};
pub use section::{Part, PlacedSection, Pose, Section, SectionLayout, SlideRule};
pub use segment::Segment;
pub use tolerance::{
    ARC_RADIUS_RATIO, CONTACT_TOLERANCE_MM, COORDINATE_LIMIT_MM, CROSSING_WORK_LIMIT, FINDINGS_LIMIT,
    FLAT_ARC_MM, LARGEST_CLEARANCE_MM, RADIUS_LIMIT_MM, SMALLEST_CLEARANCE_MM,
};
pub use travel_cost::{
    ACCELERATION_RANGE_MM_PER_S2, AxisSpeeds, CostUnit, JUNCTION_DEVIATION_LIMIT_MM, Kinematics,
    SPEED_RANGE_MM_PER_S, TravelCost,
};
