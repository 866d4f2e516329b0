//! What the list says by itself, each rule alone.

use crate::making::*;
use traverse_checker::ViolationReason::*;
use traverse_checker::{VIOLATION_LIMIT, check_sections, check_sections_while};
use traverse_geometry::{PlacedSection, Pose, SlideRule};

fn boxes(count: usize) -> traverse_geometry::SectionLayout {
    let of = |i: usize| section(&format!("s{i}"), vec![rectangle("p", 0.0, 0.0, 10.0, 5.0)]);
    layout((0..count).map(of).collect())
}

fn side_by_side(count: usize) -> Vec<PlacedSection> {
    (0..count).map(|i| at(i, 10.0 * i as f64)).collect()
}

#[test]
fn a_sound_layout_is_accepted_with_its_length() {
    let found = check(&boxes(3), &side_by_side(3));
    assert_eq!(found.violations, []);
    assert_eq!((found.length_mm, found.smallest_margin_mm), (30.0, Some(0.0)));
}

#[test]
fn every_copy_once_and_in_an_allowed_pose() {
    let mut layout = boxes(2);
    layout.sections[0].quantity = 2;
    layout.sections[1].poses = vec![Pose::AsIs];
    let copy = |copy, x_mm| PlacedSection { copy, ..at(0, x_mm) };
    assert_eq!(reasons(&layout, &[copy(0, 0.0), copy(1, 10.0), at(1, 20.0)]), []);
    assert_eq!(reasons(&layout, &[copy(0, 0.0), copy(0, 10.0), at(1, 20.0)]), [CopyRepeated, CopyMissing]);
    assert_eq!(reasons(&layout, &[copy(0, 0.0), copy(2, 10.0), at(1, 20.0)]), [UnknownCopy, CopyMissing]);
    assert_eq!(reasons(&layout, &[copy(0, 0.0), copy(1, 10.0)]), [CopyMissing]);
    let turned = PlacedSection { pose: Pose::HalfTurn, ..at(1, 20.0) };
    assert_eq!(reasons(&layout, &[copy(0, 0.0), copy(1, 10.0), turned]), [PoseNotAllowed]);
    let strange = reasons(&layout, &[copy(0, 0.0), copy(1, 10.0), at(1, 20.0), at(7, 30.0)]);
    assert_eq!(strange, [UnknownSection]);
}

#[test]
fn first_last_precedence_and_neighbours() {
    let mut layout = boxes(3);
    let order = [at(1, 0.0), at(0, 10.0), at(2, 20.0)];
    layout.first = Some(1);
    layout.last = Some(2);
    layout.precedences = vec![(1, 0), (0, 2)];
    layout.forbidden_joins = vec![(0, 1), (1, 2)];
    assert_eq!(reasons(&layout, &order), []);
    layout.first = Some(0);
    layout.last = Some(0);
    assert_eq!(reasons(&layout, &order), [WrongFirst, WrongLast]);
    (layout.first, layout.last) = (None, None);
    layout.precedences = vec![(2, 1)];
    assert_eq!(reasons(&layout, &order), [PrecedenceBroken]);
    layout.precedences.clear();
    layout.forbidden_joins = vec![(0, 2)];
    let found = check(&layout, &order);
    assert_eq!(
        found.violations.iter().map(|v| (v.reason, v.field.as_str())).collect::<Vec<_>>(),
        [(ForbiddenJoin, "order[2]")]
    );
}

#[test]
fn all_copies_of_one_come_before_all_of_the_other() {
    let mut layout = boxes(2);
    layout.sections[0].quantity = 2;
    layout.precedences = vec![(0, 1)];
    let copy = |copy, x_mm| PlacedSection { copy, ..at(0, x_mm) };
    assert_eq!(reasons(&layout, &[copy(0, 0.0), at(1, 10.0), copy(1, 20.0)]), [PrecedenceBroken]);
    assert_eq!(reasons(&layout, &[copy(0, 0.0), copy(1, 10.0), at(1, 20.0)]), []);
}

#[test]
fn nothing_left_of_the_start_and_none_passes_the_one_before() {
    let mut layout = boxes(2);
    let found = check(&layout, &[at(0, -0.5), at(1, 9.5)]);
    assert_eq!(
        found.violations.iter().map(|v| (v.reason, v.amount)).collect::<Vec<_>>(),
        [(LeftOfStart, 0.5)]
    );
    layout.sections[1].parts = vec![rectangle("p", 0.0, 20.0, 3.0, 25.0)];
    let order = [at(0, 10.0), at(1, 4.0)];
    let found = check(&layout, &order);
    assert_eq!(
        found.violations.iter().map(|v| (v.reason, v.amount)).collect::<Vec<_>>(),
        [(PassesPrevious, 6.0)]
    );
    layout.slide_rule = SlideRule::Free;
    assert_eq!(reasons(&layout, &order), []);
}

#[test]
fn the_strip_is_high_enough() {
    let mut layout = boxes(1);
    layout.strip_height_mm = Some(5.0);
    assert_eq!(reasons(&layout, &side_by_side(1)), []);
    layout.strip_height_mm = Some(4.0);
    let found = check(&layout, &side_by_side(1));
    assert_eq!(found.violations[0].reason, HigherThanStrip);
    assert!((found.violations[0].amount - 1.0).abs() < 1e-9);
}

#[test]
fn numbers_that_are_none_end_the_check() {
    let layout = boxes(2);
    assert_eq!(reasons(&layout, &[at(0, f64::NAN), at(1, f64::INFINITY)]), [NotFinite, NotFinite]);
    assert!(!check_sections(&layout, &side_by_side(2), f64::NAN).is_sound());
}

#[test]
fn copies_without_end_are_counted_within_bounds() {
    let mut layout = boxes(1);
    layout.sections[0].quantity = u32::MAX;
    let found = check(&layout, &side_by_side(1));
    assert_eq!(found.violations.len(), VIOLATION_LIMIT);
}

#[test]
fn all_in_one_place_is_answered_with_a_full_list() {
    let layout = boxes(3000);
    let order: Vec<PlacedSection> = (0..3000).map(|i| at(i, 0.0)).collect();
    let found = check(&layout, &order);
    assert_eq!(found.violations.len(), VIOLATION_LIMIT);
    assert!(found.violations.iter().all(|violation| violation.reason == SectionsOverlap));
}

#[test]
fn whoever_no_longer_wants_the_answer_gets_none() {
    assert_eq!(check_sections_while(&boxes(3), &side_by_side(3), TOLERANCE, &|| false), None);
}
