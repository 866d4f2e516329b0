//! The picture of a layout: sections joined by bounding boxes in the order given, above; the layout itself, below; both
//! lengths, and what is saved.

use super::file;
use super::frame::{Box2, Frame, MARGIN, WIDTH};
use super::header::Header;
use super::legend::Legend;
use super::outline::polygon_data;
use super::sign::Sign;
use super::style::SMALL;
use super::text::{Weight, escaped, fitted, millimetres, width_of};
use super::text_line::push_text;
use std::collections::BTreeSet;
use std::fmt::Write;
use traverse_geometry::{Bounds, Motion, PlacedSection, Point, Pose, Section, SectionLayout, Vector};

/// A layout to be shown.
#[derive(Clone, Copy, Debug)]
pub struct ShownLayout<'a> {
    /// What was to be laid out.
    pub layout: &'a SectionLayout,
    /// The layout, left to right.
    pub order: &'a [PlacedSection],
    /// Where sections touch what stopped them: on the section and on the other one.
    pub contacts: &'a [(Point, Point)],
    /// No layout is shorter, millimetres. Absent: nothing is known, nothing is said.
    pub lower_bound_mm: Option<f64>,
}

/// Colours of sections, in turn: told apart by colour-blind eyes too, and in print by their lightness.
const TINTS: [&str; 5] = ["#9ecae1", "#fdd0a2", "#a1d99b", "#dadaeb", "#d9d9d9"];
/// Room below a strip for its length, canvas units.
const DIMENSION: f64 = 64.0;
/// More contacts than this are not drawn.
const MOST_CONTACTS: usize = 500;
/// More sections than this are drawn with finer lines.
const FINE_FROM: usize = 150;
/// How far up and down an id may stand from the middle of its section, lines.
const LINES: [f64; 7] = [0.0, 1.0, -1.0, 2.0, -2.0, 3.0, -3.0];
/// So many ids back another one may be in the way.
const NEIGHBOURS: usize = 12;
/// The styles of layouts alone.
const SHEET: &str = "<style>
.strip{fill:#f4f5f7;stroke:#5c6670;stroke-width:1.2}
.saved{fill:#e2f2e5;stroke:#1f6f43;stroke-width:1.6;stroke-dasharray:9 5}
.box{fill:none;stroke:#5c6670;stroke-width:1.1;stroke-dasharray:5 4}
.piece{fill-rule:evenodd;stroke:#26303a;stroke-width:1.2;stroke-linejoin:round}
.slim .piece{stroke-width:.5}
.slim .box{stroke-width:.5}
.touch{fill:#c8102e;stroke:#fff;stroke-width:1}
.ruler{stroke:#1c2733;stroke-width:1.6;fill:none}
.ruler.after{stroke:#0b4fc4;stroke-width:2.6}
</style>
";

/// The picture of a layout as an SVG file. `title` stands on top; it may be empty.
///
/// Above, the sections stand in the order of the request, each in the first pose that it may have, joined by bounding boxes with
/// the gap between them. Equal arguments give equal text, byte for byte.
#[must_use]
pub fn picture_of_layout(shown: &ShownLayout<'_>, title: &str) -> String {
    let before = by_boxes(shown.layout);
    let (length_before, length) = (length_of(shown.layout, &before), length_of(shown.layout, shown.order));
    let header = header(shown, title, length_before, length);
    let heights = heights(shown.layout);
    let widest = length_before.max(length).max(1e-9);
    // Room for the lengths, in millimetres at about the scale that the picture will have.
    let height = heights.size().y.max(1e-9);
    let room = DIMENSION * (widest / (WIDTH - 2.0 * MARGIN)).max(2.0 * height / 800.0);
    let extent = Bounds {
        min: Point::new(0.0, heights.min.y - room),
        max: Point::new(widest, heights.max.y + room + height),
    };
    let frame = Frame::new(extent, 0.004, header.height());
    let mut body = String::from(SHEET);
    body.push_str(if shown.order.len() > FINE_FROM { "<g class=\"slim\">\n" } else { "<g>\n" });
    let upper = Row { layout: shown.layout, frame: &frame, heights, up: height + room };
    let lower = Row { up: 0.0, ..upper };
    upper.strip(&mut body, length_before);
    upper.sections(&mut body, &before, true);
    lower.strip(&mut body, length);
    if length_before > length {
        lower.saved(&mut body, length, length_before);
    }
    lower.sections(&mut body, shown.order, false);
    let drawn_contacts = shown.contacts.len() <= MOST_CONTACTS;
    if drawn_contacts {
        lower.contacts(&mut body, shown.contacts);
    }
    body.push_str("</g>\n");
    let mut unnamed = upper.ids(&mut body, &before);
    unnamed.extend(lower.ids(&mut body, shown.order));
    upper.ruler(&mut body, length_before, "ruler", "by bounding boxes");
    lower.ruler(&mut body, length, "ruler after", "joined");
    if length_before > length {
        lower.saved_text(&mut body, length, length_before);
    }
    let mut entries = vec![(Sign::Line("box"), "bounding box".to_owned())];
    if length_before > length {
        entries.push((Sign::Field("saved"), "saved".to_owned()));
    }
    if drawn_contacts && !shown.contacts.is_empty() {
        entries.push((Sign::Field("touch"), "touches what stopped it".to_owned()));
    }
    let note = match unnamed.len() {
        0 => String::new(),
        1 => "1 section is too narrow for its id".to_owned(),
        count => format!("{count} sections are too narrow for their ids"),
    };
    let legend = Legend::new(entries, note, &frame);
    file(&header, &frame, &body, &legend, legend.bottom(), "")
}

fn header(shown: &ShownLayout<'_>, title: &str, before: f64, after: f64) -> Header {
    let count = shown.order.len();
    let sections = if count == 1 { "1 section".to_owned() } else { format!("{count} sections") };
    let saved = before - after;
    let share = if before > 0.0 { 100.0 * saved / before } else { 0.0 };
    let change = match saved {
        saved if saved >= 0.0 => format!("{} saved ({share:.1} %)", millimetres(saved)),
        more => format!("{} more", millimetres(-more)),
    };
    let header = Header::titled(title).with_strong(&format!("{sections}, {}: {change}", millimetres(after)));
    match shown.lower_bound_mm {
        None => header,
        Some(bound) if bound >= after => header.with("proven: no layout reached by sliding is shorter"),
        Some(bound) => {
            let gap = if after > 0.0 { 100.0 * (after - bound) / after } else { 0.0 };
            header.with(&format!("no layout is shorter than {}: within {gap:.2} %", millimetres(bound)))
        }
    }
}

/// The order of the request, joined by bounding boxes.
fn by_boxes(layout: &SectionLayout) -> Vec<PlacedSection> {
    let mut x_mm = 0.0;
    let mut order = Vec::new();
    for (index, section) in layout.sections.iter().enumerate() {
        let width = section.bounds().size().x;
        let pose = section.poses.first().copied().unwrap_or(Pose::AsIs);
        for copy in 0..section.quantity {
            order.push(PlacedSection { section: index, copy, pose, x_mm });
            x_mm += width + layout.gap_mm;
        }
    }
    order
}

fn length_of(layout: &SectionLayout, order: &[PlacedSection]) -> f64 {
    let widths: Vec<f64> = layout.sections.iter().map(|section| section.bounds().size().x).collect();
    let right = |placed: &PlacedSection| placed.x_mm + widths.get(placed.section).copied().unwrap_or(0.0);
    order.iter().map(right).fold(0.0, f64::max)
}

/// The heights that all sections and the strip take; x is not used.
fn heights(layout: &SectionLayout) -> Bounds {
    let all = layout.sections.iter().map(Section::bounds).fold(Bounds::EMPTY, Bounds::union);
    match layout.strip_height_mm {
        Some(height) if !all.is_empty() && height > all.size().y => {
            Bounds { max: Point::new(all.max.x, all.min.y + height), ..all }
        }
        _ if all.is_empty() => Bounds::of([Point::origin(), Point::new(1.0, 1.0)]),
        _ => all,
    }
}

/// One strip of the picture.
#[derive(Clone, Copy)]
struct Row<'a> {
    layout: &'a SectionLayout,
    frame: &'a Frame,
    heights: Bounds,
    /// How far above its place it is drawn, millimetres.
    up: f64,
}

impl Row<'_> {
    fn place(&self, x: f64, y: f64) -> (f64, f64) {
        self.frame.place(Point::new(x, y + self.up))
    }

    fn rect(&self, svg: &mut String, class: &str, from: f64, to: f64) {
        let (left, top) = self.place(from, self.heights.max.y);
        let (right, bottom) = self.place(to, self.heights.min.y);
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            svg,
            "<rect class=\"{class}\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>"
        );
    }

    fn strip(&self, svg: &mut String, length: f64) {
        self.rect(svg, "strip", 0.0, length);
    }

    fn saved(&self, svg: &mut String, from: f64, to: f64) {
        self.rect(svg, "saved", from, to);
    }

    fn sections(&self, svg: &mut String, order: &[PlacedSection], with_boxes: bool) {
        for placed in order {
            let Some(section) = self.layout.sections.get(placed.section) else { continue };
            let bounds = section.bounds();
            let into_row = placed.motion(&bounds).then(&Motion::translation(Vector::new(0.0, self.up)));
            let tint = TINTS.get(placed.section % TINTS.len()).copied().unwrap_or("#d9d9d9");
            let mut data = String::new();
            for part in &section.parts {
                let shape = part.shape.moved(&part.motion().then(&into_row));
                data.push_str(&polygon_data(&shape, self.frame));
            }
            let id = escaped(&section.id);
            let _ = writeln!(
                svg,
                "<path class=\"piece\" fill=\"{tint}\" d=\"{data}\"><title>{id}</title></path>"
            );
            if with_boxes {
                let (left, top) = self.place(placed.x_mm, bounds.max.y);
                let (right, bottom) = self.place(placed.x_mm + bounds.size().x, bounds.min.y);
                let (width, height) = (right - left, bottom - top);
                let _ = writeln!(
                    svg,
                    "<rect class=\"box\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>"
                );
            }
        }
    }

    /// Ids in the middle of sections that are wide enough, above or below where another one stands already; which are
    /// not.
    fn ids(&self, svg: &mut String, order: &[PlacedSection]) -> BTreeSet<usize> {
        let mut unnamed = BTreeSet::new();
        let mut taken: Vec<Box2> = Vec::new();
        for placed in order {
            let Some(section) = self.layout.sections.get(placed.section) else { continue };
            let bounds = section.bounds();
            let width = bounds.size().x * self.frame.scale;
            let (x, y) = self.place(placed.x_mm + bounds.size().x / 2.0, bounds.center().y);
            let text = match width_of(&section.id, SMALL, Weight::Regular) {
                wide if wide + 4.0 <= width => section.id.clone(),
                _ => fitted(&section.id, SMALL, Weight::Regular, width),
            };
            let half = width_of(&text, SMALL, Weight::Regular) / 2.0;
            let at = |lines: f64| {
                let y = y + lines * SMALL * 1.2;
                Box2 { left: x - half, top: y - SMALL * 0.6, right: x + half, bottom: y + SMALL * 0.6 }
            };
            let (_, top) = self.place(0.0, bounds.max.y);
            let (_, bottom) = self.place(0.0, bounds.min.y);
            // Sections overlap in x only with near neighbours: the last few labels are all that can be in the way.
            let is_free = |area: &Box2| {
                let inside = area.top >= top && area.bottom <= bottom;
                inside && !taken.iter().rev().take(NEIGHBOURS).any(|other| other.meets(area))
            };
            let place = LINES.into_iter().map(at).find(is_free).filter(|_| width >= 3.0 * SMALL);
            if let Some(area) = place {
                push_text(svg, "id", x, f64::midpoint(area.top, area.bottom) + SMALL * 0.35, &text);
                taken.push(area);
            } else {
                unnamed.insert(placed.section);
            }
        }
        unnamed
    }

    fn contacts(&self, svg: &mut String, contacts: &[(Point, Point)]) {
        for (point, against) in contacts {
            for place in [point, against] {
                let (x, y) = self.place(place.x, place.y);
                let _ = writeln!(svg, "<circle class=\"touch\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3.4\"/>");
            }
        }
    }

    /// A line of the strip's length below it, with its figure.
    fn ruler(&self, svg: &mut String, length: f64, class: &str, words: &str) {
        let (left, bottom) = self.place(0.0, self.heights.min.y);
        let (right, _) = self.place(length, self.heights.min.y);
        let y = bottom + 13.0;
        let _ = writeln!(
            svg,
            "<path class=\"{class}\" d=\"M{left:.1} {:.1}V{:.1}M{left:.1} {y:.1}H{right:.1}M{right:.1} {:.1}V{:.1}\"/>",
            y - 7.0,
            y + 7.0,
            y - 7.0,
            y + 7.0
        );
        push_text(svg, "", left + 4.0, y + SMALL * 1.2, &format!("{words}: {}", millimetres(length)));
    }

    fn saved_text(&self, svg: &mut String, from: f64, to: f64) {
        let text = millimetres(to - from);
        let width = (to - from) * self.frame.scale;
        if width_of(&text, SMALL, Weight::Regular) + 4.0 <= width {
            let (x, y) = self.place(f64::midpoint(from, to), self.heights.center().y);
            push_text(svg, "mid", x, y + SMALL * 0.35, &text);
        }
    }
}
