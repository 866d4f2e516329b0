//! Scenes that are kept for many rapid moves and change between them.
//!
//! The data's way: the scene is taken apart once (`terrain`); what can be seen from a corner or arc is worked out when a
//! search first gets there (`sight`, `occlusion`) and kept as links (`link`, `sights`); an edit changes the links that it
//! concerns when they are next used (`edit` makes many at once). A query adds its ends and searches along the links (`scene`,
//! `along_links`): what its start may see is told by a triangulated mesh (`cones`, `mesh`, `mesh_making`, `triangulating`),
//! where many queries have made one pay (`mesh_kept`), or by an ellipse (`growth`). Many ends at once are joined to the
//! links by what each sees (`fan`). A new scene whose search outgrows its memory is prepared for it (`links_at_last`).

mod along_links;
mod cones;
mod edit;
mod fan;
mod growth;
mod horizon;
mod label;
mod link;
mod links_at_last;
mod mesh;
mod mesh_kept;
mod mesh_making;
mod nearby;
mod occlusion;
mod scene;
mod sight;
mod sights;
mod terrain;
mod triangulating;

pub use edit::SceneEdit;
pub(crate) use fan::{Fan, FanRoom};
pub(crate) use link::Link;
pub(crate) use links_at_last::LinksAtLast;
pub(crate) use nearby::{ClearPoint, Nearby};
pub use scene::{EditRefusal, PreparedScene};
