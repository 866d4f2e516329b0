//! A layout of sections as a drawing.

use super::DxfWriteError;
use super::frame::{FileLayer, begin_file, end_file};
use super::groups::Groups;
use super::polyline::polyline;
use traverse_geometry::{Bounds, Edge, PlacedSection, Point, SectionLayout, Segment};

/// The layer of the parts' outlines and holes: one closed LWPOLYLINE for each ring.
pub const PARTS_LAYER: &str = "TRAVERSE_PARTS";
/// The layer of the sections' bounding boxes.
pub const SECTIONS_LAYER: &str = "TRAVERSE_SECTIONS";
/// The layer of the sections' ids: one TEXT for each, at the lower left corner of its box.
pub const SECTION_IDS_LAYER: &str = "TRAVERSE_SECTION_IDS";
/// The layer of the strip: one closed LWPOLYLINE from its start to the right end of what reaches furthest.
pub const STRIP_LAYER: &str = "TRAVERSE_STRIP";

/// Height of ids, as a share of the height of their section.
const LETTERS: f64 = 0.05;

/// The layout as the text of a DXF file: parts where they lie, the boxes and ids of their sections, the strip.
///
/// # Errors
/// When a place in the order is not finite.
pub fn write_layout_dxf(layout: &SectionLayout, order: &[PlacedSection]) -> Result<String, DxfWriteError> {
    for (placed, number) in order.iter().zip(1..) {
        if !placed.x_mm.is_finite() {
            return Err(DxfWriteError::NotFinite { step: number, value: placed.x_mm });
        }
    }
    let boxes: Vec<(Bounds, &PlacedSection)> = (order.iter())
        .filter_map(|placed| {
            let bounds = layout.sections.get(placed.section)?.bounds();
            let size = bounds.size();
            let min = Point::new(placed.x_mm, bounds.min.y);
            Some((Bounds { min, max: min + size }, placed))
        })
        .collect();
    let all = boxes.iter().fold(Bounds::EMPTY, |all, (each, _)| all.union(*each));
    let strip = match layout.strip_height_mm {
        _ if all.is_empty() => Bounds::of([Point::origin()]),
        Some(height) => Bounds {
            min: Point::new(0.0, all.min.y),
            max: Point::new(all.max.x, (all.min.y + height).max(all.max.y)),
        },
        None => Bounds { min: Point::new(0.0, all.min.y), max: all.max },
    };
    let mut groups = Groups::default();
    let layers = [
        FileLayer { name: PARTS_LAYER, color: 5, lineweight: 35 },
        FileLayer { name: SECTIONS_LAYER, color: 8, lineweight: 13 },
        FileLayer { name: SECTION_IDS_LAYER, color: 3, lineweight: 13 },
        FileLayer { name: STRIP_LAYER, color: 1, lineweight: 25 },
    ];
    let model_space = begin_file(&mut groups, &layers, strip.union(all));
    rectangle(&mut groups, model_space, STRIP_LAYER, &strip);
    for (bounds, placed) in boxes {
        let Some(section) = layout.sections.get(placed.section) else { continue };
        let into_layout = placed.motion(&section.bounds());
        for part in &section.parts {
            let shape = part.shape.moved(&part.motion().then(&into_layout));
            for ring in shape.rings() {
                polyline(&mut groups, model_space, PARTS_LAYER, ring.edges(), true);
            }
        }
        rectangle(&mut groups, model_space, SECTIONS_LAYER, &bounds);
        text(&mut groups, model_space, SECTION_IDS_LAYER, bounds.min, LETTERS * bounds.size().y, &section.id);
    }
    Ok(end_file(groups))
}

fn rectangle(groups: &mut Groups, owner: u32, layer: &str, bounds: &Bounds) {
    let Bounds { min, max } = *bounds;
    let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
    let edges = (0..4).map(|i| Edge::Segment(Segment::new(corners[i], corners[(i + 1) % 4])));
    polyline(groups, owner, layer, edges, true);
}

fn text(groups: &mut Groups, owner: u32, layer: &str, at: Point, height: f64, words: &str) {
    groups.entity("TEXT", owner, layer, "AcDbText");
    groups.point(10, at);
    groups.number(40, height.max(1e-3));
    groups.add(1, plain(words));
    groups.add(100, "AcDbText");
}

/// On one line, in the file's code page: what has no place in it is written as DXF escapes it.
fn plain(words: &str) -> String {
    let escaped = |c: char| match c {
        c if c.is_control() => " ".to_owned(),
        c if c.is_ascii() => c.to_string(),
        c => {
            let mut units = [0; 2];
            c.encode_utf16(&mut units).iter().map(|unit| format!("\\U+{unit:04X}")).collect()
        }
    };
    words.chars().map(escaped).collect()
}
