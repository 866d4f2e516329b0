//! The picture of a drawing: every layer, and what is wrong with it.

use super::finding_list;
use super::frame::Frame;
use super::header::Header;
use super::label::Places;
use super::layer_style::LayerStyle;
use super::layers::Layers;
use super::legend::Legend;
use super::markers::{self, Kind, MARKED_FINDINGS};
use super::route::samples;
use super::sign::Sign;
use super::{extent, file};
use crate::counted::counted;
use crate::{Drawing, DrawingFinding, Fault};

/// Free border of the drawing, as a share of its extent: room for markers.
const AIR: f64 = 0.05;
/// So many layers are in the legend.
const LEGEND_LAYERS: usize = 24;
/// So many edges are kept free of markers.
const MOST_EDGES: usize = 20_000;

/// The picture of a drawing as an SVG file: every layer in a look of its own, closed loops lightly filled, open chains
/// on a broad pale line. `title` stands on top; it may be empty.
///
/// The first [`MARKED_FINDINGS`] findings are marked by number and listed below, in their own words; the rest is
/// counted. Equal arguments give equal text, byte for byte.
#[must_use]
pub fn picture_of_drawing(drawing: &Drawing, findings: &[DrawingFinding], title: &str) -> String {
    let layers = Layers::of(drawing);
    let header = header(drawing, &layers, findings, title);
    let frame = Frame::new(extent::of_drawing(drawing, findings), AIR, header.height());
    let mut body = String::new();
    layers.draw(&mut body, &frame);
    let curves = drawing.layers.iter().flat_map(|layer| &layer.curves);
    let curves = curves.filter(|curve| curve.vertices.iter().all(|&p| extent::can_be_drawn(p)));
    let edges = curves.flat_map(|curve| curve.edges().collect::<Vec<_>>()).take(MOST_EDGES);
    let gaps = markers::gap_points(findings, &frame);
    let mut places = Places::new(frame.area, &gaps, &samples(edges, &frame));
    markers::draw(&mut body, findings, &mut places, &frame);
    let legend = Legend::new(entries(drawing, &layers, findings), more_layers(drawing), &frame);
    let mut list = String::new();
    let bottom = finding_list::draw(&mut list, findings, legend.bottom());
    file(&header, &frame, &body, &legend, bottom, &list)
}

fn header(drawing: &Drawing, layers: &Layers<'_>, findings: &[DrawingFinding], title: &str) -> Header {
    let assumed = if drawing.unit_assumed { ", assumed" } else { "" };
    let header = Header::titled(title).with(&format!(
        "{} on {}, {}; unit of the file {}{assumed}",
        counted(drawing.curve_count(), "curve"),
        counted(drawing.layers.len(), "layer"),
        counted(layers.loop_count(), "closed loop"),
        drawing.unit
    ));
    match findings.len() {
        0 => header,
        count => header.with_alert(&counted(count, "finding")),
    }
}

fn entries(drawing: &Drawing, layers: &Layers<'_>, findings: &[DrawingFinding]) -> Vec<(Sign, String)> {
    let names = drawing.layers.iter().take(LEGEND_LAYERS).enumerate();
    let mut entries: Vec<(Sign, String)> =
        names.map(|(i, layer)| (Sign::Layer(LayerStyle::of(i)), layer.name.clone())).collect();
    let marked = findings.get(..MARKED_FINDINGS).unwrap_or(findings);
    let any = |kind: Kind| marked.iter().any(|finding| Kind::of(finding) == kind);
    let gaps = marked.iter().any(|finding| matches!(finding.fault, Fault::OpenChain { .. }));
    for (holds, sign, text) in [
        (layers.any_open(), Sign::OpenChain, "open chain"),
        (gaps, Sign::LooseEnd, "loose end"),
        (gaps, Sign::Line("gapline"), "gap"),
        (any(Kind::Lost), Sign::Marker(Kind::Lost), "left out: mend it"),
        (any(Kind::Kept), Sign::Marker(Kind::Kept), "taken as said below"),
    ] {
        if holds {
            entries.push((sign, text.to_owned()));
        }
    }
    entries
}

fn more_layers(drawing: &Drawing) -> String {
    match drawing.layers.len().saturating_sub(LEGEND_LAYERS) {
        0 => String::new(),
        more => format!("and {} more", counted(more, "layer")),
    }
}
