//! Scenes with optimal lengths from files: regions of free space, each an outer ring and holes, and moves, each
//! `[start x, start y, target x, target y, shortest length]`, millimetres.

use crate::planned::plan;
use crate::prepared;
use crate::timing::{share, sorted, timed};
use serde_json::Value;
use std::path::Path;
use traverse_geometry::{CornerStyle, Location, Obstacle, Point, Polygon, RapidRules, Ring, Scene, Vector};
use traverse_planner::{Algorithm, Answer, PreparedScene, RapidMove};
use traverse_solve::{Budget, Silent};

/// How well the optima of scattered scenes are known, and those of maps, as shares.
const KNOWN_TO: f64 = 1e-9;
const MAPS_KNOWN_TO: f64 = 1e-7;

/// So many moves are planned in one shot, too: on a map of thousands of vertices each reads all of them.
const ONE_SHOTS: usize = 200;

/// One region with the moves that lie in it and what each costs.
struct Region {
    scene: Scene,
    moves: Vec<RapidMove>,
    optima: Vec<f64>,
}

/// Compares every move with its optimum, here and 20 m out, and measures the prepared ones.
pub(crate) fn table(file: &Path, alone: bool) {
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    let whole: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let tolerance = if name.starts_with("cam") { KNOWN_TO } else { MAPS_KNOWN_TO };
    println!("\n{name}: moves that differ from the optimum by more than {tolerance:e}, greatest difference");
    for by in [Vector::zeros(), Vector::new(20_000.0, 20_000.0)] {
        compare(&regions(&whole, by), by, tolerance);
    }
    let scenes = regions(&whole, Vector::zeros()).into_iter().map(|region| (region.scene, region.moves));
    prepared::head();
    prepared::row(&name, &scenes.collect::<Vec<_>>(), alone);
}

fn compare(regions: &[Region], by: Vector, tolerance: f64) {
    let (mut wrong, mut count, mut greatest) = (0, 0, 0.0_f64);
    let mut one_shots = Vec::new();
    for region in regions {
        let mut kept = PreparedScene::new(region.scene.clone(), &Budget::unlimited()).unwrap();
        for (query, optimum) in region.moves.iter().zip(&region.optima) {
            let found = match kept.plan(query, &Budget::unlimited(), &mut Silent) {
                Ok((Answer::Plan(plan), _)) => plan.cost,
                other => panic!("no plan for {query:?}: {other:?}"),
            };
            let mut costs = vec![found];
            if one_shots.len() < ONE_SHOTS {
                let (time, cost) = timed(|| plan(&region.scene, query));
                one_shots.push(time);
                costs.push(cost);
            }
            for cost in costs {
                let difference = (cost - optimum).abs() / optimum.max(1.0);
                greatest = greatest.max(difference);
                count += 1;
                if difference > tolerance {
                    wrong += 1;
                    println!("{:?} to {:?}: {cost} is not {optimum}", query.start, query.target);
                }
            }
        }
    }
    let one_shot = share(&sorted(one_shots), 0.5);
    println!("{wrong} of {count} at {:.0} m, {greatest:.1e}; one shot {one_shot:.0} µs", by.x / 1000.0);
}

/// The regions that moves lie in.
fn regions(whole: &Value, by: Vector) -> Vec<Region> {
    let list = |value: &Value| value.as_array().unwrap().clone();
    let number = |value: &Value| value.as_f64().unwrap();
    let ring = |points: &Value| {
        let point = |p: &Value| Point::new(number(&p[0]), number(&p[1])) + by;
        Ring::new(list(points).iter().map(point).collect(), vec![]).unwrap()
    };
    let mut regions: Vec<Region> = list(&whole["regions"])
        .iter()
        .map(|region| {
            let holes = list(&region["holes"]);
            let obstacle = |(i, hole): (usize, &Value)| Obstacle {
                id: format!("o{i}"),
                shape: Polygon::from_ring(ring(hole)),
                clearance_mm: None,
                top_z_mm: None,
            };
            let scene = Scene {
                work_area: Some(Polygon::from_ring(ring(&region["outer"]))),
                obstacles: holes.iter().enumerate().map(obstacle).collect(),
                clearance_mm: 0.0,
                work_area_clearance_mm: Some(0.0),
                corner_style: CornerStyle::Round,
            };
            Region { scene, moves: Vec::new(), optima: Vec::new() }
        })
        .collect();
    for query in list(&whole["queries"]) {
        let at = |i: usize| Point::new(number(&query[i]), number(&query[i + 1])) + by;
        let (start, target) = (at(0), at(2));
        let region =
            regions.iter_mut().find(|region| holds(&region.scene, start) && holds(&region.scene, target));
        let region = region.expect("a region holds both ends");
        region.moves.push(RapidMove {
            start,
            target,
            algorithm: Algorithm::Exact,
            rules: RapidRules::default(),
        });
        region.optima.push(number(&query[4]));
    }
    regions.retain(|region| !region.moves.is_empty());
    regions
}

/// Whether a point lies in the region or on its border.
fn holds(scene: &Scene, p: Point) -> bool {
    let locate =
        |shape: &Polygon| if shape.bounds().contains(p) { shape.locate(p) } else { Location::Outside };
    scene.work_area.as_ref().is_some_and(|area| locate(area) != Location::Outside)
        && scene.obstacles.iter().all(|obstacle| locate(&obstacle.shape) != Location::Inside)
}
