//! Pictures are well-formed, complete, and do not change by accident.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod random;

use random::Random;
use traverse_drawing::{
    ReadOptions, SceneOptions, Shown, picture_of_plan, read_dxf_from, scene_from_drawing,
};
use traverse_geometry::{CornerStyle, Obstacle, Path, Point, Polygon, Ring, Scene};

fn bundled(name: &str, clearance_mm: f64) -> Scene {
    let path = format!("{}/../../drawings/{name}", env!("CARGO_MANIFEST_DIR"));
    let drawing = read_dxf_from(std::fs::File::open(path).unwrap(), &ReadOptions::default()).unwrap();
    scene_from_drawing(&drawing, &SceneOptions::new(clearance_mm)).unwrap().scene
}

/// The picture must equal the golden file; `TRAVERSE_BLESS=1` writes it anew.
fn check(name: &str, svg: &str) {
    let path = format!("{}/tests/golden/{name}", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("TRAVERSE_BLESS").is_some() {
        std::fs::write(&path, svg).unwrap();
    }
    let golden = std::fs::read_to_string(&path).unwrap();
    assert!(svg == golden, "{name} changed: look at it, then run with TRAVERSE_BLESS=1");
}

#[test]
fn a_path_and_no_path() {
    let scene = bundled("turned-shaft.dxf", 4.0);
    let mut path = Path::at(Point::new(100.0, 40.0));
    path.line_to(Point::new(100.0, 70.0));
    path.arc_to(Point::new(160.0, 70.0), Point::new(130.0, 70.0), -std::f64::consts::PI);
    path.line_to(Point::new(181.0, 38.0));
    let svg = picture_of_plan(&scene, Shown::Path(&path), "Turned shaft");
    check("path.svg", &svg);
    let parts = vec![String::from("STEADY_REST/1"), String::from("SHAFT/1")];
    let (start, target) = (Point::new(100.0, 60.0), Point::new(230.0, 60.0));
    let shown = Shown::NoPath { start, target, separating: &parts };
    let svg = picture_of_plan(&scene, shown, "Turned shaft");
    check("no-path.svg", &svg);
    let document = roxmltree::Document::parse(&svg).unwrap();
    let parted = |node: &roxmltree::Node<'_, '_>| node.attribute("class") == Some("obstacle parts");
    assert_eq!(
        document.descendants().filter(|node| node.tag_name().name() == "path" && parted(node)).count(),
        2
    );
}

#[test]
fn a_tool_change_and_other_ways_are_drawn_and_explained() {
    let scene = bundled("turned-shaft.dxf", 4.0);
    let (start, place, target) = (Point::new(100.0, 60.0), Point::new(150.0, 90.0), Point::new(230.0, 60.0));
    let straight = |from: Point, to: Point| {
        let mut path = Path::at(from);
        path.line_to(to);
        path
    };
    let corners = [(140.0, 90.0), (160.0, 90.0), (160.0, 99.0)].map(|(x, y)| Point::new(x, y)).to_vec();
    let regions = [Polygon::from_ring(Ring::new(corners, Vec::new()).unwrap())];
    let moves = [straight(start, place), straight(place, target)];
    let points = [place];
    let change = |moves, separating| Shown::ToolChange {
        regions: &regions,
        points: &points,
        ends: (start, target),
        moves,
        separating,
    };
    let count = |svg: &str, class: &str| {
        let document = roxmltree::Document::parse(svg).unwrap();
        document.descendants().filter(|node| node.attribute("class") == Some(class)).count()
    };
    let svg = picture_of_plan(&scene, change(&moves, &[]), "Shaft");
    // Region, point and the sign of the legend; both moves and theirs.
    assert_eq!((count(&svg, "region"), count(&svg, "rapid")), (3, 3));
    for said in ["tool change at 150, 90: both moves ", "tool change permitted", ">tool change</text>"] {
        assert!(svg.contains(said), "{said}");
    }
    let parts = [String::from("SHAFT/1")];
    let nowhere = picture_of_plan(&scene, change(&[], &parts), "");
    assert!(nowhere.contains("no place for the tool change: SHAFT/1 in the way"));
    assert_eq!((count(&nowhere, "rapid"), count(&nowhere, "obstacle parts")), (0, 2));
    let shown = Shown::Choice { path: &moves[0], others: &moves[..1] };
    let choice = picture_of_plan(&scene, shown, "");
    assert_eq!((count(&choice, "rapid"), count(&choice, "before")), (2, 2));
    assert!(choice.contains("other ways"));
}

/// A needle's barrier ends at the limit's distance from its tip, as it is planned, not at the bevel.
#[test]
fn mitred_corners_are_cut_square_at_the_limit() {
    let needle = [(0.0, 0.0), (100.0, 5.0), (0.0, 10.0)].map(|(x, y)| Point::new(x, y)).to_vec();
    let shape = Polygon::from_ring(Ring::new(needle, Vec::new()).unwrap());
    let mut scene = Scene {
        work_area: None,
        obstacles: vec![Obstacle { id: String::from("NEEDLE"), shape, clearance_mm: None, top_z_mm: None }],
        clearance_mm: 10.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Miter { limit: Some(2.0) },
    };
    let svg = picture_of_plan(&scene, Shown::Scene, "");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let cuts: Vec<&str> = document
        .descendants()
        .filter(|node| node.attribute("class") == Some("cut"))
        .filter_map(|node| node.attribute("d"))
        .collect();
    assert_eq!(cuts.len(), 2);
    let corners: Vec<(f64, f64)> = cuts[0][1..cuts[0].len() - 1]
        .split('L')
        .map(|pair| pair.split_once(' ').unwrap())
        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
        .collect();
    let [vertex, from, first, second, to] = corners[..] else { panic!("{corners:?}") };
    let scale = (from.0 - vertex.0).hypot(from.1 - vertex.1) / 10.0;
    assert!((first.0 - vertex.0 - 20.0 * scale).abs() < 0.05 && (first.0 - second.0).abs() < 0.05);
    assert!((to.0 - from.0).abs() < 0.05);
    scene.corner_style = CornerStyle::Miter { limit: None };
    assert!(!picture_of_plan(&scene, Shown::Scene, "").contains("\"cut\""));
}

#[test]
fn every_obstacle_is_there_and_text_is_escaped() {
    let ring = |x: f64| {
        let vertices = [(x, 0.0), (x + 3.0, 0.0), (x, 3.0)].map(|(x, y)| Point::new(x, y)).to_vec();
        Ring::new(vertices, Vec::new()).unwrap()
    };
    let ids = ["<a & \"b\">", "]]>\u{1}\u{0}", "日本語/1", ""];
    let obstacles = ids.iter().zip(0..).map(|(id, i)| Obstacle {
        id: (*id).to_owned(),
        shape: Polygon::from_ring(ring(5.0 * f64::from(i))),
        clearance_mm: (i == 2).then_some(0.5),
        top_z_mm: None,
    });
    let scene = Scene {
        work_area: None,
        obstacles: obstacles.collect(),
        clearance_mm: 0.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Miter { limit: None },
    };
    let svg = picture_of_plan(&scene, Shown::Scene, "<title> & more");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let titles: Vec<&str> = document
        .descendants()
        .filter(|node| node.tag_name().name() == "title")
        .filter_map(|node| node.text())
        .collect();
    assert!(titles.contains(&ids[0]) && titles.contains(&ids[2]));
}

#[test]
fn generated_scenes_give_pictures() {
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let scale = 10_f64.powi(random.below(9) as i32 - 3);
        let place = |random: &mut Random| Point::new(random.share() * scale, random.share() * scale * 0.7);
        let mut obstacles = Vec::new();
        for i in 0..random.below(120) {
            let corner = place(&mut random);
            let [a, b] = [0, 1].map(|_| scale * 0.05 * (0.1 + random.share()));
            let vertices = [(0.0, 0.0), (a, 0.0), (a, b), (0.0, b)];
            let vertices = vertices.map(|(x, y)| Point::new(corner.x + x, corner.y + y)).to_vec();
            let bulges = vec![random.share(), 0.0, random.share(), 0.0];
            let shape = Polygon::from_ring(Ring::new(vertices, bulges).unwrap());
            obstacles.push(Obstacle {
                id: format!("OBSTACLE/{i}"),
                shape,
                clearance_mm: None,
                top_z_mm: None,
            });
        }
        let scene = Scene {
            work_area: None,
            obstacles,
            clearance_mm: scale * 0.01,
            work_area_clearance_mm: None,
            corner_style: CornerStyle::Round,
        };
        let mut path = Path::at(place(&mut random));
        for _ in 0..random.below(6) {
            path.line_to(place(&mut random));
        }
        let paths = vec![path.clone(), path.reversed()];
        let separating: Vec<String> = (0..random.below(40)).map(|i| format!("OBSTACLE/{i}")).collect();
        for shown in [
            Shown::Scene,
            Shown::Path(&path),
            Shown::Paths(&paths),
            Shown::NoPath { start: path.start, target: path.end(), separating: &separating },
        ] {
            let svg = picture_of_plan(&scene, shown, "generated");
            let document = roxmltree::Document::parse(&svg).expect("well-formed");
            let drawn = document.descendants().filter(|node| {
                node.attribute("class").is_some_and(|class| class.starts_with("obstacle"))
                    && node.has_children()
            });
            assert_eq!(drawn.count(), scene.obstacles.len(), "seed {seed}");
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "seed {seed}");
        }
    }
}

#[test]
fn text_covers_neither_path_nor_ends() {
    for name in ["vise-and-clamps.dxf", "leather-hide.dxf"] {
        let scene = bundled(name, 5.0);
        let bounds = scene.work_area.as_ref().unwrap().bounds();
        for seed in 0..40 {
            let mut random = Random::new(seed);
            let mut place = || {
                Point::new(
                    bounds.min.x + random.share() * bounds.size().x,
                    bounds.min.y + random.share() * bounds.size().y,
                )
            };
            let mut path = Path::at(place());
            path.line_to(place());
            path.line_to(place());
            let svg = picture_of_plan(&scene, Shown::Path(&path), "");
            let document = roxmltree::Document::parse(&svg).unwrap();
            let of_class = |class: &'static str| {
                document.descendants().filter(move |node| node.attribute("class") == Some(class))
            };
            let data = of_class("rapid").next().and_then(|node| node.attribute("d")).unwrap();
            let corners: Vec<(f64, f64)> = data[1..]
                .split('L')
                .map(|pair| pair.split_once(' ').unwrap())
                .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
                .collect();
            for label in of_class("id").chain(of_class("end")) {
                let number = |name: &str| label.attribute(name).unwrap().parse::<f64>().unwrap();
                // Letters of 21 units are about 0.5 of that wide and 0.7 high.
                let half = label.text().unwrap().chars().count() as f64 * 21.0 * 0.25;
                let (x, y) = (number("x"), number("y") - 7.0);
                for pair in corners.windows(2) {
                    for share in (0..=1000).map(|i| f64::from(i) / 1000.0) {
                        let px = pair[0].0 + (pair[1].0 - pair[0].0) * share;
                        let py = pair[0].1 + (pair[1].1 - pair[0].1) * share;
                        let covered = (px - x).abs() < half && (py - y).abs() < 8.0;
                        assert!(!covered, "{name}, seed {seed}: {:?}", label.text());
                    }
                }
            }
        }
    }
}
