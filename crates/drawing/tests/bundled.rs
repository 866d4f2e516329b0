//! The bundled drawings: what is read from them, and that they are what their program writes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

#[path = "../examples/make_drawings/dxf_text.rs"]
mod dxf_text;
#[path = "../examples/make_drawings/leather_hide.rs"]
mod leather_hide;
#[path = "../examples/make_drawings/shoe_sections.rs"]
mod shoe_sections;
#[path = "../examples/make_drawings/turned_shaft.rs"]
mod turned_shaft;
#[path = "../examples/make_drawings/vise_and_clamps.rs"]
mod vise_and_clamps;

use std::f64::consts::PI;
use traverse_drawing::{
    ReadOptions, SceneFromDrawing, SceneOptions, WhyUnused, read_dxf, read_dxf_from, scene_from_drawing,
};

fn scene(name: &str) -> SceneFromDrawing {
    let path = format!("{}/../../drawings/{name}", env!("CARGO_MANIFEST_DIR"));
    let drawing = read_dxf_from(std::fs::File::open(path).unwrap(), &ReadOptions::default()).unwrap();
    scene_from_drawing(&drawing, &SceneOptions::new(4.0)).unwrap()
}

fn area(made: &SceneFromDrawing, id: &str) -> f64 {
    made.scene.obstacles.iter().find(|obstacle| obstacle.id == id).unwrap().shape.area()
}

fn near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

#[test]
fn the_files_are_what_the_program_writes() {
    for (name, text) in [
        ("vise-and-clamps.dxf", vise_and_clamps::text()),
        ("turned-shaft.dxf", turned_shaft::text()),
        ("leather-hide.dxf", leather_hide::text()),
    ] {
        let path = format!("{}/../../drawings/{name}", env!("CARGO_MANIFEST_DIR"));
        let options = ReadOptions::default();
        let file = read_dxf_from(std::fs::File::open(path).unwrap(), &options).unwrap();
        let written = read_dxf(text.as_bytes(), &options).unwrap();
        assert_eq!(file.unit, written.unit);
        assert_eq!(file.unused, written.unused);
        for (a, b) in file.layers.iter().zip(&written.layers) {
            assert_eq!((&a.name, a.curves.len()), (&b.name, b.curves.len()), "{name}: run make_drawings");
            for (a, b) in a.curves.iter().zip(&b.curves) {
                near(a.length(), b.length(), 1e-9);
            }
        }
    }
}

#[test]
fn the_sections_are_what_the_program_writes() {
    let path = format!("{}/../../drawings/shoe-sections.svg", env!("CARGO_MANIFEST_DIR"));
    assert_eq!(std::fs::read_to_string(path).unwrap(), shoe_sections::text(), "run make_drawings");
}

#[test]
fn vise_and_clamps() {
    let made = scene("vise-and-clamps.dxf");
    assert!(made.report.is_complete() && !made.report.unit_assumed);
    assert_eq!(made.report.unused[0].why, WhyUnused::Annotation);
    assert!(made.report.findings.is_empty());
    let ids: Vec<&str> = made.scene.obstacles.iter().map(|obstacle| obstacle.id.as_str()).collect();
    assert_eq!(
        ids,
        [
            "VISE/1", "VISE/2", "VISE/3", "VISE/4", "PART/1", "PART/2", "PLATE/1", "CLAMPS/1", "CLAMPS/2",
            "CLAMPS/3", "CLAMPS/4", "PINS/1", "PINS/2", "PINS/3", "PINS/4", "STOP/1"
        ]
    );
    near(made.scene.work_area.as_ref().unwrap().area(), 600.0 * 300.0, 1e-9);
    near(area(&made, "VISE/1"), 170.0 * 45.0, 1e-9);
    // Part less pocket; the island in the pocket is an obstacle of its own.
    near(area(&made, "PART/1"), 120.0 * 60.0 - (94.0 * 36.0 - (4.0 - PI) * 36.0), 1e-6);
    near(area(&made, "PART/2"), PI * 64.0, 1e-9);
    near(area(&made, "PLATE/1"), 170.0 * 126.0 - 2.0 * 144.0 - PI * 38.0 * 38.0, 1e-6);
    // Rectangle with a half-round nose, less a slot with two round ends.
    near(area(&made, "CLAMPS/3"), 68.0 * 24.0 + PI * 72.0 - (20.0 * 10.0 + PI * 25.0), 1e-6);
    // Two bars; convex fillets take (1 − π/4) r² each, the inner one adds as much.
    let fillets = (1.0 - PI / 4.0) * (144.0 - 4.0 * 64.0);
    near(area(&made, "STOP/1"), 80.0 * 20.0 + 25.0 * 110.0 + fillets, 1e-6);
}

#[test]
fn turned_shaft_in_inches() {
    let made = scene("turned-shaft.dxf");
    assert!(made.report.is_complete() && made.report.findings.is_empty());
    assert_eq!(made.report.unit.name, "inches");
    assert_eq!(made.scene.obstacles.len(), 5);
    near(made.scene.work_area.as_ref().unwrap().area(), 400.0 * 140.0, 1e-6);
    near(area(&made, "STEADY_REST/1"), 18.0 * 88.0 + PI * 81.0 / 2.0, 1e-6);
}

#[test]
fn leather_hide_of_loose_ends() {
    let made = scene("leather-hide.dxf");
    assert!(made.report.is_complete(), "{}", made.report);
    assert!(made.report.findings.is_empty());
    assert_eq!(made.scene.obstacles.iter().filter(|each| each.id.starts_with("PIECES/")).count(), 8);
    assert_eq!(made.scene.obstacles.iter().filter(|each| each.id.starts_with("MARKS/")).count(), 4);
    near(area(&made, "MARKS/1"), PI * 26.0 * 26.0, 1e-6);
    // A strap with a round end, less its slot; ends miss by micrometres.
    let strap = made.scene.obstacles.iter().find(|each| !each.shape.holes().is_empty()).unwrap();
    near(strap.shape.area(), 240.0 * 32.0 + PI * 128.0 - (200.0 + PI * 25.0), 1.5);
    assert!(strap.shape.outer().has_arcs());
}

#[test]
fn binary_files_read_as_their_text() {
    for text in [vise_and_clamps::text(), turned_shaft::text(), leather_hide::text()] {
        let options = ReadOptions::default();
        let from_text = read_dxf(text.as_bytes(), &options).unwrap();
        let file = dxf::Drawing::load(&mut text.as_bytes()).unwrap();
        let mut binary = Vec::new();
        file.save_binary(&mut binary).unwrap();
        let from_binary = read_dxf(&binary, &options).unwrap();
        assert_eq!(from_binary, from_text);
        for length in (0..binary.len()).step_by(97) {
            assert!(read_dxf(&binary[..length], &options).is_err(), "{length} of {}", binary.len());
        }
    }
}

/// The rows of the second table of drawings/README.md: ends must keep their distance.
#[test]
fn suggested_moves_begin_and_end_outside_every_barrier() {
    let page =
        std::fs::read_to_string(format!("{}/../../drawings/README.md", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let mut moves = 0;
    for row in page.lines().filter(|row| row.starts_with("| `")) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let Ok(clearance) = cells[4].parse::<f64>() else { continue };
        let made = scene(cells[1].trim_matches('`'));
        for cell in [cells[2], cells[3]] {
            let (x, y) = cell.split_once(',').unwrap();
            let p = traverse_geometry::Point::new(x.parse().unwrap(), y.parse().unwrap());
            for obstacle in &made.scene.obstacles {
                let free = !obstacle.shape.contains(p) && obstacle.shape.distance_to_border(p) >= clearance;
                assert!(free, "{row}: {p} is inside the barrier of {}", obstacle.id);
            }
            let area = made.scene.work_area.as_ref().unwrap();
            assert!(area.contains(p) && area.distance_to_border(p) >= clearance, "{row}: {p}");
        }
        moves += 1;
    }
    assert_eq!(moves, 7);
}
