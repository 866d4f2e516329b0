//! Checks plans against their requests on the original geometry, with none of the planner's code.
//!
//! Of geometry it shares the data types, exact orientation and the tolerances. Distances with arcs, containment,
//! mitred corners and what touches are its own, so that a mistake has to be made twice to go unseen.
//!
//! ```
//! use traverse_checker::{ViolationReason, check_rapid_move};
//! use traverse_geometry::{CONTACT_TOLERANCE_MM, CornerStyle, Obstacle, Path, Point, Polygon, Ring, Scene};
//!
//! let square = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)].map(|(x, y)| Point::new(x, y));
//! let ring = Ring::new(square.to_vec(), Vec::new()).expect("a square is a ring");
//! let scene = Scene {
//!     work_area: None,
//!     obstacles: vec![Obstacle { id: "plate".into(), shape: Polygon::from_ring(ring), clearance_mm: None, top_z_mm: None }],
//!     clearance_mm: 2.0,
//!     work_area_clearance_mm: None,
//!     corner_style: CornerStyle::Round,
//! };
//! let (start, target) = (Point::new(-5.0, 11.5), Point::new(15.0, 11.5));
//! let mut path = Path::at(start);
//! path.line_to(target);
//! let check = check_rapid_move(&scene, start, target, &path, CONTACT_TOLERANCE_MM);
//! let [violation] = &check.violations[..] else { panic!("half a millimetre too near") };
//! assert_eq!(violation.reason, ViolationReason::TooClose);
//! assert_eq!(violation.message, "step 0 comes within 1.5 mm of obstacle plate; asked are 2 mm");
//! assert_eq!((check.cost, check.smallest_margin_mm), (20.0, Some(-0.5)));
//! ```

mod arc_distance;
mod as_run;
mod bound_claim;
mod boundary;
mod boundary_tree;
mod certificate;
mod certified_bound;
mod clearance;
mod contact;
mod corridor;
mod cost;
mod cross_cut;
mod curve;
mod curve_cuts;
mod exact_sum;
mod extent;
mod facing;
mod flank;
mod flank_meeting;
mod heights;
mod inside;
mod join_prices;
mod kinematics;
mod least_offset;
mod leg;
mod message;
mod mitre;
mod order_rules;
mod part_overlaps;
mod path_shape;
mod place_check;
mod posed_section;
mod rapid_check;
mod rules_check;
mod seam;
mod section_pair;
mod sections_check;
mod silhouette;
mod strided;
mod touching;
mod violation;
mod witness;

pub use bound_claim::{BoundClaim, check_certified_sections_while};
pub use certificate::{
    CERTIFICATE_NODE_LIMIT, CERTIFIED_PAIR_LIMIT, JoinPrices, LARGEST_DUAL_MM, LayoutCertificate,
    certificate_findings,
};
pub use certified_bound::{certified_bound_mm, certified_bound_mm_while, claim_tolerance_mm};
pub use part_overlaps::{OVERLAP_LIMIT, PartOverlap, part_overlaps_while};
pub use place_check::{PlaceCheck, PlacedChange, check_tool_change};
pub use rapid_check::{
    PathCheck, RapidMoveChecker, SMALLEST_TOLERANCE_MM, VIOLATION_LIMIT, check_rapid_move,
    check_rapid_move_while,
};
pub use rules_check::{check_rapid_move_by, check_rapid_move_by_while};
pub use sections_check::{SectionsCheck, check_sections, check_sections_while};
pub use violation::{Violation, ViolationReason};
