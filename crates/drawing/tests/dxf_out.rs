//! A plan that is written as DXF is read back the same. ezdxf reads it too: see `ezdxf_roundtrip.py`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod random;

use random::Random;
use std::f64::consts::TAU;
use traverse_drawing::{
    Curve, DxfWriteError, ENDS_LAYER, OBSTACLES_LAYER, PATH_LAYER, ReadOptions, SectionOptions,
    WORK_AREA_LAYER, join_loops, read_drawing, read_dxf, sections_from_drawing, write_dxf, write_layout_dxf,
};
use traverse_geometry::{
    CornerStyle, Obstacle, Path, PlacedSection, Point, Polygon, Pose, Ring, Scene, SectionLayout, unit,
};

fn random_path(random: &mut Random, arcs: bool) -> Path {
    let mut within = |low: f64, high: f64| low + (high - low) * random.share();
    let mut path = Path::at(Point::new(within(-1e4, 1e4), within(-1e4, 1e4)));
    for _ in 0..within(0.0, 12.0) as usize {
        if arcs && within(0.0, 1.0) < 0.5 {
            let (radius, direction) = (10_f64.powf(within(-4.0, 4.0)), within(0.0, TAU));
            let sweep = if within(0.0, 1.0) < 0.2 { TAU } else { within(-TAU, TAU) };
            let center = path.end() - unit(direction) * radius;
            let end = if sweep == TAU { path.end() } else { center + unit(direction + sweep) * radius };
            path.arc_to(end, center, sweep);
        } else {
            path.line_to(Point::new(within(-1e4, 1e4), within(-1e4, 1e4)));
        }
    }
    path
}

fn scene() -> Scene {
    let square =
        |low: f64, high: f64| Ring::from_xy(&[low, low, high, low, high, high, low, high], &[]).unwrap();
    let disc = Ring::from_xy(&[40.1, 50.0, 60.3, 50.0], &[1.0, 1.0]).unwrap();
    let with_hole = Polygon::new(square(70.0, 95.0), vec![square(75.0, 90.0)]).unwrap();
    let obstacle =
        |id: &str, shape| Obstacle { id: id.to_owned(), shape, clearance_mm: None, top_z_mm: None };
    Scene {
        work_area: Some(Polygon::from_ring(square(0.0, 100.0))),
        obstacles: vec![obstacle("disc", Polygon::from_ring(disc)), obstacle("frame", with_hole)],
        clearance_mm: 1.0,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    }
}

/// Length of what our own reader finds on a layer.
fn length_on(text: &str, layer: &str) -> f64 {
    let drawing = read_dxf(text.as_bytes(), &ReadOptions::default()).unwrap();
    let found = drawing.layers.iter().find(|found| found.name == layer);
    found.map_or(0.0, |found| found.curves.iter().flat_map(Curve::edges).map(|edge| edge.length()).sum())
}

#[test]
fn lengths_are_kept_to_a_billionth() {
    let mut random = Random::new(7);
    for round in 0..500 {
        let path = random_path(&mut random, round % 3 > 0);
        let text = write_dxf(&path, None).unwrap();
        let (read, written) = (length_on(&text, PATH_LAYER), path.length());
        assert!((read - written).abs() <= 1e-9 * written.max(1.0), "{round}: {read} {written}");
        let polylines = text.matches("\nLWPOLYLINE\n").count();
        assert_eq!(polylines, usize::from(!path.steps.is_empty()));
        assert_eq!(text.matches("\nPOINT\n").count(), 2);
        assert!(text.is_ascii() && text.ends_with("  0\nEOF\n") && !text.contains("MARK"));
    }
}

#[test]
fn the_scene_goes_on_layers_of_its_own() {
    let scene = scene();
    let text = write_dxf(&Path::at(Point::new(1.0, 1.0)), Some(&scene)).unwrap();
    let drawn: f64 = scene.obstacles.iter().flat_map(|o| o.shape.rings()).map(Ring::length).sum();
    assert!((length_on(&text, OBSTACLES_LAYER) - drawn).abs() < 1e-9);
    assert!((length_on(&text, WORK_AREA_LAYER) - 400.0).abs() < 1e-9);
    assert_eq!(length_on(&text, PATH_LAYER), 0.0);
    assert_eq!(text.matches(&format!("\n  8\n{ENDS_LAYER}\n")).count(), 2);
    let drawing = read_dxf(text.as_bytes(), &ReadOptions::default()).unwrap();
    let obstacles = drawing.layers.iter().find(|layer| layer.name == OBSTACLES_LAYER).unwrap();
    assert_eq!(join_loops(OBSTACLES_LAYER, &obstacles.curves, 1e-9).loops.len(), 3);
}

#[test]
fn numbers_that_are_none_are_refused() {
    let mut path = Path::at(Point::new(0.0, f64::NAN));
    assert!(matches!(write_dxf(&path, None), Err(DxfWriteError::NotFinite { step: 0, .. })));
    path = Path::at(Point::origin());
    path.arc_to(Point::new(1.0, 0.0), Point::new(0.5, 0.0), f64::INFINITY);
    assert!(matches!(write_dxf(&path, None), Err(DxfWriteError::NotFinite { step: 1, .. })));
}

/// Writes files for `ezdxf_roundtrip.py`, with the lengths it should find: `TRAVERSE_DXF_OUT=DIR cargo test …`.
#[test]
fn files_for_ezdxf() {
    let Some(dir) = std::env::var_os("TRAVERSE_DXF_OUT").map(std::path::PathBuf::from) else { return };
    let mut random = Random::new(11);
    for number in 0..20 {
        let path = random_path(&mut random, true);
        let scene = scene();
        let text = write_dxf(&path, (number % 2 == 0).then_some(&scene)).unwrap();
        std::fs::write(dir.join(format!("{number}.dxf")), text).unwrap();
        std::fs::write(dir.join(format!("{number}.length")), path.length().to_string()).unwrap();
    }
    std::fs::write(dir.join("layout.dxf"), bundled_sections()).unwrap();
}

/// The bundled sections side by side.
fn bundled_sections() -> String {
    let path = format!("{}/../../drawings/shoe-sections.svg", env!("CARGO_MANIFEST_DIR"));
    let drawing = read_drawing(&std::fs::read(path).unwrap(), &ReadOptions::default()).unwrap();
    let sections = sections_from_drawing(&drawing, &SectionOptions::default()).unwrap().sections;
    let mut x_mm = 0.0;
    let order: Vec<PlacedSection> = (sections.iter().enumerate())
        .map(|(section, of)| {
            let placed = PlacedSection { section, copy: 0, pose: Pose::HalfTurn, x_mm };
            x_mm += of.bounds().size().x;
            placed
        })
        .collect();
    let layout = SectionLayout::new(sections);
    write_layout_dxf(&layout, &order).unwrap()
}
