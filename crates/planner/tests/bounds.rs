//! Arcs against polygons inside and outside of them; clearances against barriers drawn beforehand; budgets.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::{assert_close, mitred, no_path, plan, point, polygon, query, scene};
use traverse_geometry::{Edge, Point, Polygon, Ring};
use traverse_planner::{Refusal, plan_rapid_move};
use traverse_solve::{Budget, CancelToken, Interrupt, Seed, Silent, Trace};

/// A star whose edges bulge in and out.
fn bulging(random: &mut impl RngExt, center: Point) -> Ring {
    let corners = random.random_range(3..7);
    let step = std::f64::consts::TAU / f64::from(corners);
    let vertices: Vec<Point> = (0..corners)
        .map(|i| center + traverse_geometry::unit(step * f64::from(i)) * random.random_range(9.0..12.0))
        .collect();
    let bulges = vertices.iter().map(|_| random.random_range(-0.25..0.45)).collect();
    Ring::new(vertices, bulges).unwrap()
}

/// The ring with every arc cut into `pieces` chords, moved off the centre by `factor` of the radius.
fn polygonised(ring: &Ring, pieces: u32, outside: bool) -> Polygon {
    let mut points = Vec::new();
    for edge in ring.edges() {
        points.push(edge.start());
        let Edge::Arc(arc) = edge else { continue };
        // Chords of an arc that bulges outwards lie inside the material, tangents outside; hollow arcs reversed.
        let tangents = outside == (arc.sweep > 0.0);
        let half = arc.sweep / f64::from(pieces) / 2.0;
        for i in 0..pieces {
            if tangents {
                let angle = arc.start_angle + half * f64::from(2 * i + 1);
                points.push(arc.center + traverse_geometry::unit(angle) * (arc.radius / half.cos()));
            } else if i > 0 {
                points.push(arc.point_at(f64::from(i) / f64::from(pieces)));
            }
        }
    }
    polygon(&points.iter().map(|p| (p.x, p.y)).collect::<Vec<_>>())
}

#[test]
fn arcs_lie_between_their_inscribed_and_circumscribed_polygons() {
    for case in 0..60 {
        let mut random = Seed(7).part(case).stream();
        let rings: Vec<Ring> = (0..6)
            .map(|i| bulging(&mut random, point(f64::from(i % 3) * 30.0, f64::from(i / 3) * 30.0)))
            .collect();
        let clearance = [0.0, 2.0][case as usize % 2];
        // Round only: the mitres of a polygon's corners stand out beyond the arc.
        let build = |shapes: Vec<Polygon>| scene(shapes, clearance);
        let exact = build(rings.iter().cloned().map(Polygon::from_ring).collect());
        let inner = build(rings.iter().map(|ring| polygonised(ring, 40, false)).collect());
        let outer = build(rings.iter().map(|ring| polygonised(ring, 40, true)).collect());
        let (start, target) =
            (point(-20.0, random.random_range(-20.0..50.0)), point(80.0, random.random_range(-20.0..50.0)));
        let cost = |scene| plan(scene, start, target).cost;
        let (low, exact, high) = (cost(&inner), cost(&exact), cost(&outer));
        assert!(low <= exact + 1e-9 && exact <= high + 1e-9, "case {case}: {low} {exact} {high}");
        assert!(high - low < 0.1, "case {case}: {low} {exact} {high}");
    }
}

/// A convex polygon with its edges moved outwards: the published barrier, drawn beforehand.
fn offset(points: &[(f64, f64)], by: f64) -> Vec<(f64, f64)> {
    let n = points.len();
    (0..n)
        .map(|i| {
            let normal = |a: (f64, f64), b: (f64, f64)| {
                let length = (b.0 - a.0).hypot(b.1 - a.1);
                ((b.1 - a.1) / length, -(b.0 - a.0) / length)
            };
            let (n1, n2) =
                (normal(points[(i + n - 1) % n], points[i]), normal(points[i], points[(i + 1) % n]));
            let opening = 1.0 + n1.0 * n2.0 + n1.1 * n2.1;
            (points[i].0 + by * (n1.0 + n2.0) / opening, points[i].1 + by * (n1.1 + n2.1) / opening)
        })
        .collect()
}

#[test]
fn mitred_barriers_are_what_the_paper_draws() {
    for case in 0..100 {
        let mut random = Seed(8).part(case).stream();
        let convex: Vec<Vec<(f64, f64)>> = (0..9)
            .map(|i| {
                let center = point(f64::from(i % 3) * 25.0, f64::from(i / 3) * 25.0);
                let corners = random.random_range(3..8);
                let turn = random.random_range(0.0..1.0);
                let radius = random.random_range(5.0..11.0);
                (0..corners)
                    .map(|k| {
                        let angle = (f64::from(k) + turn) * std::f64::consts::TAU / f64::from(corners);
                        let p = center + traverse_geometry::unit(angle) * radius;
                        (p.x, p.y)
                    })
                    .collect()
            })
            .collect();
        let by = random.random_range(0.5..2.5);
        let obstacles = mitred(scene(convex.iter().map(|points| polygon(points)), by));
        let barriers = scene(convex.iter().map(|points| polygon(&offset(points, by))), 0.0);
        let (start, target) =
            (point(-30.0, random.random_range(-5.0..55.0)), point(90.0, random.random_range(-5.0..55.0)));
        assert_close(
            plan(&obstacles, start, target).cost,
            plan(&barriers, start, target).cost,
            &format!("case {case}"),
        );
    }
}

#[test]
fn more_clearance_never_costs_less() {
    for case in 0..30 {
        let mut random = Seed(9).part(case).stream();
        let shapes = support::stars(&mut random, 10, 100.0, 12.0);
        let mut last = 0.0;
        for clearance in [0.0, 0.5, 1.0, 2.0] {
            let base = scene(shapes.clone(), clearance);
            let (start, target) = (point(-20.0, 50.0), point(120.0, 50.0));
            let cost = |scene: traverse_geometry::Scene| match support::answer(&scene, start, target).unwrap()
            {
                traverse_planner::Answer::Plan(plan) => plan.cost,
                traverse_planner::Answer::NoPath(_) => f64::INFINITY,
            };
            let round = cost(base.clone());
            assert!(round >= last - 1e-9, "case {case}");
            assert!(cost(mitred(base)) >= round - 1e-9, "case {case}: a mitre covers the round corner");
            last = round;
        }
    }
}

fn maze() -> traverse_geometry::Scene {
    let mut random = Seed(10).stream();
    scene(support::stars(&mut random, 200, 300.0, 12.0), 0.5)
}

#[test]
fn every_budget_ends_the_work_with_a_bound() {
    let (start, target) = (point(-20.0, -20.0), point(320.0, 320.0));
    let straight = (target - start).norm();
    let ask = |budget: &Budget| {
        plan_rapid_move(&maze(), &query(start, target), budget, &mut Silent)
            .map_err(|refusals| refusals[0].clone())
    };
    let cancelled = Budget { cancel: CancelToken::new(), ..Budget::unlimited() };
    cancelled.cancel.cancel();
    let ended = Budget { deadline: Some(std::time::Instant::now()), ..Budget::unlimited() };
    let short = Budget { iterations: Some(40), ..Budget::unlimited() };
    for (budget, why) in
        [(cancelled, Interrupt::Cancelled), (ended, Interrupt::Deadline), (short, Interrupt::Iterations)]
    {
        match ask(&budget) {
            Err(Refusal::Interrupted { interrupt, lower_bound }) => {
                assert_eq!(interrupt, why);
                assert!(lower_bound >= straight);
            }
            other => panic!("{other:?}"),
        }
    }
    let (_, stats) = ask(&Budget::unlimited()).unwrap();
    assert!(stats.expanded_nodes > 40);
}

#[test]
fn bounds_rise_to_the_cost() {
    let mut trace = Trace::default();
    let (start, target) = (point(-20.0, -20.0), point(320.0, 320.0));
    plan_rapid_move(&maze(), &query(start, target), &Budget::unlimited(), &mut trace).unwrap();
    assert!(trace.bounds.is_sorted() && trace.bounds.len() > 2, "{:?}", trace.bounds);
    assert_eq!(trace.costs, [*trace.bounds.last().unwrap()]);
}

#[test]
fn a_closed_room_of_many_pieces_is_proven_shut() {
    let ring = (0..60).map(|i| {
        let angle = f64::from(i) * std::f64::consts::TAU / 60.0;
        support::disc(100.0 * angle.cos(), 100.0 * angle.sin(), 5.0)
    });
    let shut = no_path(&scene(ring, 1.0), point(0.0, 0.0), point(300.0, 0.0));
    assert_eq!(shut.separating_obstacles.len(), 60);
}
