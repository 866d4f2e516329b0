//! Scenes that are kept for many rapid moves and change between them.
//!
//! The data's way: the scene is taken apart once (`terrain`); what can be seen from a corner or arc is worked out when a
//! search first gets there (`sight`, `occlusion`) and kept as links (`link`, `sights`); an edit changes the links that it
//! concerns when they are next used. A query adds its ends (`growth`) and searches along the links (`scene`).

mod along_links;
mod best;
mod growth;
mod horizon;
mod label;
mod link;
mod nearby;
mod occlusion;
mod scene;
mod sight;
mod sights;
mod terrain;

pub(crate) use link::Link;
pub(crate) use nearby::Nearby;
pub use scene::{EditRefusal, PreparedScene};
