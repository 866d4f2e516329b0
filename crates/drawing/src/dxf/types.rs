//! Entity types that are not read, and why.

use crate::WhyUnused;

/// Types that a machine can't meet.
const ANNOTATION: [&str; 19] = [
    "ACAD_TABLE",
    "ARC_DIMENSION",
    "ATTDEF",
    "ATTRIB",
    "DIMENSION",
    "GEOPOSITIONMARKER",
    "LARGE_RADIAL_DIMENSION",
    "LEADER",
    "LIGHT",
    "MTEXT",
    "MULTILEADER",
    "MLEADER",
    "POINT",
    "RAY",
    "TEXT",
    "TOLERANCE",
    "VIEWPORT",
    "WIPEOUT",
    "XLINE",
];

/// Faces, meshes and bodies in space.
const BODIES: [&str; 12] = [
    "3DFACE",
    "3DSOLID",
    "BODY",
    "EXTRUDEDSURFACE",
    "LOFTEDSURFACE",
    "MESH",
    "NURBSURFACE",
    "PLANESURFACE",
    "REGION",
    "REVOLVEDSURFACE",
    "SURFACE",
    "SWEPTSURFACE",
];

/// Pictures and other files' pages that lie behind the drawing.
const PICTURES: [&str; 7] =
    ["DGNUNDERLAY", "DWFUNDERLAY", "IMAGE", "OLE2FRAME", "OLEFRAME", "PDFUNDERLAY", "POINTCLOUD"];

/// Why entities of a type that has no reader are not used.
pub(super) fn why_not_read(entity: &str) -> WhyUnused {
    if ANNOTATION.contains(&entity) {
        WhyUnused::Annotation
    } else if BODIES.contains(&entity) {
        WhyUnused::Body
    } else if PICTURES.contains(&entity) {
        WhyUnused::Picture
    } else {
        WhyUnused::Type
    }
}
