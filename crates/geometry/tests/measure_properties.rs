//! Areas, lengths, distances and locations against sampling, and unchanged under motions.

use proptest::prelude::*;
use traverse_geometry::{Edge, FlattenSide, Location, Motion, Point, Polygon, Ring, Vector};

/// Star-shaped rings with arcs; those that cross themselves are left out.
fn rings() -> impl Strategy<Value = Ring> {
    prop::collection::vec((2.0..10.0f64, -0.4..0.4f64, any::<bool>()), 3..9).prop_filter_map(
        "crossing",
        |spokes| {
            let n = spokes.len() as f64;
            let vertex = |(i, &(radius, _, _)): (usize, &(f64, f64, bool))| {
                let angle = std::f64::consts::TAU * i as f64 / n;
                Point::new(radius * angle.cos(), radius * angle.sin())
            };
            let bulges =
                spokes.iter().map(|&(_, bulge, straight)| if straight { 0.0 } else { bulge }).collect();
            Ring::new(spokes.iter().enumerate().map(vertex).collect(), bulges).ok()
        },
    )
}

fn edges() -> impl Strategy<Value = Edge> {
    let coordinate = || -9.0..9.0f64;
    let bulge = prop_oneof![Just(0.0), -1.0..1.0f64, Just(1.0), Just(-1.0), Just(1e-4)];
    (coordinate(), coordinate(), coordinate(), coordinate(), bulge).prop_map(|(x, y, to_x, to_y, bulge)| {
        Edge::from_bulge(Point::new(x, y), Point::new(to_x, to_y), bulge)
    })
}

fn motions() -> impl Strategy<Value = Motion> {
    (any::<bool>(), 0..4i32, -7.0..7.0f64, prop_oneof![Just(0.0), Just(20_000.0), -50.0..50.0f64]).prop_map(
        |(mirrored, quarters, angle, x)| {
            let first = if mirrored { Motion::mirror_x() } else { Motion::IDENTITY };
            first
                .then(&Motion::quarter_turns(quarters))
                .then(&Motion::rotation(angle))
                .then(&Motion::translation(Vector::new(x, -x)))
        },
    )
}

fn sampled(edge: &Edge) -> impl Iterator<Item = Point> + '_ {
    (0..=2000).map(|i| edge.point_at(f64::from(i) / 2000.0))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn point_to_edge(edge in edges(), x in -20.0..20.0f64, y in -20.0..20.0f64) {
        let p = Point::new(x, y);
        let dense = sampled(&edge).map(|q| (p - q).norm()).fold(f64::INFINITY, f64::min);
        let exact = edge.distance_to_point(p);
        prop_assert!(exact <= dense + 1e-9 && dense <= exact + edge.length() / 4000.0 + 1e-9);
        prop_assert!(((p - edge.nearest_point(p)).norm() - exact).abs() < 1e-9);
        prop_assert!(edge.distance_to_point(edge.nearest_point(p)) < 1e-9);
        prop_assert!(edge.bounds().grown(1e-9).contains(edge.nearest_point(p)));
    }

    #[test]
    fn edge_to_edge(a in edges(), b in edges()) {
        let dense = sampled(&a).map(|p| b.distance_to_point(p)).fold(f64::INFINITY, f64::min);
        let exact = a.distance(&b);
        prop_assert!(exact <= dense + 1e-9 && dense <= exact + a.length() / 4000.0 + 1e-9, "{exact} {dense}");
        prop_assert!((exact - b.distance(&a)).abs() < 1e-9);
        prop_assert!((exact - a.reversed().distance(&b)).abs() < 1e-9);
    }

    #[test]
    fn arcs_hold_their_own_points(edge in edges(), share in 0.0..1.0f64) {
        if let Edge::Arc(arc) = edge {
            for arc in [arc, arc.reversed()] {
                prop_assert!(arc.spans(arc.start - arc.center) && arc.spans(arc.end - arc.center));
                prop_assert!(arc.spans(arc.point_at(share) - arc.center));
                prop_assert!(!arc.spans(arc.center - arc.point_at(0.5)));
                prop_assert!(arc.bounds().grown(1e-9).contains(arc.point_at(share)));
            }
        }
    }

    #[test]
    fn area_and_length_against_fine_chords(ring in rings()) {
        let fine = ring.flattened(FlattenSide::Nearest, 1e-5);
        let chords = Ring::new(fine, Vec::new()).unwrap();
        prop_assert!((chords.signed_area() - ring.signed_area()).abs() < 1e-5 * ring.length());
        prop_assert!((chords.length() - ring.length()).abs() < 1e-3);
        let inside = Ring::new(ring.flattened(FlattenSide::Inside, 1e-3), Vec::new());
        let outside = Ring::new(ring.flattened(FlattenSide::Outside, 1e-3), Vec::new());
        if let (Ok(inside), Ok(outside)) = (inside, outside) {
            let area = ring.signed_area() + 1e-9;
            prop_assert!(inside.signed_area() <= area && area <= outside.signed_area() + 2e-9);
        }
    }

    #[test]
    fn location_against_angles(ring in rings(), x in -14.0..14.0f64, y in -14.0..14.0f64) {
        let p = Point::new(x, y);
        let fine = ring.flattened(FlattenSide::Nearest, 1e-5);
        let sum: f64 = (0..fine.len()).map(|i| {
            let (a, b) = (fine[i] - p, fine[(i + 1) % fine.len()] - p);
            (a.x * b.y - a.y * b.x).atan2(a.dot(&b))
        }).sum();
        if ring.distance_to_point(p) > 1e-4 {
            let expected = if sum.abs() > 3.0 { Location::Inside } else { Location::Outside };
            prop_assert_eq!(ring.locate(p), expected);
            prop_assert_eq!(ring.reversed().locate(p), expected);
        }
        // Points in line with vertices and chords: where the half-open rules have to agree.
        for i in 0..ring.len() {
            let edge = ring.edge(i);
            prop_assert_eq!(ring.locate(edge.start()), Location::Border);
            let level = Point::new(x, edge.start().y);
            let middle = middle_of(edge.start(), edge.end());
            for p in [level, middle] {
                if ring.distance_to_point(p) > 1e-4 {
                    let aside = Point::new(p.x + 1e-6, p.y + 1.1e-6);
                    prop_assert_eq!(ring.locate(p), ring.locate(aside));
                }
            }
            if matches!(edge, Edge::Arc(_)) {
                prop_assert_eq!(ring.locate(edge.point_at(0.37)), Location::Border);
            }
        }
    }

    #[test]
    fn motions_keep_measures(ring in rings(), motion in motions(), x in -14.0..14.0f64, y in -14.0..14.0f64) {
        let (p, moved) = (Point::new(x, y), ring.moved(&motion));
        let sign = if motion.is_mirrored() { -1.0 } else { 1.0 };
        prop_assert!((moved.signed_area() - sign * ring.signed_area()).abs() < 1e-6);
        prop_assert!((moved.length() - ring.length()).abs() < 1e-7);
        prop_assert!((moved.distance_to_point(motion.point(p)) - ring.distance_to_point(p)).abs() < 1e-7);
        prop_assert!((moved.nearest_point(motion.point(p)) - motion.point(ring.nearest_point(p))).norm() < 1e-4);
        prop_assert!(!moved.bounds().is_empty());
        if ring.distance_to_point(p) > 1e-6 {
            prop_assert_eq!(moved.locate(motion.point(p)), ring.locate(p));
        }
        let again = Ring::new(moved.vertices().to_vec(), moved.bulges().to_vec());
        prop_assert_eq!(again.as_ref(), Ok(&moved));
    }

    #[test]
    fn other_writings_of_a_ring(ring in rings(), start in 0usize..8) {
        let n = ring.len();
        let (mut vertices, mut bulges) = (ring.vertices().to_vec(), ring.bulges().to_vec());
        vertices.rotate_left(start % n);
        if !bulges.is_empty() {
            bulges.rotate_left(start % n);
        }
        let rotated = Ring::new(vertices, bulges).unwrap();
        for (other, sign) in [(rotated, 1.0), (ring.reversed(), -1.0)] {
            prop_assert!((other.signed_area() - sign * ring.signed_area()).abs() < 1e-9);
            prop_assert!((other.length() - ring.length()).abs() < 1e-9);
            prop_assert_eq!(other.touches_itself(), ring.touches_itself());
        }
        prop_assert_eq!(ring.reversed().reversed(), ring);
    }

    #[test]
    fn polygons_with_a_hole(ring in rings(), x in -9.0..9.0f64, y in -9.0..9.0f64) {
        let frame = Ring::from_xy(&[-30.0, -30.0, 30.0, -30.0, 30.0, 30.0, -30.0, 30.0], &[]).unwrap();
        let polygon = Polygon::new(frame, vec![ring.clone()]).unwrap();
        prop_assert!((polygon.area() + ring.signed_area().abs() - 3600.0).abs() < 1e-9);
        let p = Point::new(x, y);
        let opposite = match ring.locate(p) {
            Location::Inside => Location::Outside,
            Location::Outside => Location::Inside,
            Location::Border => Location::Border,
        };
        prop_assert_eq!(polygon.locate(p), opposite);
        prop_assert!((polygon.distance_to_border(p) - (polygon.nearest_point(p) - p).norm()).abs() < 1e-9);
    }
}

fn middle_of(a: Point, b: Point) -> Point {
    Point::new((a.x + b.x) / 2.0, (a.y + b.y) / 2.0)
}
