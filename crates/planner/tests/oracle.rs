//! The planner against the brute-force tangent-point graph.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use rand::RngExt;
use support::oracle::{Circle, Wall, shortest};
use support::{answer, assert_close, disc, point, scene, stars};
use traverse_geometry::{Obstacle, Point, Scene};
use traverse_planner::{Answer, Refusal};
use traverse_solve::Seed;

fn pair(p: Point) -> (f64, f64) {
    (p.x, p.y)
}

/// Walls and circles of a scene of straight edges, with clearances above 0.
fn taken_apart(scene: &Scene) -> (Vec<Circle>, Vec<Wall>) {
    let (mut circles, mut walls) = (Vec::new(), Vec::new());
    for obstacle in &scene.obstacles {
        let radius = scene.clearance_of(obstacle);
        for ring in obstacle.shape.rings() {
            for edge in ring.edges() {
                walls.push(Wall { a: pair(edge.start()), b: pair(edge.end()), distance: radius });
                circles.push(Circle { center: pair(edge.start()), radius });
            }
        }
    }
    (circles, walls)
}

fn compare(
    scene: &Scene,
    start: Point,
    target: Point,
    circles: &[Circle],
    walls: &[Wall],
    what: &str,
) -> bool {
    match answer(scene, start, target) {
        Err(refusals) => {
            assert!(
                refusals.iter().all(|r| matches!(r, Refusal::EndInsideBarrier { .. })),
                "{what}: {refusals:?}"
            );
            false
        }
        Ok(Answer::Plan(plan)) => {
            let expected = shortest(pair(start), pair(target), circles, walls);
            assert_close(plan.cost, expected, what);
            true
        }
        Ok(Answer::NoPath(_)) => {
            let expected = shortest(pair(start), pair(target), circles, walls);
            assert!(expected.is_infinite(), "{what}: there is a path of {expected}");
            true
        }
    }
}

#[test]
fn agrees_on_random_scenes_of_discs() {
    let mut compared = 0;
    for case in 0..1500 {
        let mut random = Seed(1).part(case).stream();
        let clearance = if case % 3 == 0 { 0.0 } else { random.random_range(0.1..3.0) };
        let discs: Vec<(f64, f64, f64)> = (0..12)
            .map(|_| {
                (
                    random.random_range(0.0..100.0),
                    random.random_range(0.0..100.0),
                    random.random_range(2.0..14.0),
                )
            })
            .collect();
        let scene = scene(discs.iter().map(|&(x, y, r)| disc(x, y, r)), clearance);
        let circles: Vec<Circle> =
            discs.iter().map(|&(x, y, r)| Circle { center: (x, y), radius: r + clearance }).collect();
        let walls: Vec<Wall> =
            circles.iter().map(|c| Wall { a: c.center, b: c.center, distance: c.radius }).collect();
        let start = point(random.random_range(-10.0..110.0), random.random_range(-10.0..110.0));
        let target = point(random.random_range(-10.0..110.0), random.random_range(-10.0..110.0));
        compared += usize::from(compare(&scene, start, target, &circles, &walls, &format!("case {case}")));
    }
    assert!(compared > 500, "{compared}");
}

#[test]
fn agrees_on_random_polygons_that_may_overlap() {
    let mut compared = 0;
    for case in 0..300 {
        let mut random = Seed(2).part(case).stream();
        let clearance = random.random_range(0.2..4.0);
        let scene = scene(stars(&mut random, 6, 100.0, 18.0), clearance);
        let (circles, walls) = taken_apart(&scene);
        let start = point(random.random_range(-10.0..110.0), random.random_range(-10.0..110.0));
        let target = point(random.random_range(-10.0..110.0), random.random_range(-10.0..110.0));
        compared += usize::from(compare(&scene, start, target, &circles, &walls, &format!("case {case}")));
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn agrees_where_every_obstacle_has_its_own_clearance() {
    for case in 0..150 {
        let mut random = Seed(3).part(case).stream();
        let mut scene = scene(stars(&mut random, 6, 100.0, 15.0), 1.0);
        for obstacle in &mut scene.obstacles {
            obstacle.clearance_mm = Some(random.random_range(0.1..6.0));
        }
        let (circles, walls) = taken_apart(&scene);
        compare(&scene, point(-8.0, -8.0), point(108.0, 108.0), &circles, &walls, &format!("case {case}"));
    }
}

#[test]
fn agrees_at_clearance_zero_on_polygons_apart() {
    for case in 0..200 {
        let mut random = Seed(4).part(case).stream();
        // One star per cell of a grid: apart by construction.
        let cells = (0..9).map(|i| point(f64::from(i % 3) * 30.0 + 15.0, f64::from(i / 3) * 30.0 + 15.0));
        let shapes: Vec<_> = cells
            .map(|center| {
                let corners = random.random_range(3..9);
                support::star(&mut random, center, 14.9, corners)
            })
            .collect();
        let scene = scene(shapes, 0.0);
        let (circles, mut walls) = taken_apart(&scene);
        // Sliding along edges is contact: the oracle needs a distance to hold against crossing.
        for wall in &mut walls {
            wall.distance = 6e-7;
        }
        let (start, target) =
            (point(-5.0, random.random_range(0.0..90.0)), point(95.0, random.random_range(0.0..90.0)));
        let at_zero: Vec<Circle> = circles.iter().map(|c| Circle { radius: 1e-6, ..*c }).collect();
        let Ok(Answer::Plan(plan)) = answer(&scene, start, target) else { panic!("case {case}") };
        // The oracle keeps a nanometre: its answer is longer by at most that, once per turn.
        let expected = shortest(pair(start), pair(target), &at_zero, &walls);
        assert!((plan.cost - expected).abs() < 1e-4, "case {case}: {} {expected}", plan.cost);
        let exact = visibility_graph(&scene.obstacles, start, target);
        assert_close(plan.cost, exact, &format!("case {case}"));
    }
}

/// The classical visibility graph of disjoint polygons, with exact orientation.
fn visibility_graph(obstacles: &[Obstacle], start: Point, target: Point) -> f64 {
    use traverse_geometry::{Orientation, orientation};
    let mut nodes = vec![start, target];
    let mut edges = Vec::new();
    for obstacle in obstacles {
        nodes.extend(obstacle.shape.outer().vertices());
        edges.extend(obstacle.shape.outer().edges().map(|e| (e.start(), e.end())));
    }
    let apart =
        |a: Orientation, b: Orientation| a != b && a != Orientation::Straight && b != Orientation::Straight;
    let inside =
        |p: Point| obstacles.iter().any(|o| o.shape.locate(p) == traverse_geometry::Location::Inside);
    let sees = |p: Point, q: Point| {
        p != q
            && !edges.iter().any(|&(a, b)| {
                apart(orientation(p, q, a), orientation(p, q, b))
                    && apart(orientation(a, b, p), orientation(a, b, q))
            })
            && ![0.03, 0.5, 0.97].into_iter().any(|t| {
                let p = p + (q - p) * t;
                edges.iter().all(|&(a, b)| traverse_geometry::Segment::new(a, b).distance_to_point(p) > 1e-9)
                    && inside(p)
            })
    };
    let n = nodes.len();
    let mut best = vec![f64::INFINITY; n];
    let mut done = vec![false; n];
    best[0] = 0.0;
    while let Some(at) = (0..n).filter(|&i| !done[i]).min_by(|&i, &j| best[i].total_cmp(&best[j])) {
        if at == 1 || best[at].is_infinite() {
            break;
        }
        done[at] = true;
        for next in 0..n {
            let cost = best[at] + (nodes[next] - nodes[at]).norm();
            if cost < best[next] && sees(nodes[at], nodes[next]) {
                best[next] = cost;
            }
        }
    }
    best[1]
}
