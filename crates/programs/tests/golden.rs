//! The bundled programs, rewritten: byte for byte what stands in tests/golden. `UPDATE_GOLDEN=1` writes those anew.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::collections::BTreeMap;
use std::path::{Path as FilePath, PathBuf};
use traverse_drawing::{
    ArcMotion, ObstacleRole, ReadOptions as DrawingOptions, SceneOptions, read_drawing, scene_from_drawing,
};
use traverse_geometry::{Path, Scene};
use traverse_programs::{
    Found, Program, RapidPlanner, ReadOptions, Reason, ScenePlanner, ToolScenes, Travel, WriteOptions,
    rewrite,
};
use traverse_solve::Budget;

fn root() -> PathBuf {
    FilePath::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn mill() -> Scene {
    let bytes = std::fs::read(root().join("drawings/vise-and-clamps.dxf")).unwrap();
    let drawing = read_drawing(&bytes, &DrawingOptions::default()).unwrap();
    let mut options = SceneOptions::new(5.0);
    options.roles.obstacles = ["VISE", "CLAMPS", "PINS", "STOP"].map(ObstacleRole::new).to_vec();
    scene_from_drawing(&drawing, &options).unwrap().scene
}

fn bundled(name: &str) -> Vec<u8> {
    std::fs::read(root().join("docs/examples/programs").join(name)).unwrap()
}

fn check(name: &str, read: &ReadOptions, write: &WriteOptions) {
    let scenes = ToolScenes { any: mill(), by_tool: BTreeMap::new(), safe_z_mm: Some(60.0) };
    let text = bundled(name);
    let program = Program::read(&text, read).unwrap();
    let budget = Budget::unlimited();
    let planner = ScenePlanner::new(&scenes, &budget);
    let found = rewrite(&program, &planner, write).text;
    let golden = FilePath::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(name);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(&golden, &found).unwrap();
    }
    let expected = std::fs::read(&golden).unwrap();
    assert_eq!(String::from_utf8_lossy(&found), String::from_utf8_lossy(&expected), "{name}");
}

fn fed() -> WriteOptions {
    WriteOptions { arcs: ArcMotion::Fed { feed_mm_per_min: 6000.0 }, ..WriteOptions::default() }
}

#[test]
fn linuxcnc_with_fed_arcs() {
    check("plate-and-vise.ngc", &ReadOptions::default(), &fed());
}

#[test]
fn fanuc_with_a_second_offset_and_chords() {
    let mut read = ReadOptions::default();
    read.offsets.set(1, traverse_geometry::Vector::new(340.0, 92.0));
    check("stop-and-plate.nc", &read, &WriteOptions::default());
}

#[test]
fn grbl_in_inches_never_feeds_arcs_while_the_beam_may_be_on() {
    check("table-engraving.gcode", &ReadOptions::default(), &fed());
}

/// Finds everything free.
struct Free;

impl RapidPlanner for Free {
    fn look(&self, _: &Travel, _: &Path) -> Result<Found, Reason> {
        Ok(Found { hits: Vec::new(), margin_mm: None })
    }

    fn shortest(&self, _: &Travel, _: f64) -> Result<Path, Reason> {
        Err(Reason::Rounding)
    }
}

/// Finds everything blocked, and no way.
struct Blocked;

impl RapidPlanner for Blocked {
    fn look(&self, _: &Travel, _: &Path) -> Result<Found, Reason> {
        Ok(Found { hits: vec!["everything".to_owned()], margin_mm: Some(-1.0) })
    }

    fn shortest(&self, _: &Travel, _: f64) -> Result<Path, Reason> {
        Err(Reason::NoPath { separating: Vec::new() })
    }
}

#[test]
fn what_needs_no_change_stays_byte_for_byte() {
    let odd: &[u8] = b"\xef\xbb\xbf% first\r\n\r\n  n10 G 0\tx 1.50 Y-.5 ( \xe4\xf6\xfc ) ; \xff\xfe\rG1x5\n/G0 X7\r\n(no end of line) G0 X1 Y1";
    let names = ["plate-and-vise.ngc", "stop-and-plate.nc", "table-engraving.gcode"];
    for text in names.map(bundled).iter().map(Vec::as_slice).chain([odd]) {
        let program = Program::read(text, &ReadOptions::default()).unwrap();
        assert_eq!(rewrite(&program, &Blocked, &WriteOptions::default()).text, text);
        let runs = program.links.iter().filter(|link| link.lines().0 != link.lines().1).count();
        if runs == 0 {
            assert_eq!(rewrite(&program, &Free, &WriteOptions::default()).text, text);
        }
    }
}
