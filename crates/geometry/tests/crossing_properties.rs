//! The search for crossings against all pairs, against winding numbers, and on rings that touch themselves a lot.

use proptest::prelude::*;
use std::collections::BTreeMap;
use traverse_geometry::{Orientation, Point, Reason, Ring, orientation};

fn points(xy: &[(f64, f64)]) -> Vec<Point> {
    xy.iter().map(|&(x, y)| Point::new(x, y)).collect()
}

fn cross_properly(p: Point, q: Point, r: Point, s: Point) -> bool {
    let sides = [orientation(p, q, r), orientation(p, q, s), orientation(r, s, p), orientation(r, s, q)];
    sides.iter().all(|&side| side != Orientation::Straight) && sides[0] != sides[1] && sides[2] != sides[3]
}

/// Turns of a closed chain of straight edges round `p`, by the sum of angles.
fn turns(vertices: &[Point], p: Point) -> i32 {
    let sum: f64 = (0..vertices.len())
        .map(|i| {
            let (a, b) = (vertices[i] - p, vertices[(i + 1) % vertices.len()] - p);
            (a.x * b.y - a.y * b.x).atan2(a.dot(&b))
        })
        .sum();
    (sum / std::f64::consts::TAU).round() as i32
}

/// Whether some vertex turns back on itself.
fn has_antenna(vertices: &[Point]) -> bool {
    let n = vertices.len();
    (0..n).any(|i| {
        let (a, b, c) = (vertices[i], vertices[(i + 1) % n], vertices[(i + 2) % n]);
        orientation(a, b, c) == Orientation::Straight && (a - b).dot(&(c - b)) > 0.0
    })
}

fn small_grid_ring() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let coordinate = || (0..5i32).prop_map(f64::from);
    prop::collection::vec((coordinate(), coordinate()), 3..11)
}

/// The borders of a pattern of cells, each traced with the cells on its left; where four edges meet, the chain
/// turns to `turn_left` or to the right, so that it touches itself there.
fn traced(cells: &[bool], width: usize, turn_left: bool) -> Vec<Vec<Point>> {
    let filled = |x: i32, y: i32| {
        x >= 0 && y >= 0 && (x as usize) < width && cells.get(y as usize * width + x as usize) == Some(&true)
    };
    let height = cells.len().div_ceil(width) as i32;
    let mut leaving: BTreeMap<(i32, i32), Vec<(i32, i32)>> = BTreeMap::new();
    for y in 0..height {
        for x in 0..width as i32 {
            if !filled(x, y) {
                continue;
            }
            for (open, from, way) in [
                (!filled(x, y - 1), (x, y), (1, 0)),
                (!filled(x + 1, y), (x + 1, y), (0, 1)),
                (!filled(x, y + 1), (x + 1, y + 1), (-1, 0)),
                (!filled(x - 1, y), (x, y + 1), (0, -1)),
            ] {
                if open {
                    leaving.entry(from).or_default().push(way);
                }
            }
        }
    }
    let mut rings = Vec::new();
    while let Some((&first, ways)) = leaving.iter().next() {
        let (mut at, mut way) = (first, ways[0]);
        let mut ring = Vec::new();
        loop {
            let ways = leaving.get_mut(&at).expect("the border goes on");
            ways.retain(|&other| other != way);
            if ways.is_empty() {
                leaving.remove(&at);
            }
            ring.push(Point::new(f64::from(at.0), f64::from(at.1)));
            at = (at.0 + way.0, at.1 + way.1);
            let left = (-way.1, way.0);
            let wanted = if turn_left { left } else { (-left.0, -left.1) };
            match leaving.get(&at) {
                Some(ways) if ways.len() == 1 => way = ways[0],
                Some(ways) => way = *ways.iter().find(|&&other| other == wanted).unwrap_or(&ways[0]),
                None => break,
            }
            // The ring may close where it touches itself: then go on while the wanted turn is there.
            if at == first && !(leaving[&at].contains(&wanted)) {
                break;
            }
        }
        rings.push(ring);
    }
    rings
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn agrees_with_all_pairs(xy in prop::collection::vec((-1e3..1e3f64, -1e3..1e3f64), 3..14)) {
        let vertices = points(&xy);
        let n = vertices.len();
        let at = |i: usize| vertices[i % n];
        let mut expected = Vec::new();
        for a in 0..n {
            for b in a + 1..n {
                if cross_properly(at(a), at(a + 1), at(b), at(b + 1)) {
                    expected.push(format!("edges {a} and {b}"));
                }
            }
        }
        let found = Ring::new(vertices.clone(), Vec::new()).err().unwrap_or_default();
        prop_assert!(found.iter().all(|finding| finding.reason == Reason::EdgesCross));
        let found: Vec<_> = found.into_iter().map(|finding| finding.value).collect();
        prop_assert_eq!(found, expected);
    }

    #[test]
    fn what_is_taken_winds_once(xy in small_grid_ring()) {
        if let Ok(ring) = Ring::new(points(&xy), Vec::new()) {
            let once = if ring.is_counter_clockwise() { 1 } else { -1 };
            // Antennas have no side; all other rings are decided.
            if !has_antenna(ring.vertices()) {
                for i in 0..23 {
                    for j in 0..23 {
                        let p = Point::new(f64::from(i) * 0.1846 - 0.0123, f64::from(j) * 0.1871 - 0.0137);
                        let turns = turns(ring.vertices(), p);
                        prop_assert!(turns == 0 || turns == once, "{turns} turns round {p}");
                    }
                }
            }
        }
    }

    #[test]
    fn symmetry_changes_no_decision(xy in small_grid_ring(), start in 0usize..10) {
        let base = points(&xy);
        let reasons = |vertices: Vec<Point>| -> Vec<Reason> {
            let findings = Ring::new(vertices, Vec::new()).err().unwrap_or_default();
            let mut reasons: Vec<_> = findings.iter().map(|finding| finding.reason).collect();
            reasons.dedup();
            reasons
        };
        let expected = reasons(base.clone());
        let mut rotated = base.clone();
        rotated.rotate_left(start % base.len());
        prop_assert_eq!(&reasons(rotated), &expected, "another first vertex");
        prop_assert_eq!(&reasons(base.iter().rev().copied().collect()), &expected, "reversed");
        prop_assert_eq!(&reasons(base.iter().map(|p| Point::new(-p.x, p.y)).collect()), &expected, "mirrored");
        prop_assert_eq!(&reasons(base.iter().map(|p| Point::new(-p.y, p.x)).collect()), &expected, "turned");
        let far = base.iter().map(|p| Point::new(p.x + 20_000.0, p.y - 20_000.0)).collect();
        prop_assert_eq!(&reasons(far), &expected, "20 m away");
    }

    #[test]
    fn a_ring_that_touches_says_so(xy in small_grid_ring()) {
        if let Ok(ring) = Ring::new(points(&xy), Vec::new()) {
            let (n, edges): (usize, Vec<_>) = (ring.len(), ring.edges().collect());
            let apart = |a: usize, b: usize| b - a > 1 && !(a == 0 && b == n - 1);
            let touches = (0..n).any(|a| (a + 1..n).any(|b| apart(a, b) && edges[a].distance(&edges[b]) == 0.0));
            prop_assert_eq!(ring.touches_itself(), touches || has_antenna(ring.vertices()));
        }
    }

    #[test]
    fn borders_of_cells_are_taken(cells in prop::collection::vec(any::<bool>(), 42), turn_left: bool) {
        let mut area = 0.0;
        for border in traced(&cells, 6, turn_left) {
            let ring = Ring::new(border.clone(), Vec::new());
            prop_assert!(ring.is_ok(), "{:?} of {border:?}", ring);
            area += ring.unwrap().signed_area();
        }
        prop_assert_eq!(area, cells.iter().filter(|&&cell| cell).count() as f64);
    }

    #[test]
    fn arcs_that_are_taken_wind_once(
        xy in prop::collection::vec((-9.0..9.0f64, -9.0..9.0f64, -1.0..1.0f64), 2..7),
    ) {
        let vertices = xy.iter().map(|&(x, y, _)| Point::new(x, y)).collect();
        let bulges = xy.iter().map(|&(_, _, bulge)| bulge).collect();
        match Ring::new(vertices, bulges) {
            Ok(ring) => {
                let fine = ring.flattened(traverse_geometry::FlattenSide::Nearest, 1e-4);
                let once = if ring.is_counter_clockwise() { 1 } else { -1 };
                for i in 0..40 {
                    for j in 0..40 {
                        let p = Point::new(f64::from(i) - 20.0, f64::from(j) - 20.0);
                        if ring.distance_to_point(p) > 1e-3 {
                            let turns = turns(&fine, p);
                            prop_assert!(turns == 0 || turns == once, "{turns} turns round {p}");
                        }
                    }
                }
            }
            Err(findings) => {
                prop_assert!(findings.iter().all(|finding| finding.reason == Reason::EdgesCross));
            }
        }
    }

    #[test]
    fn refused_arcs_do_meet(xy in prop::collection::vec((-9.0..9.0f64, -9.0..9.0f64, -1.0..1.0f64), 2..7)) {
        let n = xy.len();
        let edge = |i: usize| {
            let ((x, y, bulge), (to_x, to_y, _)) = (xy[i], xy[(i + 1) % n]);
            traverse_geometry::Edge::from_bulge(Point::new(x, y), Point::new(to_x, to_y), bulge)
        };
        let findings = Ring::new(
            xy.iter().map(|&(x, y, _)| Point::new(x, y)).collect(),
            xy.iter().map(|&(_, _, bulge)| bulge).collect(),
        ).err().unwrap_or_default();
        for finding in findings {
            let numbers: Vec<usize> = finding.value.split(' ').filter_map(|word| word.parse().ok()).collect();
            prop_assert_eq!(numbers.len(), 2);
            prop_assert!(edge(numbers[0]).distance(&edge(numbers[1])) < 1e-9);
        }
    }
}
