//! Drawings in, pictures of plans out.

mod curve;
mod drawing;
mod dxf;
mod error;
mod finding;
mod forest;
mod joining;
mod monotone;
mod obstacles;
mod options;
mod pattern;
mod picture;
mod roles;
mod scene_from_drawing;
mod scene_report;
mod unit;
mod unused;
mod work_area;

pub use curve::Curve;
pub use drawing::{Drawing, Layer};
pub use dxf::{read_dxf, read_dxf_from};
pub use error::ReadError;
pub use finding::{DrawingFinding, Fault};
pub use forest::Forest;
pub use joining::{JOIN_TOLERANCE_MM, Joined, Loop, join_loops};
pub use options::ReadOptions;
pub use pattern::LayerPattern;
pub use picture::{Shown, picture_of_plan};
pub use roles::{Roles, WORK_AREA_LAYERS};
pub use scene_from_drawing::{SceneOptions, scene_from_drawing};
pub use scene_report::{LayerRole, LayerUse, SceneError, SceneFromDrawing, SceneReport};
pub use unit::LengthUnit;
pub use unused::{Unused, WhyUnused};
