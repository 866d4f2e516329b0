//! Text of our pictures as outlines of letters: DejaVu Sans, cut down; its licence lies beside it in `fonts`.
//!
//! So a PNG needs neither a font on the machine nor a library that sets text: our pictures hold single lines without
//! kerning, each letter as wide as the font says.

use crate::picture::{Lettering, TextLine};
use std::fmt::Write;
use std::sync::OnceLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

const REGULAR: &[u8] = include_bytes!("../../fonts/DejaVuSans.subset.ttf");
const BOLD: &[u8] = include_bytes!("../../fonts/DejaVuSans-Bold.subset.ttf");

/// The picture with its lines of text as paths; none when it becomes longer than `most_bytes`.
pub(super) fn with_letters_as_paths(svg: &str, most_bytes: usize) -> Option<String> {
    let mut out = String::with_capacity(2 * svg.len());
    for line in svg.split_inclusive('\n') {
        match TextLine::of(line) {
            Some(text) => draw(&mut out, &text),
            None => out.push_str(line),
        }
        if out.len() > most_bytes {
            return None;
        }
    }
    Some(out)
}

/// Writes a line of text as one path of the same class. What the class says of its colour goes before ours.
fn draw(out: &mut String, line: &TextLine<'_>) {
    let lettering = Lettering::of(line.class);
    let width = width_of(&line.text, &lettering);
    let left = if lettering.centred { line.x - width / 2.0 } else { line.x };
    let _ = write!(out, "<path class=\"{}\" fill=\"#1c2733\" d=\"", line.class);
    let mut pen = Pen { out, x: left, y: line.y, scale: scale_of(&lettering) };
    for c in line.text.chars() {
        let glyph = glyph_of(c, &lettering);
        face(lettering.bold).outline_glyph(glyph, &mut pen);
        pen.x += advance(glyph, &lettering);
    }
    out.push_str("\"/>\n");
}

/// How wide a line of text is.
pub(crate) fn width_of(text: &str, lettering: &Lettering) -> f64 {
    text.chars().map(|c| advance(glyph_of(c, lettering), lettering)).sum()
}

/// The face, read once.
fn face(bold: bool) -> &'static Face<'static> {
    static FACES: OnceLock<[Face<'static>; 2]> = OnceLock::new();
    let read = || {
        [REGULAR, BOLD]
            .map(|bytes| Face::parse(bytes, 0).expect("invariant: the fonts brought along are sound"))
    };
    &FACES.get_or_init(read)[usize::from(bold)]
}

/// The letter's outline; an empty box for what the font lacks.
fn glyph_of(c: char, lettering: &Lettering) -> GlyphId {
    face(lettering.bold).glyph_index(c).unwrap_or(GlyphId(0))
}

fn advance(glyph: GlyphId, lettering: &Lettering) -> f64 {
    f64::from(face(lettering.bold).glyph_hor_advance(glyph).unwrap_or(0)) * scale_of(lettering)
}

fn scale_of(lettering: &Lettering) -> f64 {
    lettering.size / f64::from(face(lettering.bold).units_per_em())
}

/// Writes outlines as path data, y down.
struct Pen<'a> {
    out: &'a mut String,
    x: f64,
    y: f64,
    scale: f64,
}

impl Pen<'_> {
    fn write(&mut self, command: char, points: &[(f32, f32)]) {
        self.out.push(command);
        for &(x, y) in points {
            let (x, y) = (self.x + f64::from(x) * self.scale, self.y - f64::from(y) * self.scale);
            let _ = write!(self.out, "{x:.2} {y:.2} ");
        }
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.write('M', &[(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.write('L', &[(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.write('Q', &[(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.write('C', &[(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.out.push('Z');
    }
}
