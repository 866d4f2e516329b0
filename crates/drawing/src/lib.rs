//! Drawings in, pictures of plans out.
//!
//! A DXF or SVG file becomes a [`Drawing`]: layers of curves in millimetres, and a list of what could not be used.
//! Its curves are given [`Roles`]; [`scene_from_drawing`] joins the curves to loops, finds which lies in which and
//! builds the [`Scene`](traverse_geometry::Scene) that a rapid move is planned in. [`picture_of_plan`] draws scene
//! and plan.
//! No I/O but for the reader that is passed in, no clock, no panic on any input.
//!
//! ```
//! use traverse_drawing::{ReadOptions, SceneOptions, Shown, picture_of_plan, read_dxf, scene_from_drawing};
//! use traverse_geometry::{Path, Point};
//!
//! let file = b"0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\nPINS\n10\n50\n20\n20\n40\n8\n0\nENDSEC\n0\nEOF\n";
//! let drawing = read_dxf(file, &ReadOptions::default())?;
//! let made = scene_from_drawing(&drawing, &SceneOptions::new(2.0))?;
//! assert_eq!(made.scene.obstacles[0].id, "PINS/1");
//! assert!(made.report.is_complete() && made.report.unit_assumed);
//!
//! let mut path = Path::at(Point::new(0.0, 20.0));
//! path.line_to(Point::new(50.0, 34.0));
//! path.line_to(Point::new(100.0, 20.0));
//! let svg = picture_of_plan(&made.scene, Shown::Path(&path), "round a pin");
//! assert!(svg.starts_with("<svg"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod box_pairs;
mod color;
mod counted;
mod crossing_loops;
mod curve;
mod drawing;
mod dxf;
mod dxf_out;
mod error;
mod finding;
mod fit;
mod forest;
mod gcode;
mod inspection;
mod joining;
mod monotone;
mod obstacles;
mod options;
mod overlaps;
mod page_mapping;
mod part;
mod pattern;
mod picture;
mod png;
mod profile;
mod read_drawing;
mod role_loops;
mod roles;
mod scene_from_drawing;
mod scene_report;
mod sections;
mod selector;
mod sniff;
mod source;
mod svg;
mod unit;
mod unused;
mod work_area;

pub use color::Color;
pub use curve::Curve;
pub use drawing::{Drawing, Layer};
pub use dxf::{read_dxf, read_dxf_from};
pub use dxf_out::{
    DxfWriteError, ENDS_LAYER, OBSTACLES_LAYER, PARTS_LAYER, PATH_LAYER, SECTION_IDS_LAYER, SECTIONS_LAYER,
    STRIP_LAYER, WORK_AREA_LAYER, write_dxf, write_layout_dxf,
};
pub use error::ReadError;
pub use finding::{DrawingFinding, Fault};
pub use forest::Forest;
pub use gcode::{
    ArcMotion, GcodeDialect, GcodeError, GcodeMoves, GcodePlane, GcodeProgram, GcodeSettings, GcodeUnit,
    LARGEST_CHORD_TOLERANCE_MM, ModalMotion, ModalState, SMALLEST_CHORD_TOLERANCE_MM, SettingFinding,
    StraightMotion, XWord, chords_outside, gcode_moves, write_gcode,
};
pub use inspection::{Inspection, LayerInspection, inspect_drawing};
pub use joining::{JOIN_TOLERANCE_MM, Joined, Loop, join_loops};
pub use options::ReadOptions;
pub use page_mapping::PageMapping;
pub use part::{Part, Section};
pub use picture::{
    MARKED_FINDINGS, Shown, ShownLayout, picture_of_drawing, picture_of_layout, picture_of_plan,
};
pub use png::{
    LARGEST_PNG_PIXELS, LARGEST_PNG_WIDTH_PX, LARGEST_SVG_BYTES, PngError, SMALLEST_PNG_WIDTH_PX, png_of_svg,
};
pub use profile::{
    JUNCTION_DEVIATION_MM, Machine, MachineSpeeds, PROFILE_BYTE_LIMIT, ProfileError, ProfileFinding, Profiles,
};
pub use read_drawing::{read_drawing, read_drawing_from};
pub use roles::{ObstacleRole, Role, Roles, WORK_AREA_LAYERS};
pub use scene_from_drawing::{SceneOptions, scene_from_drawing};
pub use scene_report::{LayerUse, SceneError, SceneFromDrawing, SceneReport};
pub use sections::{
    BlockRules, PartSet, PartSetError, Piece, SectionOptions, SectionsBy, SectionsError, SectionsFromDrawing,
    build_blocks, read_part_set, sections_from_drawing,
};
pub use selector::Selector;
pub use source::{DrawnGroup, Source};
pub use svg::{read_svg, read_svg_from};
pub use unit::LengthUnit;
pub use unused::{Unused, WhyUnused};
