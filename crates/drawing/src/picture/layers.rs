//! The curves of a drawing, layer by layer: closed loops lightly filled, open chains on a broad pale line.

use super::extent::can_be_drawn;
use super::frame::Frame;
use super::layer_style::LayerStyle;
use super::outline::push_chain;
use super::text::escaped;
use crate::{Curve, Drawing, JOIN_TOLERANCE_MM, Joined, Layer, join_loops};
use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt::Write;
use traverse_geometry::Bounds;

/// The layers, joined to see what is closed.
pub(super) struct Layers<'a> {
    layers: Vec<(&'a Layer, Joined)>,
}

/// Of curves smaller than this only one is drawn in each square of that side, canvas units: bounds the file's size.
const SPECK: f64 = 0.5;

impl<'a> Layers<'a> {
    pub(super) fn of(drawing: &'a Drawing) -> Self {
        let joined =
            |layer: &'a Layer| (layer, join_loops(&layer.name, &drawable(&layer.curves), JOIN_TOLERANCE_MM));
        Self { layers: drawing.layers.iter().map(joined).collect() }
    }

    /// Count of closed loops.
    pub(super) fn loop_count(&self) -> usize {
        self.layers.iter().map(|(_, joined)| joined.loops.len()).sum()
    }

    /// Whether any curve belongs to an open chain.
    pub(super) fn any_open(&self) -> bool {
        self.layers.iter().any(|(_, joined)| !joined.open_curves.is_empty())
    }

    pub(super) fn draw(&self, svg: &mut String, frame: &Frame) {
        for (i, (layer, joined)) in self.layers.iter().enumerate() {
            self.fill(svg, LayerStyle::of(i), joined, frame);
            let open = joined.open_curves.iter().filter_map(|&curve| layer.curves.get(curve));
            push_path(svg, "glow", "", &data_of(open, frame), "");
        }
        // All lines above all fills.
        for (i, (layer, _)) in self.layers.iter().enumerate() {
            let data = data_of(layer.curves.iter(), frame);
            push_path(svg, "curve", &LayerStyle::of(i).stroke(), &data, &layer.name);
        }
    }

    fn fill(&self, svg: &mut String, style: LayerStyle, joined: &Joined, frame: &Frame) {
        let mut data = String::new();
        let mut specks = Specks::default();
        for each in &joined.loops {
            if each.vertices.iter().all(|&p| can_be_drawn(p)) && specks.take(each.bounds(), frame) {
                push_chain(&mut data, each.edges(), true, frame);
            }
        }
        push_path(svg, "loops", &style.fill(), &data, "");
    }
}

/// The curves, with empty ones in place of those that can't be drawn.
fn drawable(curves: &[Curve]) -> Cow<'_, [Curve]> {
    let fits = |curve: &Curve| curve.vertices.iter().all(|&p| can_be_drawn(p));
    if curves.iter().all(fits) {
        return Cow::Borrowed(curves);
    }
    let nothing = || Curve::new(Vec::new(), Vec::new(), false);
    curves.iter().map(|curve| if fits(curve) { curve.clone() } else { nothing() }).collect()
}

fn data_of<'a>(curves: impl Iterator<Item = &'a Curve>, frame: &Frame) -> String {
    let mut data = String::new();
    let mut specks = Specks::default();
    for curve in curves.filter(|curve| curve.vertices.iter().all(|&p| can_be_drawn(p))) {
        let bounds = curve.edges().map(|edge| edge.bounds()).fold(Bounds::EMPTY, Bounds::union);
        if !bounds.is_empty() && specks.take(bounds, frame) {
            push_chain(&mut data, curve.edges(), curve.closed, frame);
        }
    }
    data
}

fn push_path(svg: &mut String, class: &str, attributes: &str, data: &str, name: &str) {
    if data.is_empty() {
        return;
    }
    let _ = write!(svg, "<path class=\"{class}\"{attributes} d=\"{data}\"");
    let _ = match name {
        "" => writeln!(svg, "/>"),
        _ => writeln!(svg, "><title>{}</title></path>", escaped(name)),
    };
}

/// Where curves too small to be seen one by one are drawn already.
#[derive(Default)]
struct Specks(HashSet<(i64, i64)>);

impl Specks {
    /// Whether something of these bounds has to be drawn.
    fn take(&mut self, bounds: Bounds, frame: &Frame) -> bool {
        let size = bounds.size() * frame.scale;
        let (x, y) = frame.place(bounds.min);
        size.x.max(size.y) >= SPECK || self.0.insert(((x / SPECK) as i64, (y / SPECK) as i64))
    }
}
