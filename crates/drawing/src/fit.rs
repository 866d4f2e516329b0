//! Smooth curves as chains of circular arcs and segments.
//!
//! A piece of the curve is replaced by one edge or by a biarc: two arcs that have the directions of the curve at its
//! ends and share one where they meet (Bolton 1975). All points where the two could meet lie on one circle, and where
//! that circle cuts the curve they are made to meet, so every edge ends on the curve. A piece that no biarc follows
//! within the tolerance is parted into two to four, by how far it runs beside it: the error of a biarc falls with the
//! cube of its length. Cost: some 20 points of the curve per edge.

mod biarc;
mod cubic_bezier;
mod edges;
mod elliptic_arc;
mod follows;
mod smooth;
mod station;
mod track;

pub(crate) use cubic_bezier::CubicBezier;
pub(crate) use edges::fitted_edges;
pub(crate) use elliptic_arc::EllipticArc;
pub(crate) use smooth::Smooth;
