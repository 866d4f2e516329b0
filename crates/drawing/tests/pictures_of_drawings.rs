//! Pictures of drawings: every layer is there, findings are marked at their places and listed.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod pictures_svg;
mod random;

use pictures_svg::{assert_text_is_free, chords, covers};
use random::Random;
use traverse_drawing::{
    Curve, Drawing, DrawingFinding, Fault, Layer, LengthUnit, MARKED_FINDINGS, ReadOptions, SceneOptions,
    picture_of_drawing, read_dxf_from, scene_from_drawing,
};
use traverse_geometry::Point;

fn curve(points: &[(f64, f64)], closed: bool) -> Curve {
    let vertices: Vec<Point> = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
    let bulges = vec![0.0; vertices.len()];
    Curve::new(vertices, bulges, closed)
}

fn drawing(layers: Vec<(&str, Vec<Curve>)>) -> Drawing {
    let layers = layers.into_iter().map(|(name, curves)| Layer { name: name.to_owned(), curves }).collect();
    Drawing { unit: LengthUnit::MILLIMETRES, unit_assumed: false, layers, unused: Vec::new(), mapping: None }
}

fn findings(drawing: &Drawing) -> Vec<DrawingFinding> {
    scene_from_drawing(drawing, &SceneOptions::new(1.0)).unwrap().report.findings
}

fn square(x: f64, y: f64, side: f64) -> Curve {
    curve(&[(x, y), (x + side, y), (x + side, y + side), (x, y + side)], true)
}

/// One of each finding.
fn faulty() -> Drawing {
    let with_hole = vec![
        square(0.0, 0.0, 100.0),
        // Crosses the right side of the first at 100,30 and 100,50; its middle lies inside.
        curve(&[(40.0, 30.0), (105.0, 30.0), (105.0, 50.0), (40.0, 50.0)], true),
    ];
    let open = vec![
        curve(&[(130.0, 10.0), (180.0, 10.0), (180.0, 50.0), (130.0, 50.0), (130.0, 16.0)], false),
        curve(&[(200.0, 10.0), (240.0, 10.0)], false),
    ];
    let twice = vec![square(130.0, 70.0, 20.0), square(130.0, 70.0, 20.0)];
    let bow = vec![curve(&[(170.0, 70.0), (210.0, 100.0), (210.0, 70.0), (170.0, 100.0)], true)];
    drawing(vec![("HOLED", with_hole), ("OPEN", open), ("TWICE", twice), ("BOW", bow)])
}

#[test]
fn findings_have_their_places() {
    let found = findings(&faulty());
    let place = |fits: fn(&Fault) -> bool| -> Vec<(f64, f64)> {
        let fitting = found.iter().filter(|finding| fits(&finding.fault));
        fitting.map(|finding| (finding.place.x, finding.place.y)).collect()
    };
    // One for both loops, at one of the two places where they cross.
    let [crossing] = place(|fault| matches!(fault, Fault::LoopsCross))[..] else { panic!("{found:?}") };
    assert!(crossing == (100.0, 30.0) || crossing == (100.0, 50.0), "{crossing:?}");
    assert_eq!(place(|fault| matches!(fault, Fault::InvalidLoop { .. })), [(190.0, 85.0)]);
    assert_eq!(place(|fault| matches!(fault, Fault::Duplicate)), [(130.0, 70.0)]);
    assert_eq!(place(|fault| matches!(fault, Fault::OpenChain { .. })).len(), 2);
}

/// Holes that are valid one by one but not together: each finding lies at the hole that it names.
#[test]
fn crossing_holes_are_found_where_they_cross() {
    let curves = vec![
        square(0.0, 0.0, 100.0),
        square(10.0, 10.0, 10.0),
        curve(&[(50.0, 50.0), (90.0, 50.0), (90.0, 58.0), (50.0, 58.0)], true),
        curve(&[(60.0, 40.0), (64.0, 40.0), (64.0, 90.0), (60.0, 90.0)], true),
    ];
    let found = findings(&drawing(vec![("PLATE", curves)]));
    assert!(!found.is_empty());
    for finding in found {
        assert!((60.0..=64.0).contains(&finding.place.x), "{finding}");
        assert!((50.0..=58.0).contains(&finding.place.y), "{finding}");
    }
}

#[test]
fn findings_are_marked_and_listed() {
    let drawing = faulty();
    let found = findings(&drawing);
    let svg = picture_of_drawing(&drawing, &found, "Faulty plate");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let count =
        |class: &str| document.descendants().filter(|node| node.attribute("class") == Some(class)).count();
    // Twice each, on the drawing and in the list; one of both in the legend.
    assert_eq!(count("lost") + count("kept"), 2 * found.len() + 2);
    assert_eq!(count("loose"), 4 + 1);
    let said: String = document
        .descendants()
        .filter(|node| node.attribute("class") == Some("said"))
        .filter_map(|node| node.text())
        .collect::<Vec<_>>()
        .join(" ");
    for finding in &found {
        assert!(said.contains(&finding.to_string()), "{finding}");
    }
    for name in ["HOLED", "OPEN", "TWICE", "BOW"] {
        assert!(svg.contains(&format!(">{name}</text>")) && svg.contains(&format!("<title>{name}</title>")));
    }
    assert_text_is_free(&svg, &["gapline", "spot"], "faulty");
    let golden = format!("{}/tests/golden/drawing.svg", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("TRAVERSE_BLESS").is_some() {
        std::fs::write(&golden, &svg).unwrap();
    }
    let same = svg == std::fs::read_to_string(golden).unwrap();
    assert!(same, "drawing.svg changed: look at it, then run with TRAVERSE_BLESS=1");
}

#[test]
fn markers_cover_no_place_of_a_finding_and_no_other_marker() {
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let count = random.below(60);
        let spread = [1.0, 30.0, 1000.0][random.below(3)];
        let found: Vec<DrawingFinding> = (0..count)
            .map(|_| {
                let mut place =
                    || Point::new(500.0 + spread * random.share(), 300.0 + spread * random.share());
                let (place, other_end) = (place(), place());
                let gap_mm = (place - other_end).norm();
                let fault = match random.below(3) {
                    0 => Fault::Duplicate,
                    1 => Fault::Junction { ends: 3 },
                    _ => Fault::OpenChain { other_end, gap_mm, length_mm: 1.0 },
                };
                DrawingFinding { layer: String::from("L"), entity: None, place, fault }
            })
            .collect();
        let svg = picture_of_drawing(&drawing(vec![("L", vec![square(0.0, 0.0, 1000.0)])]), &found, "");
        let document = roxmltree::Document::parse(&svg).unwrap();
        let number = |node: &roxmltree::Node<'_, '_>, name: &str| -> f64 {
            node.attribute(name).unwrap().parse().unwrap()
        };
        let of_class = |classes: &[&str]| -> Vec<(f64, f64)> {
            document
                .descendants()
                .filter(|node| node.attribute("class").is_some_and(|class| classes.contains(&class)))
                .filter(|node| node.has_attribute("cx"))
                .map(|node| (number(&node, "cx"), number(&node, "cy")))
                .collect()
        };
        let discs = of_class(&["lost", "kept"]);
        let spots = of_class(&["spot"]);
        let marked = count.min(MARKED_FINDINGS);
        assert!(discs.len() >= 2 * marked, "seed {seed}: {} discs for {marked}", discs.len());
        let away = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot(a.1 - b.1);
        for (i, &disc) in discs.iter().enumerate() {
            assert!(discs[i + 1..].iter().all(|&other| away(disc, other) >= 28.0), "seed {seed}");
            assert!(spots.iter().all(|&spot| away(disc, spot) >= 22.0), "seed {seed}");
        }
        let gaps = chords(&svg, &["gapline"]);
        for (x, y) in discs {
            let r = 9.0;
            assert!(gaps.iter().all(|&gap| !covers(&[x - r, y - r, x + r, y + r], gap)), "seed {seed}");
        }
        assert_text_is_free(&svg, &["gapline"], "markers");
        assert_eq!(svg.contains("findings more"), count > MARKED_FINDINGS);
    }
}

#[test]
fn bundled_drawings_and_degenerate_ones_give_pictures() {
    for name in ["vise-and-clamps.dxf", "leather-hide.dxf", "turned-shaft.dxf"] {
        let path = format!("{}/../../drawings/{name}", env!("CARGO_MANIFEST_DIR"));
        let drawing = read_dxf_from(std::fs::File::open(path).unwrap(), &ReadOptions::default()).unwrap();
        let svg = picture_of_drawing(&drawing, &[], name);
        assert_text_is_free(&svg, &[], name);
        assert!(!svg.contains("findings"));
    }
    let nowhere = Point::new(f64::NAN, f64::INFINITY);
    let fault = Fault::OpenChain { other_end: nowhere, gap_mm: f64::NAN, length_mm: 0.0 };
    let found = [
        DrawingFinding { layer: String::new(), entity: None, place: nowhere, fault: fault.clone() },
        DrawingFinding { layer: String::from("<&>"), entity: None, place: Point::new(1.0, 1.0), fault },
    ];
    let odd = vec![
        Curve::new(vec![nowhere, nowhere], vec![0.0; 2], true),
        Curve::new(vec![], vec![], false),
        Curve::new(vec![Point::origin()], vec![], true),
        curve(&[(0.0, 0.0), (0.0, 0.0)], false),
    ];
    for drawing in [drawing(vec![]), drawing(vec![("<a & b>", vec![])]), drawing(vec![("ODD", odd)])] {
        for found in [&[][..], &found] {
            let svg = picture_of_drawing(&drawing, found, "");
            let document = roxmltree::Document::parse(&svg).expect("well-formed");
            let mut drawn = document.descendants().flat_map(|node| node.attributes());
            assert!(drawn.all(|each| !each.value().contains("NaN") && !each.value().contains("inf")));
        }
    }
}

#[test]
fn the_size_of_a_picture_is_bounded() {
    let mut random = Random::new(1);
    let mut specks: Vec<Curve> =
        (0..60_000).map(|_| square(random.share() * 50.0, random.share() * 50.0, 0.01)).collect();
    specks.push(square(0.0, 0.0, 1000.0));
    let long: Vec<(f64, f64)> = (0..200_000)
        .map(|i| f64::from(i) / 200_000.0 * std::f64::consts::TAU)
        .map(|a| (a.cos(), a.sin()))
        .collect();
    for drawing in [drawing(vec![("SPECKS", specks)]), drawing(vec![("LONG", vec![curve(&long, true)])])] {
        let size = picture_of_drawing(&drawing, &[], "").len();
        assert!(size < 2_000_000, "{size}");
    }
    let layers: Vec<String> = (0..100).map(|i| format!("LAYER {i}")).collect();
    let many = layers.iter().map(|name| (name.as_str(), vec![square(0.0, 0.0, 9.0)])).collect();
    let svg = picture_of_drawing(&drawing(many), &[], "");
    assert!(svg.contains("and 76 layers more"));
    assert_text_is_free(&svg, &[], "layers");
}
