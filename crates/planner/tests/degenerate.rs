//! Input that breaks planners: contact, collinearity, thin things, far origins.

#![allow(clippy::unwrap_used, clippy::panic, clippy::expect_used, reason = "a test fails by panicking")]

mod support;

use support::{answer, assert_close, disc, mitred, no_path, plan, point, polygon, rectangle, ring, scene};
use traverse_geometry::{CornerStyle, Obstacle, Point, Polygon, Ring, Scene};
use traverse_planner::{Answer, Refusal};

#[test]
fn nothing_in_the_way_is_a_straight_line_and_no_way_is_no_step() {
    let free = plan(&scene([], 5.0), point(0.0, 0.0), point(3.0, 4.0));
    assert_eq!((free.cost, free.lower_bound, free.path.steps.len()), (5.0, 5.0, 1));
    let still = plan(&scene([], 5.0), point(1.0, 1.0), point(1.0, 1.0));
    assert_eq!((still.cost, still.path.steps.len()), (0.0, 0));
}

#[test]
fn starts_on_the_border_of_a_round_barrier() {
    let block = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 2.0);
    let way = plan(&block, point(3.0, -2.0), point(-2.0, 3.0));
    assert_close(way.cost, 6.0 + std::f64::consts::PI, "edge, quarter circle, edge");
    assert_eq!(way.path.steps.len(), 3);
}

#[test]
fn collinear_edges_and_repeated_vertices_change_nothing() {
    let plain = rectangle(0.0, 0.0, 9.0, 9.0);
    let busy = polygon(&[
        (0.0, 0.0),
        (3.0, 0.0),
        (3.0, 0.0),
        (6.0, 0.0),
        (9.0, 0.0),
        (9.0, 4.0),
        (9.0, 9.0),
        (9.0, 9.0),
        (0.0, 9.0),
        (0.0, 2.0),
        (0.0, 0.0),
    ]);
    for clearance in [0.0, 2.0] {
        let (start, target) = (point(-4.0, 1.0), point(13.0, 8.0));
        let expected = plan(&scene([plain.clone()], clearance), start, target).cost;
        assert_close(plan(&scene([busy.clone()], clearance), start, target).cost, expected, "busy square");
        let expected = plan(&mitred(scene([plain.clone()], clearance)), start, target).cost;
        assert_close(plan(&mitred(scene([busy.clone()], clearance)), start, target).cost, expected, "mitred");
    }
}

#[test]
fn a_micrometre_from_a_corner() {
    let block = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 0.0);
    let way = plan(&block, point(-0.001, -0.001), point(11.0, 5.0));
    let expected = (point(10.0, 0.0) - point(-0.001, -0.001)).norm() + 26.0_f64.sqrt();
    assert_close(way.cost, expected, "past two corners");
}

#[test]
fn twenty_metres_from_the_origin_costs_the_same() {
    let shift = 20_000.0;
    let at = |x: f64, y: f64| (x + shift, y - shift);
    let shape = |f: &dyn Fn(f64, f64) -> (f64, f64)| {
        [
            polygon(&[f(0.0, 0.0), f(12.0, 1.0), f(9.0, 9.0), f(4.0, 3.0), f(1.0, 11.0)]),
            polygon(&[f(14.0, -6.0), f(20.0, 2.0), f(13.0, 12.0)]),
        ]
    };
    let here = |x: f64, y: f64| (x, y);
    for clearance in [0.0, 0.7] {
        let near = scene(shape(&here), clearance);
        let far = scene(shape(&at), clearance);
        for (near, far) in [(near.clone(), far.clone()), (mitred(near), mitred(far))] {
            let expected = plan(&near, point(-6.0, 3.0), point(25.0, 4.0)).cost;
            let (sx, sy) = at(-6.0, 3.0);
            let (tx, ty) = at(25.0, 4.0);
            assert_close(plan(&far, point(sx, sy), point(tx, ty)).cost, expected, "20 m away");
        }
    }
}

fn refusals(scene: &Scene, start: Point, target: Point) -> Vec<(String, String, f64)> {
    let refusals = answer(scene, start, target).unwrap_err();
    refusals
        .into_iter()
        .map(|refusal| match refusal {
            Refusal::EndInsideBarrier { field, obstacle, depth_mm } => (field.to_owned(), obstacle, depth_mm),
            other => panic!("{other:?}"),
        })
        .collect()
}

#[test]
fn ends_inside_barriers_are_refused_all_at_once_with_their_depth() {
    let mut blocks = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(12.0, 0.0, 20.0, 10.0)], 2.0);
    let found = refusals(&blocks, point(11.0, 5.0), point(5.0, 4.0));
    let expected = [("start", "o0", 1.0), ("start", "o1", 1.0), ("target", "o0", 6.0)];
    assert_eq!(found, expected.map(|(field, id, depth)| (field.to_owned(), id.to_owned(), depth)));
    blocks.clearance_mm = 0.0;
    let found = refusals(&blocks, point(3.0, 5.0), point(30.0, 0.0));
    assert_eq!(found, [("start".to_owned(), "o0".to_owned(), 3.0)]);
    // Beyond the round corner but inside the mitred one.
    let corner = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 2.0);
    let beside = point(-1.5, -1.75);
    assert!(answer(&corner, beside, point(-9.0, 0.0)).is_ok());
    let found = refusals(&mitred(corner), beside, point(-9.0, 0.0));
    assert_eq!(found, [("start".to_owned(), "o0".to_owned(), 0.25)]);
}

#[test]
fn the_work_area_keeps_the_tool_in() {
    let area = Polygon::new(
        ring(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0), (0.0, 100.0)]),
        vec![ring(&[(40.0, 0.0), (60.0, 0.0), (60.0, 80.0), (40.0, 80.0)])],
    )
    .unwrap();
    let mut bounded = scene([], 5.0);
    bounded.work_area = Some(area);
    let way = plan(&bounded, point(20.0, 20.0), point(80.0, 20.0));
    assert_eq!(way.bending_obstacles, ["work_area"]);
    let arcs: usize = way.path.steps.iter().filter(|step| step.arc.is_some()).count();
    assert_eq!(arcs, 2);
    let found = refusals(&bounded, point(3.0, 50.0), point(110.0, 50.0));
    assert_eq!(found[0], ("start".to_owned(), "work_area".to_owned(), 2.0));
    assert_eq!(found[1], ("target".to_owned(), "work_area".to_owned(), 15.0));
    bounded.work_area_clearance_mm = Some(0.0);
    assert_close(plan(&bounded, point(0.0, 0.0), point(0.0, 100.0)).cost, 100.0, "riding on the border");
    bounded.work_area_clearance_mm = Some(11.0);
    let shut = no_path(&bounded, point(20.0, 50.0), point(80.0, 50.0));
    assert!(shut.separating_obstacles.is_empty());
}

#[test]
fn what_parts_the_ends_is_named_and_nothing_else() {
    // A closed fence of eight blocks about the target, and bystanders.
    let mut shapes: Vec<Polygon> = (0..8)
        .map(|i| {
            let angle = f64::from(i) * std::f64::consts::FRAC_PI_4;
            disc(20.0 * angle.cos(), 20.0 * angle.sin(), 7.0)
        })
        .collect();
    shapes.insert(3, rectangle(-60.0, -3.0, -55.0, 3.0));
    shapes.push(disc(2.0, 5.0, 1.0));
    let fenced = scene(shapes, 1.0);
    let shut = no_path(&fenced, point(-80.0, 0.0), point(0.0, 0.0));
    assert_eq!(shut.separating_obstacles, ["o0", "o1", "o2", "o4", "o5", "o6", "o7", "o8"]);
    let mut open = fenced;
    open.obstacles.remove(4);
    assert!(matches!(answer(&open, point(-80.0, 0.0), point(0.0, 0.0)), Ok(Answer::Plan(_))));
}

#[test]
fn a_hole_is_a_room() {
    let frame = Polygon::new(
        ring(&[(0.0, 0.0), (40.0, 0.0), (40.0, 40.0), (0.0, 40.0)]),
        vec![ring(&[(10.0, 10.0), (30.0, 10.0), (30.0, 30.0), (10.0, 30.0)])],
    )
    .unwrap();
    let room = scene([frame, rectangle(18.0, 12.0, 22.0, 28.0)], 1.0);
    let way = plan(&room, point(14.0, 20.0), point(26.0, 20.0));
    assert_eq!(way.bending_obstacles, ["o1"]);
    assert_eq!(no_path(&room, point(14.0, 20.0), point(50.0, 20.0)).separating_obstacles, ["o0"]);
}

#[test]
fn rounded_corners_at_clearance_zero_are_a_smaller_block_with_clearance() {
    let r = 3.0;
    let (x1, y1, bulge) = (30.0, 20.0, (std::f64::consts::PI / 8.0).tan());
    let vertices =
        [(r, 0.0), (x1 - r, 0.0), (x1, r), (x1, y1 - r), (x1 - r, y1), (r, y1), (0.0, y1 - r), (0.0, r)];
    let bulges = vec![0.0, bulge, 0.0, bulge, 0.0, bulge, 0.0, bulge];
    let rounded = Ring::new(vertices.map(|(x, y)| point(x, y)).to_vec(), bulges).unwrap();
    let inner = rectangle(r, r, x1 - r, y1 - r);
    for extra in [0.0, 2.0] {
        let a = scene([Polygon::from_ring(rounded.clone())], extra);
        let b = scene([inner.clone()], r + extra);
        for (start, target) in
            [((-9.0, 4.0), (39.0, 11.0)), ((-9.0, 10.0), (15.0, 29.0)), ((15.0, -9.0), (15.0, 29.0))]
        {
            let (start, target) = (point(start.0, start.1), point(target.0, target.1));
            assert_close(plan(&a, start, target).cost, plan(&b, start, target).cost, "rounded");
        }
    }
}

#[test]
fn a_disc_grows_as_a_disc_whatever_the_corner_style() {
    let (start, target) = (point(-20.0, 1.0), point(20.0, -2.0));
    let expected = plan(&scene([disc(0.0, 0.0, 8.0)], 0.0), start, target).cost;
    for clearance in [1.0, 7.5] {
        let grown = scene([disc(0.0, 0.0, 8.0 - clearance)], clearance);
        assert_close(plan(&grown, start, target).cost, expected, "round");
        assert_close(plan(&mitred(grown), start, target).cost, expected, "mitred");
    }
}

#[test]
fn mitre_limits_cut_corners_square() {
    let block = || scene([rectangle(0.0, 0.0, 10.0, 10.0)], 2.0);
    let style = |limit| Scene { corner_style: CornerStyle::Miter { limit: Some(limit) }, ..block() };
    let (start, target) = (point(-2.0, -9.0), point(-2.0, 9.0));
    // The corner's ratio is √2: a limit above it changes nothing, one of 1 touches the round corner.
    assert_close(plan(&style(1.5), start, target).cost, 18.0, "uncut");
    let diagonal = (point(-9.0, 3.0), point(3.0, -9.0));
    let cut = |limit| plan(&style(limit), diagonal.0, diagonal.1).cost;
    let free = (diagonal.1 - diagonal.0).norm();
    assert!(cut(1.0) >= free && cut(1.0) <= cut(1.2) && cut(1.2) <= cut(1.5));
    // A needle's control point would lie far out; it is cut at the standing limit.
    let needle = polygon(&[(0.0, 0.0), (100.0, -0.001), (100.0, 0.001)]);
    let sharp = mitred(scene([needle], 1.0));
    let way = plan(&sharp, point(50.0, -40.0), point(50.0, 40.0));
    assert!(way.cost < 300.0, "{}", way.cost);
}

#[test]
fn ids_of_what_bends_the_path_are_in_its_order() {
    let mut stair = scene([rectangle(0.0, -50.0, 10.0, 20.0), rectangle(30.0, 0.0, 40.0, 90.0)], 1.0);
    stair.obstacles.push(Obstacle {
        id: "far".into(),
        shape: rectangle(90.0, 90.0, 91.0, 91.0),
        clearance_mm: None,
        top_z_mm: None,
    });
    assert_eq!(plan(&stair, point(-10.0, 0.0), point(60.0, 40.0)).bending_obstacles, ["o0", "o1"]);
    assert_eq!(plan(&stair, point(60.0, 40.0), point(-10.0, 0.0)).bending_obstacles, ["o1", "o0"]);
}

/// A collar whose rounded corners were written with twelve digits, as drawings are: neither quite smooth nor quite not.
#[test]
fn corners_that_are_smooth_but_for_rounding_leave_no_gap() {
    for digits in [6, 9, 11, 12, 13] {
        let scale = 10.0_f64.powi(digits);
        let rounded = |x: f64| (x / 25.4 * scale).round() / scale * 25.4;
        let bulge = -((std::f64::consts::SQRT_2 - 1.0) * scale).round() / scale;
        let vertices = [
            (24.0, 0.0),
            (24.0, 30.0),
            (120.0, 30.0),
            (120.0, 58.0),
            (124.0, 62.0),
            (148.0, 62.0),
            (152.0, 58.0),
            (152.0, 30.0),
            (299.0, 30.0),
            (299.0, 0.0),
        ];
        let bulges = vec![0.0, 0.0, 0.0, bulge, 0.0, bulge, 0.0, 0.0, 0.0, 0.0];
        let ring = Ring::new(vertices.map(|(x, y)| point(rounded(x), rounded(y))).to_vec(), bulges).unwrap();
        for clearance in [0.0, 4.0] {
            let mut lathe = scene([Polygon::from_ring(ring.clone())], clearance);
            lathe.work_area = Some(rectangle(-20.0, 0.0, 380.0, 140.0));
            let expected = {
                let exact = [
                    (24.0, 0.0),
                    (24.0, 30.0),
                    (124.0, 30.0),
                    (124.0, 58.0),
                    (148.0, 58.0),
                    (148.0, 30.0),
                    (299.0, 30.0),
                    (299.0, 0.0),
                ];
                let inner = Scene {
                    obstacles: scene([polygon(&exact)], clearance + 4.0).obstacles,
                    clearance_mm: clearance + 4.0,
                    ..lathe.clone()
                };
                plan(&inner, point(100.0, 50.0), point(206.0, 50.0)).cost
            };
            let way = plan(&lathe, point(100.0, 50.0), point(206.0, 50.0));
            assert!(
                (way.cost - expected).abs() < 20.0 / scale + 1e-9,
                "{digits} digits: {} {expected}",
                way.cost
            );
        }
    }
}
