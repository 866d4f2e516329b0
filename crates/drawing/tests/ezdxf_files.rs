//! Files that ezdxf wrote, against what ezdxf says of them: run ezdxf_files.py first and name its directory.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use traverse_drawing::{Curve, ReadOptions, read_dxf};

/// Where the files are. Without it there is nothing to test.
const DIRECTORY: &str = "TRAVERSE_EZDXF_DIR";

fn bounds(curve: &Curve) -> [f64; 4] {
    let mut edges = curve.edges().map(|edge| edge.bounds());
    let first = edges.next().unwrap();
    let all = edges.fold(first, traverse_geometry::Bounds::union);
    [all.min.x, all.min.y, all.max.x, all.max.y]
}

fn check(path: &Path) {
    let name = path.file_name().unwrap().to_string_lossy().into_owned();
    let facts: Value = serde_json::from_slice(&std::fs::read(path.with_extension("json")).unwrap()).unwrap();
    let mut options = ReadOptions::default();
    // Lengths of fitted curves must agree to 1e-6.
    options.fit_tolerance_mm = 1e-4;
    let drawing = read_dxf(&std::fs::read(path).unwrap(), &options).unwrap();
    assert_eq!(drawing.unit.millimetres, facts["millimetres"].as_f64().unwrap(), "{name}");

    let unused: BTreeMap<String, u64> = drawing
        .unused
        .iter()
        .map(|each| (format!("{}|{}|{:?}", each.layer, each.entity, each.why), each.count as u64))
        .collect();
    let expected: BTreeMap<String, u64> = facts["unused"]
        .as_object()
        .unwrap()
        .iter()
        .map(|(key, count)| (key.clone(), count.as_u64().unwrap()))
        .collect();
    assert_eq!(unused, expected, "{name}");

    // By layer, in file order.
    let mut by_layer: BTreeMap<&str, Vec<&Value>> = BTreeMap::new();
    for curve in facts["curves"].as_array().unwrap() {
        by_layer.entry(curve["layer"].as_str().unwrap()).or_default().push(curve);
    }
    assert_eq!(drawing.layers.len(), by_layer.len(), "{name}");
    for layer in &drawing.layers {
        let expected = &by_layer[layer.name.as_str()];
        assert_eq!(layer.curves.len(), expected.len(), "{name}, layer {}", layer.name);
        for (number, (curve, expected)) in layer.curves.iter().zip(expected).enumerate() {
            let place = format!("{name}, layer {}, curve {number}: {expected}", layer.name);
            let exact = curve.deviation_mm == 0.0;
            if expected["exact"] == true {
                assert!(exact, "{place}");
            }
            let length = expected["length"].as_f64().unwrap();
            let share = if exact { 1e-9 } else { 1e-6 };
            assert!((curve.length() - length).abs() <= share * length, "{place}: {}", curve.length());
            // Boxes of fitted curves are sampled.
            let allowed = if exact { 1e-9 * (1.0 + length) } else { 5e-4 + 1e-5 * length };
            for (value, expected) in bounds(curve).iter().zip(expected["box"].as_array().unwrap()) {
                assert!(
                    (value - expected.as_f64().unwrap()).abs() <= allowed,
                    "{place}: {:?}",
                    bounds(curve)
                );
            }
            let color = curve.source.color.map(|color| Value::from(color.to_string()));
            assert_eq!(color.as_ref(), expected.get("color"), "{place}");
            assert_eq!(Value::from(curve.source.groups.clone()), expected["groups"], "{place}");
        }
    }
}

#[test]
fn files_of_ezdxf_are_read_as_ezdxf_means_them() {
    let Some(directory) = std::env::var_os(DIRECTORY) else {
        println!("skipped: set {DIRECTORY} to a directory of ezdxf_files.py");
        return;
    };
    let mut paths: Vec<_> = std::fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "dxf"))
        .collect();
    paths.sort();
    assert!(paths.len() >= 80, "{} files", paths.len());
    let failed: Vec<_> =
        paths.iter().filter(|path| std::panic::catch_unwind(|| check(path)).is_err()).collect();
    assert!(failed.is_empty(), "{} of {}: {failed:?}", failed.len(), paths.len());
}
