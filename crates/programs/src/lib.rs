//! G-code programs in, the same programs with shorter and safer rapid moves out.
//!
//! A [`Program`] is read without being changed: modes, offsets and positions are followed as far as they can be known,
//! and what lies between two cuts becomes a [`Link`]. [`rewrite`] asks a [`RapidPlanner`] for the shortest way of each
//! and edits the text: blocks are inserted, way points taken out, everything else stays byte for byte.
//!
//! ```
//! use traverse_geometry::{CornerStyle, Obstacle, Polygon, Ring, Scene};
//! use traverse_programs::{Done, Program, ReadOptions, ScenePlanner, ToolScenes, WriteOptions, rewrite};
//! use traverse_solve::Budget;
//!
//! let clamp = Ring::from_xy(&[40.0, -10.0, 60.0, -10.0, 60.0, 30.0, 40.0, 30.0], &[]).expect("a box is a ring");
//! let scene = Scene {
//!     work_area: None,
//!     obstacles: vec![Obstacle { id: "clamp".into(), shape: Polygon::from_ring(clamp), clearance_mm: None, top_z_mm: None }],
//!     clearance_mm: 5.0,
//!     work_area_clearance_mm: None,
//!     corner_style: CornerStyle::Miter { limit: None },
//! };
//! let scenes = ToolScenes { any: scene, by_tool: Default::default(), safe_z_mm: None };
//! let text = b"G21 G90\nG0 X0 Y0\nG1 X10 F200\nG0 X100\nM30\n";
//! let program = Program::read(text, &ReadOptions::default())?;
//! let budget = Budget::unlimited();
//! let rewritten = rewrite(&program, &ScenePlanner::new(&scenes, &budget), &WriteOptions::default());
//! assert_eq!(rewritten.outcomes[0].hits, ["clamp"]);
//! assert_eq!(
//!     String::from_utf8(rewritten.text)?,
//!     "G21 G90\nG0 X0 Y0\nG1 X10 F200\nG0 X34.998 Y-15.002\nG0 X65.002 Y-15.002\nG0 X100 Y0\nG0 X100\nM30\n"
//! );
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod block;
mod codes;
mod decimal;
mod edit;
mod error;
mod grid;
mod interpreter;
mod lift;
mod lifting;
mod line;
mod link;
mod modal;
mod options;
mod outcome;
mod program;
mod protection;
mod rapid_planner;
mod reason;
mod rewrite;
mod rounded;
mod scene_planner;
mod spelling;
mod survey;
mod way_blocks;

pub use block::Fault;
pub use codes::Distortion;
pub use error::ProgramError;
pub use link::{Heights, Link};
pub use modal::Lost;
pub use options::{Offsets, ReadOptions};
pub use outcome::{Done, Outcome};
pub use program::{PROGRAM_BYTE_LIMIT, Program};
pub use rapid_planner::{Found, RapidPlanner, Straight, Travel};
pub use reason::Reason;
pub use rewrite::{Rewritten, WriteOptions, rewrite};
pub use scene_planner::{PassingOver, ScenePlanner, ToolScenes};
