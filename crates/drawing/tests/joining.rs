//! Joining curves to loops: order and direction do not matter, nothing is guessed.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

mod random;

use random::Random;
use traverse_drawing::{
    Curve, Drawing, Fault, Forest, JOIN_TOLERANCE_MM, Layer, LengthUnit, Loop, Roles, SceneOptions,
    inspect_drawing, join_loops, picture_of_drawing, scene_from_drawing,
};
use traverse_geometry::Point;

fn open(points: &[(f64, f64, f64)]) -> Curve {
    let vertices = points.iter().map(|&(x, y, _)| Point::new(x, y)).collect();
    Curve::new(vertices, points.iter().map(|&(_, _, bulge)| bulge).collect(), false)
}

fn line(a: (f64, f64), b: (f64, f64)) -> Curve {
    open(&[(a.0, a.1, 0.0), (b.0, b.1, 0.0)])
}

fn turned(curve: &Curve) -> Curve {
    let last = curve.vertices.len() - 1;
    let mut bulges: Vec<f64> = curve.bulges[..last].iter().rev().map(|bulge| -bulge).collect();
    bulges.push(0.0);
    Curve::new(curve.vertices.iter().rev().copied().collect(), bulges, false)
}

/// A loop of lines and arcs round `(x, y)`, each its own curve; ends miss by up to half the tolerance.
fn pieces(random: &mut Random, x: f64, y: f64) -> Vec<Curve> {
    let count = 3 + random.below(9);
    let corner = |i: usize| {
        let angle = std::f64::consts::TAU * (i % count) as f64 / count as f64;
        (x + 10.0 * angle.cos(), y + 10.0 * angle.sin())
    };
    (0..count)
        .map(|i| {
            let bulge = [0.0, 0.2, -0.1, 0.9][random.below(4)];
            let mut miss = || (random.share() - 0.5) * JOIN_TOLERANCE_MM * 0.5;
            let ((x0, y0), (x1, y1)) = (corner(i), corner(i + 1));
            open(&[(x0 + miss(), y0 + miss(), bulge), (x1 + miss(), y1 + miss(), 0.0)])
        })
        .collect()
}

fn figures(loops: &[Loop]) -> Vec<(i64, i64, usize)> {
    let round = |value: f64| (value * 1e9).round() as i64;
    let mut figures: Vec<_> =
        loops.iter().map(|each| (round(each.area()), round(each.length()), each.vertices.len())).collect();
    figures.sort_unstable();
    figures
}

#[test]
fn order_and_direction_do_not_matter() {
    for seed in 0..60 {
        let mut random = Random::new(seed);
        let mut curves: Vec<Curve> =
            (0..6).flat_map(|i| pieces(&mut random, 30.0 * f64::from(i), 7.0)).collect();
        let first = join_loops("A", &curves, JOIN_TOLERANCE_MM);
        assert_eq!(first.loops.len(), 6, "seed {seed}");
        assert!(first.findings.is_empty(), "seed {seed}: {:?}", first.findings);
        for each in &first.loops {
            assert_eq!(each.vertices.len(), each.bulges.len());
        }
        for _ in 0..5 {
            random.shuffle(&mut curves);
            for curve in &mut curves {
                if random.below(2) == 0 {
                    *curve = turned(curve);
                }
            }
            let again = join_loops("A", &curves, JOIN_TOLERANCE_MM);
            assert_eq!(figures(&again.loops), figures(&first.loops), "seed {seed}");
        }
    }
}

#[test]
fn a_gap_above_the_tolerance_is_an_open_chain() {
    let gap = 2.5 * JOIN_TOLERANCE_MM;
    let curves = [line((0.0, 0.0), (9.0, 0.0)), line((9.0, 0.0), (9.0, 9.0)), line((9.0, 9.0), (0.0, gap))];
    let joined = join_loops("A", &curves, JOIN_TOLERANCE_MM);
    assert!(joined.loops.is_empty());
    let [finding] = &joined.findings[..] else { panic!("{:?}", joined.findings) };
    let Fault::OpenChain { gap_mm, length_mm, .. } = finding.fault else { panic!("{finding}") };
    assert!((gap_mm - gap).abs() < 1e-12 && length_mm > 30.0);
    assert!(finding.fault.loses_something() && finding.to_string().starts_with("layer A at "));
}

#[test]
fn three_ends_are_a_junction_and_loops_that_touch_in_a_vertex_are_not() {
    // Two triangles that share an edge: no one can say which two sides belong together.
    let (a, b, c, d) = ((0.0, 0.0), (10.0, 0.0), (5.0, 8.0), (5.0, -8.0));
    let shared = [line(a, b), line(b, c), line(c, a), line(b, d), line(d, a)];
    let joined = join_loops("A", &shared, JOIN_TOLERANCE_MM);
    assert!(joined.loops.is_empty());
    assert_eq!(joined.findings.len(), 2);
    assert!(joined.findings.iter().all(|finding| finding.fault == Fault::Junction { ends: 3 }));

    // Two triangles that share a vertex: both come back to it.
    let (e, f) = ((-5.0, 8.0), (-5.0, -8.0));
    let touching = [line(a, b), line(b, c), line(c, a), line(a, e), line(e, f), line(f, a)];
    let joined = join_loops("A", &touching, JOIN_TOLERANCE_MM);
    assert_eq!((joined.loops.len(), joined.findings.len()), (2, 0));
}

#[test]
fn duplicates_count_once_however_they_are_drawn() {
    let half = |from: f64, to: f64| open(&[(from, 0.0, 1.0), (to, 0.0, 0.0)]);
    let circle =
        |start: f64| Curve::new(vec![Point::new(start, 0.0), Point::new(-start, 0.0)], vec![1.0; 2], true);
    let curves =
        [half(-5.0, 5.0), turned(&half(5.0, -5.0)), half(5.0, -5.0), circle(5.0), circle(-5.0), circle(4.0)];
    let joined = join_loops("A", &curves, JOIN_TOLERANCE_MM);
    assert_eq!(joined.loops.len(), 2);
    assert_eq!(joined.findings.iter().filter(|finding| finding.fault == Fault::Duplicate).count(), 3);
    // Same box, same area, but mirrored: no duplicate.
    let corner = |mirror: f64| {
        let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)];
        let vertices = points.map(|(x, y)| Point::new(2.0 + mirror * (x - 2.0), y)).to_vec();
        Curve::new(vertices, vec![0.0; 6], true)
    };
    assert_eq!(join_loops("A", &[corner(1.0), corner(-1.0)], JOIN_TOLERANCE_MM).loops.len(), 2);
}

#[test]
fn what_is_shorter_than_the_tolerance_is_left_out_and_said() {
    let tiny = JOIN_TOLERANCE_MM / 3.0;
    let curves = [
        line((0.0, 0.0), (9.0, 0.0)),
        line((9.0, 0.0), (9.0 + tiny, 0.0)),
        line((9.0 + tiny, 0.0), (9.0, 9.0)),
        line((9.0, 9.0), (0.0, 0.0)),
    ];
    let joined = join_loops("A", &curves, JOIN_TOLERANCE_MM);
    assert_eq!((joined.loops.len(), joined.loops[0].vertices.len()), (1, 3));
    assert!(matches!(joined.findings[0].fault, Fault::TooShort { .. }));
}

#[test]
fn a_tail_on_a_loop_is_reported_and_the_loop_kept() {
    let curves = [
        line((0.0, 0.0), (9.0, 0.0)),
        line((9.0, 0.0), (9.0, 9.0)),
        line((9.0, 9.0), (0.0, 0.0)),
        line((9.0, 9.0), (20.0, 20.0)),
    ];
    let joined = join_loops("A", &curves, JOIN_TOLERANCE_MM);
    assert_eq!((joined.loops.len(), joined.findings.len()), (1, 2));
}

#[test]
fn numbers_that_are_not_finite_are_findings() {
    let ring = |bad: f64, place: usize| {
        let mut numbers = [0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.5];
        numbers[place] = bad;
        let [a, b, c, d, e, f, bulge] = numbers;
        let vertices = vec![Point::new(a, b), Point::new(c, d), Point::new(e, f)];
        Curve::new(vertices, vec![bulge, 0.0, 0.0], place.is_multiple_of(2))
    };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..7 {
            let curves = [ring(1.0, 6), ring(bad, place)];
            for tolerance in [0.01, 0.0, -1.0, f64::NAN] {
                let joined = join_loops("A", &curves, tolerance);
                assert_eq!((joined.loops.len(), joined.findings.len()), (1, 1), "{bad} {place}");
                assert_eq!(joined.findings[0].fault, Fault::NotFinite);
                assert!(joined.findings[0].place.x.is_finite() && joined.findings[0].place.y.is_finite());
            }
            let layer = Layer { name: "A".to_owned(), curves: curves.to_vec() };
            let drawing = Drawing {
                unit: LengthUnit::MILLIMETRES,
                unit_assumed: false,
                layers: vec![layer],
                unused: Vec::new(),
                mapping: None,
            };
            let seen = inspect_drawing(&drawing, &Roles::default(), f64::NAN);
            assert!(seen.findings.iter().any(|finding| finding.fault == Fault::NotFinite));
            let made = scene_from_drawing(&drawing, &SceneOptions::new(1.0)).unwrap();
            assert!(made.scene.obstacles.len() == 1 && !made.report.is_complete());
            assert!(picture_of_drawing(&drawing, &seen.findings, "").starts_with("<svg"));
            let loops = curves.map(|curve| Loop {
                vertices: curve.vertices,
                bulges: curve.bulges,
                first_curve: 0,
                deviation_mm: 0.0,
            });
            assert_eq!(Forest::of(&loops).parents.len(), 2);
        }
    }
}
