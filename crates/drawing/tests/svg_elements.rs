//! Every element, command, transform and unit, against lengths and areas in closed form.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2, TAU};
use traverse_drawing::{Color, Curve, Drawing, ReadOptions, Unused, WhyUnused, read_svg};
use traverse_geometry::{Edge, Point, cross};

fn read(text: &str) -> Drawing {
    read_svg(text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}: {text}"))
}

/// A page of 100 × 100 mm with a user unit of 1 mm.
fn on_page(content: &str) -> Drawing {
    read(&format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>{content}</svg>"
    ))
}

fn curves(drawing: &Drawing) -> Vec<&Curve> {
    drawing.layers.iter().flat_map(|layer| &layer.curves).collect()
}

fn only(content: &str) -> Curve {
    let drawing = on_page(content);
    let curves = curves(&drawing);
    assert_eq!(curves.len(), 1, "{content}");
    curves[0].clone()
}

/// Enclosed area, counter-clockwise positive; an open chain is closed by its chord.
fn area(curve: &Curve) -> f64 {
    let from = |point: Point| point - curve.vertices[0];
    curve
        .edges()
        .map(|edge| {
            let chords = cross(from(edge.start()), from(edge.end())) / 2.0;
            match edge {
                Edge::Segment(_) => chords,
                Edge::Arc(arc) => chords + arc.radius * arc.radius * (arc.sweep - arc.sweep.sin()) / 2.0,
            }
        })
        .sum()
}

#[test]
fn shapes_have_their_length_and_area() {
    let corners = |r: f64| TAU * r - 8.0 * r;
    for (content, length, enclosed) in [
        ("<rect x='10' y='10' width='30' height='20'/>", 100.0, 600.0),
        ("<rect width='30' height='20' rx='4'/>", 100.0 + corners(4.0), 600.0 - (4.0 - PI) * 16.0),
        ("<rect width='30' height='20' ry='4'/>", 100.0 + corners(4.0), 600.0 - (4.0 - PI) * 16.0),
        ("<rect width='30' height='20' rx='99' ry='10'/>", f64::NAN, PI * 150.0),
        ("<circle cx='50' cy='50' r='20'/>", 40.0 * PI, 400.0 * PI),
        ("<ellipse cx='50' cy='50' rx='20' ry='20'/>", 40.0 * PI, 400.0 * PI),
        ("<ellipse cx='50' cy='50' rx='20' ry='10'/>", 96.884_482_205_476_79, 200.0 * PI),
        ("<line x1='1' y1='2' x2='4' y2='6'/>", 5.0, 0.0),
        ("<polyline points='0,0 10,0 10,10'/>", 20.0, 50.0),
        ("<polygon points='0,0 10,0 10,10'/>", 20.0 + 10.0 * SQRT_2, 50.0),
        ("<path d='M0 0h10v10H0z'/>", 40.0, 100.0),
        ("<path d='M10 50A20 20 0 0 1 50 50'/>", 20.0 * PI, 200.0 * PI),
        ("<path d='M10 50A20 20 0 0 0 50 50'/>", 20.0 * PI, 200.0 * PI),
        ("<path d='M10 50A5 5 0 0 0 50 50'/>", 20.0 * PI, 200.0 * PI),
        ("<path d='M10 50A20 20 0 0 0 30 70'/>", 10.0 * PI, 100.0 * PI - 200.0),
        ("<path d='M10 50A20 20 0 1 0 30 30'/>", 30.0 * PI, 300.0 * PI + 200.0),
        ("<path d='M10 50A0 20 0 1 0 30 50'/>", 20.0, 0.0),
        ("<path d='M10 50A20 10 0 0 1 50 50'/>", 96.884_482_205_476_79 / 2.0, 100.0 * PI),
        ("<path d='M10 50A20 10 90 0 1 30 50'/>", f64::NAN, 100.0 * PI),
        ("<path d='M0 0Q10 20 20 0'/>", f64::NAN, 400.0 / 3.0),
        ("<path d='M0 0Q10 20 20 0T40 0'/>", f64::NAN, 0.0),
        ("<path d='M0 0C0 10 30 10 30 0'/>", f64::NAN, 180.0),
        ("<path d='M0 0C0 10 30 10 30 0S60 -10 60 0'/>", f64::NAN, 0.0),
        ("<path d='M0 0C10 0 20 0 30 0'/>", 30.0, 0.0),
    ] {
        let curve = only(content);
        assert!((area(&curve).abs() - enclosed).abs() < 0.05, "{content}: {} {enclosed}", area(&curve));
        assert!(length.is_nan() || (curve.length() - length).abs() < 0.001, "{content}: {}", curve.length());
        let circular = !content.contains("ellipse cx='50' cy='50' rx='20' ry='10'")
            && !content.contains("ry='10'")
            && !content.contains(['Q', 'C'])
            && !content.contains("A20 10");
        assert_eq!(curve.deviation_mm == 0.0, circular, "{content}");
    }
}

#[test]
fn transforms_of_styles_turn_about_their_origin() {
    for (said, as_attribute) in [
        ("style='transform:translate(3px, 4px)'", "translate(3 4)"),
        ("style='transform: rotate(90deg); transform-origin: 10px 20px'", "rotate(90 10 20)"),
        ("transform='rotate(90)' transform-origin='10 20'", "rotate(90 10 20)"),
        ("transform='scale(9)' style='transform:scale(2)'", "scale(2)"),
        ("transform='scale(9)' style='transform:none;transform-origin:5px 5px'", "scale(1)"),
        (
            "style='transform:rotate(30deg) scale(2);transform-origin:center'",
            "translate(50 50) rotate(30) scale(2) translate(-50 -50)",
        ),
        ("style='transform:rotate(30deg);transform-origin:bottom left'", "rotate(30 0 100)"),
        (
            "style='transform:rotate(30deg);transform-origin:25% 5px;transform-box:view-box'",
            "rotate(30 25 5)",
        ),
    ] {
        let line = |how: &str| only(&format!("<line x1='1' y1='2' x2='7' y2='9' {how}/>")).vertices;
        for (p, q) in line(said).into_iter().zip(line(&format!("transform='{as_attribute}'"))) {
            assert!((p - q).norm() < 1e-9, "{said}: {p} {q}");
        }
    }
}

#[test]
fn circles_stay_circles_under_similar_maps() {
    for transform in [
        "translate(3 4)",
        "rotate(30)",
        "rotate(30 10 10) scale(2)",
        "scale(-1 1)",
        "matrix(0 2 2 0 1 1)",
        "skewX(0) rotate(-123.4)",
    ] {
        for shape in ["<circle cx='7' cy='9' r='5'", "<path d='M2 9a5 5 0 1 1 10 0a5 5 0 1 1-10 0z'"] {
            let curve = only(&format!("{shape} transform='{transform}'/>"));
            assert_eq!(
                (curve.deviation_mm, curve.vertices.len(), curve.closed),
                (0.0, 2, true),
                "{transform}"
            );
            assert!(curve.bulges.iter().all(|bulge| (bulge.abs() - 1.0).abs() < 1e-9));
        }
    }
    let curve = only("<circle r='10' cx='50' cy='50' transform='scale(1 0.5)'/>");
    assert!(curve.deviation_mm > 0.0 && (area(&curve).abs() - 50.0 * PI).abs() < 0.01);
    let curve = only("<rect width='10' height='10' transform='skewX(30) skewY(10)'/>");
    let determinant = 1.0;
    assert!((area(&curve).abs() - 100.0 * determinant).abs() < 1e-9);
}

#[test]
fn y_runs_up_from_the_lower_left_of_the_page() {
    let curve = only("<line x1='10' y1='20' x2='10' y2='90'/>");
    assert_eq!(curve.vertices, [Point::new(10.0, 80.0), Point::new(10.0, 10.0)]);
    // In the picture counter-clockwise is clockwise on the machine's side of things: an arc swept in positive
    // angles turns to the right.
    let curve = only("<path d='M0 50A50 50 0 0 1 50 0'/>");
    assert!(curve.bulges[0] < 0.0 && (curve.length() - 50.0 * FRAC_PI_2).abs() < 1e-9);
}

#[test]
fn pages_say_what_a_unit_is() {
    let line = "<line x2='10' y1='50' y2='50'/>";
    let px = 25.4 / 96.0;
    for (page, length, unit, assumed, mapping) in [
        (
            "width='100mm' height='100mm' viewBox='0 0 100 100'",
            10.0,
            "millimetres",
            false,
            "1 user unit = 1 mm; page 100 x 100 mm; x_mm = 1 (x - 0), y_mm = 100 - 1 (y - 0)",
        ),
        (
            "width='10cm' height='10cm' viewBox='0 0 50 50'",
            20.0,
            "centimetres",
            false,
            "1 user unit = 2 mm; page 100 x 100 mm; x_mm = 2 (x - 0), y_mm = 100 - 2 (y - 0)",
        ),
        (
            "width='1in' height='2in' viewBox='0 0 72 144'",
            25.4 / 7.2,
            "inches",
            false,
            "1 user unit = 0.3528 mm; page 25.4 x 50.8 mm; x_mm = 0.3528 (x - 0), y_mm = 50.8 - 0.3528 (y - 0)",
        ),
        (
            "width='100mm' viewBox='-10 5 50 100'",
            20.0,
            "millimetres",
            false,
            "1 user unit = 2 mm; page 100 x 200 mm; x_mm = 2 (x + 10), y_mm = 200 - 2 (y - 5)",
        ),
        (
            "width='100mm' height='50mm' viewBox='0 0 10 10' preserveAspectRatio='none'",
            100.0,
            "millimetres",
            false,
            "1 user unit = 10 mm in x and 5 mm in y; page 100 x 50 mm; x_mm = 10 (x - 0), y_mm = 50 - 5 (y - 0)",
        ),
        (
            "width='100mm' height='50mm' viewBox='0 0 10 10'",
            50.0,
            "millimetres",
            false,
            "1 user unit = 5 mm; page 100 x 50 mm; x_mm = 5 (x + 5), y_mm = 50 - 5 (y - 0)",
        ),
        (
            "width='96px' height='96' viewBox='0 0 96 96'",
            10.0 * px,
            "pixels",
            true,
            "1 user unit = 0.2646 mm; page 25.4 x 25.4 mm; x_mm = 0.2646 (x - 0), y_mm = 25.4 - 0.2646 (y - 0)",
        ),
        (
            "viewBox='0 0 96 96'",
            10.0 * px,
            "pixels",
            true,
            "1 user unit = 0.2646 mm; page 25.4 x 25.4 mm; x_mm = 0.2646 (x - 0), y_mm = 25.4 - 0.2646 (y - 0)",
        ),
        (
            "width='100%' height='100%'",
            10.0 * px,
            "pixels",
            true,
            "1 user unit = 0.2646 mm; page 0 x 0 mm; x_mm = 0.2646 (x - 0), y_mm = 0 - 0.2646 (y - 0)",
        ),
        (
            "width='100mm' height='100mm'",
            10.0 * px,
            "millimetres",
            false,
            "1 user unit = 0.2646 mm; page 100 x 100 mm; x_mm = 0.2646 (x - 0), y_mm = 100 - 0.2646 (y - 0)",
        ),
    ] {
        let drawing = read(&format!("<svg {page}>{line}</svg>"));
        assert!((curves(&drawing)[0].length() - length).abs() < 1e-9, "{page}");
        assert_eq!((drawing.unit.name, drawing.unit_assumed), (unit, assumed), "{page}");
        let stated = drawing.mapping.unwrap();
        assert_eq!(stated.to_string(), mapping);
        let start = curves(&drawing)[0].vertices[0];
        let x_mm = stated.mm_per_unit_x * (0.0 - stated.left);
        let y_mm = stated.page_height_mm - stated.mm_per_unit_y * (50.0 - stated.top);
        assert!((start - Point::new(x_mm, y_mm)).norm() < 1e-9, "{page}");
    }
    let mut options = ReadOptions::default();
    options.pixels_per_inch = 72.0;
    let drawing = read_svg(b"<svg width='72' height='72'><line x2='1in'/></svg>", &options).unwrap();
    assert!((curves(&drawing)[0].length() - 25.4).abs() < 1e-9);
}

#[test]
fn layers_groups_ids_and_colours_are_kept() {
    let drawing = read(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:i='http://www.inkscape.org/namespaces/inkscape' color='#010203'>
         <style>/* .a{stroke:red} */ .a{stroke:#0a0b0c} .b{fill:none!important} #z{stroke:lime} g > .c{fill:red}</style>
         <g id='outer'><g id='inner' stroke='blue'><line id='l1' x2='1'/><line class='a' x2='2'/>
           <line class='a' x2='3' style='stroke:#ff8000'/><line x2='4' stroke='currentColor'/><line id='z' x2='5'/></g></g>
         <g id='L1' i:groupmode='layer' i:label='Cut'><g id='sub'><circle id='c' r='5'/></g>
           <g i:groupmode='layer' i:label='Deep'><rect width='1' height='1' class='b' style='fill:red'/></g></g>
         <g i:label='no id'><line x2='6' stroke='url(#g) #00f'/></g></svg>",
    );
    let found: Vec<_> = drawing
        .layers
        .iter()
        .flat_map(|layer| layer.curves.iter().map(move |curve| (layer.name.as_str(), &curve.source)))
        .map(|(layer, source)| {
            let color = source.color.map_or(String::from("none"), |color: Color| color.to_string());
            (layer, source.id.as_deref().unwrap_or("-"), source.groups.join("/"), color)
        })
        .collect();
    let row = |layer, id, groups: &str, color: &str| (layer, id, groups.to_owned(), color.to_owned());
    assert_eq!(
        found,
        [
            row("outer", "l1", "outer/inner", "#0000ff"),
            row("outer", "-", "outer/inner", "#0a0b0c"),
            row("outer", "-", "outer/inner", "#ff8000"),
            row("outer", "-", "outer/inner", "#010203"),
            row("outer", "z", "outer/inner", "#00ff00"),
            row("Cut", "c", "Cut/sub", "#000000"),
            row("Deep", "-", "Cut/Deep", "none"),
            row("0", "-", "no id", "#0000ff"),
        ]
    );
    assert_eq!(
        drawing.unused,
        [Unused { layer: String::new(), entity: "style".into(), why: WhyUnused::Selector, count: 1 }]
    );
}

#[test]
fn what_is_not_read_is_counted() {
    let drawing = on_page(
        "<defs><circle r='5'/></defs><text>a</text><image width='5' height='5'/><g id='A'><rect width='0' height='9'/>
         <circle r='0'/><path d='M5 5'/><g display='none'><circle r='1'/><use href='#q'/></g><use href='#nowhere'/>
         <use href='other.svg#q'/><circle visibility='hidden' r='3'/><circle r='4' mask='url(#m)'/></g>
         <foreignObject/><metadata/><frobnicate/>",
    );
    let unused: Vec<_> =
        drawing.unused.iter().map(|u| (u.layer.as_str(), u.entity.as_str(), u.why, u.count)).collect();
    assert_eq!(
        unused,
        [
            ("0", "foreignObject", WhyUnused::Type, 1),
            ("0", "frobnicate", WhyUnused::Type, 1),
            ("0", "image", WhyUnused::Type, 1),
            ("0", "text", WhyUnused::Annotation, 1),
            ("A", "circle", WhyUnused::NoLength, 1),
            ("A", "circle", WhyUnused::Hidden, 2),
            ("A", "circle", WhyUnused::Clipped, 1),
            ("A", "path", WhyUnused::NoLength, 1),
            ("A", "rect", WhyUnused::NoLength, 1),
            ("A", "use", WhyUnused::Hidden, 1),
            ("A", "use", WhyUnused::Reference, 2),
        ]
    );
    assert_eq!(drawing.curve_count(), 1);
}

#[test]
fn subpaths_are_curves() {
    let drawing = on_page("<path id='p' d='M0 0h10v10zM20 20h5m1 1l4 4zl9 0'/>");
    let curves = curves(&drawing);
    let shapes: Vec<_> = curves.iter().map(|curve| (curve.vertices.len(), curve.closed)).collect();
    assert_eq!(shapes, [(3, true), (2, false), (2, true), (2, false)]);
    assert_eq!(curves[3].vertices, [Point::new(26.0, 79.0), Point::new(35.0, 79.0)]);
    assert!(std::sync::Arc::ptr_eq(&curves[0].source, &curves[3].source));
}
