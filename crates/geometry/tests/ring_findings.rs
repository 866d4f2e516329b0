//! Every kind of bad ring, with the exact findings; and rings that look bad but are not.

use traverse_geometry::{COORDINATE_LIMIT_MM, FINDINGS_LIMIT, Finding, Motion, Reason, Ring, Vector};

fn findings(xy_mm: &[f64], bulges: &[f64]) -> Vec<Finding> {
    Ring::from_xy(xy_mm, bulges).expect_err("the ring is bad")
}

#[track_caller]
fn check(xy_mm: &[f64], bulges: &[f64], expected: &[(&str, Reason, &str)]) {
    let findings = findings(xy_mm, bulges);
    let found: Vec<_> = findings.iter().map(|f| (f.field.as_str(), f.reason, f.value.as_str())).collect();
    assert_eq!(found, expected, "{findings:?}");
    for finding in findings {
        assert!(!finding.message.starts_with(char::is_uppercase), "{}", finding.message);
        assert!(["send", "split", "keep", "needs", "mend"].iter().any(|verb| finding.message.contains(verb)));
    }
}

#[track_caller]
fn valid(xy_mm: &[f64], bulges: &[f64]) -> Ring {
    Ring::from_xy(xy_mm, bulges).expect("the ring is valid")
}

const SQUARE: [f64; 8] = [0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0];

#[test]
fn counts() {
    check(&[], &[], &[("xy_mm", Reason::TooFewVertices, "0")]);
    check(&[1.0; 8], &[], &[("xy_mm", Reason::TooFewVertices, "0")]);
    check(&[0.0, 0.0, 4.0, 0.0], &[], &[("xy_mm", Reason::TooFewVertices, "2")]);
    check(&[0.0, 0.0, 4.0, 0.0, 4.0, 0.0, 0.0, 0.0], &[], &[("xy_mm", Reason::TooFewVertices, "2")]);
    check(&[0.0, 0.0, 4.0, 0.0], &[0.0, 0.0], &[("xy_mm", Reason::TooFewVertices, "2")]);
    check(&SQUARE[..7], &[], &[("xy_mm", Reason::OddCoordinateCount, "7")]);
    check(&SQUARE, &[0.0; 3], &[("bulges", Reason::BulgeCountMismatch, "3")]);
    check(&SQUARE, &[0.0; 5], &[("bulges", Reason::BulgeCountMismatch, "5")]);
}

#[test]
fn numbers_all_at_once() {
    check(
        &[f64::NAN, 0.0, 4.0, f64::NEG_INFINITY, 1e308, 4.0, 0.0, -1.1 * COORDINATE_LIMIT_MM, 3.0],
        &[0.0, 1.5, f64::NAN, -2.0],
        &[
            ("xy_mm", Reason::OddCoordinateCount, "9"),
            ("xy_mm[0]", Reason::NotFinite, "NaN"),
            ("xy_mm[3]", Reason::NotFinite, "-inf"),
            ("xy_mm[4]", Reason::CoordinateTooLarge, "1e308"),
            ("xy_mm[7]", Reason::CoordinateTooLarge, "-1100000.0"),
            ("bulges[1]", Reason::BulgeOutOfRange, "1.5"),
            ("bulges[2]", Reason::NotFinite, "NaN"),
            ("bulges[3]", Reason::BulgeOutOfRange, "-2.0"),
        ],
    );
}

#[test]
fn the_list_is_capped_and_counted() {
    let found = findings(&vec![f64::NAN; 1000], &[]);
    assert_eq!(found.len(), FINDINGS_LIMIT + 1);
    let last = &found[FINDINGS_LIMIT];
    assert_eq!((last.field.as_str(), last.reason, last.value.as_str()), ("xy_mm", Reason::NotFinite, "900"));
}

#[test]
fn flat_arcs() {
    check(&[0.0, 0.0, 1e6, 0.0, 1e6, 1e6], &[1e-4, 0.0, 0.0], &[("bulges[0]", Reason::ArcTooFlat, "0.0001")]);
    let ring = valid(&[0.0, 0.0, 1e6, 0.0, 1e6, 1e6], &[1e-14, 0.0, 0.0]);
    assert!(!ring.has_arcs() && ring.bulges().is_empty());
}

#[test]
fn no_area() {
    check(&[0.0, 0.0, 4.0, 0.0, 9.0, 0.0], &[], &[("xy_mm", Reason::NoArea, "0")]);
    check(&[0.0, 0.0, 4.0, 0.0, 4.0, 3.0, 4.0, 0.0], &[], &[("xy_mm", Reason::NoArea, "0")]);
    check(&[0.1, 0.2, 4.3, 0.7], &[0.3, -0.3], &[("xy_mm", Reason::NoArea, "0")]);
}

#[test]
fn bow_ties_name_their_edges() {
    check(&[0.0, 0.0, 5.0, 4.0, 5.0, 0.0, 0.0, 3.0], &[], &[("xy_mm", Reason::EdgesCross, "edges 0 and 2")]);
    let message = findings(&[0.0, 0.0, 0.0, 0.0, 5.0, 4.0, 5.0, 0.0, 0.0, 3.0], &[]).remove(0).message;
    assert!(message.starts_with("edge 1 crosses edge 3 near (2."), "{message}");
}

#[test]
fn crossing_at_a_vertex() {
    // The chain comes to (2, 2) twice and passes through itself.
    check(
        &[0.0, 0.0, 2.0, 2.0, 5.0, 4.0, 5.0, 0.0, 2.0, 2.0, 0.0, 3.0],
        &[],
        &[("xy_mm", Reason::EdgesCross, "edges 1 and 4")],
    );
    // The same point, but the chain turns away.
    let touching = valid(&[0.0, 0.0, 2.0, 2.0, 5.0, 0.0, 5.0, 4.0, 2.0, 2.0, 0.0, 4.0], &[]);
    assert!(touching.touches_itself());
}

#[test]
fn crossing_at_a_vertex_within_an_edge() {
    let through = [0.0, 0.0, 8.0, 0.0, 8.0, 4.0, 4.0, 0.0, 2.0, -3.0, 0.0, -1.0];
    check(&through, &[], &[("xy_mm", Reason::EdgesCross, "edges 0 and 3")]);
    assert!(valid(&[0.0, 0.0, 8.0, 0.0, 8.0, 4.0, 4.0, 0.0, 0.0, 4.0], &[]).touches_itself());
}

#[test]
fn crossing_along_an_overlap() {
    // Down to the base line, along it, and out below.
    let through = [0.0, 0.0, 8.0, 0.0, 8.0, 4.0, 5.0, 0.0, 3.0, 0.0, 2.0, -3.0, 0.0, -1.0];
    let found = findings(&through, &[]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].reason, Reason::EdgesCross);
    let back_up = [0.0, 0.0, 8.0, 0.0, 8.0, 4.0, 5.0, 0.0, 3.0, 0.0, 2.0, 3.0, 0.0, 5.0];
    assert!(valid(&back_up, &[]).touches_itself());
}

/// The shared way runs over vertex 0. Found by generated rings.
#[test]
fn crossing_along_an_overlap_at_the_first_vertex() {
    let mut xy = vec![3.0, 1.0, 0.0, 0.0, 0.0, 1.0, 3.0, 1.0, 3.0, 2.0, 4.0, 0.0, 3.0, 3.0];
    for _ in 0..7 {
        let found = findings(&xy, &[]);
        assert_eq!(found.iter().map(|finding| finding.reason).collect::<Vec<_>>(), [Reason::EdgesCross]);
        xy.rotate_left(2);
    }
}

#[test]
fn weakly_simple_rings_are_taken() {
    // Keyhole: a slit of width 0 to an inner square run the other way.
    let keyhole = [
        0.0, 0.0, 9.0, 0.0, 9.0, 9.0, 0.0, 9.0, 0.0, 3.0, 3.0, 3.0, 3.0, 6.0, 6.0, 6.0, 6.0, 3.0, 3.0, 3.0,
        0.0, 3.0,
    ];
    assert_eq!(valid(&keyhole, &[]).signed_area(), 72.0);
    // Antennas outside and inside.
    assert!(valid(&[0.0, 0.0, 4.0, 0.0, 7.0, 0.0, 4.0, 0.0, 4.0, 4.0], &[]).touches_itself());
    assert!(valid(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 2.0, 1.0, 4.0, 4.0], &[]).touches_itself());
    // A collinear vertex is no contact.
    assert!(!valid(&[0.0, 0.0, 2.0, 0.0, 4.0, 0.0, 4.0, 4.0], &[]).touches_itself());
    // A slit of 1 µm is none either.
    let slit = [0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 2.001, 4.0, 2.0, 1.0, 2.0, 4.0, 0.0, 4.0];
    assert!(!valid(&slit, &[]).touches_itself());
}

#[test]
fn an_antenna_through_a_wall_crosses() {
    let found = findings(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 2.0, -2.0, 4.0, 4.0], &[]);
    assert!(found.iter().all(|finding| finding.reason == Reason::EdgesCross), "{found:?}");
    assert_eq!(found.len(), 2);
}

#[test]
fn two_rounds_are_refused() {
    let twice: Vec<f64> = SQUARE.iter().chain(&SQUARE).copied().collect();
    check(&twice, &[], &[("xy_mm", Reason::EdgesCross, "2 rounds")]);
    let circle = [0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0, 0.0];
    check(&circle, &[1.0; 4], &[("xy_mm", Reason::EdgesCross, "2 rounds")]);
}

#[test]
fn equal_vertices_go_with_their_bulges() {
    let xy = [0.0, -0.0, 4.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0, -0.0, 0.0];
    let ring = valid(&xy, &[0.0, 0.5, 0.25, 0.0, 0.0, 0.75]);
    assert_eq!(ring.len(), 4);
    assert_eq!(ring.bulges(), [0.0, 0.25, 0.0, 0.0]);
    assert!(ring.vertices().iter().all(|v| v.x.is_sign_positive() && v.y.is_sign_positive()));
}

#[test]
fn arcs_that_cross_and_arcs_that_touch() {
    // A half circle that bulges through the opposite side.
    check(
        &[0.0, 0.0, 8.0, 0.0, 8.0, 2.0, 0.0, 2.0],
        &[-1.0, 0.0, 0.0, 0.0],
        &[("xy_mm", Reason::EdgesCross, "edges 0 and 2"), ("xy_mm", Reason::EdgesCross, "edges 0 and 2")]
            [..1],
    );
    // One that reaches it exactly.
    let touching = valid(&[0.0, 0.0, 8.0, 0.0, 8.0, 4.0, 0.0, 4.0], &[-1.0, 0.0, 0.0, 0.0]);
    assert!(touching.touches_itself());
    // A slot and a rounded rectangle touch nothing.
    assert!(!valid(&[0.0, 0.0, 8.0, 0.0, 8.0, 2.0, 0.0, 2.0], &[0.0, 1.0, 0.0, 1.0]).touches_itself());
    let q = (std::f64::consts::PI / 8.0).tan();
    let rounded = [1.0, 0.0, 7.0, 0.0, 8.0, 1.0, 8.0, 5.0, 7.0, 6.0, 1.0, 6.0, 0.0, 5.0, 0.0, 1.0];
    assert!(!valid(&rounded, &[0.0, q, 0.0, q, 0.0, q, 0.0, q]).touches_itself());
    // A circle, in two and in four arcs.
    assert!(!valid(&[0.0, 0.0, 2.0, 0.0], &[1.0, 1.0]).touches_itself());
    assert!(!valid(&[1.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, -1.0], &[q; 4]).touches_itself());
    // A moon.
    assert!(!valid(&[0.0, 0.0, 2.0, 0.0], &[1.0, -0.5]).touches_itself());
    // A keyhole slot round a circle.
    let keyhole = [0.0, 0.0, 9.0, 0.0, 9.0, 9.0, 0.0, 9.0, 0.0, 4.0, 3.0, 4.0, 6.0, 4.0, 3.0, 4.0, 0.0, 4.0];
    let ring = valid(&keyhole, &[0.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0]);
    assert!(ring.touches_itself());
    assert!((ring.signed_area() - 81.0 + std::f64::consts::PI * 2.25).abs() < 1e-9);
}

#[test]
fn arcs_cross_at_a_vertex() {
    // Two lobes of arcs through (0, 0): in turns they cross, one after the other they touch.
    let crossing = [0.0, 0.0, 4.0, 4.0, 4.0, 0.0, 0.0, 0.0, -4.0, 4.0, -4.0, 1.0];
    let found = findings(&crossing, &[0.1, 0.3, 0.1, 0.1, 0.3, 0.1]);
    assert!(found.iter().all(|finding| finding.reason == Reason::EdgesCross), "{found:?}");
    let touching = [0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 0.0, -4.0, 4.0, -4.0, 1.0];
    assert!(valid(&touching, &[0.1; 6]).touches_itself());
}

#[test]
fn touching_arcs_stay_valid_when_turned_and_far_away() {
    let rings = [
        valid(
            &[0.0, 0.0, 9.0, 0.0, 9.0, 9.0, 0.0, 9.0, 0.0, 4.0, 3.0, 4.0, 6.0, 4.0, 3.0, 4.0, 0.0, 4.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0],
        ),
        valid(&[0.0, 0.0, 8.0, 0.0, 8.0, 4.0, 0.0, 4.0], &[-1.0, 0.0, 0.0, 0.0]),
        valid(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 0.0, -4.0, 4.0, -4.0, 1.0], &[0.1; 6]),
        valid(
            &[-5.0, 9.0, -5.0, 0.0, 5.0, 0.0, 5.0, 9.0, 10.0, 9.0, 10.0, -9.0, -10.0, -9.0, -10.0, 9.0],
            &[-0.5, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
        ),
    ];
    for ring in rings {
        for step in 0..50 {
            let motion =
                Motion::rotation(0.1 * f64::from(step)).then(&Motion::translation(Vector::new(2e4, -2e4)));
            let moved = ring.moved(&motion);
            let again = Ring::new(moved.vertices().to_vec(), moved.bulges().to_vec());
            assert_eq!(again.as_ref(), Ok(&moved), "step {step} of {ring:?}");
        }
    }
}
