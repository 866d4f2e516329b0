//! DXF in: ASCII and binary, R12 to R2018.
//!
//! The `dxf` crate reads the entities. It loses some types (HATCH) without a word, ends early at an empty line, and
//! takes about 2 kB per entity; so the file is first run through group by group ([`census`]): that counts every
//! entity, finds what is malformed with its line, and bounds the work before it begins. Cost: linear.

mod census;
mod entity;
mod groups;
mod reader;
mod sniff;

pub use reader::{read_dxf, read_dxf_from};
