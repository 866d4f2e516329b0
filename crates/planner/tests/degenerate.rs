//! Input that breaks planners: contact, collinearity, thin things, far origins.

mod support;

use support::{answer, assert_close, disc, mitred, no_path, plan, point, polygon, rectangle, ring, scene};
use traverse_geometry::{CONTACT_TOLERANCE_MM, CornerStyle, Obstacle, Point, Polygon, Ring, Scene};
use traverse_planner::{Answer, Refusal};

const SQRT_2: f64 = std::f64::consts::SQRT_2;

#[test]
fn nothing_in_the_way_is_a_straight_line_and_no_way_is_no_step() {
    let free = plan(&scene([], 5.0), point(0.0, 0.0), point(3.0, 4.0));
    assert_eq!((free.cost, free.lower_bound, free.path.steps.len()), (5.0, 5.0, 1));
    let still = plan(&scene([], 5.0), point(1.0, 1.0), point(1.0, 1.0));
    assert_eq!((still.cost, still.path.steps.len()), (0.0, 0));
}

#[test]
fn slides_along_an_edge_between_points_of_a_border() {
    let block = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 0.0);
    assert_close(plan(&block, point(2.0, 0.0), point(8.0, 0.0)).cost, 6.0, "along an edge");
    assert_close(plan(&block, point(0.0, 0.0), point(10.0, 0.0)).cost, 10.0, "from corner to corner");
    assert_close(plan(&block, point(-5.0, 0.0), point(15.0, 0.0)).cost, 20.0, "past an edge");
    assert_close(plan(&block, point(0.0, 5.0), point(10.0, 5.0)).cost, 20.0, "round three sides");
    assert_close(plan(&block, point(0.0, 0.0), point(10.0, 10.0)).cost, 20.0, "between opposite corners");
    assert_close(plan(&block, point(5.0, 0.0), point(5.0, -7.0)).cost, 7.0, "straight off");
}

#[test]
fn starts_on_the_border_of_a_round_barrier() {
    let block = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 2.0);
    let way = plan(&block, point(3.0, -2.0), point(-2.0, 3.0));
    assert_close(way.cost, 6.0 + std::f64::consts::PI, "edge, quarter circle, edge");
    assert_eq!(way.path.steps.len(), 3);
}

#[test]
fn nothing_passes_between_obstacles_that_touch_at_clearance_zero() {
    // Two squares that share a corner: the straight diagonal through it is shut.
    let corner = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 10.0, 20.0, 20.0)], 0.0);
    let around = plan(&corner, point(5.0, 15.0), point(15.0, 5.0));
    let one_way = point(5.0, 15.0) - point(0.0, 10.0);
    let expected = one_way.norm() + 10.0 + 10.0 + (point(15.0, 5.0) - point(10.0, 0.0)).norm();
    assert_close(around.cost, expected, "round a corner contact");
    // Two that share an edge; along the seam is shut too.
    let seam = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 0.0, 20.0, 10.0)], 0.0);
    let around = plan(&seam, point(10.0, -5.0), point(10.0, 15.0));
    assert_close(around.cost, 10.0 + 2.0 * 125.0_f64.sqrt(), "round a seam");
    // A vertex that touches the middle of an edge.
    let tip = polygon(&[(10.0, 5.0), (20.0, 0.0), (20.0, 10.0)]);
    let tee = scene([rectangle(0.0, 0.0, 10.0, 10.0), tip], 0.0);
    let around = plan(&tee, point(10.5, 2.0), point(10.5, 8.0));
    assert!(around.cost > 15.0, "{}", around.cost);
    // Discs.
    let discs = scene([disc(0.0, 0.0, 5.0), disc(10.0, 0.0, 5.0)], 0.0);
    assert!(plan(&discs, point(5.0, -9.0), point(5.0, 9.0)).cost > 28.0);
}

#[test]
fn an_end_where_obstacles_touch_leaves_on_either_side() {
    let corner = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 10.0, 20.0, 20.0)], 0.0);
    let contact = point(10.0, 10.0);
    assert_close(plan(&corner, contact, point(5.0, 15.0)).cost, 5.0 * SQRT_2, "upper left");
    assert_close(plan(&corner, contact, point(15.0, 5.0)).cost, 5.0 * SQRT_2, "lower right");
    let seam = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(10.0, 0.0, 20.0, 10.0)], 0.0);
    let shut = no_path(&seam, point(10.0, 5.0), point(10.0, 15.0));
    assert_eq!(shut.separating_obstacles, ["o0", "o1"]);
}

#[test]
fn an_end_in_a_narrow_notch_gets_out() {
    // A notch of 11 degrees and one of 0.1 degrees.
    for half in [1.0, 0.01] {
        let notch = polygon(&[
            (-20.0, -5.0),
            (20.0, -5.0),
            (20.0, 10.0),
            (half, 10.0),
            (0.0, 0.0),
            (-half, 10.0),
            (-20.0, 10.0),
        ]);
        let way = plan(&scene([notch], 0.0), point(0.0, 0.0), point(15.0, 10.0));
        assert_close(way.cost, (half * half + 100.0).sqrt() + 15.0 - half, "out of the notch");
    }
}

#[test]
fn overlapping_and_equal_obstacles_are_one_barrier() {
    let square = || rectangle(0.0, 0.0, 10.0, 10.0);
    for clearance in [0.0, 1.5] {
        let (start, target) = (point(-5.0, 5.0), point(15.0, 5.0));
        let once = plan(&scene([square()], clearance), start, target).cost;
        let twice = plan(&scene([square(), square()], clearance), start, target).cost;
        assert_close(twice, once, "equal");
        let halves = [rectangle(0.0, 0.0, 6.0, 10.0), rectangle(4.0, 0.0, 10.0, 10.0)];
        assert_close(plan(&scene(halves, clearance), start, target).cost, once, "overlapping");
        let touching = [rectangle(0.0, 0.0, 5.0, 10.0), rectangle(5.0, 0.0, 10.0, 10.0)];
        assert_close(plan(&scene(touching, clearance), start, target).cost, once, "touching");
        let discs = [disc(5.0, 5.0, 5.0), disc(5.0, 5.0, 5.0)];
        let disc_once = plan(&scene([disc(5.0, 5.0, 5.0)], clearance), start, target).cost;
        assert_close(plan(&scene(discs, clearance), start, target).cost, disc_once, "equal discs");
    }
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
fn a_wall_of_no_width_is_a_wall() {
    // A square with an antenna on its right side: out to (20, 5) and back.
    let antenna =
        polygon(&[(0.0, 0.0), (10.0, 0.0), (10.0, 5.0), (20.0, 5.0), (10.0, 5.0), (10.0, 10.0), (0.0, 10.0)]);
    let walled = scene([antenna.clone()], 0.0);
    assert_close(
        plan(&walled, point(15.0, 0.0), point(15.0, 10.0)).cost,
        2.0 * 50.0_f64.sqrt(),
        "round its tip",
    );
    assert_close(plan(&walled, point(12.0, 5.0), point(25.0, 5.0)).cost, 13.0, "along it");
    let wide = scene([antenna], 1.0);
    let way = plan(&wide, point(15.0, 0.0), point(15.0, 10.0));
    assert!(way.cost > 2.0 * 50.0_f64.sqrt() + 0.5, "{}", way.cost);
}

#[test]
fn a_slit_of_no_width_is_shut_and_a_keyhole_joins_a_hole() {
    // A ring of material about a hole, written as one weakly simple ring.
    let keyhole = polygon(&[
        (0.0, 0.0),
        (30.0, 0.0),
        (30.0, 30.0),
        (0.0, 30.0),
        (0.0, 15.0),
        (10.0, 15.0),
        (10.0, 20.0),
        (20.0, 20.0),
        (20.0, 10.0),
        (10.0, 10.0),
        (10.0, 15.0),
        (0.0, 15.0),
    ]);
    for clearance in [0.0, 0.5] {
        let shut = no_path(&scene([keyhole.clone()], clearance), point(15.0, 15.0), point(-5.0, 15.0));
        assert_eq!(shut.separating_obstacles, ["o0"]);
        let inside = plan(&scene([keyhole.clone()], clearance), point(12.0, 12.0), point(18.0, 18.0));
        assert_close(inside.cost, 6.0 * SQRT_2, "inside the hole");
    }
}

#[test]
fn a_ring_that_visits_a_vertex_twice_bends_paths_there() {
    // Two triangles that meet in (0, 0), as one ring.
    let bow = polygon(&[(0.0, 0.0), (-10.0, -5.0), (-10.0, 5.0), (0.0, 0.0), (10.0, 5.0), (10.0, -5.0)]);
    let way = plan(&scene([bow], 0.0), point(-1.0, 3.0), point(1.0, 3.0));
    assert_close(way.cost, 2.0, "above");
}

#[test]
fn a_slit_of_a_micrometre_is_open_until_the_clearance_fills_it() {
    let slit =
        |clearance| scene([rectangle(-50.0, 0.0, 0.0, 10.0), rectangle(0.001, 0.0, 50.0, 10.0)], clearance);
    let (start, target) = (point(0.0005, -5.0), point(0.0005, 15.0));
    for clearance in [0.0, 0.0004, 0.0005] {
        assert_close(plan(&slit(clearance), start, target).cost, 20.0, "through");
    }
    assert!(plan(&slit(0.0006), start, target).cost > 50.0);
    assert!(plan(&mitred(slit(0.0006)), start, target).cost > 50.0);
    assert_close(plan(&mitred(slit(0.0005)), start, target).cost, 20.0, "mitred through");
}

#[test]
fn a_micrometre_from_a_corner() {
    let block = scene([rectangle(0.0, 0.0, 10.0, 10.0)], 0.0);
    let way = plan(&block, point(-0.001, -0.001), point(11.0, 5.0));
    let expected = (point(10.0, 0.0) - point(-0.001, -0.001)).norm() + 26.0_f64.sqrt();
    assert_close(way.cost, expected, "past two corners");
}

/// A 6 × 6 grid of squares, `gap` apart.
fn grid(gap: f64, clearance: f64) -> Scene {
    let at = |i: u32| f64::from(i) * (10.0 + gap);
    let squares = (0..36)
        .map(|i| rectangle(at(i % 6), at(i / 6), at(i % 6) + 10.0, at(i / 6) + 10.0))
        .collect::<Vec<_>>();
    scene(squares, clearance)
}

#[test]
fn gaps_of_exactly_twice_the_clearance_let_the_tool_through() {
    let clearance = 1.0;
    let (start, target) = (point(-3.0, 35.0), point(75.0, 35.0));
    let through = |gap: f64| {
        let scene = grid(gap, clearance);
        (plan(&scene, start, target).cost, plan(&mitred(scene), start, target).cost)
    };
    let (open, open_mitred) = through(2.0);
    for gap in [2.0_f64.next_up(), 2.0_f64.next_down(), 2.0 + 2.0 * CONTACT_TOLERANCE_MM] {
        let (round, miter) = through(gap);
        assert!(
            (round - open).abs() < 1e-4 && (miter - open_mitred).abs() < 1e-4,
            "{gap}: {round} {miter} {open}"
        );
    }
    let (shut, shut_mitred) = through(2.0 - 2.0 * CONTACT_TOLERANCE_MM);
    assert!(shut > open + 1.0, "{shut} {open}");
    assert!(shut_mitred > open_mitred + 1.0, "{shut_mitred} {open_mitred}");
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
fn an_obstacle_over_the_border_joins_with_it() {
    let mut bounded = scene([rectangle(40.0, -10.0, 60.0, 70.0), rectangle(40.0, 70.0, 60.0, 110.0)], 0.0);
    bounded.work_area = Some(rectangle(0.0, 0.0, 100.0, 100.0));
    let shut = no_path(&bounded, point(20.0, 50.0), point(80.0, 50.0));
    assert_eq!(shut.separating_obstacles, ["o0", "o1"]);
    bounded.obstacles.pop();
    let way = plan(&bounded, point(20.0, 50.0), point(80.0, 50.0));
    assert_close(way.cost, 20.0 + 2.0 * 800.0_f64.sqrt(), "through the gap at the top");
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
fn obstacles_of_clearance_zero_stand_beside_others() {
    let mut mixed = scene([rectangle(0.0, 0.0, 10.0, 10.0), rectangle(15.0, 0.0, 25.0, 10.0)], 0.0);
    mixed.obstacles[1].clearance_mm = Some(4.99);
    let way = plan(&mixed, point(10.0, -8.0), point(10.0, 18.0));
    assert_close(way.cost, 26.0, "through the gap, along the first");
    // Clearance 0 is the limit of ever smaller ones: where the second asks for the whole gap, nothing is left.
    mixed.obstacles[1].clearance_mm = Some(5.0);
    assert!(plan(&mixed, point(9.0, -8.0), point(9.0, 18.0)).cost > 30.0);
}

#[test]
fn ids_of_what_bends_the_path_are_in_its_order() {
    let mut stair = scene([rectangle(0.0, -50.0, 10.0, 20.0), rectangle(30.0, 0.0, 40.0, 90.0)], 1.0);
    stair.obstacles.push(Obstacle {
        id: "far".into(),
        shape: rectangle(90.0, 90.0, 91.0, 91.0),
        clearance_mm: None,
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

#[test]
fn an_end_where_many_obstacles_meet_leaves_through_every_gap() {
    // Twelve thin triangles about the origin.
    let at = |k: u32, part: f64| {
        traverse_geometry::unit((f64::from(k) + part) * std::f64::consts::TAU / 12.0) * 10.0
    };
    let blades = (0..12).map(|k| {
        let (a, b) = (at(k, 0.0), at(k, 0.4));
        polygon(&[(0.0, 0.0), (a.x, a.y), (b.x, b.y)])
    });
    let fan = scene(blades, 0.0);
    for k in 0..12 {
        let gap = at(k, 0.7);
        assert_close(plan(&fan, point(0.0, 0.0), point(gap.x, gap.y)).cost, 10.0, &format!("gap {k}"));
    }
}
