//! Where to change the tool: the place among those permitted that makes start → change → target cheapest.
//!
//! The data's way: what is permitted and free becomes parts of borders and spots (`permitted`); two fans, search trees from
//! start and target, meet on them best first (`meeting`), on a part where the ways from two bends are shortest together
//! (`detour`, `kinked`, `way`); with heights, at the best pair of levels (`levels`). See docs/decisions/0011-tool-change.md.

mod detour;
mod kinked;
mod levels;
mod meeting;
mod parted;
mod permitted;
mod plan;
mod question;
mod way;

pub use plan::plan_tool_change;
pub use question::{ToolChange, ToolChangeAnswer, ToolChangePlan};
