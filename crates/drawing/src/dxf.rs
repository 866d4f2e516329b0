//! DXF in: ASCII and binary, R12 to R2018.
//!
//! In three steps, each bounded before it begins: [`file`] runs once through the groups and keeps the entities of
//! the model and of every block; [`totals`] counts what the blocks would come to when they are drawn out, and finds
//! blocks that hold themselves; [`explode`] draws them out, each shape as a curve in millimetres. Cost: linear in the
//! bytes and in the curves that come out.
//!
//! The groups are read by hand: the `dxf` crate loses some types (HATCH) without a word, ends early at an empty line,
//! takes about 2 kB per entity and reads text in binary files wrongly.

mod aci;
mod affine;
mod blocks;
mod budget;
mod chain;
mod entity;
mod explode;
mod file;
mod fit_points;
mod groups;
mod hatch;
mod heights;
mod insert;
mod layers;
mod nurbs;
mod outline;
mod polyline;
mod reader;
mod record;
mod round;
mod sniff;
mod spline;
mod text;
mod totals;
mod types;

pub use reader::{read_dxf, read_dxf_from};
