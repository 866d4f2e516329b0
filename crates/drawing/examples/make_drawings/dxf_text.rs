//! A small DXF file as text: header, layers, entities.

use std::fmt::Write;

/// A vertex and the bulge of the edge that leaves it.
pub(crate) type Vertex = (f64, f64, f64);

/// `$INSUNITS` for inches.
pub(crate) const INCHES: i16 = 1;
/// `$INSUNITS` for millimetres.
pub(crate) const MILLIMETRES: i16 = 4;

/// Collects entities, then writes the file.
pub(crate) struct DxfText {
    entities: String,
    layers: Vec<&'static str>,
    handle: u32,
    units: i16,
    /// How many millimetres a unit of the file is; coordinates are given in millimetres.
    scale: f64,
}

impl DxfText {
    pub(crate) fn new(units: i16) -> Self {
        let scale = if units == INCHES { 25.4 } else { 1.0 };
        Self { entities: String::new(), layers: Vec::new(), handle: 0x100, units, scale }
    }

    pub(crate) fn line(&mut self, layer: &'static str, (x0, y0): (f64, f64), (x1, y1): (f64, f64)) {
        self.begin("LINE", "AcDbLine", layer);
        self.lengths(&[(10, x0), (20, y0), (11, x1), (21, y1)]);
    }

    pub(crate) fn circle(&mut self, layer: &'static str, x: f64, y: f64, radius: f64) {
        self.begin("CIRCLE", "AcDbCircle", layer);
        self.lengths(&[(10, x), (20, y), (40, radius)]);
    }

    /// Counter-clockwise from angle to angle, degrees.
    pub(crate) fn arc(&mut self, layer: &'static str, center: (f64, f64), radius: f64, from: f64, to: f64) {
        self.begin("ARC", "AcDbCircle", layer);
        self.lengths(&[(10, center.0), (20, center.1), (40, radius)]);
        self.group(100, "AcDbArc");
        self.group(50, &number(from));
        self.group(51, &number(to));
    }

    pub(crate) fn polyline(&mut self, layer: &'static str, vertices: &[Vertex]) {
        self.begin("LWPOLYLINE", "AcDbPolyline", layer);
        self.group(90, &vertices.len().to_string());
        self.group(70, "1");
        for &(x, y, bulge) in vertices {
            self.lengths(&[(10, x), (20, y)]);
            if bulge != 0.0 {
                self.group(42, &number(bulge));
            }
        }
    }

    pub(crate) fn label(&mut self, layer: &'static str, x: f64, y: f64, text: &str) {
        self.begin("TEXT", "AcDbText", layer);
        self.lengths(&[(10, x), (20, y), (40, 6.0)]);
        self.group(1, text);
    }

    /// A closed chain as single LINE and ARC entities: every second one run backwards, in an order of their own, with
    /// ends that miss each other by up to 4 µm, as exports after several roundings have them.
    pub(crate) fn loose_loop(&mut self, layer: &'static str, vertices: &[Vertex]) {
        let count = vertices.len();
        let stride = (2..count).find(|stride| greatest_common_divisor(*stride, count) == 1).unwrap_or(1);
        for turn in 0..count {
            let i = turn * stride % count;
            let (start, end) = (vertices[i], vertices[(i + 1) % count]);
            let miss = |k: usize| (((i * 2 + k) * 7919) % 9) as f64 * 0.5e-3 - 2e-3;
            let (x0, y0) = (start.0 + miss(0), start.1 - miss(1));
            let (x1, y1) = (end.0 - miss(1), end.1 + miss(0));
            if start.2 == 0.0 && turn % 2 == 0 {
                self.line(layer, (x0, y0), (x1, y1));
            } else if start.2 == 0.0 {
                self.line(layer, (x1, y1), (x0, y0));
            } else {
                self.arc_by_bulge(layer, (x0, y0), (x1, y1), start.2);
            }
        }
    }

    fn arc_by_bulge(&mut self, layer: &'static str, (x0, y0): (f64, f64), (x1, y1): (f64, f64), bulge: f64) {
        let rise = (1.0 - bulge * bulge) / (4.0 * bulge);
        let center = ((x0 + x1) / 2.0 - (y1 - y0) * rise, (y0 + y1) / 2.0 + (x1 - x0) * rise);
        let radius = (x0 - center.0).hypot(y0 - center.1);
        let angle = |x: f64, y: f64| (y - center.1).atan2(x - center.0).to_degrees().rem_euclid(360.0);
        let (first, last) = (angle(x0, y0), angle(x1, y1));
        let (from, to) = if bulge > 0.0 { (first, last) } else { (last, first) };
        self.arc(layer, center, radius, from, to);
    }

    pub(crate) fn finish(self, title: &str) -> String {
        let mut text = String::new();
        let mut group = |code: i16, value: &str| {
            let _ = writeln!(text, "{code:>3}\n{value}");
        };
        group(999, title);
        group(999, "Copyright the Traverse founders. MIT OR Apache-2.0.");
        group(999, "Written by crates/drawing/examples/make_drawings.rs.");
        for (code, value) in [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1015"), (9, "$INSUNITS")]
        {
            group(code, value);
        }
        group(70, &self.units.to_string());
        for (code, value) in [(0, "ENDSEC"), (0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LAYER")] {
            group(code, value);
        }
        group(70, &self.layers.len().to_string());
        for (number, layer) in self.layers.iter().enumerate() {
            group(0, "LAYER");
            group(100, "AcDbSymbolTableRecord");
            group(100, "AcDbLayerTableRecord");
            group(2, layer);
            group(70, "0");
            group(62, &(number + 1).to_string());
            group(6, "CONTINUOUS");
        }
        for (code, value) in [(0, "ENDTAB"), (0, "ENDSEC"), (0, "SECTION"), (2, "ENTITIES")] {
            group(code, value);
        }
        text.push_str(&self.entities);
        text.push_str("  0\nENDSEC\n  0\nEOF\n");
        text
    }

    fn begin(&mut self, entity: &str, class: &str, layer: &'static str) {
        if !self.layers.contains(&layer) {
            self.layers.push(layer);
        }
        self.handle += 1;
        self.group(0, entity);
        self.group(5, &format!("{:X}", self.handle));
        self.group(100, "AcDbEntity");
        self.group(8, layer);
        self.group(100, class);
    }

    fn group(&mut self, code: i16, value: &str) {
        let _ = writeln!(self.entities, "{code:>3}\n{value}");
    }

    fn lengths(&mut self, groups: &[(i16, f64)]) {
        for &(code, length) in groups {
            self.group(code, &number(length / self.scale));
        }
    }
}

/// Twelve digits after the point, as CAD programs write, without the zeros at the end.
fn number(value: f64) -> String {
    let text = format!("{value:.12}");
    let short = text.trim_end_matches('0');
    if short.ends_with('.') { format!("{short}0") } else { short.to_owned() }
}

fn greatest_common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { greatest_common_divisor(b, a % b) }
}
