//! In which order, and in which pose, the sections of a cutting layout join tightest: exact joins, true lengths, lower
//! bounds always and mostly a proof.

mod answer;
mod best_first;
mod certificate;
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
mod layout;
mod meeting;
mod moves;
mod neighbours;
mod offsets;
mod options;
mod order;
mod outline;
mod placing;
mod pose_choice;
mod profile;
mod progress;
mod published_effect;
mod published_order;
mod relaxation;
mod sampled_borders;
mod sequence;

pub use answer::{Ending, LayoutAnswer, LayoutPlan};
pub use certificate::{BoundCertificate, JoinDuals};
pub use contact::Contact;
pub use findings::{LARGEST_COPIES, LARGEST_PUBLISHED_COPIES, layout_findings};
pub use join::{Join, join};
pub use join_matrix::{JoinItem, JoinMatrix, joins};
pub use layout::{contacts, layout_length_mm, place, place_as_published};
pub use options::{Algorithm, EffectModel, InnerOverlap, OrderOptions};
pub use order::order_sections;
pub use published_effect::published_effect;
