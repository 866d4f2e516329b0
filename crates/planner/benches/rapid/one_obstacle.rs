//! One obstacle of very many vertices: how time grows with them.

use crate::planned::plan;
use crate::timing::timed;
use std::f64::consts::TAU;
use traverse_geometry::{CornerStyle, Obstacle, Point, Polygon, RapidRules, Ring, Scene, unit};
use traverse_planner::{Algorithm, PreparedScene, RapidMove};
use traverse_solve::{Budget, Silent};

/// A name, vertices by count, and the ends of a move round them.
type Shape = (&'static str, fn(usize) -> Vec<Point>, [Point; 2]);

/// Turns of the spiral.
const TURNS: f64 = 6.0;

/// Prints microseconds for four sizes of a spiral and of a polygonised circle.
pub(crate) fn table() {
    println!("\none obstacle: µs by vertices, one shot; prepared, least of 3 repeats");
    let sizes = [2_500, 5_000, 10_000, 20_000];
    println!("{:>26} {:>10} {:>10} {:>10} {:>10}", "vertices", sizes[0], sizes[1], sizes[2], sizes[3]);
    let shapes: [Shape; 2] = [
        ("circle", circle, [Point::new(-700.0, 3.0), Point::new(700.0, 1.0)]),
        ("spiral", spiral, [Point::new(-700.0, 3.0), Point::new(0.0, 0.0)]),
    ];
    for (name, shape, ends) in shapes {
        for clearance_mm in [0.0, 1.5] {
            let times = sizes.map(|count| once(scene(shape(count), clearance_mm), ends));
            for (way, at) in [("one shot", 0), ("prepared", 1)] {
                let title = format!("{name}, {clearance_mm} mm, {way}");
                let [a, b, c, d] = times.map(|times| times[at]);
                println!("{title:>26} {a:>10.0} {b:>10.0} {c:>10.0} {d:>10.0}");
            }
        }
    }
}

fn once(scene: Scene, [start, target]: [Point; 2]) -> [f64; 2] {
    let query = RapidMove { start, target, algorithm: Algorithm::Exact, rules: RapidRules::default() };
    let least =
        |mut work: Box<dyn FnMut() + '_>| (0..3).map(|_| timed(&mut work).0).fold(f64::INFINITY, f64::min);
    let one_shot = least(Box::new(|| {
        plan(&scene, &query);
    }));
    let mut kept = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
    let prepared = least(Box::new(|| {
        kept.plan(&query, &Budget::unlimited(), &mut Silent).unwrap();
    }));
    [one_shot, prepared]
}

fn scene(vertices: Vec<Point>, clearance_mm: f64) -> Scene {
    let shape = Polygon::from_ring(Ring::new(vertices, vec![]).unwrap());
    let obstacle = Obstacle { id: "one".into(), shape, clearance_mm: None, top_z_mm: None };
    Scene {
        work_area: None,
        obstacles: vec![obstacle],
        clearance_mm,
        work_area_clearance_mm: None,
        corner_style: CornerStyle::Round,
    }
}

fn circle(count: usize) -> Vec<Point> {
    (0..count).map(|i| Point::origin() + unit(TAU * i as f64 / count as f64) * 500.0).collect()
}

/// A wall that winds round the origin, as thick as what it leaves free.
fn spiral(count: usize) -> Vec<Point> {
    let half = count / 2;
    let at = |i: usize, aside: f64| {
        let turn = TURNS * TAU * i as f64 / (half - 1) as f64;
        Point::origin() + unit(turn) * (60.0 + 60.0 * turn / TAU + aside)
    };
    (0..half).map(|i| at(i, 15.0)).chain((0..half).rev().map(|i| at(i, -15.0))).collect()
}
