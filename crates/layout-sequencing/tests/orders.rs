//! Orders against every order there is, placed by joins one by one, and those joins against distances of all edges.

mod oracle;

use oracle::{Borders, least_margin, section, standing, stopped};
use rand::{Rng, RngExt};
use std::collections::HashMap;
use traverse_geometry::{Point, Polygon, Pose, Ring, SectionLayout, SlideRule};
use traverse_layout_sequencing::{Ending, OrderOptions, join, layout_findings, order_sections, place};
use traverse_solve::{Budget, Seed, Trace};

/// A layout of at most six copies with everything that can be asked.
fn layout_of_chance(borders: Borders, chance: &mut impl Rng) -> SectionLayout {
    let count = chance.random_range(1..=4);
    let mut sections: Vec<_> = (0..count).map(|i| section(&i.to_string(), borders, chance)).collect();
    let mut left: u32 = 6 - count;
    for section in &mut sections {
        let more = chance.random_range(0..=left.min(2));
        section.quantity += more;
        left -= more;
        if chance.random_bool(0.4) {
            section.poses = Pose::ALL[..chance.random_range(1..=4)].to_vec();
        }
    }
    let mut layout = oracle::layout(sections);
    let any = |chance: &mut dyn Rng| chance.random_range(0..count) as usize;
    layout.gap_mm = [0.0, 0.0, 0.5][chance.random_range(0..3)];
    layout.slide_rule = [SlideRule::KeepOrder, SlideRule::Free][chance.random_range(0..2)];
    if chance.random_bool(0.2) {
        layout.first = Some(any(chance));
    }
    if chance.random_bool(0.2) {
        layout.last = Some(any(chance));
    }
    if chance.random_bool(0.3) {
        layout.precedences.push((any(chance), any(chance)));
    }
    for _ in 0..chance.random_range(0..3) {
        if chance.random_bool(0.4) {
            layout.forbidden_joins.push((any(chance), any(chance)));
        }
    }
    layout
}

/// What stands where: section and pose.
type Standing = (usize, Pose);

/// The least length of all orders and poses; nothing when none is allowed.
fn shortest(
    layout: &SectionLayout,
    offset: &mut dyn FnMut(Standing, Standing) -> Option<f64>,
) -> Option<f64> {
    let mut left: Vec<u32> = layout.sections.iter().map(|section| section.quantity).collect();
    let mut best = None;
    extend(layout, offset, &mut vec![], &mut left, &mut best);
    best
}

fn extend(
    layout: &SectionLayout,
    offset: &mut dyn FnMut(Standing, Standing) -> Option<f64>,
    placed: &mut Vec<(Standing, f64)>,
    left: &mut [u32],
    best: &mut Option<f64>,
) {
    if left.iter().all(|&left| left == 0) {
        let width = |section: usize| layout.sections[section].bounds().size().x;
        let ends = placed.iter().map(|&((section, _), x)| x + width(section));
        let length = ends.fold(0.0, f64::max);
        if layout.last.is_none_or(|last| placed.last().is_some_and(|placed| placed.0.0 == last)) {
            *best = Some(best.map_or(length, |best: f64| best.min(length)));
        }
        return;
    }
    for next in 0..left.len() {
        let before = placed.last().map(|last| last.0.0);
        let barred = left[next] == 0
            || layout.precedences.iter().any(|&(a, b)| b == next && left[a] > 0)
            || before.is_some_and(|before| layout.forbidden_joins.contains(&(before, next)))
            || (before.is_none() && layout.first.is_some_and(|first| first != next));
        if barred {
            continue;
        }
        left[next] -= 1;
        for &pose in &layout.sections[next].poses {
            let start = match layout.slide_rule {
                SlideRule::KeepOrder => placed.last().map_or(0.0, |last| last.1),
                SlideRule::Free => 0.0,
            };
            let mut x = start;
            for &(earlier, at) in placed.iter() {
                if let Some(offset) = offset(earlier, (next, pose)) {
                    x = x.max(at + offset);
                }
            }
            placed.push(((next, pose), x));
            extend(layout, offset, placed, left, best);
            placed.pop();
        }
        left[next] += 1;
    }
}

fn check_case(layout: &SectionLayout, name: &str, by_distances: bool) -> Ending {
    let mut known: HashMap<(Standing, Standing), Option<f64>> = HashMap::new();
    let mut offset = |left: Standing, right: Standing| {
        *known.entry((left, right)).or_insert_with(|| {
            let (a, b) = (&layout.sections[left.0], &layout.sections[right.0]);
            if by_distances {
                let from = a.bounds().size().x + layout.gap_mm + 1.0;
                let until = -b.bounds().size().x - layout.gap_mm - 1.0;
                stopped(&standing(a, left.1, 0.0), |x| standing(b, right.1, x), from, until, layout.gap_mm)
            } else {
                join((a, left.1), (b, right.1), layout.gap_mm).offset_mm
            }
        })
    };
    let optimum = shortest(layout, &mut offset);
    let options = OrderOptions {
        inner_overlap: traverse_layout_sequencing::InnerOverlap::Allowed,
        ..Default::default()
    };
    let mut trace = Trace::default();
    let answer = order_sections(layout, &options, &Budget::unlimited(), &mut trace).expect("no findings");
    let Some(optimum) = optimum else {
        assert_eq!((answer.ending, answer.plan), (Ending::ProvenInfeasible, None), "{name}");
        return Ending::ProvenInfeasible;
    };
    assert!(answer.plan.is_some(), "{name}: no plan of {optimum}");
    let plan = answer.plan.as_ref().expect("just looked at");
    assert_eq!(answer.ending, Ending::ProvenOptimal, "{name}: {} of {optimum}", plan.length_mm);
    assert!((plan.length_mm - optimum).abs() < 2e-5, "{name}: {} is not {optimum}", plan.length_mm);
    assert_eq!(answer.lower_bound_mm, plan.length_mm, "{name}");
    assert!(answer.certified_lower_bound_mm <= plan.length_mm, "{name}");
    assert!(plan.bounding_box_length_mm >= plan.length_mm - 1e-5, "{name}");
    assert_eq!(place(layout, &plan.order), plan.order, "{name}");
    assert!(least_margin(layout, &plan.order) > -1e-6, "{name}: overlap");
    assert!(trace.bounds.windows(2).all(|pair| pair[0] < pair[1]), "{name}");
    assert!(trace.costs.windows(2).all(|pair| pair[0] > pair[1]), "{name}");
    for contact in &plan.contacts {
        let apart = (contact.point - contact.against_point).norm();
        assert!((apart - layout.gap_mm).abs() < 3e-6, "{name}: {contact:?}");
    }
    answer.ending
}

#[test]
fn answers_are_the_shortest_of_all_orders() {
    let (mut optimal, mut infeasible) = (0, 0);
    for (seed, borders) in [(1, Borders::Straight), (2, Borders::Round), (3, Borders::Steps)] {
        let mut chance = Seed(seed).stream();
        for case in 0..120 {
            let layout = layout_of_chance(borders, &mut chance);
            let options = OrderOptions {
                inner_overlap: traverse_layout_sequencing::InnerOverlap::Allowed,
                ..Default::default()
            };
            if !layout_findings(&layout, &options, &Budget::unlimited()).unwrap().is_empty() {
                continue;
            }
            // Where heights are equal or arcs graze, the way of distances may end early.
            let by_distances = borders == Borders::Straight && case % 3 == 0;
            match check_case(&layout, &format!("{borders:?} {case}"), by_distances) {
                Ending::ProvenOptimal => optimal += 1,
                _ => infeasible += 1,
            }
        }
    }
    assert!(optimal > 200 && infeasible > 10, "{optimal} {infeasible}");
}

/// The layout with every width so many times as large; what has an even number stands `lift_mm` higher.
fn widened(layout: &SectionLayout, times: f64, lift_mm: f64) -> SectionLayout {
    let mut wide = SectionLayout { gap_mm: 0.0, ..layout.clone() };
    for (number, section) in wide.sections.iter_mut().enumerate() {
        let lift = if number % 2 == 0 { lift_mm } else { 0.0 };
        for part in &mut section.parts {
            let shape = part.in_section();
            let xy = shape.outer().vertices().iter().flat_map(|p| [p.x * times, p.y + lift]);
            let ring = Ring::from_xy(&xy.collect::<Vec<_>>(), &[]).expect("as sound as before");
            part.shape = Polygon::from_ring(ring);
            part.pole = Point::origin();
        }
    }
    wide
}

#[test]
fn sections_of_a_hundred_metres_are_ordered_as_those_of_a_decimetre_are() {
    let options = OrderOptions {
        inner_overlap: traverse_layout_sequencing::InnerOverlap::Allowed,
        ..Default::default()
    };
    let mut chance = Seed(7).stream();
    let mut compared = 0;
    for case in 0..120 {
        let layout = layout_of_chance(Borders::Straight, &mut chance);
        // Of disjoint heights nothing is in the way of anything.
        let lift_mm = [0.0, 100.0][case % 2];
        let [small, wide] = [10.0, 10_000.0].map(|times| {
            let layout = widened(&layout, times, lift_mm);
            order_sections(&layout, &options, &Budget::unlimited(), &mut Trace::default())
        });
        let (Ok(small), Ok(wide)) = (small, wide) else { continue };
        let (Some(a), Some(b)) = (&small.plan, &wide.plan) else { continue };
        let (short, long) = (a.length_mm, b.length_mm / 1000.0);
        assert!((short - long).abs() < 1e-4 * short, "{case}: {short} {long}");
        assert!(wide.lower_bound_mm <= 1000.0 * short * (1.0 + 1e-6), "{case}: {}", wide.lower_bound_mm);
        assert!(wide.certified_lower_bound_mm <= 1000.0 * short * (1.0 + 1e-6), "{case}");
        compared += 1;
    }
    assert!(compared > 60, "{compared}");
}
