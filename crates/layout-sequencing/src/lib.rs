//! In which order, and in which pose, the sections of a cutting layout join tightest: exact joins, true lengths, lower
//! bounds always and mostly a proof.
//!
//! Sections stand side by side in a strip that begins at x = 0. Each slides left until one of its parts is as near to a
//! part of *any* earlier section as the gap permits ([`place`]); [`order_sections`] finds the order and the poses that
//! make the whole shortest. What two sections do to each other is a [`join()`]; all pairs are [`joins()`]. The effect as
//! published in 2009 is [`published_effect`], and [`place_as_published`] shows what becomes of it.
//!
//! No clock, no chance but the seed, no I/O.
//!
//! ```
//! use traverse_geometry::{Part, Point, Polygon, Pose, Ring, Section, SectionLayout, SlideRule};
//! use traverse_layout_sequencing::{OrderOptions, order_sections};
//! use traverse_solve::{Budget, Silent};
//!
//! let section = |id: &str, xy: &[f64]| {
//!     let shape = Polygon::from_ring(Ring::from_xy(xy, &[]).expect("a ring"));
//!     let part = Part { id: id.into(), shape, pole: Point::origin(), rotation_rad: 0.0, mirrored: false };
//!     Section { id: id.into(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
//! };
//! // A wedge that leans right, a block, and a wedge into which the first one fits.
//! let layout = SectionLayout {
//!     sections: vec![
//!         section("leaning", &[0.0, 0.0, 6.0, 0.0, 10.0, 10.0, 0.0, 10.0]),
//!         section("block", &[0.0, 0.0, 5.0, 0.0, 5.0, 10.0, 0.0, 10.0]),
//!         section("fitting", &[0.0, 0.0, 8.0, 0.0, 8.0, 10.0, 4.0, 10.0]),
//!     ],
//!     gap_mm: 1.0,
//!     strip_height_mm: Some(10.0),
//!     first: None,
//!     last: None,
//!     precedences: vec![],
//!     forbidden_joins: vec![],
//!     slide_rule: SlideRule::KeepOrder,
//! };
//! let answer = order_sections(&layout, &OrderOptions::default(), &Budget::unlimited(), &mut Silent)?;
//! let plan = answer.plan.as_ref().expect("nothing is forbidden");
//! assert!(answer.is_proven() && answer.lower_bound_mm == plan.length_mm);
//! assert!(plan.length_mm < plan.bounding_box_length_mm - 2.9);
//! # Ok::<(), Vec<traverse_geometry::Finding>>(())
//! ```

mod allowed_order;
mod answer;
mod beginning;
mod beginning_bound;
mod best_first;
mod certificate;
mod chain_bound;
mod completion;
mod contact;
mod curve;
mod envelope;
mod findings;
mod grid;
mod height_bound;
mod improvement;
mod inner_overlap;
mod instance;
mod join;
mod join_matrix;
mod kept_start;
mod layout;
mod lazy_relaxation;
mod longest_parts;
mod meeting;
mod moves;
mod neighbours;
mod offsets;
mod options;
mod order;
mod order_findings;
mod outline;
mod pace;
mod places;
mod placing;
mod pose_choice;
mod pose_prices;
mod profile;
mod progress;
mod published_effect;
mod published_order;
mod relaxation;
mod sampled_borders;
mod sequence;
mod thicknesses;

pub use answer::{Ending, LayoutAnswer, LayoutPlan};
pub use certificate::{BoundCertificate, JoinDuals};
pub use contact::Contact;
pub use findings::{LARGEST_COPIES, LARGEST_PUBLISHED_COPIES, layout_findings};
pub use join::{Join, join};
pub use join_matrix::{JoinItem, JoinMatrix, joins};
pub use layout::{contacts, layout_length_mm, place, place_as_published};
pub use options::{Algorithm, ContactList, EffectModel, InnerOverlap, OrderOptions};
pub use order::order_sections;
pub use published_effect::published_effect;
