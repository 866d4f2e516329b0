//! Gaps as wide as the tool, round barriers between polygons, one obstacle of many vertices, both engines on large scenes of
//! everything at once, the largest feasible clearance by brute force.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use std::f64::consts::TAU;
use support::oracle::{Circle, Wall, shortest};
use support::{
    answer, assert_close, disc, mitred, no_path, plan, plan_by, point, polygon, query, rectangle, scene, star,
};
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, HeightRule, Obstacle, Point, Polygon, RapidRules, Ring, Scene, unit,
};
use traverse_planner::{Answer, FeasibleClearance, PreparedScene};
use traverse_solve::{Budget, Seed, Silent};

/// Four by four squares of 10 mm with that gap.
fn grid(gap: f64, clearance: f64) -> Scene {
    let at = |i: usize| i as f64 * (10.0 + gap);
    let squares = (0..16).map(|i| {
        let (x, y) = (at(i % 4), at(i / 4));
        rectangle(x, y, x + 10.0, y + 10.0)
    });
    scene(squares, clearance)
}

#[test]
fn a_gap_of_twice_the_clearance_is_passed_and_one_of_two_tolerances_less_is_not() {
    let clearance = 3.0;
    let exact: f64 = 2.0 * clearance;
    let tight = [exact, exact.next_up(), exact.next_down(), exact + 2.0 * CONTACT_TOLERANCE_MM];
    for gap in tight {
        for style in [grid(gap, clearance), mitred(grid(gap, clearance))] {
            let middle = 10.0 + gap / 2.0;
            let (start, target) = (point(-20.0, middle), point(70.0 + 3.0 * gap, middle));
            assert_close(
                plan(&style, start, target).cost,
                90.0 + 3.0 * gap,
                &format!("straight through {gap:?}"),
            );
            // Round corners inside as well.
            let inside = plan(&style, start, point(middle, 60.0));
            assert!(inside.cost < 120.0, "{gap:?}: {}", inside.cost);
        }
    }
    for gap in [exact - 2.0 * CONTACT_TOLERANCE_MM, exact - 1e-3] {
        for style in [grid(gap, clearance), mitred(grid(gap, clearance))] {
            let middle = 10.0 + gap / 2.0;
            let far = plan(&style, point(-20.0, middle), point(70.0 + 3.0 * gap, middle));
            assert!(far.cost > 95.0 + 3.0 * gap, "{gap:?}: {}", far.cost);
            assert!(!far.bending_obstacles.is_empty());
        }
    }
}

/// A convex polygon, counter-clockwise.
fn convex(random: &mut impl RngExt, center: Point) -> Vec<Point> {
    let count = random.random_range(3..6);
    let radius = random.random_range(2.0..9.0);
    let first = random.random_range(0.0..TAU);
    let step = TAU / f64::from(count);
    let angles = (0..count).map(|i| first + step * (f64::from(i) + random.random_range(0.0..0.7)));
    angles.map(|angle| center + unit(angle) * radius).collect()
}

/// Its barrier with arcs of so many pieces, inside or outside the true one.
fn grown(corners: &[Point], by: f64, pieces: u32, outside: bool) -> Polygon {
    let count = corners.len();
    let mut points = Vec::new();
    for i in 0..count {
        let (before, at, after) = (corners[(i + count - 1) % count], corners[i], corners[(i + 1) % count]);
        let normal = |a: Point, b: Point| (b.y - a.y).atan2(b.x - a.x) - TAU / 4.0;
        let from = normal(before, at);
        let turn = (normal(at, after) - from).rem_euclid(TAU);
        let step = turn / f64::from(pieces);
        if outside {
            points.push(at + unit(from) * by);
            let reach = by / (step / 2.0).cos();
            points.extend((0..pieces).map(|k| at + unit(from + step * (f64::from(k) + 0.5)) * reach));
            points.push(at + unit(from + turn) * by);
        } else {
            points.extend((0..=pieces).map(|k| at + unit(from + step * f64::from(k)) * by));
        }
    }
    Polygon::from_ring(Ring::new(points, vec![]).unwrap())
}

#[test]
fn round_barriers_lie_between_finely_polygonised_ones() {
    let mut compared = 0;
    for seed in 0..60 {
        let mut random = Seed(seed).stream();
        let clearance = random.random_range(0.5..3.0);
        let shapes: Vec<Vec<Point>> = (0..7)
            .map(|_| {
                let center = point(random.random_range(0.0..60.0), random.random_range(0.0..60.0));
                convex(&mut random, center)
            })
            .collect();
        let ends = [point(-8.0, random.random_range(0.0..60.0)), point(68.0, random.random_range(0.0..60.0))];
        let polygons =
            |outside: bool| scene(shapes.iter().map(|shape| grown(shape, clearance, 48, outside)), 0.0);
        let rings = shapes.iter().map(|shape| Polygon::from_ring(Ring::new(shape.clone(), vec![]).unwrap()));
        let round = scene(rings, clearance);
        let cost = |scene: &Scene| match answer(scene, ends[0], ends[1]) {
            Ok(Answer::Plan(plan)) => Some(plan.cost),
            _ => None,
        };
        let (Some(inner), Some(true_cost), Some(outer)) =
            (cost(&polygons(false)), cost(&round), cost(&polygons(true)))
        else {
            continue;
        };
        let what = format!("seed {seed}: {inner} {true_cost} {outer}");
        assert!(inner <= true_cost + 1e-9 && true_cost <= outer + 1e-9, "{what}");
        // As near as arcs of 48 pieces are to their polygons, unless a gap closes.
        assert!(true_cost - inner < 0.01 && (outer - true_cost < 0.01 || outer - true_cost > 0.1), "{what}");
        compared += 1;
    }
    assert!(compared > 30, "{compared}");
}

#[test]
fn a_circle_of_twenty_thousand_vertices_is_nearly_a_disc() {
    let count = 20_000;
    let radius = 100.0;
    let at = |i: u32| unit(TAU * f64::from(i) / f64::from(count)) * radius;
    let vertices: Vec<Point> = (0..count).map(|i| Point::from(at(i))).collect();
    let polygonised = scene([Polygon::from_ring(Ring::new(vertices, vec![]).unwrap())], 2.0);
    let round = scene([disc(0.0, 0.0, radius)], 2.0);
    let (start, target) = (point(-150.0, 96.0), point(140.0, 97.0));
    let (found, expected) = (plan(&polygonised, start, target), plan(&round, start, target));
    let apothem = radius * (std::f64::consts::PI / f64::from(count)).cos();
    assert!(found.cost <= expected.cost + 1e-9, "{} {}", found.cost, expected.cost);
    assert!(found.cost >= plan(&scene([disc(0.0, 0.0, apothem)], 2.0), start, target).cost - 1e-9);
}

/// A band that winds outwards, of so many vertices.
fn spiral(count: u32, turns: f64) -> Polygon {
    let half = count / 2;
    let arm = |inset: f64| {
        (0..half).map(move |i| {
            let angle = turns * TAU * f64::from(i) / f64::from(half - 1);
            Point::from(unit(angle) * (20.0 + 10.0 * angle / TAU + inset))
        })
    };
    let mut points: Vec<Point> = arm(0.0).collect();
    points.extend(arm(4.0).collect::<Vec<_>>().into_iter().rev());
    Polygon::from_ring(Ring::new(points, vec![]).unwrap())
}

#[test]
fn a_spiral_of_twenty_thousand_vertices_is_followed_outwards() {
    let turns = 2.0;
    let fine = scene([spiral(20_000, turns)], 1.0);
    let coarse = scene([spiral(500, turns)], 1.0);
    let (start, target) = (point(0.0, 0.0), point(100.0, 50.0));
    let (found, about) = (plan(&fine, start, target), plan(&coarse, start, target));
    assert!((found.cost - about.cost).abs() < 0.1, "{} {}", found.cost, about.cost);
    assert_eq!(found.cost, found.lower_bound);
}

/// Stars, discs, plates with holes, some with clearances of their own, in a work area with holes.
fn everything(random: &mut impl RngExt, count: usize, side: f64) -> Scene {
    let shapes: Vec<Polygon> = (0..count)
        .map(|i| {
            let center = point(random.random_range(0.0..side), random.random_range(0.0..side));
            match i % 4 {
                0 => disc(center.x, center.y, random.random_range(1.0..6.0)),
                1 => {
                    let hole = disc(center.x, center.y, 3.0).outer().clone();
                    Polygon::new(disc(center.x, center.y, 7.0).outer().clone(), vec![hole]).unwrap()
                }
                _ => {
                    let corners = random.random_range(3..9);
                    star(random, center, 8.0, corners)
                }
            }
        })
        .collect();
    let mut scene = scene(shapes, 1.0);
    for (i, obstacle) in scene.obstacles.iter_mut().enumerate() {
        obstacle.clearance_mm = [None, Some(0.0), Some(2.5), None, Some(0.4)][i % 5];
    }
    let holes = [0.3, 0.7].map(|share| disc(share * side, share * side, 5.0).outer().clone());
    let border = rectangle(-20.0, -20.0, side + 20.0, side + 20.0).outer().clone();
    scene.work_area = Some(Polygon::new(border, holes.to_vec()).unwrap());
    scene.work_area_clearance_mm = Some(0.5);
    scene
}

#[test]
fn both_engines_agree_on_large_scenes_of_everything() {
    let mut planned = 0;
    for seed in 0..6 {
        let mut random = Seed(90 + seed).stream();
        let mut scene = everything(&mut random, 160, 260.0);
        if seed % 2 == 1 {
            scene = mitred(scene);
        }
        let mut prepared = PreparedScene::new(scene.clone(), &Budget::unlimited()).unwrap();
        for _ in 0..8 {
            let mut at = || point(random.random_range(-15.0..275.0), random.random_range(-15.0..275.0));
            let (start, target) = (at(), at());
            let fresh = answer(&scene, start, target);
            let kept = prepared.plan(&query(start, target), &Budget::unlimited(), &mut Silent);
            match (fresh, kept) {
                (Ok(Answer::Plan(fresh)), Ok((Answer::Plan(kept), _))) => {
                    assert_close(kept.cost, fresh.cost, &format!("seed {seed} from {start} to {target}"));
                    support::assert_sound(&scene, start, target, &kept);
                    planned += 1;
                }
                (Ok(Answer::NoPath(_)), Ok((Answer::NoPath(_), _))) | (Err(_), Err(_)) => {}
                (fresh, kept) => panic!("seed {seed}: {fresh:?} but {kept:?}"),
            }
        }
    }
    assert!(planned > 15, "{planned}");
}

/// Bisects the clearance at which a brute-force graph finds a way.
fn bisected(scene: &Scene, start: Point, target: Point, most: f64) -> f64 {
    let pair = |p: Point| (p.x, p.y);
    let has_way = |radius: f64| {
        let (mut circles, mut walls) = (Vec::new(), Vec::new());
        for edge in scene.obstacles.iter().flat_map(|obstacle| obstacle.shape.outer().edges()) {
            walls.push(Wall { a: pair(edge.start()), b: pair(edge.end()), distance: radius });
            circles.push(Circle { center: pair(edge.start()), radius });
        }
        shortest(pair(start), pair(target), &circles, &walls).is_finite()
    };
    let (mut enough, mut too_much) = (0.0, most);
    while too_much - enough > 1e-7 {
        let middle = f64::midpoint(enough, too_much);
        if has_way(middle) { enough = middle } else { too_much = middle }
    }
    enough
}

#[test]
fn the_largest_feasible_clearance_is_that_of_a_brute_force_bisection() {
    for seed in 0..12 {
        let mut random = Seed(40 + seed).stream();
        // A ring of bars about the start with gaps of different widths.
        let bars = (0..5).map(|i| {
            let angle = TAU * f64::from(i) / 5.0;
            let width = random.random_range(0.42..0.58);
            let corner = |by: f64, radius: f64| Point::from(unit(angle + by) * radius);
            let points =
                vec![corner(-width, 20.0), corner(-width, 24.0), corner(width, 24.0), corner(width, 20.0)];
            Polygon::from_ring(Ring::new(points, vec![]).unwrap())
        });
        let shut = scene(bars, 9.0);
        let (start, target) = (point(0.0, 0.0), point(60.0, 10.0));
        let FeasibleClearance::Millimetres(found) = no_path(&shut, start, target).feasible_clearance else {
            panic!("seed {seed}: none")
        };
        let expected = bisected(&shut, start, target, 9.0);
        assert!((found - expected).abs() < 2e-6, "seed {seed}: {found} {expected}");
    }
}

#[test]
fn an_obstacle_that_is_all_border_is_no_trouble() {
    // Clearances of their own beside one another at a seam.
    let mut seam = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 0.0, 20.0, 10.0)], 1.0);
    seam.obstacles[1] = Obstacle { clearance_mm: Some(0.0), ..seam.obstacles[1].clone() };
    let over = plan(&seam, point(-5.0, 5.0), point(25.0, 5.0));
    assert!(over.cost > 30.0 && over.cost < 45.0, "{}", over.cost);
}

/// Every corner of a cogwheel sees thousands of others past its neighbours: more pairs than a search may have labels.
#[test]
fn what_outgrows_the_labels_of_one_search_is_planned_along_links() {
    let cogs: Vec<(f64, f64)> = (0..16_000)
        .map(|i| {
            let (angle, radius) = (TAU * f64::from(i) / 16_000.0, 4000.0 + f64::from(i % 2) * 0.2);
            (radius * angle.cos(), radius * angle.sin())
        })
        .collect();
    let mut wheel = scene([rectangle(0.0, 5000.0, 1.0, 5001.0), polygon(&cogs)], 0.01);
    wheel.obstacles[0].top_z_mm = Some(1.0);
    let (start, target) = (point(-5000.0, 10.0), point(5000.0, 10.0));
    let found = plan(&wheel, start, target);
    // Twice from an end to the circle of the outer cogs, and the arc between.
    let (distance, radius) = (5000.0_f64.hypot(10.0), 4000.21);
    let half_arc = std::f64::consts::FRAC_PI_2 - 10.0_f64.atan2(5000.0) - (radius / distance).acos();
    let round = 2.0 * ((distance * distance - radius * radius).sqrt() + radius * half_arc);
    assert!(found.cost < round && found.cost > round - 0.1, "{} {round}", found.cost);
    assert_eq!((found.lower_bound, &found.bending_obstacles[..]), (found.cost, &["o1".to_owned()][..]));
    // Passing over the first obstacle, the second keeps its name.
    let heights = HeightRule { start_z_mm: 5.0, target_z_mm: 5.0, highest_z_mm: 9.0, clearance_z_mm: 1.0 };
    let rules = RapidRules { heights: Some(heights), ..RapidRules::default() };
    let over = plan_by(&wheel, &rules, start, target);
    assert_eq!((over.cost, over.bending_obstacles), (found.cost, found.bending_obstacles));
}
