//! Bounds of certificates on layouts whose lengths are known by hand, and certificates that make no sense.

use crate::making::*;
use std::cell::Cell;
use traverse_checker::{
    BoundClaim, CERTIFIED_PAIR_LIMIT, JoinPrices, LayoutCertificate, ViolationReason, certificate_findings,
    certified_bound_mm, certified_bound_mm_while, check_certified_sections_while, claim_tolerance_mm,
};
use traverse_geometry::{PlacedSection, Point, Pose, Reason, Section, SectionLayout, SlideRule};

fn joins(rows_mm: &[f64], columns_mm: &[f64], sets: &[(&[usize], f64)]) -> LayoutCertificate {
    LayoutCertificate::Joins(JoinPrices {
        rows_mm: rows_mm.to_vec(),
        columns_mm: columns_mm.to_vec(),
        sets: sets.iter().map(|(nodes, weight)| (nodes.to_vec(), *weight)).collect(),
    })
}

fn as_is(id: &str, parts: Vec<traverse_geometry::Part>) -> Section {
    Section { poses: vec![Pose::AsIs], ..section(id, parts) }
}

/// Boxes 10 and 6 wide, 2 apart.
fn boxes() -> SectionLayout {
    let sections = vec![
        as_is("wide", vec![rectangle("p", 3.0, 0.0, 13.0, 10.0)]),
        as_is("slim", vec![rectangle("p", -1.0, 0.0, 5.0, 10.0)]),
    ];
    SectionLayout { gap_mm: 2.0, ..layout(sections) }
}

fn near(found: f64, wanted: f64) {
    assert!(found <= wanted && found > wanted - 1e-9 && found >= 0.0, "{found}, not {wanted}");
}

#[test]
fn widths_and_gaps_of_boxes_add_up() {
    let layout = boxes();
    // To the ends the gap is missing: their price takes it back.
    near(certified_bound_mm(&layout, &joins(&[12.0, 8.0, 0.0], &[0.0, 0.0, -2.0], &[])), 18.0);
    // Without that, the rows are too dear by the gap.
    near(certified_bound_mm(&layout, &joins(&[12.0, 8.0, 0.0], &[0.0; 3], &[])), 18.0);
    near(certified_bound_mm(&layout, &LayoutCertificate::Height { y_mm: 10.0 }), 18.0);
    near(certified_bound_mm(&layout, &LayoutCertificate::Height { y_mm: 10.1 }), 0.0);
    near(certified_bound_mm(&layout, &LayoutCertificate::Width { section: 0 }), 10.0);
}

#[test]
fn copies_count_each() {
    let mut layout = boxes();
    layout.sections[0].quantity = 3;
    near(certified_bound_mm(&layout, &joins(&[12.0, 8.0, 0.0], &[0.0, 0.0, -2.0], &[])), 42.0);
    near(certified_bound_mm(&layout, &LayoutCertificate::Height { y_mm: 0.0 }), 42.0);
}

#[test]
fn the_best_pose_counts() {
    // A wedge that another one fits into once it is turned.
    let wedge = |id: &str, poses: &[Pose]| Section {
        poses: poses.to_vec(),
        ..section(id, vec![part("p", &[0.0, 0.0, 10.0, 0.0, 4.0, 10.0, 0.0, 10.0], &[])])
    };
    let of = |poses: &[Pose]| layout(vec![wedge("a", poses), wedge("b", poses)]);
    let prices = joins(&[10.0, 10.0, 0.0], &[0.0; 3], &[]);
    near(certified_bound_mm(&of(&[Pose::AsIs]), &prices), 20.0);
    // Turned, one stands 4 right of the other.
    near(
        certified_bound_mm(
            &of(&[Pose::AsIs, Pose::HalfTurn]),
            &joins(&[4.0, 4.0, 0.0], &[0.0, 0.0, 6.0], &[]),
        ),
        14.0,
    );
    let turned = certified_bound_mm(&of(&[Pose::AsIs, Pose::HalfTurn]), &prices);
    assert!(turned <= 14.0, "{turned}");
}

#[test]
fn what_must_not_be_neighbours_or_come_first_is_no_arc() {
    let mut layout = boxes();
    // The wide one first, the slim one last: nothing else has to be paid.
    layout.first = Some(0);
    layout.last = Some(1);
    near(certified_bound_mm(&layout, &joins(&[1.0, 5.0, 3.0], &[-3.0, 7.0, 1.0], &[])), 14.0);
    // Only slim and then wide is left: what stands right of the wide one may be as dear as one likes.
    (layout.first, layout.last) = (None, None);
    let prices = joins(&[20.0, 8.0, 0.0], &[0.0, 0.0, -10.0], &[]);
    layout.forbidden_joins = vec![(0, 1)];
    near(certified_bound_mm(&layout, &prices), 18.0);
    layout.forbidden_joins.clear();
    near(certified_bound_mm(&layout, &prices), 10.0);
}

#[test]
fn sections_that_pass_each_other_cost_nothing() {
    let above = as_is("above", vec![rectangle("p", 0.0, 20.0, 10.0, 30.0)]);
    let below = as_is("below", vec![rectangle("p", 0.0, 0.0, 10.0, 10.0)]);
    let mut layout = layout(vec![above, below]);
    let widest = joins(&[0.0; 3], &[0.0, 0.0, 10.0], &[]);
    let side_by_side = joins(&[10.0, 10.0, 0.0], &[0.0; 3], &[]);
    for gap in [0.0, 9.999] {
        layout.gap_mm = gap;
        near(certified_bound_mm(&layout, &widest), 10.0);
        near(certified_bound_mm(&layout, &side_by_side), 0.0);
    }
    // Exactly a gap apart they touch.
    layout.gap_mm = 10.0;
    near(certified_bound_mm(&layout, &side_by_side), 20.0);
}

#[test]
fn prices_that_are_nonsense_prove_nothing() {
    let layout = boxes();
    for huge in [1e12, 1e11] {
        for prices in [
            joins(&[huge, -huge, huge], &[huge; 3], &[]),
            joins(&[huge, huge, -2.0 * huge / 2.0], &[-huge, huge, huge], &[(&[0], huge)]),
            joins(&[0.0; 3], &[0.0; 3], &[(&[0], huge), (&[1, 2], huge)]),
            joins(&[-huge; 3], &[-huge; 3], &[]),
        ] {
            let bound = certified_bound_mm(&layout, &prices);
            assert!((0.0..=18.0).contains(&bound), "{bound}");
        }
    }
}

fn fields(layout: &SectionLayout, certificate: &LayoutCertificate) -> Vec<(String, Reason)> {
    assert!(certified_bound_mm(layout, certificate) == 0.0);
    certificate_findings(layout, certificate).into_iter().map(|it| (it.field, it.reason)).collect()
}

#[test]
fn what_does_not_fit_the_layout_is_found() {
    let layout = boxes();
    let found = |certificate: LayoutCertificate| fields(&layout, &certificate);
    let wrong = |field: &str| vec![(field.to_owned(), Reason::OutOfRange)];
    assert_eq!(found(joins(&[0.0; 2], &[0.0; 3], &[])), wrong("row_duals"));
    assert_eq!(found(joins(&[0.0; 3], &[], &[])), wrong("column_duals"));
    assert_eq!(found(joins(&[0.0; 3], &[0.0, 1e13, 0.0], &[])), wrong("column_duals[1]"));
    assert_eq!(found(joins(&[0.0; 3], &[0.0; 3], &[(&[0], -1.0)])), wrong("sets[0].weight"));
    assert_eq!(found(joins(&[0.0; 3], &[0.0; 3], &[(&[0, 3], 1.0)])), wrong("sets[0].nodes[1]"));
    assert_eq!(found(joins(&[0.0; 3], &[0.0; 3], &[(&[1, 1], 1.0)])), wrong("sets[0].nodes[1]"));
    assert_eq!(found(joins(&[0.0; 3], &[0.0; 3], &[(&[], 1.0)])), wrong("sets[0].nodes"));
    assert_eq!(found(joins(&[0.0; 3], &[0.0; 3], &[(&[0, 1, 2], 1.0)])), wrong("sets[0].nodes"));
    let nan = |field: &str| vec![(field.to_owned(), Reason::NotFinite)];
    assert_eq!(found(joins(&[f64::NAN, 0.0, 0.0], &[0.0; 3], &[])), nan("row_duals[0]"));
    assert_eq!(found(joins(&[0.0; 3], &[0.0; 3], &[(&[0], f64::INFINITY)])), nan("sets[0].weight"));
    assert_eq!(found(LayoutCertificate::Height { y_mm: f64::NAN }), nan("height_mm"));
    let unknown = vec![("section_id".to_owned(), Reason::UnknownId)];
    assert_eq!(found(LayoutCertificate::Width { section: 2 }), unknown);
    let free = SectionLayout { slide_rule: SlideRule::Free, ..boxes() };
    let prices = joins(&[0.0; 3], &[0.0; 3], &[]);
    assert_eq!(fields(&free, &prices), [("row_duals".to_owned(), Reason::NotApplicable)]);
}

#[test]
fn too_many_pairs_are_refused() {
    let count = CERTIFIED_PAIR_LIMIT.isqrt() / 4 + 1;
    let sections = (0..count).map(|i| section(&i.to_string(), vec![rectangle("p", 0.0, 0.0, 1.0, 1.0)]));
    let layout = layout(sections.collect());
    let prices = joins(&vec![0.0; count + 1], &vec![0.0; count + 1], &[]);
    assert_eq!(fields(&layout, &prices), [("row_duals".to_owned(), Reason::TooMany)]);
}

#[test]
fn claims_are_compared_join_by_join() {
    let mut layout = boxes();
    assert_eq!(claim_tolerance_mm(&layout, 1e-6), 3e-6);
    layout.sections[1].quantity = 9;
    assert_eq!(claim_tolerance_mm(&layout, 1e-3), 11e-3);
}

#[test]
fn a_claim_beyond_what_is_proven_is_a_violation_beside_the_layouts_own() {
    let layout = boxes();
    let claimed = |mm: Option<f64>, order: &[PlacedSection]| {
        let certificate = LayoutCertificate::Height { y_mm: 5.0 };
        let claim = BoundClaim { certificate, lower_bound_mm: mm };
        check_certified_sections_while(&layout, order, &claim, TOLERANCE, &|| true).expect("not given up")
    };
    let order = [at(0, 0.0), at(1, 12.0)];
    for sound in [None, Some(0.0), Some(18.0), Some(18.0 + 2.9e-6)] {
        let found = claimed(sound, &order);
        assert!(found.is_sound(), "{:?}", found.violations);
        near(found.certified_bound_mm.expect("asked for"), 18.0);
    }
    let found = claimed(Some(18.5), &order);
    let [violation] = &found.violations[..] else { panic!("{found:?}") };
    assert_eq!(violation.reason, ViolationReason::BoundNotProven);
    assert!((violation.amount - 0.5).abs() < 1e-9, "{violation}");
    let nearer = claimed(Some(f64::NAN), &[at(0, 0.0), at(1, 11.0)]);
    let reasons: Vec<_> = nearer.violations.iter().map(|violation| violation.reason).collect();
    assert_eq!(reasons, [ViolationReason::SectionsTooClose, ViolationReason::BoundNotProven]);
}

#[test]
fn heights_a_rounding_error_too_far_apart_do_not_meet() {
    // Their difference is rounded to the gap.
    let of = |top: f64, bottom: f64, gap: f64, poses: &[Pose]| {
        let in_poses = |section: Section| Section { poses: poses.to_vec(), ..section };
        let below = in_poses(as_is("below", vec![rectangle("p", 0.0, -20.0, 100.0, top)]));
        let above = in_poses(as_is("above", vec![rectangle("p", 0.0, bottom, 100.0, 20.0)]));
        SectionLayout { gap_mm: gap, ..layout(vec![below, above]) }
    };
    let as_one = joins(&[100.0, 100.0, 0.0], &[0.0; 3], &[]);
    let with_gap = joins(&[108.0, 100.0, 0.0], &[0.0; 3], &[]);
    for poses in [&[Pose::AsIs][..], &[Pose::MirrorX]] {
        let bound = |bottom: f64| certified_bound_mm(&of(-5.0, bottom, 8.0, poses), &with_gap);
        assert!(bound(3.0) > 200.0 - 1e-9);
        assert!(bound(3.0_f64.next_down()) > 200.0 - 1e-9);
        let above = 3.0_f64.next_up();
        assert_eq!(above - -5.0, 8.0);
        assert!(bound(above) <= 100.0, "{}", bound(above));
    }
    // Without a gap heights are as exact as they are sent.
    near(certified_bound_mm(&of(0.3, 0.3, 0.0, &[Pose::AsIs]), &as_one), 200.0);
    assert!(certified_bound_mm(&of(0.3, 0.3_f64.next_up(), 0.0, &[Pose::AsIs]), &as_one) <= 100.0);
}

#[test]
fn what_stands_upside_down_meets_what_the_poses_motion_says() {
    let prices = joins(&[100.0, 100.0, 0.0], &[0.0; 3], &[]);
    for i in 1..200 {
        // Turned, its step comes to lie below a thin post that passes the other section.
        let step = f64::from(i) / 300.0;
        let parts = vec![rectangle("p", 0.0, step, 100.0, 90.7), rectangle("post", 0.0, -9.3, 1.0, step)];
        let stepped = Section { poses: vec![Pose::MirrorY], ..as_is("stepped", parts) };
        let bounds = stepped.bounds();
        let top = Pose::MirrorY.motion(&bounds).point(Point::new(0.0, step)).y;
        let bound = |bottom: f64| {
            let above = as_is("above", vec![rectangle("p", 0.0, bottom, 100.0, bottom + 100.0)]);
            certified_bound_mm(&layout(vec![stepped.clone(), above]), &prices)
        };
        assert!(bound(top.next_up()) <= 101.0, "{i}: {}", bound(top.next_up()));
        near(bound(top), 200.0);
        near(bound(top - 1e-9), 200.0);
    }
}

#[test]
fn tops_of_arcs_do_not_meet_what_begins_above_them() {
    for i in 1..200 {
        // 3, 4, 5: centre, radius and top are as exact as the vertices.
        let (size, top) = (8.0 + f64::from(i % 3), f64::from(i) / 1024.0);
        let (x, y) = (100.0 - 5.0 * size, top - 5.0 * size);
        let ends = [x - 3.0 * size, y - 4.0 * size, x + 3.0 * size, y + 4.0 * size];
        let parts = vec![part("disc", &ends, &[1.0, 1.0]), rectangle("q", 0.0, -200.0, 100.0, -199.0)];
        let disc = as_is("disc", parts);
        let left_over = x.min(100.0 - x);
        let prices = joins(&[x, 100.0 - x, 0.0], &[0.0, 0.0, left_over], &[]);
        let bound = |bottom: f64| {
            let above = as_is("above", vec![rectangle("p", 0.0, bottom, 100.0, 40.0)]);
            certified_bound_mm(&layout(vec![disc.clone(), above]), &prices)
        };
        assert!(bound(top.next_up()) <= 100.0, "{i}: {}", bound(top.next_up()));
        near(bound(top - 1e-9), 100.0 + left_over);
    }
}

#[test]
fn what_is_no_layout_proves_nothing() {
    let prices = joins(&[1e6], &[1e6], &[]);
    assert_eq!(certified_bound_mm(&layout(Vec::new()), &prices), 0.0);
    let mut none_of_one = layout(vec![as_is("s", vec![rectangle("p", 0.0, 0.0, 1.0, 1.0)])]);
    none_of_one.sections[0].quantity = 0;
    for certificate in [joins(&[0.0, 1e6], &[-1e6, 0.0], &[]), LayoutCertificate::Width { section: 0 }] {
        assert_eq!(certified_bound_mm(&none_of_one, &certificate), 0.0);
    }
}

/// A saw of points that look to the right: as many bands as there are.
fn saw(id: &str, points: usize) -> Section {
    let mut xy = vec![0.0, 0.0];
    for point in 0..points {
        let y = point as f64;
        xy.extend([10.0, y + 0.25, 9.0 + (point % 7) as f64 / 10.0, y + 0.75]);
    }
    xy.extend([0.0, points as f64]);
    as_is(id, vec![part("p", &xy, &[])])
}

#[test]
fn a_no_ends_the_check_wherever_it_comes() {
    // Every band of one is near every band of the other.
    let layout = SectionLayout { gap_mm: 1e5, ..layout(vec![saw("a", 4_000), saw("b", 4_000)]) };
    let certificate = joins(&[1.0, 1.0, 0.0], &[0.0; 3], &[]);
    let asked = Cell::new(0);
    let until = |last: usize| {
        asked.set(0);
        let go_on = || {
            asked.set(asked.get() + 1);
            asked.get() <= last
        };
        certified_bound_mm_while(&layout, &certificate, &go_on)
    };
    assert!(until(usize::MAX).is_some());
    let in_all = asked.get();
    // Two pairs of sections have a million pairs of bands each.
    assert!(in_all > 2_000_000 / 1_000, "{in_all}");
    for share in 0..10 {
        assert_eq!(until(in_all * share / 10), None);
        assert_eq!(asked.get(), in_all * share / 10 + 1, "asked again after a no");
    }
}
