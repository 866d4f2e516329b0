//! What stands where in a picture: the boxes of its texts, as the PNG font sets them, and its paths as chords.

#![allow(dead_code, reason = "each test uses its part")]

use traverse_geometry::{Edge, Point};
use ttf_parser::Face;

/// A text with its box: left, top, right, bottom.
pub(crate) type TextBox = (String, [f64; 4]);

/// What the style sheet says of a property, for an element `text` of these classes: the last rule that says it.
fn said<'a>(sheet: &'a str, classes: &str, property: &str) -> Option<&'a str> {
    let selects = |selector: &str| {
        selector == "text" || classes.split(' ').any(|class| selector.strip_prefix('.') == Some(class))
    };
    let rules = sheet.split('}').filter_map(|rule| rule.trim().split_once('{'));
    let rules = rules.filter(|(selectors, _)| selectors.split(',').any(selects));
    let declarations = rules.flat_map(|(_, declarations)| declarations.split(';'));
    declarations
        .filter_map(|each| each.split_once(':'))
        .rfind(|(name, _)| *name == property)
        .map(|(_, value)| value)
}

/// Every text of the picture, as high as its font is.
pub(crate) fn text_boxes(svg: &str) -> Vec<TextBox> {
    let [regular, bold] = ["DejaVuSans.subset.ttf", "DejaVuSans-Bold.subset.ttf"]
        .map(|name| std::fs::read(format!("{}/fonts/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap());
    let [regular, bold] = [&regular, &bold].map(|bytes| Face::parse(bytes, 0).unwrap());
    let document = roxmltree::Document::parse(svg).unwrap();
    let named =
        |name: &'static str| document.descendants().filter(move |node| node.tag_name().name() == name);
    let sheet = named("style").next().and_then(|style| style.text()).unwrap();
    let text_box = |node: roxmltree::Node<'_, '_>| {
        let classes = node.attribute("class").unwrap();
        let face = if said(sheet, classes, "font-weight") == Some("bold") { &bold } else { &regular };
        let size: f64 =
            said(sheet, classes, "font-size").unwrap().strip_suffix("px").unwrap().parse().unwrap();
        let scale = size / f64::from(face.units_per_em());
        let text = node.text().unwrap_or_default().to_owned();
        let glyphs = text.chars().map(|c| face.glyph_index(c).unwrap_or_default());
        let width: f64 = glyphs.map(|glyph| scale * f64::from(face.glyph_hor_advance(glyph).unwrap())).sum();
        let place = |name| node.attribute(name).unwrap().parse::<f64>().unwrap();
        let centred = said(sheet, classes, "text-anchor") == Some("middle");
        let left = place("x") - if centred { width / 2.0 } else { 0.0 };
        let above = |height: i16| place("y") - scale * f64::from(height);
        (text, [left, above(face.ascender()), left + width, above(face.descender())])
    };
    named("text").map(text_box).collect()
}

/// The paths of one of these classes, as chords.
pub(crate) fn chords(svg: &str, classes: &[&str]) -> Vec<[(f64, f64); 2]> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let mut chords = Vec::new();
    for node in document.descendants() {
        let meant = node.attribute("class").is_some_and(|class| classes.contains(&class));
        if let Some(data) = node.attribute("d").filter(|_| meant) {
            push_chords(&mut chords, data);
        }
    }
    chords
}

/// Path data of M, L, A and Z, as this crate writes it.
fn push_chords(chords: &mut Vec<[(f64, f64); 2]>, data: &str) {
    let (mut first, mut at) = ((0.0, 0.0), (0.0, 0.0));
    let mut rest = data;
    while let Some(command) = rest.chars().next() {
        let end = rest[1..].find(['M', 'L', 'A', 'Z', 'H']).map_or(rest.len(), |i| i + 1);
        let numbers: Vec<f64> = rest[1..end].split_whitespace().map(|text| text.parse().unwrap()).collect();
        match (command, &numbers[..]) {
            ('M', &[x, y]) => (first, at) = ((x, y), (x, y)),
            ('L', &[x, y]) => {
                chords.push([at, (x, y)]);
                at = (x, y);
            }
            // A sign of the legend.
            ('H', &[x]) => at = (x, at.1),
            ('A', &[radius, _, _, _, flag, x, y]) => {
                let half = ((x - at.0).hypot(y - at.1) / 2.0 / radius).min(1.0).asin();
                // Mirrored: y points down here.
                let bulge = if flag == 0.0 { 1.0 } else { -1.0 } * (half / 2.0).tan();
                let arc = Edge::from_bulge(Point::new(at.0, -at.1), Point::new(x, -y), bulge);
                for i in 1..=32 {
                    let p = arc.point_at(f64::from(i) / 32.0);
                    chords.push([at, (p.x, -p.y)]);
                    at = (p.x, -p.y);
                }
            }
            ('Z', &[]) => {
                chords.push([at, first]);
                at = first;
            }
            _ => panic!("{command} {numbers:?}"),
        }
        rest = &rest[end..];
    }
}

/// Whether a chord runs through a box.
pub(crate) fn covers(sides: &[f64; 4], [a, b]: [(f64, f64); 2]) -> bool {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for (from, to, least, most) in [(a.0, b.0, sides[0], sides[2]), (a.1, b.1, sides[1], sides[3])] {
        let run = to - from;
        if run == 0.0 {
            if from <= least || from >= most {
                return false;
            }
            continue;
        }
        let (t0, t1) = ((least - from) / run, (most - from) / run);
        low = low.max(t0.min(t1));
        high = high.min(t0.max(t1));
    }
    low < high
}

/// No text covers a path or another text.
pub(crate) fn assert_text_is_free(svg: &str, classes: &[&str], what: &str) {
    let boxes = text_boxes(svg);
    let chords = chords(svg, classes);
    for (i, (text, sides)) in boxes.iter().enumerate() {
        for &chord in &chords {
            assert!(!covers(sides, chord), "{what}: {text} at {sides:?} covers {chord:?}");
        }
        for (other, [left, top, right, bottom]) in &boxes[i + 1..] {
            let meets = sides[0] < *right && *left < sides[2] && sides[1] < *bottom && *top < sides[3];
            assert!(!meets, "{what}: {text} at {sides:?} covers {other} at {left} {top} {right} {bottom}");
        }
    }
}
