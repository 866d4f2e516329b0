//! Blocks of part sets of our own making, ordered and placed, and judged by the checker, which shares nothing with what
//! ordered them: every layout is sound, every contact is tight, and the published effect overlaps where it must.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use rand::RngExt;
use traverse_checker::{ViolationReason, check_sections, part_overlaps_while};
use traverse_drawing::{BlockRules, build_blocks, read_part_set};
use traverse_geometry::{CONTACT_TOLERANCE_MM, PlacedSection, Pose, Section, SectionLayout, SlideRule};
use traverse_layout_sequencing::{
    OrderOptions, contacts, join, order_sections, place, place_as_published, published_effect,
};
use traverse_solve::{Budget, Seed, Silent};

/// A part set as JSON: pieces of every shape between a slab and a star, as part sets of the literature have them.
fn part_set(seed: u64) -> String {
    let mut chance = Seed(seed).stream();
    let mut items = Vec::new();
    for _ in 0..8 {
        let corners = chance.random_range(3..9);
        let (wide, high) = (chance.random_range(8.0..45.0), chance.random_range(8.0..45.0));
        let vertices: Vec<String> = (0..corners)
            .map(|corner| {
                let angle = std::f64::consts::TAU * (f64::from(corner) + chance.random_range(0.0..0.7))
                    / f64::from(corners);
                let reach = chance.random_range(0.35..1.0);
                format!("[{}, {}]", wide * reach * angle.cos(), high * reach * angle.sin())
            })
            .collect();
        let demand = chance.random_range(1..4);
        items.push(format!(
            r#"{{"demand": {demand}, "allowed_orientations": [0, 90, 180], "shape": {{"data": [{}]}}}}"#,
            vertices.join(", ")
        ));
    }
    format!(r#"{{"strip_height": 100, "items": [{}]}}"#, items.join(", "))
}

fn blocks(seed: u64, count: usize, poses: &[Pose]) -> Vec<Section> {
    let set = read_part_set(part_set(seed).as_bytes()).unwrap();
    let rules = BlockRules { count: Some(count), seed, poses: poses.to_vec(), ..BlockRules::default() };
    build_blocks(&set, &rules).unwrap()
}

fn layout(sections: Vec<Section>, gap_mm: f64, slide_rule: SlideRule) -> SectionLayout {
    SectionLayout {
        sections,
        gap_mm,
        strip_height_mm: Some(100.0),
        first: None,
        last: None,
        precedences: Vec::new(),
        forbidden_joins: Vec::new(),
        slide_rule,
    }
}

/// Sound, and tight: whatever touches is refused ten tolerances nearer along the line of contact.
fn assert_sound_and_tight(layout: &SectionLayout, order: &[PlacedSection]) {
    let found = check_sections(layout, order, CONTACT_TOLERANCE_MM);
    assert!(found.is_sound(), "{:#?}", found.violations);
    for contact in contacts(layout, order) {
        let between = contact.point - contact.against_point;
        // Without a gap the direction of contact is not known; with one a level contact has no share of x.
        let share = if layout.gap_mm > 0.0 { between.x.abs() / between.norm() } else { 0.3 };
        if share < 0.1 {
            continue;
        }
        let mut nearer = order.to_vec();
        nearer[contact.index].x_mm -= 10.0 * CONTACT_TOLERANCE_MM / share;
        let found = check_sections(layout, &nearer, CONTACT_TOLERANCE_MM);
        let is_refused = found.violations.iter().any(|violation| {
            matches!(violation.reason, ViolationReason::SectionsOverlap | ViolationReason::SectionsTooClose)
        });
        // A level edge without a gap takes hardly any of the shift.
        assert!(is_refused || layout.gap_mm == 0.0, "{contact:?} is not tight");
    }
}

#[test]
fn what_is_ordered_is_sound_by_every_rule() {
    for seed in 0..4 {
        for (poses, gap, slide) in [
            (&[Pose::AsIs][..], 0.0, SlideRule::KeepOrder),
            (&[Pose::AsIs, Pose::HalfTurn], 2.5, SlideRule::KeepOrder),
            (&Pose::ALL, 0.5, SlideRule::Free),
        ] {
            let layout = layout(blocks(seed, 6, poses), gap, slide);
            for section in &layout.sections {
                let overlaps = part_overlaps_while(section, CONTACT_TOLERANCE_MM, &|| true).unwrap();
                assert_eq!(overlaps, [], "{}", section.id);
            }
            let budget = Budget { iterations: Some(2_000), ..Budget::unlimited() };
            let answer = order_sections(&layout, &OrderOptions::default(), &budget, &mut Silent).unwrap();
            let plan = answer.plan.unwrap();
            assert!(answer.lower_bound_mm <= plan.length_mm + 1e-9);
            assert!(answer.certified_lower_bound_mm <= answer.lower_bound_mm + 1e-9);
            let found = check_sections(&layout, &plan.order, CONTACT_TOLERANCE_MM);
            assert!((found.length_mm - plan.length_mm).abs() < 1e-9);
            assert_sound_and_tight(&layout, &plan.order);
        }
    }
}

/// Every section in an order of chance, in a pose of chance.
fn shuffled(layout: &SectionLayout, seed: u64) -> Vec<PlacedSection> {
    let mut chance = Seed(seed).stream();
    let mut order: Vec<PlacedSection> = (layout.sections.iter().enumerate())
        .map(|(section, of)| {
            let pose = of.poses[chance.random_range(0..of.poses.len())];
            PlacedSection { section, copy: 0, pose, x_mm: 0.0 }
        })
        .collect();
    for last in (1..order.len()).rev() {
        order.swap(last, chance.random_range(0..=last));
    }
    order
}

#[test]
fn layouts_of_chance_never_overlap() {
    for seed in 0..150 {
        let gap = [0.0, 1.25, 6.0][seed as usize % 3];
        let slide = if seed % 2 == 0 { SlideRule::KeepOrder } else { SlideRule::Free };
        let layout = layout(blocks(seed, 8, &Pose::ALL), gap, slide);
        assert_sound_and_tight(&layout, &place(&layout, &shuffled(&layout, seed)));
    }
}

#[test]
fn the_published_effect_overlaps_and_the_checker_shows_it() {
    let mut overlapping = 0;
    for seed in 0..60 {
        let layout = layout(blocks(seed, 8, &[Pose::AsIs]), 0.0, SlideRule::KeepOrder);
        let order = place_as_published(&layout, &shuffled(&layout, seed));
        let found = check_sections(&layout, &order, CONTACT_TOLERANCE_MM);
        overlapping +=
            u32::from(found.violations.iter().any(|it| it.reason == ViolationReason::SectionsOverlap));
    }
    assert!(overlapping >= 3, "only {overlapping} of 60 layouts overlap");
}

#[test]
fn the_worked_example_is_nine_as_published_and_six_in_truth() {
    let section = |id: &str, xy: &[f64]| {
        let ring = traverse_geometry::Ring::from_xy(xy, &[]).unwrap();
        let part = traverse_geometry::Part {
            id: "part".into(),
            shape: traverse_geometry::Polygon::from_ring(ring),
            pole: traverse_geometry::Point::origin(),
            rotation_rad: 0.0,
            mirrored: false,
        };
        Section { id: id.into(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
    };
    let left = section("left", &[-20.0, 0.0, 0.0, 0.0, 10.0, 10.0, -20.0, 10.0]);
    let right = section("right", &[10.0, 0.0, 40.0, 0.0, 40.0, 10.0, 19.0, 10.0, 12.0, 6.0]);
    assert!((published_effect((&left, Pose::AsIs), (&right, Pose::AsIs)) - 9.0).abs() < 1e-9);
    assert!((join((&left, Pose::AsIs), (&right, Pose::AsIs), 0.0).effect_mm - 6.0).abs() < 1e-5);
    let layout = layout(vec![left, right], 0.0, SlideRule::KeepOrder);
    let order = shuffled(&layout, 0);
    let order: Vec<PlacedSection> =
        [0, 1].iter().map(|&it| *order.iter().find(|p| p.section == it).unwrap()).collect();
    let found = check_sections(&layout, &place_as_published(&layout, &order), CONTACT_TOLERANCE_MM);
    let [violation] = &found.violations[..] else { panic!("{found:?}") };
    assert_eq!(violation.reason, ViolationReason::SectionsOverlap);
    // 3 mm along x of an edge that leans by 45 degrees.
    assert!((violation.amount - 3.0 / 2.0_f64.sqrt()).abs() < 1e-6, "{violation}");
    assert_sound_and_tight(&layout, &place(&layout, &order));
}
