//! Clearance 0 against brute force: is there a path that touches nothing and stays near the given one?
//!
//! The given path is walked in small steps while a free point is kept within reach of it: a search over pairs of
//! (place on the path, point of a fine lattice). Found: the checker must accept. Not found though the reach is
//! ample: the checker must refuse.

use crate::making::*;
use proptest::prelude::*;
use std::collections::HashSet;
use traverse_checker::check_rapid_move;
use traverse_geometry::{Path, Point, Ring, Scene, Segment};

const REACH: f64 = 0.2;
const SPACING: f64 = 0.02;
const STRIDE: f64 = 0.04;

/// Lattice points lie off every line through whole numbers with small slopes.
fn lattice(i: i32, j: i32) -> Point {
    p(f64::from(i) * SPACING + 0.003_141, f64::from(j) * SPACING + 0.005_927)
}

struct Obstacles {
    rings: Vec<Vec<Point>>,
}

impl Obstacles {
    fn edges(&self) -> impl Iterator<Item = Segment> + '_ {
        self.rings
            .iter()
            .flat_map(|ring| (0..ring.len()).map(|i| Segment::new(ring[i], ring[(i + 1) % ring.len()])))
    }

    fn hold(&self, q: Point) -> bool {
        self.rings.iter().any(|ring| {
            let mut odd = false;
            for (i, a) in ring.iter().enumerate() {
                let b = ring[(i + 1) % ring.len()];
                if (a.y > q.y) != (b.y > q.y) && q.x < (b.x - a.x) * (q.y - a.y) / (b.y - a.y) + a.x {
                    odd = !odd;
                }
            }
            odd
        })
    }
}

/// Whether a path that touches nothing stays within [`REACH`] of this one all along.
///
/// The place on the path only moves forward: with straight steps, going back never helps.
fn can_be_freed(obstacles: &Obstacles, path: &Path) -> bool {
    let mut places: Vec<Point> = vec![path.start];
    for edge in path.edges() {
        let count = (edge.length() / STRIDE).ceil() as i32;
        places.extend((1..=count).map(|k| edge.point_at(f64::from(k) / f64::from(count))));
    }
    let edges: Vec<Segment> = obstacles.edges().collect();
    let around = (REACH / SPACING).ceil() as i32 + 1;
    let side = 2 * around + 1;
    let mut reached: Option<HashSet<(i32, i32)>> = None;
    for &place in &places {
        let (ci, cj) = ((place.x / SPACING).round() as i32, (place.y / SPACING).round() as i32);
        let is_near = |(i, j): (i32, i32)| (lattice(i, j) - place).norm() <= REACH;
        let close: Vec<Segment> = edges
            .iter()
            .copied()
            .filter(|edge| edge.distance_to_point(place) < REACH + 2.0 * SPACING)
            .collect();
        let mut seen = vec![false; (side * side) as usize];
        let index = |(i, j): (i32, i32)| ((i - ci + around) * side + (j - cj + around)) as usize;
        let mut open: Vec<(i32, i32)> = match &reached {
            Some(reached) => reached.iter().copied().filter(|&cell| is_near(cell)).collect(),
            None => (ci - around..=ci + around)
                .flat_map(|i| (cj - around..=cj + around).map(move |j| (i, j)))
                .filter(|&cell| is_near(cell) && !obstacles.hold(lattice(cell.0, cell.1)))
                .collect(),
        };
        open.iter().for_each(|&cell| seen[index(cell)] = true);
        let mut all = open.clone();
        while let Some((i, j)) = open.pop() {
            for (di, dj) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
                let next = (i + di, j + dj);
                if is_near(next) && !seen[index(next)] {
                    let step = Segment::new(lattice(i, j), lattice(next.0, next.1));
                    if close.is_empty() || !close.iter().any(|edge| edge.meets(&step)) {
                        seen[index(next)] = true;
                        open.push(next);
                        all.push(next);
                    }
                }
            }
        }
        reached = Some(all.into_iter().collect());
    }
    reached.is_some_and(|reached| !reached.is_empty())
}

/// Rings on whole numbers, many of which touch.
fn any_ring() -> impl Strategy<Value = Ring> {
    (0..6_i32, 0..6_i32, 1..4_i32, 1..4_i32, 0..7).prop_map(|(x, y, w, h, kind)| {
        let (x, y, w, h) = (f64::from(x), f64::from(y), f64::from(w), f64::from(h));
        match kind {
            0 | 1 => rectangle(x, y, x + w, y + h),
            2 => ring(&[(x, y), (x + w, y), (x, y + h)]),
            3 => ring(&[(x + w, y + h), (x, y + h), (x + w, y)]),
            4 => ring(&[(x + w, y), (x, y + h), (x - w, y), (x, y - h)]),
            // Antennas to the right and upwards.
            5 => ring(&[(x, y), (x + 1.0, y), (x + 1.0 + w, y), (x + 1.0, y), (x + 1.0, y + h), (x, y + h)]),
            _ => ring(&[
                (x, y),
                (x + 1.0, y),
                (x + 1.0, y + h),
                (x + 1.0, y + h + 2.0),
                (x + 1.0, y + h),
                (x, y + h),
            ]),
        }
    })
}

fn reverses(path: &Path) -> bool {
    let directions: Vec<_> = path.edges().map(|edge| edge.direction_at(0.5)).collect();
    directions.windows(2).any(|pair| pair[0].dot(&pair[1]) < -1.0 + 1e-9)
}

/// Level, upright or halfway between: no wedge is too narrow for the lattice.
fn is_plain(edge: Segment) -> bool {
    let v = edge.vector();
    v.x == 0.0 || v.y == 0.0 || v.x.abs() == v.y.abs()
}

fn agrees(rings: &[Ring], path: &Path) -> Result<(), TestCaseError> {
    let obstacles = Obstacles { rings: rings.iter().map(|ring| ring.vertices().to_vec()).collect() };
    let scene: Scene = scene(0.0, rings.to_vec());
    let free = can_be_freed(&obstacles, path);
    let strict = check_rapid_move(&scene, path.start, path.end(), path, TOLERANCE);
    if free {
        let lenient = check_rapid_move(&scene, path.start, path.end(), path, REACH);
        prop_assert!(lenient.is_sound(), "refused, but can be freed: {:#?}", lenient.violations);
    } else if !reverses(path) && obstacles.edges().all(is_plain) {
        prop_assert!(!strict.is_sound(), "accepted, but can't be freed");
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases.max(600), max_global_rejects: 1_000_000, ..ProptestConfig::default() })]

    #[test]
    fn accepts_what_can_be_freed_and_nothing_else(
        rings in proptest::collection::vec(any_ring(), 1..7),
        stops in proptest::collection::vec((-1..10_i32, -1..10_i32, any::<proptest::sample::Index>(), 0..3), 2..5),
    ) {
        // Mostly from vertex to vertex.
        let vertices: Vec<Point> = rings.iter().flat_map(|ring| ring.vertices().to_vec()).collect();
        let stop = |&(x, y, at, kind): &(i32, i32, proptest::sample::Index, i32)| {
            if kind == 0 { (f64::from(x), f64::from(y)) } else { let q = at.get(&vertices); (q.x, q.y) }
        };
        let path = line(&stops.iter().map(stop).collect::<Vec<_>>());
        // Most random paths run through something: those say little.
        let scene = scene(0.0, rings.clone());
        let check = check(&scene, &path);
        let pierced = check.violations.iter().any(|v| v.reason == traverse_checker::ViolationReason::InsideObstacle);
        // A path that never leaves its start has nothing to pass between.
        prop_assume!(!pierced && check.cost > 0.0);
        prop_assume!(check.smallest_margin_mm.is_some_and(|margin| margin < 0.1));
        agrees(&rings, &path)?;
    }
}
