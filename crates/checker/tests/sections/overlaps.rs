//! Parts that come too near, lie in one another, or the one inside the other.

use crate::making::*;
use traverse_checker::ViolationReason::{SectionsOverlap, SectionsTooClose};
use traverse_checker::part_overlaps_while;
use traverse_geometry::{Part, PlacedSection, Polygon, Pose, Ring, SectionLayout};

fn two(left: Vec<Part>, right: Vec<Part>) -> SectionLayout {
    layout(vec![section("left", left), section("right", right)])
}

fn only(layout: &SectionLayout, order: &[PlacedSection]) -> traverse_checker::Violation {
    let found = check(layout, order);
    let [violation] = &found.violations[..] else { panic!("{:#?}", found.violations) };
    assert_eq!(found.smallest_margin_mm, Some(-violation.amount));
    violation.clone()
}

#[test]
fn the_example_of_the_published_effect_overlaps_by_three() {
    // Left edge and right edge lean; at heights 0 and 10 the published effect of 9 leaves them apart.
    let left = part("a", &[0.0, 0.0, 0.0, 10.0, 10.0, 10.0], &[]);
    let right = part("b", &[10.0, 0.0, 20.0, 0.0, 20.0, 10.0, 19.0, 10.0, 12.0, 6.0], &[]);
    let layout = two(vec![left], vec![right]);
    assert!(check(&layout, &[at(0, 0.0), at(1, 4.0)]).is_sound());
    let violation = only(&layout, &[at(0, 0.0), at(1, 1.0)]);
    assert_eq!((violation.reason, violation.field.as_str()), (SectionsOverlap, "order[1]"));
    assert_eq!(violation.obstacle.as_deref(), Some("left"));
    // The corner lies 3 mm inside along x, of an edge that leans by 45 degrees.
    assert!((violation.amount - 3.0 / 2.0_f64.sqrt()).abs() < 1e-9, "{violation}");
    let place = violation.at.expect("it has a place");
    assert!((place.x - 3.0).abs() < 1e-9 && (place.y - 6.0).abs() < 1e-9, "{place}");
}

#[test]
fn the_gap_is_a_true_distance() {
    let mut layout =
        two(vec![rectangle("a", 0.0, 0.0, 10.0, 10.0)], vec![rectangle("b", 0.0, 13.0, 10.0, 20.0)]);
    layout.gap_mm = 5.0;
    // Corners at (10, 10) and (14, 13) are exactly 5 apart.
    let found = check(&layout, &[at(0, 0.0), at(1, 14.0)]);
    assert!(
        found.is_sound() && found.smallest_margin_mm.is_some_and(|margin| margin.abs() < 1e-12),
        "{found:?}"
    );
    let violation = only(&layout, &[at(0, 0.0), at(1, 13.0)]);
    assert_eq!(violation.reason, SectionsTooClose);
    assert!((violation.amount - (5.0 - 18.0_f64.sqrt())).abs() < 1e-9);
}

#[test]
fn one_inside_the_other_is_found_both_ways_round() {
    let (big, small) = (rectangle("big", 0.0, 0.0, 100.0, 100.0), disc("small", 5.0, 50.0, 5.0));
    for (left, right) in [(big.clone(), small.clone()), (small, big)] {
        let layout = two(vec![left], vec![right]);
        // The small one in the middle: 40 mm from left edge to left edge.
        let order = [at(0, 0.0), at(1, 40.0)];
        let order = match layout.sections[0].bounds().size().x > 50.0 {
            true => order,
            false => [at(1, 0.0), at(0, 40.0)],
        };
        let violation = only(&layout, &order);
        assert_eq!(violation.reason, SectionsOverlap);
        assert!(violation.amount > 40.0, "{violation}");
    }
}

#[test]
fn a_part_in_a_hole_is_no_overlap() {
    let outer = Ring::from_xy(&[0.0, 0.0, 100.0, 0.0, 100.0, 100.0, 0.0, 100.0], &[]).expect("valid");
    let hole = Ring::from_xy(&[20.0, 20.0, 80.0, 20.0, 80.0, 80.0, 20.0, 80.0], &[]).expect("valid");
    let frame =
        Part { shape: Polygon::new(outer, vec![hole]).expect("valid"), ..disc("frame", 0.0, 0.0, 1.0) };
    let layout = two(vec![frame], vec![disc("core", 0.0, 50.0, 25.0)]);
    let found = check(&layout, &[at(0, 0.0), at(1, 25.0)]);
    assert!(
        found.is_sound() && found.smallest_margin_mm.is_some_and(|margin| (margin - 5.0).abs() < 1e-9),
        "{found:?}"
    );
    assert_eq!(only(&layout, &[at(0, 0.0), at(1, 10.0)]).reason, SectionsOverlap);
}

#[test]
fn the_same_shape_in_the_same_place_is_found() {
    let shapes = [
        vec![rectangle("a", 0.0, 0.0, 30.0, 20.0)],
        vec![disc("a", 0.0, 0.0, 20.0)],
        // Touches itself: two lobes.
        vec![part("a", &[0.0, 0.0, 10.0, 0.0, 5.0, 5.0, 10.0, 10.0, 0.0, 10.0, 5.0, 5.0], &[])],
    ];
    for parts in shapes {
        let layout = two(parts.clone(), parts);
        for shift in [0.0, 1e-9, 1e-7, 1e-3] {
            let violation = only(&layout, &[at(0, 0.0), at(1, shift)]);
            assert!(violation.reason == SectionsOverlap && violation.amount > 0.5, "{shift}: {violation}");
        }
    }
}

#[test]
fn touching_is_allowed_along_edges_at_corners_and_in_discs() {
    let layout = two(vec![disc("a", 0.0, 0.0, 10.0)], vec![disc("b", 0.0, 0.0, 7.0)]);
    let found = check(&layout, &[at(0, 0.0), at(1, 20.0)]);
    assert!(found.is_sound(), "{:?}", found.violations);
    assert!(!check(&layout, &[at(0, 0.0), at(1, 20.0 - 10.0 * TOLERANCE)]).is_sound());
}

#[test]
fn poses_turn_about_the_middle_of_the_box() {
    // A wedge, high at its right: mirrored it is high at its left.
    let wedge = || vec![part("a", &[0.0, 0.0, 10.0, 0.0, 10.0, 10.0], &[])];
    let layout = two(wedge(), wedge());
    let posed = |section, pose, x_mm| PlacedSection { pose, ..at(section, x_mm) };
    let (as_is, turned) = (posed(0, Pose::AsIs, 0.0), |x| posed(1, Pose::HalfTurn, x));
    // Its lower left half is empty; half turned, the upper right one is: they fit into one box, the turned one left.
    assert!(check(&layout, &[posed(1, Pose::HalfTurn, 0.0), posed(0, Pose::AsIs, 0.0)]).is_sound());
    assert!(!check(&layout, &[as_is, turned(9.0)]).is_sound());
    assert!(check(&layout, &[as_is, turned(10.0)]).is_sound());
    for (left, right, fits) in [
        (Pose::MirrorX, Pose::MirrorY, true),
        (Pose::MirrorX, Pose::AsIs, false),
        (Pose::MirrorY, Pose::AsIs, false),
    ] {
        assert_eq!(
            check(&layout, &[posed(0, left, 0.0), posed(1, right, 0.0)]).is_sound(),
            fits,
            "{left:?} {right:?}"
        );
    }
}

#[test]
fn parts_that_overlap_inside_their_section_are_listed() {
    let parts = vec![
        rectangle("a", 100.0, 0.0, 110.0, 10.0),
        rectangle("b", 110.0, 0.0, 120.0, 10.0),
        disc("c", 118.0, 5.0, 3.0),
        rectangle("d", 100.0, 0.0, 110.0, 10.0),
    ];
    let found = part_overlaps_while(&section("s", parts), TOLERANCE, &|| true).expect("not given up");
    let pairs: Vec<_> = found.iter().map(|overlap| (overlap.first, overlap.second)).collect();
    assert_eq!(pairs, [(0, 3), (1, 2)]);
    assert!(found[1].at.x > 110.0 && found[1].depth_mm > 2.0, "{found:?}");
}
