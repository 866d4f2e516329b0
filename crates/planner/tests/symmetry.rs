//! The same scene moved, mirrored, turned, reordered or run backwards costs the same.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use rand::seq::SliceRandom;
use support::{answer, assert_close, mitred, point, scene, stars};
use traverse_geometry::{Obstacle, Point, Polygon, Ring, Scene};
use traverse_planner::Answer;
use traverse_solve::Seed;

/// A point map and whether it mirrors.
type Map = (fn(Point) -> Point, bool);

const MAPS: [(&str, Map); 4] = [
    ("quarter turn", (|p| point(-p.y, p.x), false)),
    ("half turn", (|p| point(-p.x, -p.y), false)),
    ("mirror", (|p| point(-p.x, p.y), true)),
    ("shift by a power of two", (|p| point(p.x + 128.0, p.y - 64.0), false)),
];

fn mapped(shape: &Polygon, (map, mirrors): Map) -> Polygon {
    let ring = |ring: &Ring| {
        let vertices = ring.vertices().iter().map(|&p| map(p)).collect();
        let bulges = ring.bulges().iter().map(|b| if mirrors { -b } else { *b }).collect();
        Ring::new(vertices, bulges).unwrap()
    };
    Polygon::new(ring(shape.outer()), shape.holes().iter().map(ring).collect()).unwrap()
}

fn cost(scene: &Scene, start: Point, target: Point) -> Option<f64> {
    match answer(scene, start, target) {
        Ok(Answer::Plan(plan)) => Some(plan.cost),
        Ok(Answer::NoPath(_)) => None,
        Err(refusals) => panic!("{refusals:?}"),
    }
}

fn assert_same(found: Option<f64>, expected: Option<f64>, what: &str) {
    match (found, expected) {
        (Some(found), Some(expected)) => assert_close(found, expected, what),
        (found, expected) => assert_eq!(found, expected, "{what}"),
    }
}

#[test]
fn symmetric_scenes_cost_the_same() {
    for case in 0..60 {
        let mut random = Seed(5).part(case).stream();
        let mut shapes = stars(&mut random, 8, 100.0, 16.0);
        shapes.push(support::disc(random.random_range(0.0..100.0), random.random_range(0.0..100.0), 9.0));
        let clearance = [0.0, 1.5][case as usize % 2];
        let mut base = scene(shapes, clearance);
        if case % 3 == 0 {
            base = mitred(base);
        }
        let (start, target) = (point(-20.0, 31.0), point(121.0, 70.0));
        let expected = cost(&base, start, target);
        let name = |what: &str| format!("case {case}: {what}");
        assert_same(cost(&base, target, start), expected, &name("backwards"));
        for (what, map) in MAPS {
            let obstacles = base
                .obstacles
                .iter()
                .map(|o| Obstacle { shape: mapped(&o.shape, map), ..o.clone() })
                .collect();
            let moved = Scene { obstacles, ..base.clone() };
            assert_same(cost(&moved, map.0(start), map.0(target)), expected, &name(what));
        }
        let mut shuffled = base.clone();
        shuffled.obstacles.shuffle(&mut random);
        for obstacle in &mut shuffled.obstacles {
            obstacle.shape = Polygon::from_ring(obstacle.shape.outer().reversed());
        }
        assert_same(cost(&shuffled, start, target), expected, &name("reordered and reversed"));
    }
}

#[test]
fn equal_questions_get_equal_answers_bit_for_bit() {
    let mut random = Seed(6).stream();
    let scene = scene(stars(&mut random, 20, 100.0, 12.0), 1.0);
    let ask = || answer(&scene, point(-20.0, 0.0), point(120.0, 100.0)).unwrap();
    assert_eq!(ask(), ask());
}
