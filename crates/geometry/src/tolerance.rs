//! Every tolerance and limit of the plane, each named by the comparison that it serves.

/// How far inside a barrier still counts as touching it, millimetres: one nanometre.
///
/// Tangents and arcs are floating point and touch what they go round by construction, so half of all
/// contacts come out a rounding error inside. Planner and checker close contacts within this one constant.
pub const CONTACT_TOLERANCE_MM: f64 = 1e-6;

/// Largest absolute value of a coordinate, millimetres: one kilometre. Up to here the spacing of `f64`
/// (1.2e-10 mm) stays far below [`CONTACT_TOLERANCE_MM`].
pub const COORDINATE_LIMIT_MM: f64 = 1e6;

/// Smallest clearance other than 0, millimetres. Below it a clearance could not be told from contact.
pub const SMALLEST_CLEARANCE_MM: f64 = 1e-4;

/// Largest clearance, millimetres.
pub const LARGEST_CLEARANCE_MM: f64 = 1e5;

/// Largest radius of a circular edge, millimetres. Beyond it the centre is too far away for the
/// distance to the arc to be known to [`CONTACT_TOLERANCE_MM`].
pub const RADIUS_LIMIT_MM: f64 = 1e8;

/// A circular edge whose middle lies nearer than this to its chord is straight, millimetres.
pub const FLAT_ARC_MM: f64 = 1e-7;

/// Most that the two radii of an arc step (centre to start, centre to end) may differ, as a share of the radius.
pub const ARC_RADIUS_RATIO: f64 = 1e-9;

/// Most findings that are listed for one ring, open chain or polygon; one more finding says how many follow.
pub const FINDINGS_LIMIT: usize = 100;

/// Most work that the search for crossings of one ring or polygon may take, counted in tests of two bounding boxes:
/// a few seconds. Only input whose edges lie packed over each other by the hundred thousand comes near it.
pub const CROSSING_WORK_LIMIT: u64 = 400_000_000;
