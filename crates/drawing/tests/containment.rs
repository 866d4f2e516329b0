//! Which loop lies in which, against the truth that the drawing was made from and against brute force.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod random;

use random::Random;
use traverse_drawing::{Curve, Forest, JOIN_TOLERANCE_MM, Loop, join_loops};
use traverse_geometry::Point;

/// Loops nested by construction. A child may touch its parent in corners or along a side.
fn nest(
    random: &mut Random,
    corner: Point,
    side: f64,
    parent: Option<usize>,
    depth: u8,
    out: &mut Vec<(Curve, Option<usize>)>,
) {
    let at = |u: f64, v: f64| Point::new(corner.x + u * side, corner.y + v * side);
    let round = random.below(3) == 0;
    let curve = if round {
        Curve::new(vec![at(0.0, 0.5), at(1.0, 0.5)], vec![1.0; 2], true)
    } else {
        let bulge = [0.0, -0.1][random.below(2)];
        let vertices = vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
        Curve::new(vertices, vec![0.0, bulge, 0.0, 0.0], true)
    };
    let bent = !round && curve.bulges[1] != 0.0;
    let own = out.len();
    out.push((curve, parent));
    if depth == 0 {
        return;
    }
    for cell in 0..4 {
        if random.below(3) == 0 {
            continue;
        }
        let (u, v) = (f64::from(cell % 2) * 0.5, f64::from(cell / 2) * 0.5);
        // In a circle and beside a bent side the children stay in the middle; elsewhere they may touch the border.
        let inset = if round || bent || random.below(2) == 0 { 0.19 } else { 0.0 };
        let place = |share: f64| if inset > 0.0 { 0.2 + share * 0.6 } else { share };
        let child = if inset > 0.0 { 0.29 } else { 0.5 };
        nest(random, at(place(u), place(v)), side * child, Some(own), depth - 1, out);
    }
}

fn truth(nested: &[(Curve, Option<usize>)]) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::new();
    for (_, parent) in nested {
        depths.push(parent.map_or(0, |parent| depths[parent] + 1));
    }
    depths
}

/// Winding of a flattened loop about a point.
fn around(each: &Loop, p: Point) -> bool {
    let points: Vec<Point> =
        each.edges().flat_map(|edge| (0..64).map(move |i| edge.point_at(f64::from(i) / 64.0))).collect();
    let mut inside = false;
    for (i, a) in points.iter().enumerate() {
        let b = points[(i + 1) % points.len()];
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    inside
}

#[test]
fn nested_by_construction() {
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let mut nested = Vec::new();
        nest(&mut random, Point::new(-3.0, 11.0), 1000.0, None, 4, &mut nested);
        nest(&mut random, Point::new(1500.0, 400.0), 700.0, None, 3, &mut nested);
        let depths = truth(&nested);
        let mut order: Vec<usize> = (0..nested.len()).collect();
        random.shuffle(&mut order);
        let curves: Vec<Curve> = order.iter().map(|&i| nested[i].0.clone()).collect();
        let joined = join_loops("A", &curves, JOIN_TOLERANCE_MM);
        assert_eq!(joined.loops.len(), curves.len(), "seed {seed}");
        let forest = Forest::of(&joined.loops);
        for (place, &i) in order.iter().enumerate() {
            assert_eq!(
                forest.parents[place].map(|parent| order[parent]),
                nested[i].1,
                "seed {seed}, loop {i}"
            );
            assert_eq!(forest.depths[place], depths[i], "seed {seed}, loop {i}");
        }
    }
}

#[test]
fn scattered_discs_against_brute_force() {
    for seed in 0..30 {
        let mut random = Random::new(1000 + seed);
        let mut discs: Vec<(Point, f64)> = Vec::new();
        for _ in 0..400 {
            let center = Point::new(random.share() * 100.0, random.share() * 100.0);
            let radius = 0.2 + random.share().powi(4) * 30.0;
            let apart = |&(other, r): &(Point, f64)| {
                let distance = (other - center).norm();
                distance > r + radius + 0.05 || distance + radius.min(r) + 0.05 < radius.max(r)
            };
            if discs.iter().all(apart) {
                discs.push((center, radius));
            }
        }
        let loops: Vec<Loop> = discs
            .iter()
            .enumerate()
            .map(|(first_curve, &(center, radius))| {
                let angle = random.share() * 7.0;
                let spoke = traverse_geometry::unit(angle) * radius;
                let bulge = [1.0, -1.0][random.below(2)];
                Loop {
                    vertices: vec![center + spoke, center - spoke],
                    bulges: vec![bulge; 2],
                    first_curve,
                    deviation_mm: 0.0,
                }
            })
            .collect();
        let forest = Forest::of(&loops);
        for (i, &(center, radius)) in discs.iter().enumerate() {
            let parent = (0..discs.len())
                .filter(|&j| j != i && discs[j].1 > radius && around(&loops[j], center))
                .min_by(|&a, &b| discs[a].1.total_cmp(&discs[b].1));
            assert_eq!(forest.parents[i], parent, "seed {seed}, disc {i}");
        }
    }
}
