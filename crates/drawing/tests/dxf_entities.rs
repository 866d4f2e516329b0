//! Every kind of entity, with lengths and places known in closed form.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};
use traverse_drawing::{Curve, Drawing, ReadOptions, WhyUnused, read_dxf};
use traverse_geometry::Point;

fn file(sections: &str, entities: &str) -> String {
    format!("{sections}0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n")
}

fn read(sections: &str, entities: &str) -> Drawing {
    read_dxf(file(sections, entities).as_bytes(), &ReadOptions::default()).unwrap()
}

/// The only curve of a drawing of one entity.
fn one(entity: &str) -> Curve {
    let drawing = read("", entity);
    assert_eq!((drawing.curve_count(), drawing.unused.len()), (1, 0), "{:?}", drawing.unused);
    drawing.layers[0].curves[0].clone()
}

/// Entities in the block B with base point (1, 0), then entities of the model.
fn with_block(inside: &str, model: &str) -> Drawing {
    let blocks =
        format!("0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n10\n1\n20\n0\n{inside}0\nENDBLK\n0\nENDSEC\n");
    read(&blocks, model)
}

fn near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

fn at(p: Point, x: f64, y: f64) {
    assert!((p - Point::new(x, y)).norm() < 1e-9, "{p} instead of {x}, {y}");
}

/// Area by Green's theorem: chords and circular segments.
fn area(curve: &Curve) -> f64 {
    assert!(curve.closed);
    let next = curve.vertices.iter().cycle().skip(1);
    let chords: f64 = curve.vertices.iter().zip(next).map(|(a, b)| (a.x * b.y - b.x * a.y) / 2.0).sum();
    let segment = |(edge, bulge): (traverse_geometry::Edge, &f64)| {
        let sweep = 4.0 * bulge.atan();
        if *bulge == 0.0 { 0.0 } else { (edge.length() / sweep).powi(2) / 2.0 * (sweep - sweep.sin()) }
    };
    chords + curve.edges().zip(&curve.bulges).map(segment).sum::<f64>()
}

#[test]
fn ellipses_are_followed() {
    // Half axes 20 and 10.
    let full = one("0\nELLIPSE\n8\nA\n10\n5\n20\n6\n11\n20\n21\n0\n40\n0.5\n41\n0\n42\n6.283185\n");
    assert!(full.closed && full.deviation_mm == 0.001);
    near(area(&full), 200.0 * PI, 0.05);
    near(full.length(), 96.884_482_205_476_73, 1e-4);
    // A quarter, from (25, 6) to (5, 16); seen from below it ends at (5, −4).
    let quarter = "0\nELLIPSE\n8\nA\n10\n5\n20\n6\n11\n20\n21\n0\n40\n0.5\n41\n0\n42\n1.5707963267948966\n";
    let up = one(quarter);
    at(up.vertices[0], 25.0, 6.0);
    at(*up.vertices.last().unwrap(), 5.0, 16.0);
    near(up.length(), 96.884_482_205_476_73 / 4.0, 1e-4);
    let down = one(&format!("{quarter}230\n-1\n"));
    at(*down.vertices.last().unwrap(), 5.0, -4.0);
    // A circle is one exactly.
    let round = one("0\nELLIPSE\n8\nA\n11\n3\n21\n4\n40\n1\n");
    assert_eq!((round.vertices.len(), round.deviation_mm), (2, 0.0));
    near(round.length(), 10.0 * PI, 1e-12);
}

#[test]
fn old_polylines_are_read() {
    let vertex = |x: f64, y: f64, rest: &str| format!("0\nVERTEX\n8\nignored\n10\n{x}\n20\n{y}\n{rest}");
    let slot = vertex(0.0, 0.0, "")
        + &vertex(10.0, 0.0, "42\n1\n")
        + &vertex(10.0, 4.0, "")
        + &vertex(0.0, 4.0, "42\n1\n")
        + "0\nSEQEND\n";
    let closed = one(&format!("0\nPOLYLINE\n8\nA\n66\n1\n10\n99\n20\n99\n70\n1\n{slot}"));
    near(area(&closed), 40.0 + 4.0 * PI, 1e-9);
    let open = one(&format!("0\nPOLYLINE\n8\nA\n{slot}"));
    near(open.length(), 20.0 + TAU, 1e-9);
    let below = one(&format!("0\nPOLYLINE\n8\nA\n70\n1\n230\n-1\n{slot}"));
    near(area(&below), -40.0 - 4.0 * PI, 1e-9);
    at(below.vertices[1], -10.0, 0.0);
    // In space: bulges mean nothing, and z is ignored.
    let space = one(&format!("0\nPOLYLINE\n8\nA\n70\n9\n210\n1\n230\n0\n{slot}"));
    near(area(&space), 40.0, 1e-9);
    // Spline-fit: the frame is passed over.
    let fit = vertex(0.0, 0.0, "70\n16\n")
        + &vertex(0.0, 0.0, "70\n8\n")
        + &vertex(5.0, 9.0, "70\n16\n")
        + &vertex(3.0, 4.0, "70\n8\n")
        + "0\nSEQEND\n";
    near(one(&format!("0\nPOLYLINE\n8\nA\n70\n4\n{fit}")).length(), 5.0, 1e-12);
    // Meshes are bodies; a polyline that only has a frame is a contradiction.
    for (flags, why) in [(16, WhyUnused::Body), (64, WhyUnused::Body)] {
        let drawing = read("", &format!("0\nPOLYLINE\n8\nA\n70\n{flags}\n{slot}"));
        assert_eq!((drawing.curve_count(), drawing.unused[0].why), (0, why));
    }
    let frame = vertex(0.0, 0.0, "70\n16\n") + &vertex(5.0, 9.0, "70\n16\n");
    let drawing = read("", &format!("0\nPOLYLINE\n8\nA\n70\n4\n{frame}"));
    assert_eq!(drawing.unused[0].why, WhyUnused::Inconsistent);
}

#[test]
fn splines_are_followed() {
    // A parabola: y = x (1 − x) up to scale; its length is known.
    let parabola = "0\nSPLINE\n8\nA\n70\n8\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n\
                    10\n0\n20\n0\n10\n50\n20\n100\n10\n100\n20\n0\n";
    let half = 50.0_f64;
    let length = half * (5.0_f64.sqrt() + 2.0_f64.asinh() / 2.0);
    let curve = one(parabola);
    near(curve.length(), length, 1e-3);
    at(curve.vertices[0], 0.0, 0.0);
    at(*curve.vertices.last().unwrap(), 100.0, 0.0);
    // Rational: a full circle of two halves would need more; a quarter is the classic.
    let quarter = format!(
        "0\nSPLINE\n8\nA\n70\n4\n71\n2\n40\n0\n40\n0\n40\n0\n40\n1\n40\n1\n40\n1\n41\n1\n41\n{FRAC_1_SQRT_2}\n41\n1\n\
         10\n10\n20\n0\n10\n10\n20\n10\n10\n0\n20\n10\n"
    );
    near(one(&quarter).length(), 5.0 * PI, 1e-6);
    // A corner at a knot that is there three times.
    let corner = "0\nSPLINE\n8\nA\n71\n1\n40\n0\n40\n0\n40\n1\n40\n2\n40\n2\n10\n0\n20\n0\n10\n30\n20\n0\n10\n30\n20\n40\n";
    let curve = one(corner);
    near(curve.length(), 70.0, 1e-9);
    at(curve.vertices[1], 30.0, 0.0);
    // Through points on a line; and along given directions.
    near(one("0\nSPLINE\n8\nA\n71\n3\n11\n0\n21\n0\n11\n30\n21\n40\n11\n60\n21\n80\n").length(), 100.0, 1e-9);
    let circle: String = (0..64)
        .map(|i| (TAU * f64::from(i) / 64.0).sin_cos())
        .map(|(sin, cos)| format!("11\n{}\n21\n{}\n", 50.0 * cos, 50.0 * sin))
        .collect();
    let closed = one(&format!("0\nSPLINE\n8\nA\n70\n1\n71\n3\n{circle}"));
    near(area(&closed), 2500.0 * PI, 0.3);
    // What contradicts itself is said.
    for broken in ["71\n1000\n", "71\n0\n", "40\n9\n", "41\n1\n", "41\n0\n"] {
        let drawing = read("", &format!("{parabola}{broken}"));
        assert_eq!(drawing.unused[0].why, WhyUnused::Inconsistent, "{broken}");
    }
}

#[test]
fn extrusion_downwards_mirrors() {
    let arc = one("0\nARC\n8\nA\n10\n20\n20\n6\n40\n3\n50\n0\n51\n90\n230\n-1\n");
    at(arc.vertices[0], -23.0, 6.0);
    at(arc.vertices[1], -20.0, 9.0);
    assert!(arc.bulges[0] < 0.0);
    let line = one("0\nLWPOLYLINE\n8\nA\n70\n0\n10\n1\n20\n2\n42\n1\n10\n5\n20\n2\n230\n-1\n");
    at(line.vertices[1], -5.0, 2.0);
    assert_eq!(line.bulges[0], -1.0);
    near(one("0\nLINE\n10\n0\n20\n0\n11\n3\n21\n4\n210\n1\n230\n0\n").vertices[1].x, 3.0, 0.0);
    let aside = read("", "0\nCIRCLE\n10\n0\n20\n0\n40\n1\n210\n0.6\n230\n0.8\n");
    assert_eq!(aside.unused[0].why, WhyUnused::Extrusion);
}

#[test]
fn blocks_are_placed_turned_and_repeated() {
    let unit = "0\nLINE\n8\n0\n10\n1\n20\n0\n11\n2\n21\n0\n";
    let insert = |rest: &str| {
        let drawing = with_block(unit, &format!("0\nINSERT\n8\nA\n2\nb\n10\n10\n20\n20\n{rest}"));
        assert_eq!(drawing.layers[0].name, "A");
        drawing.layers[0].curves.clone()
    };
    let ends = |rest: &str| (insert(rest)[0].vertices[0], insert(rest)[0].vertices[1]);
    at(ends("").1, 11.0, 20.0);
    at(ends("50\n90\n").1, 10.0, 21.0);
    at(ends("41\n-3\n").1, 7.0, 20.0);
    at(ends("50\n90\n42\n-2\n").1, 10.0, 21.0);
    at(ends("230\n-1\n").0, -10.0, 20.0);
    at(ends("230\n-1\n50\n90\n").1, -10.0, 21.0);
    let array = insert("70\n3\n71\n2\n44\n5\n45\n7\n50\n90\n");
    assert_eq!(array.len(), 6);
    at(array[2].vertices[0], 10.0, 30.0);
    at(array[5].vertices[0], 3.0, 30.0);
    // Scaled by nothing.
    let drawing = with_block(unit, "0\nINSERT\n8\nA\n2\nB\n41\n0\n");
    assert_eq!(drawing.unused[0].why, WhyUnused::NoLength);
    let aside = with_block(unit, "0\nINSERT\n8\nA\n2\nB\n210\n1\n230\n0\n");
    assert_eq!(aside.unused[0].why, WhyUnused::Extrusion);
}

#[test]
fn circles_and_bulges_become_ellipses_where_blocks_are_stretched() {
    let slot = "70\n1\n10\n0\n20\n0\n10\n10\n20\n0\n42\n1\n10\n10\n20\n4\n10\n0\n20\n4\n42\n1\n";
    let inside = format!("0\nCIRCLE\n40\n5\n0\nLWPOLYLINE\n{slot}0\nARC\n40\n5\n50\n0\n51\n90\n");
    for (scale, turn) in [("41\n2\n42\n6\n", 1.0), ("41\n-2\n42\n6\n", -1.0)] {
        let drawing = with_block(&inside, &format!("0\nINSERT\n2\nB\n50\n30\n{scale}"));
        let curves = &drawing.layers[0].curves;
        near(area(&curves[0]), turn * 25.0 * PI * 12.0, 0.2);
        near(area(&curves[1]), turn * (40.0 + 4.0 * PI) * 12.0, 0.2);
        assert!(curves.iter().all(|curve| curve.deviation_mm == 0.001));
        near(4.0 * curves[2].length(), curves[0].length(), 1e-3);
    }
    // Nearly a full turn, and nearly none.
    for (bulge, length) in [(1e7, 30.0), (1e-9, 3e-9)] {
        let arc = format!("0\nLWPOLYLINE\n10\n0\n20\n0\n42\n{bulge}\n10\n1e-9\n20\n0\n");
        let drawing = with_block(&arc, "0\nINSERT\n2\nB\n41\n3\n");
        let found = drawing.layers[0].curves[0].length();
        assert!(found.is_finite() && found < 1.1 * length, "{found}");
    }
    let same = with_block(&inside, "0\nINSERT\n2\nB\n50\n30\n41\n-2\n42\n2\n43\n7\n");
    near(area(&same.layers[0].curves[1]), -(40.0 + 4.0 * PI) * 4.0, 1e-9);
    assert!(same.layers[0].curves.iter().all(|curve| curve.deviation_mm == 0.0));
}

#[test]
fn colours_layers_handles_and_groups_are_told() {
    let tables = "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n2\n0\nLAYER\n2\nRed\n70\n0\n62\n-1\n\
                  0\nLAYER\n2\nTrue\n62\n3\n420\n66051\n0\nENDTAB\n0\nENDSEC\n";
    let line = |rest: &str| format!("0\nLINE\n{rest}10\n0\n20\n0\n11\n1\n21\n1\n");
    let blocks = format!(
        "{tables}0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nInner\n{}{}{}0\nTEXT\n8\n0\n0\nENDBLK\n0\nBLOCK\n2\nOuter\n\
         0\nINSERT\n8\n0\n2\nInner\n62\n0\n0\nENDBLK\n0\nENDSEC\n",
        line("5\nA1\n8\n0\n62\n0\n"),
        line("8\n0\n"),
        line("8\nTrue\n62\n5\n"),
    );
    let model = format!(
        "0\nINSERT\n8\nRed\n2\nOUTER\n62\n4\n70\n2\n0\nATTRIB\n8\nRed\n0\nSEQEND\n{}{}{}{}",
        line("8\nred\n"),
        line("8\nRed\n62\n0\n"),
        line("8\nTrue\n62\n256\n"),
        line("8\nnew\n5\n00ff\n"),
    );
    let drawing = read(&blocks, &model);
    let told: Vec<_> = drawing
        .layers
        .iter()
        .flat_map(|layer| layer.curves.iter().map(|curve| (layer.name.as_str(), &*curve.source)))
        .map(|(layer, source)| {
            let color = source.color.map(|color| color.to_string()).unwrap_or_default();
            (layer, color, source.id.clone().unwrap_or_default(), source.groups.join("/"))
        })
        .collect();
    let row = |layer, color: &str, id: &str, groups: &str| {
        (layer, color.to_owned(), id.to_owned(), groups.to_owned())
    };
    let expected = [
        row("Red", "#00ffff", "A1", "Outer/Inner"),
        row("Red", "#ff0000", "", "Outer/Inner"),
        row("Red", "#00ffff", "A1", "Outer/Inner"),
        row("Red", "#ff0000", "", "Outer/Inner"),
        row("Red", "#ff0000", "", ""),
        row("Red", "#ffffff", "", ""),
        row("True", "#0000ff", "", "Outer/Inner"),
        row("True", "#0000ff", "", "Outer/Inner"),
        row("True", "#010203", "", ""),
        row("new", "", "FF", ""),
    ];
    assert_eq!(told, expected);
    let unused: Vec<_> =
        drawing.unused.iter().map(|each| (&*each.layer, &*each.entity, each.count)).collect();
    assert_eq!(unused, [("Red", "ATTRIB", 1), ("Red", "TEXT", 2)]);
}

#[test]
fn names_are_decoded() {
    let circle = |layer: &[u8]| [b"0\nCIRCLE\n8\n", layer, b"\n40\n1\n"].concat();
    let around = |page: &str, layer: &[u8]| {
        let head = format!(
            "0\nSECTION\n2\nHEADER\n9\n$DWGCODEPAGE\n3\n{page}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
        );
        let bytes = [head.as_bytes(), &circle(layer), b"0\nENDSEC\n0\nEOF\n"].concat();
        read_dxf(&bytes, &ReadOptions::default()).unwrap().layers[0].name.clone()
    };
    assert_eq!(around("ANSI_1252", b"Fr\xe4ser"), "Fräser");
    assert_eq!(around("ANSI_1251", b"\xcb\xe8\xf1\xf2"), "Лист");
    assert_eq!(around("ANSI_1252", "Fräser".as_bytes()), "Fräser");
    assert_eq!(around("ANSI_1252", b"Fr\\U+00E4ser"), "Fräser");
}

#[test]
fn fillings_are_let_go_only_when_their_border_is_drawn() {
    let circle = |layer: &str| format!("0\nCIRCLE\n5\nA1\n8\n{layer}\n40\n4\n");
    let hatch = |associative: u8, paths: &str| {
        format!("0\nHATCH\n330\nA1\n8\nA\n10\n0\n20\n0\n71\n{associative}\n91\n1\n{paths}75\n0\n98\n0\n")
    };
    let path = |handle: &str| format!("92\n1\n93\n1\n72\n2\n10\n0\n20\n0\n97\n1\n330\n{handle}\n");
    let why = |entities: String| read("", &entities).unused[0].why;
    assert_eq!(why(circle("A") + &hatch(1, &path("A1"))), WhyUnused::Filling);
    assert_eq!(why(hatch(1, &path("A1")) + &circle("a")), WhyUnused::Filling);
    assert_eq!(why(circle("A") + &hatch(0, &path("A1"))), WhyUnused::Type);
    assert_eq!(why(circle("B") + &hatch(1, &path("A1"))), WhyUnused::Type);
    assert_eq!(why(circle("A") + &hatch(1, &(path("A1") + &path("A2")))), WhyUnused::Type);
    assert_eq!(why(circle("A") + &hatch(1, &(path("A1") + "92\n1\n93\n1\n97\n0\n"))), WhyUnused::Type);
    assert_eq!(why(circle("A") + &hatch(1, "")), WhyUnused::Type);
}

#[test]
fn the_model_and_the_sheets_are_no_blocks() {
    let blocks = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\n$MODEL_SPACE\n0\nENDBLK\n0\nBLOCK\n2\n*Paper_Space0\n\
                  0\nCIRCLE\n40\n1\n0\nENDBLK\n0\nENDSEC\n";
    let drawing = read(
        blocks,
        "0\nINSERT\n2\n*Paper_Space0\n0\nINSERT\n2\n$Model_Space\n0\nINSERT\n2\nNone\n0\nINSERT\n",
    );
    let unused: Vec<_> = drawing.unused.iter().map(|each| (&*each.entity, each.why, each.count)).collect();
    assert_eq!(unused, [("CIRCLE", WhyUnused::PaperSpace, 1), ("INSERT", WhyUnused::UnknownBlock, 4)]);
    assert!(WhyUnused::UnknownBlock.loses_something());
}

/// Reasons why entities were not used, of a drawing of one curve.
fn beside_one_curve(entity: &str) -> Vec<WhyUnused> {
    let drawing = read("", entity);
    assert_eq!(drawing.curve_count(), 1, "{entity}");
    drawing.unused.iter().map(|unused| unused.why).collect()
}

#[test]
fn bands_keep_their_centre_line_and_lose_their_width() {
    let corners = |first: &str| format!("10\n0\n20\n0\n{first}10\n9\n20\n0\n10\n9\n20\n9\n");
    for (constant, first, lost) in [
        ("43\n10\n", "", true),
        ("", "40\n0\n41\n2\n", true),
        ("", "40\n2\n", true),
        ("43\n0.0\n", "40\n0\n41\n0\n", false),
        ("", "", false),
    ] {
        let text = format!("0\nLWPOLYLINE\n8\nA\n90\n3\n70\n1\n{constant}{}", corners(first));
        let expected = if lost { vec![WhyUnused::Width] } else { Vec::new() };
        assert_eq!(beside_one_curve(&text), expected, "{text}");
    }
    let old = |flags: i64, head: &str, vertex: &str| {
        format!(
            "0\nPOLYLINE\n8\nA\n70\n{flags}\n{head}0\nVERTEX\n10\n0\n20\n0\n{vertex}0\nVERTEX\n10\n9\n20\n0\n0\nSEQEND\n"
        )
    };
    assert_eq!(beside_one_curve(&old(0, "40\n0.5\n41\n0.5\n", "")), [WhyUnused::Width]);
    assert_eq!(beside_one_curve(&old(0, "", "41\n1\n")), [WhyUnused::Width]);
    assert_eq!(beside_one_curve(&old(0, "40\n0\n41\n0\n", "40\n0\n")), []);
    assert_eq!(beside_one_curve(&old(8, "40\n1\n", "")), [], "in space there is no width");
    assert!(WhyUnused::Width.loses_something());
}

#[test]
fn what_climbs_is_counted_and_read_from_above() {
    for (text, climbs) in [
        ("0\nLINE\n8\nA\n10\n0\n20\n0\n30\n0\n11\n9\n21\n0\n31\n4\n", true),
        ("0\nLINE\n8\nA\n10\n0\n20\n0\n30\n4\n11\n9\n21\n0\n", true),
        ("0\nLINE\n8\nA\n10\n0\n20\n0\n30\nnan\n11\n9\n21\n0\n", true),
        ("0\nLINE\n8\nA\n10\n0\n20\n0\n30\n4\n11\n9\n21\n0\n31\n4.0000000000001\n", false),
        (
            "0\nPOLYLINE\n8\nA\n70\n8\n0\nVERTEX\n10\n0\n20\n0\n0\nVERTEX\n10\n9\n20\n0\n30\n2\n0\nSEQEND\n",
            true,
        ),
        ("0\nPOLYLINE\n8\nA\n70\n8\n0\nVERTEX\n10\n0\n30\n2\n0\nVERTEX\n10\n9\n30\n2\n0\nSEQEND\n", false),
        ("0\nSPLINE\n8\nA\n71\n1\n10\n0\n20\n0\n30\n0\n10\n9\n20\n0\n30\n1\n", true),
        ("0\nSPLINE\n8\nA\n71\n1\n10\n0\n20\n0\n30\n1\n10\n9\n20\n0\n30\n1\n", false),
    ] {
        let expected = if climbs { vec![WhyUnused::Height] } else { Vec::new() };
        assert_eq!(beside_one_curve(text), expected, "{text}");
    }
    assert!(!WhyUnused::Height.loses_something(), "what is seen from above is all there");
}

#[test]
fn a_negative_radius_is_a_contradiction() {
    for entity in ["CIRCLE", "ARC"] {
        let drawing = read("", &format!("0\n{entity}\n8\nA\n10\n0\n20\n0\n40\n-5\n50\n0\n51\n90\n"));
        assert_eq!((drawing.curve_count(), drawing.unused[0].why), (0, WhyUnused::Inconsistent));
    }
}
