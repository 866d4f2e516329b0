//! Drawings of 100 000 entities of every kind, strewn at random.

use crate::random::Random;
use std::f64::consts::TAU;
use std::fmt::Write;

const COUNT: usize = 100_000;

/// What splines and ellipses a drawing holds: a twentieth of each.
#[derive(Clone, Copy, PartialEq)]
enum Smooth {
    /// None: lines instead.
    None,
    /// Splines that wave along a line, ellipses of up to 20 mm.
    Tame,
    /// Splines through eight points anywhere in 200 mm, ellipses of up to 80 mm.
    Wild,
}

/// Every drawing with its name.
pub(crate) fn all() -> Vec<(&'static str, String)> {
    vec![
        ("DXF, lines, arcs, circles, polylines, blocks", dxf(Smooth::None)),
        ("DXF, 5 % ellipses, 5 % splines, as in shops", dxf(Smooth::Tame)),
        ("DXF, 5 % ellipses, 5 % splines, wild", dxf(Smooth::Wild)),
        ("SVG, rectangles, circles, paths, lines", svg()),
    ]
}

/// Half the width of the region that a DXF drawing covers, millimetres.
const HALF: f64 = 1000.0;

struct Dxf {
    text: String,
    random: Random,
    handle: usize,
}

fn dxf(smooth: Smooth) -> String {
    const BEGIN: &str = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nS\n\
        10\n0\n20\n0\n0\nCIRCLE\n8\n0\n10\n1.5\n20\n2.5\n40\n3.25\n0\nLWPOLYLINE\n8\n0\n70\n1\n10\n0\n20\n0\n10\n10\n20\n0\n\
        42\n0.5\n10\n10\n20\n7\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    let mut file = Dxf { text: BEGIN.to_owned(), random: Random::new(5), handle: 0x100 };
    for _ in 0..COUNT {
        match file.random.below(100) {
            0..30 => file.line(),
            30..45 => file.arc(),
            45..55 => file.circle(),
            55..70 => file.light_polyline(),
            70..75 => file.polyline(),
            75..80 if smooth != Smooth::None => {
                file.ellipse(if smooth == Smooth::Wild { 60.0 } else { 15.0 });
            }
            80..85 if smooth == Smooth::Wild => file.wild_spline(),
            80..85 if smooth == Smooth::Tame => file.tame_spline(),
            75..85 => file.line(),
            85..95 => file.insert(),
            _ => file.label(),
        }
    }
    file.text.push_str("0\nENDSEC\n0\nEOF\n");
    file.text
}

impl Dxf {
    /// Within ±`half`.
    fn number(&mut self, half: f64) -> f64 {
        (2.0 * self.random.share() - 1.0) * half
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.random.share()
    }

    fn head(&mut self, entity: &str) {
        self.handle += 1;
        let (handle, layer) = (self.handle, self.handle % 20);
        let _ = write!(
            self.text,
            "0\n{entity}\n5\n{handle:X}\n330\n1F\n100\nAcDbEntity\n8\nLayer{layer}\n100\nAcDb{entity}\n"
        );
    }

    /// A point of the group codes `x_code` and ten more.
    fn point(&mut self, x_code: u16, half: f64) {
        let (x, y) = (self.number(half), self.number(half));
        let _ = write!(self.text, "{x_code}\n{x:.12}\n{}\n{y:.12}\n", x_code + 10);
    }

    fn say(&mut self, groups: &str) {
        self.text.push_str(groups);
    }

    fn real(&mut self, code: u16, value: f64) {
        let _ = write!(self.text, "{code}\n{value}\n");
    }

    fn line(&mut self) {
        self.head("LINE");
        self.point(10, HALF);
        self.say("30\n0.0\n");
        self.point(11, HALF);
        self.say("31\n0.0\n");
    }

    fn circle(&mut self) {
        self.head("CIRCLE");
        self.point(10, HALF);
        let radius = self.between(1.0, 50.0);
        self.real(40, radius);
    }

    fn arc(&mut self) {
        self.head("ARC");
        self.point(10, HALF);
        let (radius, from, to) =
            (self.between(1.0, 50.0), self.between(0.0, 360.0), self.between(0.0, 360.0));
        self.real(40, radius);
        self.real(50, from);
        self.real(51, to);
    }

    fn light_polyline(&mut self) {
        self.head("LWPOLYLINE");
        self.say("90\n12\n70\n1\n43\n0.0\n");
        for i in 0..12 {
            self.point(10, HALF);
            if i % 3 == 0 {
                self.say("42\n0.4142135623730951\n");
            }
        }
    }

    fn polyline(&mut self) {
        self.head("POLYLINE");
        self.say("66\n1\n70\n1\n");
        for _ in 0..8 {
            self.say("0\nVERTEX\n5\n1\n8\nA\n");
            self.point(10, HALF);
            self.say("30\n0.0\n");
        }
        self.say("0\nSEQEND\n8\nA\n");
    }

    fn ellipse(&mut self, half: f64) {
        self.head("ELLIPSE");
        self.point(10, HALF);
        self.point(11, half);
        let ratio = self.between(0.1, 0.9);
        self.real(40, ratio);
        self.real(41, 0.0);
        self.real(42, TAU);
    }

    fn spline(&mut self) {
        self.head("SPLINE");
        self.say("70\n8\n71\n3\n72\n12\n73\n8\n74\n0\n");
        for knot in [0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5] {
            self.real(40, f64::from(knot));
        }
    }

    fn wild_spline(&mut self) {
        self.spline();
        for _ in 0..8 {
            self.point(10, 100.0);
        }
    }

    fn tame_spline(&mut self) {
        self.spline();
        for i in 0..8 {
            let (x, y) = (10.0 * f64::from(i) + self.number(2.0), self.number(5.0));
            self.real(10, x);
            self.real(20, y);
        }
    }

    fn insert(&mut self) {
        self.head("INSERT");
        self.say("2\nS\n");
        self.point(10, HALF);
        let angle = self.between(0.0, 360.0);
        self.real(50, angle);
        self.say("41\n2.0\n42\n2.0\n");
    }

    fn label(&mut self) {
        self.head("TEXT");
        self.point(10, HALF);
        self.say("40\n5.0\n1\nhello\n");
    }
}

fn svg() -> String {
    let mut text = String::from(
        "<svg xmlns='http://www.w3.org/2000/svg' width='900mm' height='900mm' viewBox='0 0 900 900'>\
         <style>.a{fill:none}</style><g id='all'>",
    );
    for i in 0..COUNT {
        let (x, y) = (i % 300, i / 300);
        let _ = match i % 4 {
            0 => {
                write!(text, "<rect id='r{i}' class='a' x='{x}' y='{y}' width='3' height='2' rx='.5'/>")
            }
            1 => write!(text, "<circle cx='{x}' cy='{y}' r='1.5' style='fill:none;stroke:red'/>"),
            2 => write!(text, "<path d='M{x} {y}c1 2 3 2 4 0s3-2 4 0' transform='rotate({i})'/>"),
            _ => write!(text, "<line x1='{x}' y1='{y}' x2='9' y2='9'/>"),
        };
    }
    text.push_str("</g></svg>");
    text
}
