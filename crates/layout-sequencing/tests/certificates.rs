//! Certificates of bounds, recomputed by the checker: true ones hold, and no other one ever proves more than the shortest
//! layout that there is.

mod oracle;

use oracle::{Borders, section};
use rand::{Rng, RngExt};
use traverse_checker::{
    JoinPrices, LayoutCertificate, certificate_findings, certified_bound_mm, certified_bound_mm_while,
    claim_tolerance_mm,
};
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, Part, PlacedSection, Point, Polygon, Pose, Ring, Section, SectionLayout, SlideRule,
};
use traverse_layout_sequencing::{
    BoundCertificate, InnerOverlap, LayoutAnswer, OrderOptions, layout_length_mm, order_sections, place,
};
use traverse_solve::{Budget, Seed, Silent};

const BORDERS: [Borders; 3] = [Borders::Straight, Borders::Round, Borders::Steps];

fn ordered(layout: &SectionLayout) -> LayoutAnswer {
    let options = OrderOptions { inner_overlap: InnerOverlap::Allowed, ..OrderOptions::default() };
    let budget = Budget { iterations: Some(20_000), ..Budget::unlimited() };
    order_sections(layout, &options, &budget, &mut Silent).expect("no findings")
}

/// The engine's certificate in the checker's terms.
fn certificate_of(answer: &LayoutAnswer) -> Option<LayoutCertificate> {
    Some(match &answer.certificate {
        BoundCertificate::None => return None,
        BoundCertificate::Height { y_mm } => LayoutCertificate::Height { y_mm: *y_mm },
        BoundCertificate::Width { section } => LayoutCertificate::Width { section: *section },
        BoundCertificate::Joins(duals) => LayoutCertificate::Joins(JoinPrices {
            rows_mm: duals.row_mm.clone(),
            columns_mm: duals.column_mm.clone(),
            sets: duals.sets.clone(),
        }),
    })
}

/// A layout of chance: borders, gap, poses, copies, ends, forbidden joins.
fn layout_of_chance(count: usize, chance: &mut impl Rng) -> SectionLayout {
    let borders = BORDERS[chance.random_range(0..3)];
    let mut layout = oracle::layout((0..count).map(|i| section(&i.to_string(), borders, chance)).collect());
    layout.gap_mm = [0.0, 0.0, 0.5, 2.0, 30.0][chance.random_range(0..5)];
    for section in &mut layout.sections {
        match chance.random_range(0..4) {
            0 => section.poses = vec![Pose::AsIs, Pose::HalfTurn],
            1 => section.poses = vec![Pose::MirrorX, Pose::MirrorY],
            _ => {}
        }
    }
    if chance.random_bool(0.3) {
        layout.first = Some(chance.random_range(0..count));
    }
    if chance.random_bool(0.3) {
        layout.last = Some(chance.random_range(0..count)).filter(|last| layout.first != Some(*last));
    }
    if chance.random_bool(0.3) {
        layout.forbidden_joins = vec![(chance.random_range(0..count), chance.random_range(0..count))];
    }
    layout
}

#[test]
fn what_the_engine_certifies_the_checker_recomputes() {
    let (mut by_joins, mut by_height) = (0, 0);
    for seed in 0..240 {
        let mut chance = Seed(7_000 + seed).stream();
        let count = chance.random_range(2..12);
        let mut layout = layout_of_chance(count, &mut chance);
        let copied = chance.random_range(0..count);
        layout.sections[copied].quantity = chance.random_range(1..4);
        if seed % 4 == 0 {
            layout.slide_rule = SlideRule::Free;
        }
        if seed % 7 == 0 && layout.first.is_none() && layout.last.is_none() {
            layout.precedences = vec![(0, 1)];
        }
        let answer = ordered(&layout);
        let Some(certificate) = certificate_of(&answer) else { continue };
        assert_eq!(certificate_findings(&layout, &certificate), []);
        let (claimed, recomputed) =
            (answer.certified_lower_bound_mm, certified_bound_mm(&layout, &certificate));
        // The engine counts in nanometres, offsets rounded up.
        let tolerance = claim_tolerance_mm(&layout, CONTACT_TOLERANCE_MM);
        assert!(recomputed > claimed - tolerance, "{seed}: {recomputed} of {claimed}");
        if let Some(plan) = &answer.plan {
            assert!(recomputed <= plan.length_mm, "{seed}: {recomputed} above {}", plan.length_mm);
        }
        match &certificate {
            LayoutCertificate::Joins(_) => by_joins += 1,
            LayoutCertificate::Height { .. } => by_height += 1,
            LayoutCertificate::Width { .. } => {}
        }
    }
    assert!(by_joins > 80 && by_height > 20, "{by_joins} {by_height}");
}

/// A parallelogram of height 10 that leans by `lean` to the right.
fn leaning(id: &str, width: f64, lean: f64) -> Section {
    let ring = Ring::from_xy(&[0.0, 0.0, width, 0.0, width + lean, 10.0, lean, 10.0], &[]).expect("a ring");
    let shape = Polygon::from_ring(ring);
    let part = Part { id: id.into(), shape, pole: Point::origin(), rotation_rad: 0.0, mirrored: false };
    Section { id: id.into(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
}

#[test]
fn sets_that_every_layout_leaves_count() {
    // Some lean one way, some the other: among themselves they join without loss, so that prices of nodes alone prove as
    // much as if nobody had to go from the ones to the others.
    let leans = [8.0, 8.0, 8.0, -8.0, -8.0, -8.0];
    let sections = leans.iter().enumerate().map(|(i, &lean)| leaning(&i.to_string(), 3.0 + i as f64, lean));
    let layout = oracle::layout(sections.collect());
    let answer = ordered(&layout);
    let length = answer.plan.as_ref().map_or(0.0, |plan| plan.length_mm);
    let Some(LayoutCertificate::Joins(mut prices)) = certificate_of(&answer) else { panic!("duals") };
    let bound = |prices: JoinPrices| certified_bound_mm(&layout, &LayoutCertificate::Joins(prices));
    assert!((bound(prices.clone()) - answer.certified_lower_bound_mm).abs() < 1e-5);
    assert!(answer.certified_lower_bound_mm < length - 7.0);
    // The way to the ends may cost less: those who lean the same way have to be left in any case.
    prices.columns_mm[6] -= 8.0;
    prices.sets = vec![(vec![0, 1, 2], 8.0), (vec![3, 4, 5], 8.0)];
    let right = bound(prices.clone());
    assert!((right - length).abs() < 1e-5, "{right} of {length}");
    for set in 0..prices.sets.len() {
        for member in 0..prices.sets[set].0.len() {
            let mut smaller = prices.clone();
            smaller.sets[set].0.remove(member);
            assert!(bound(smaller) <= right + 1e-9, "{set} {member}");
            let mut larger = prices.clone();
            larger.sets[set].1 += 1.0;
            assert!(bound(larger) <= right + 1e-9, "{set} {member}");
        }
        let mut without = prices.clone();
        let weight = without.sets.remove(set).1;
        assert!((bound(without) - (right - weight)).abs() < 1e-6, "{set}");
    }
}

/// The length of the shortest of all layouts, every order and every pose; nothing when none is allowed.
fn shortest(layout: &SectionLayout) -> Option<f64> {
    let copies: Vec<(usize, u32)> = (layout.sections.iter().enumerate())
        .flat_map(|(section, of)| (0..of.quantity).map(move |copy| (section, copy)))
        .collect();
    let mut best: Option<f64> = None;
    let mut order: Vec<PlacedSection> = vec![];
    extend(layout, &copies, &mut order, &mut best);
    best
}

fn extend(
    layout: &SectionLayout,
    copies: &[(usize, u32)],
    order: &mut Vec<PlacedSection>,
    best: &mut Option<f64>,
) {
    if order.len() == copies.len() {
        if layout.last.is_none_or(|last| order.last().is_some_and(|placed| placed.section == last)) {
            let length = layout_length_mm(layout, &place(layout, order));
            *best = Some(best.map_or(length, |best| best.min(length)));
        }
        return;
    }
    for &(section, copy) in copies {
        let is_placed = order.iter().any(|placed| (placed.section, placed.copy) == (section, copy));
        // Copies are alike: in turn.
        let in_turn =
            copy == 0 || order.iter().any(|placed| (placed.section, placed.copy) == (section, copy - 1));
        let may_follow = match order.last() {
            None => layout.first.is_none_or(|first| first == section),
            Some(before) => !layout.forbidden_joins.contains(&(before.section, section)),
        };
        if is_placed || !in_turn || !may_follow {
            continue;
        }
        for &pose in &layout.sections[section].poses {
            order.push(PlacedSection { section, copy, pose, x_mm: 0.0 });
            extend(layout, copies, order, best);
            order.pop();
        }
    }
}

/// Changes a certificate somewhere, so that it may claim more.
fn corrupted(layout: &SectionLayout, from: &LayoutCertificate, chance: &mut impl Rng) -> LayoutCertificate {
    let mut changed = from.clone();
    match &mut changed {
        LayoutCertificate::Height { y_mm } => *y_mm = chance.random_range(-12.0..32.0),
        LayoutCertificate::Width { section } => *section = chance.random_range(0..layout.sections.len()),
        LayoutCertificate::Joins(prices) => {
            for _ in 0..chance.random_range(1..4) {
                let node = chance.random_range(0..prices.rows_mm.len());
                let by = [1e-3, 0.1, 5.0, 1e4][chance.random_range(0..4)];
                match chance.random_range(0..6) {
                    0 => prices.rows_mm[node] += by,
                    1 => prices.columns_mm[node] += by,
                    2 => prices.sets.push((vec![node], by)),
                    3 => {
                        let size = chance.random_range(1..prices.rows_mm.len());
                        prices.sets.push(((0..size).collect(), by));
                    }
                    4 => {
                        if let Some((_, weight)) = prices.sets.first_mut() {
                            *weight += by;
                        }
                    }
                    _ => {
                        if let Some((members, _)) = prices.sets.iter_mut().find(|(set, _)| set.len() > 1) {
                            members.pop();
                        }
                    }
                }
            }
        }
    }
    changed
}

#[test]
fn no_certificate_proves_more_than_the_shortest_layout() {
    let (mut tried, mut useful) = (0, 0);
    for seed in 0..60 {
        let mut chance = Seed(9_000 + seed).stream();
        let count = chance.random_range(2..5);
        let mut layout = layout_of_chance(count, &mut chance);
        if count < 4 {
            layout.sections[0].quantity = 2;
        }
        let Some(shortest) = shortest(&layout) else { continue };
        let answer = ordered(&layout);
        let mut certificates: Vec<LayoutCertificate> = certificate_of(&answer).into_iter().collect();
        certificates.push(LayoutCertificate::Height { y_mm: 3.0 });
        certificates.push(LayoutCertificate::Width { section: 0 });
        let nothing = vec![0.0; count + 1];
        certificates.push(LayoutCertificate::Joins(JoinPrices {
            rows_mm: nothing.clone(),
            columns_mm: nothing,
            sets: vec![],
        }));
        for certificate in certificates {
            for _ in 0..40 {
                let wrong = corrupted(&layout, &certificate, &mut chance);
                let bound = certified_bound_mm(&layout, &wrong);
                assert!(bound <= shortest + 1e-9, "{seed}: {bound} above {shortest}: {wrong:?}");
                assert!(bound >= 0.0);
                tried += 1;
                useful += usize::from(bound > shortest / 2.0);
            }
        }
    }
    assert!(tried > 5_000 && useful > 1_000, "{tried} {useful}");
}

#[test]
fn a_price_too_high_costs_no_more_than_itself() {
    let mut chance = Seed(3).stream();
    let layout =
        oracle::layout((0..8).map(|i| section(&i.to_string(), Borders::Round, &mut chance)).collect());
    let answer = ordered(&layout);
    let Some(LayoutCertificate::Joins(prices)) = certificate_of(&answer) else { panic!("duals") };
    let bound = |prices: &JoinPrices| certified_bound_mm(&layout, &LayoutCertificate::Joins(prices.clone()));
    let right = bound(&prices);
    for node in 0..9 {
        let mut higher = prices.clone();
        higher.rows_mm[node] += 50.0;
        assert!((bound(&higher) - right).abs() < 1e-3, "{node}");
        let mut lower = prices.clone();
        lower.columns_mm[node] -= 1.0;
        assert!((bound(&lower) - (right - 1.0)).abs() < 1e-3, "{node}");
    }
}

#[test]
fn a_check_that_is_given_up_says_nothing() {
    let mut chance = Seed(4).stream();
    let layout = layout_of_chance(6, &mut chance);
    let certificate = certificate_of(&ordered(&layout)).expect("a certificate");
    assert_eq!(certified_bound_mm_while(&layout, &certificate, &|| false), None);
}
