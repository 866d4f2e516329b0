//! The work area from the loops of its layers.

use crate::obstacles::Shape;
use crate::role_loops::RoleLoops;
use crate::{DrawingFinding, Fault, SceneError};
use traverse_geometry::Polygon;

/// The region inside the one outermost loop, less the loops directly inside it; none without a layer.
pub(crate) fn work_area_of(
    areas: Vec<(RoleLoops<'_>, Vec<DrawingFinding>)>,
    findings: &mut Vec<DrawingFinding>,
) -> Result<Option<Shape>, SceneError> {
    let count: usize = areas.iter().map(|(layer, _)| layer.forest.roots().count()).sum();
    let Some((first, _)) = areas.first() else { return Ok(None) };
    let first_layer = first.layer.to_owned();
    if count > 1 {
        return Err(SceneError::SeveralWorkAreas { layer: first_layer, count });
    }
    let mut on_layers = Vec::new();
    let mut border = None;
    for (layer, found) in areas {
        on_layers.extend(found);
        let root = layer.forest.roots().next();
        border = border.or(root.map(|root| (layer, root)));
    }
    let Some((layer, root)) = border else {
        return Err(SceneError::NoWorkAreaLoop { layer: first_layer, findings: on_layers });
    };
    let mut invalid = Vec::new();
    let outer = layer.ring(root, &mut invalid);
    let children = &layer.forest.children[root];
    let holes: Vec<_> = children.iter().filter_map(|&hole| layer.ring(hole, &mut invalid)).collect();
    let Some(outer) = outer else {
        return Err(SceneError::InvalidWorkArea { findings: invalid });
    };
    // A hole that is lost would let the tool in where it must not be: refuse.
    if !invalid.is_empty() {
        return Err(SceneError::InvalidWorkArea { findings: invalid });
    }
    let area = Polygon::new(outer, holes).map_err(|why| SceneError::InvalidWorkArea {
        findings: layer.findings_at(root, children, why, |finding| Fault::InvalidLoop { finding }),
    })?;
    findings.extend(on_layers);
    for (island, &depth) in layer.forest.depths.iter().enumerate() {
        if depth == 2 {
            let island = &layer.loops[island];
            findings.push(layer.finding(island, island.vertices[0], Fault::IslandInWorkArea));
        }
    }
    let deviation_mm = layer.loops.iter().map(|each| each.deviation_mm).fold(0.0, f64::max);
    Ok(Some(Shape { polygon: area, deviation_mm }))
}
