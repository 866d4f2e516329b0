//! DXF out: a plan as a drawing, R2000 ASCII in millimetres, on layers of its own.
//!
//! Written by hand: the `dxf` crate rounds to 12 decimals and leaves out handles and the root dictionary, which
//! ezdxf's audit has to repair. Numbers here are the shortest text that reads back as the same `f64`. Cost: linear.

mod frame;
mod groups;
mod layout;
mod polyline;

pub use layout::{PARTS_LAYER, SECTION_IDS_LAYER, SECTIONS_LAYER, STRIP_LAYER, write_layout_dxf};

use frame::{FileLayer, begin_file, end_file};
use groups::Groups;
use polyline::polyline;
use traverse_geometry::{Bounds, Path, Point, Polygon, Scene};

/// The layer of the path: one LWPOLYLINE from start to target.
pub const PATH_LAYER: &str = "TRAVERSE_PATH";
/// The layer of the path's ends: one POINT for the start, then one for the target.
pub const ENDS_LAYER: &str = "TRAVERSE_ENDS";
/// The layer of obstacles: one closed LWPOLYLINE for each ring.
pub const OBSTACLES_LAYER: &str = "TRAVERSE_OBSTACLES";
/// The layer of the work area: one closed LWPOLYLINE for each ring.
pub const WORK_AREA_LAYER: &str = "TRAVERSE_WORK_AREA";

/// Why a plan can't be written as DXF.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DxfWriteError {
    /// A coordinate, centre or angle is no finite number.
    #[error("step {step} of the path, or section {step} of the layout, holds {value}; give finite numbers")]
    NotFinite {
        /// Counted from 1; 0 for the start.
        step: usize,
        /// What it holds.
        value: f64,
    },
}

/// The path, its ends and, when it is given, the scene round it as the text of a DXF file.
///
/// Circular steps become bulges; what turns more than half a turn is split in two. A path without steps has ends
/// but no polyline. The length of the polyline is that of the path within 1e-9 of it.
///
/// # Errors
/// When the path holds a number that is not finite.
pub fn write_dxf(path: &Path, scene: Option<&Scene>) -> Result<String, DxfWriteError> {
    check_finite(path)?;
    let mut bounds = path.edges().fold(Bounds::of([path.start]), |bounds, edge| bounds.union(edge.bounds()));
    let mut layers = vec![
        FileLayer { name: PATH_LAYER, color: 5, lineweight: 50 },
        FileLayer { name: ENDS_LAYER, color: 3, lineweight: 35 },
    ];
    if let Some(scene) = scene {
        bounds = scene.rings().fold(bounds, |bounds, ring| bounds.union(ring.bounds()));
        layers.push(FileLayer { name: OBSTACLES_LAYER, color: 1, lineweight: 25 });
        layers.push(FileLayer { name: WORK_AREA_LAYER, color: 8, lineweight: 25 });
    }
    let mut groups = Groups::default();
    let model_space = begin_file(&mut groups, &layers, bounds);
    if let Some(scene) = scene {
        for ring in scene.work_area.iter().flat_map(Polygon::rings) {
            polyline(&mut groups, model_space, WORK_AREA_LAYER, ring.edges(), true);
        }
        for ring in scene.obstacles.iter().flat_map(|obstacle| obstacle.shape.rings()) {
            polyline(&mut groups, model_space, OBSTACLES_LAYER, ring.edges(), true);
        }
    }
    if !path.steps.is_empty() {
        polyline(&mut groups, model_space, PATH_LAYER, path.edges(), false);
    }
    for end in [path.start, path.end()] {
        groups.entity("POINT", model_space, ENDS_LAYER, "AcDbPoint");
        groups.point(10, end);
    }
    Ok(end_file(groups))
}

fn check_finite(path: &Path) -> Result<(), DxfWriteError> {
    let all_finite = |step: usize, values: &[f64]| {
        let wrong = values.iter().find(|value| !value.is_finite());
        wrong.map_or(Ok(()), |&value| Err(DxfWriteError::NotFinite { step, value }))
    };
    let xy = |p: Point| [p.x, p.y];
    all_finite(0, &xy(path.start))?;
    for (step, number) in path.steps.iter().zip(1..) {
        all_finite(number, &xy(step.end))?;
        if let Some(arc) = step.arc {
            all_finite(number, &[arc.center.x, arc.center.y, arc.sweep])?;
        }
    }
    Ok(())
}
