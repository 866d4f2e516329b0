//! Methods by name, given orders, limits, cancels, certificates.

mod oracle;

use oracle::{Borders, section};
use std::time::Duration;
use traverse_checker::check_sections;
use traverse_geometry::{CONTACT_TOLERANCE_MM, PlacedSection, Pose, Section, SectionLayout, SlideRule};
use traverse_layout_sequencing::{
    Algorithm, BoundCertificate, ContactList, EffectModel, Ending, InnerOverlap, LayoutAnswer, OrderOptions,
    contacts, join, joins, order_sections, place, published_effect,
};
use traverse_solve::{Budget, CancelToken, Effort, Interrupt, Observer, Seed, Silent};
use traverse_tours::{FORBIDDEN, Method, SectionModel, SolveOptions, order_with_every_end};

fn layout(count: usize, seed: u64) -> SectionLayout {
    let mut chance = Seed(seed).stream();
    oracle::layout((0..count).map(|i| section(&i.to_string(), Borders::Straight, &mut chance)).collect())
}

fn permissive() -> OrderOptions {
    OrderOptions { inner_overlap: InnerOverlap::Allowed, ..OrderOptions::default() }
}

fn ordered(layout: &SectionLayout, options: &OrderOptions, budget: &Budget) -> LayoutAnswer {
    order_sections(layout, options, budget, &mut Silent).expect("no findings")
}

#[test]
fn both_published_models_with_every_end_give_what_the_method_gives() {
    for seed in 0..6 {
        let layout = layout(6, seed);
        let matrix = joins(&layout, EffectModel::Published, 1, &Budget::unlimited()).unwrap();
        let effects: Vec<i64> = (0..36)
            .map(|at| if at % 7 == 0 { FORBIDDEN } else { (matrix.effects_mm[at] * 1e6).round() as i64 })
            .collect();
        let whole: f64 = layout.sections.iter().map(|section| section.bounds().size().x).sum();
        let models =
            [SectionModel::ShareOfLength { whole_length: (whole * 1e6) as i64 }, SectionModel::Complement];
        let best = models.map(|model| {
            let options = SolveOptions { method: Method::BranchAndBound, ..SolveOptions::default() };
            let found =
                order_with_every_end(&effects, 6, model, &options, &Budget::unlimited(), &mut |_, _| {});
            found.unwrap().unwrap().1
        });
        assert_eq!(best[0], best[1]);
        let options = OrderOptions {
            algorithm: Algorithm::BranchAndBound,
            effect_model: EffectModel::Published,
            ..permissive()
        };
        let plan = ordered(&layout, &options, &Budget::unlimited()).plan.unwrap();
        assert!((plan.published_length_mm - (whole - best[0] as f64 / 1e6)).abs() < 1e-4);
        assert!(check_sections(&layout, &plan.order, CONTACT_TOLERANCE_MM).is_sound());
    }
}

#[test]
fn every_method_gives_a_sound_layout_that_is_no_shorter_than_the_bound() {
    for seed in 0..4 {
        let mut layout = layout(7, seed);
        layout.first = Some(2);
        layout.sections[4].quantity = 2;
        layout.forbidden_joins = vec![(0, 1), (4, 4)];
        layout.slide_rule = [SlideRule::KeepOrder, SlideRule::Free][seed as usize % 2];
        let best = ordered(&layout, &permissive(), &Budget::unlimited());
        assert_eq!(best.ending, Ending::ProvenOptimal);
        for algorithm in [Algorithm::BranchAndBound, Algorithm::AntColony, Algorithm::LocalImprovement] {
            for effect_model in [EffectModel::Exact, EffectModel::Published] {
                let options = OrderOptions { algorithm, effect_model, ..permissive() };
                let answer =
                    ordered(&layout, &options, &Budget { iterations: Some(50_000), ..Budget::unlimited() });
                let plan = answer.plan.unwrap();
                assert_eq!(answer.algorithm, algorithm.name());
                assert!(plan.length_mm >= best.lower_bound_mm - 1e-5, "{algorithm:?}");
                assert!(answer.lower_bound_mm <= best.plan.as_ref().unwrap().length_mm);
                let check = check_sections(&layout, &plan.order, CONTACT_TOLERANCE_MM);
                assert!(check.is_sound(), "{algorithm:?}: {:?}", check.violations);
            }
        }
    }
}

#[test]
fn a_given_order_is_evaluated_and_a_start_is_never_made_worse() {
    let mut layout = layout(8, 3);
    layout.sections[1].quantity = 2;
    layout.sections[5].poses = Pose::ALL.to_vec();
    let order = [(5, 0), (1, 1), (0, 0), (2, 0), (7, 0), (1, 0), (6, 0), (4, 0), (3, 0)];
    let order: Vec<PlacedSection> = order
        .map(|(section, copy)| {
            let pose = if section == 5 { Pose::MirrorY } else { Pose::AsIs };
            PlacedSection { section, copy, pose, x_mm: f64::NAN }
        })
        .to_vec();
    let options =
        OrderOptions { algorithm: Algorithm::GivenOrder, initial_order: Some(order.clone()), ..permissive() };
    let given = ordered(&layout, &options, &Budget::unlimited());
    let plan = given.plan.clone().unwrap();
    assert_eq!(plan.order, place(&layout, &order));
    assert!(given.lower_bound_mm > 0.0 && given.lower_bound_mm <= plan.length_mm);
    let start = OrderOptions { algorithm: Algorithm::Best, ..options };
    let none = Budget { iterations: Some(0), ..Budget::unlimited() };
    assert_eq!(ordered(&layout, &start, &none).plan.unwrap().length_mm, plan.length_mm);
    let best = ordered(&layout, &start, &Budget::unlimited());
    assert!(best.is_proven() && best.plan.unwrap().length_mm < plan.length_mm);
}

#[test]
fn equal_questions_and_limits_give_equal_answers() {
    for rule in [SlideRule::KeepOrder, SlideRule::Free] {
        let mut layout = layout(24, 5);
        layout.slide_rule = rule;
        layout.sections.iter_mut().for_each(|section| section.poses = vec![Pose::AsIs, Pose::HalfTurn]);
        for iterations in [100, 5_000, 40_000] {
            let budget = Budget { iterations: Some(iterations), ..Budget::unlimited() };
            let first = ordered(&layout, &permissive(), &budget);
            assert_eq!(first, ordered(&layout, &permissive(), &budget));
            let plan = first.plan.unwrap();
            assert!(first.lower_bound_mm <= plan.length_mm);
            assert!(check_sections(&layout, &plan.order, CONTACT_TOLERANCE_MM).is_sound());
        }
    }
}

#[test]
fn a_gap_that_is_small_enough_ends_the_search() {
    let options = OrderOptions { gap_limit: Some(0.5), ..permissive() };
    let mut layout = layout(20, 2);
    layout.slide_rule = SlideRule::Free;
    let answer = ordered(&layout, &options, &Budget::unlimited());
    let length = answer.plan.unwrap().length_mm;
    assert_eq!(answer.ending, Ending::GapReached);
    assert!((length - answer.lower_bound_mm) / length <= 0.5);
}

/// Raises a cancel at the first thing it hears.
struct CancelAtOnce(CancelToken);

impl Observer for CancelAtOnce {
    fn better_cost(&mut self, _cost: f64) {
        self.0.cancel();
    }

    fn better_bound(&mut self, _lower_bound: f64) {
        self.0.cancel();
    }
}

#[test]
fn cancelled_work_ends_without_a_plan() {
    for rule in [SlideRule::KeepOrder, SlideRule::Free] {
        for algorithm in [Algorithm::Best, Algorithm::BranchAndBound, Algorithm::AntColony] {
            let mut layout = layout(40, 1);
            layout.slide_rule = rule;
            let budget = Budget::unlimited();
            let options = OrderOptions { algorithm, ..permissive() };
            let mut observer = CancelAtOnce(budget.cancel.clone());
            let answer = order_sections(&layout, &options, &budget, &mut observer).unwrap();
            assert_eq!(answer.ending, Ending::Interrupted(Interrupt::Cancelled));
            assert_eq!(answer.plan, None);
        }
    }
}

#[test]
fn a_time_that_is_over_leaves_no_plan_but_an_answer() {
    let effort = Effort { time_limit: Some(Duration::ZERO), ..Effort::default() };
    let answer = ordered(&layout(5, 1), &permissive(), &effort.budget_from_now(CancelToken::new()));
    assert_eq!((answer.plan, answer.ending), (None, Ending::Interrupted(Interrupt::Deadline)));
}

#[test]
fn precedence_among_more_sections_than_are_proven_leaves_a_layout() {
    let mut layout = layout(420, 3);
    layout.sections.iter_mut().for_each(|section| section.quantity = 2);
    layout.precedences = vec![(419, 0), (7, 3), (3, 2)];
    layout.first = Some(5);
    layout.last = Some(2);
    let budget = Budget { iterations: Some(2_000), ..Budget::unlimited() };
    let plan = ordered(&layout, &permissive(), &budget).plan.expect("there are allowed orders");
    assert_eq!(plan.order.len(), 840);
    assert!(check_sections(&layout, &plan.order, CONTACT_TOLERANCE_MM).is_sound());
}

#[test]
fn contacts_are_listed_unless_they_are_omitted() {
    let layout = layout(6, 2);
    let budget = Budget::unlimited();
    let listed = ordered(&layout, &permissive(), &budget).plan.unwrap();
    assert_eq!(listed.contacts, contacts(&layout, &listed.order));
    assert!(!listed.contacts.is_empty());
    let options = OrderOptions { contacts: ContactList::Omitted, ..permissive() };
    let omitted = ordered(&layout, &options, &budget).plan.unwrap();
    assert_eq!((omitted.contacts, omitted.order), (vec![], listed.order));
}

/// What the certificate proves, recomputed with joins alone.
fn proven(layout: &SectionLayout, certificate: &BoundCertificate) -> f64 {
    let count = layout.sections.len();
    let width = |section: &Section| section.bounds().size().x;
    match certificate {
        BoundCertificate::None => 0.0,
        BoundCertificate::Width { section } => width(&layout.sections[*section]),
        BoundCertificate::Height { .. } => 0.0,
        BoundCertificate::Joins(duals) => {
            let cost = |i: usize, j: usize| -> Option<f64> {
                match (layout.sections.get(i), layout.sections.get(j)) {
                    (None, None) => None,
                    (None, Some(_)) => layout.first.is_none_or(|first| first == j).then_some(0.0),
                    (Some(left), None) => layout.last.is_none_or(|last| last == i).then(|| width(left)),
                    (Some(left), Some(right)) => {
                        let forbidden =
                            layout.forbidden_joins.contains(&(i, j)) || (i == j && left.quantity == 1);
                        let offset = |pair: (Pose, Pose)| {
                            join((left, pair.0), (right, pair.1), layout.gap_mm)
                                .offset_mm
                                .unwrap_or(0.0)
                                .max(0.0)
                        };
                        let pairs = left.poses.iter().flat_map(|&a| right.poses.iter().map(move |&b| (a, b)));
                        (!forbidden).then(|| pairs.map(offset).fold(f64::INFINITY, f64::min))
                    }
                }
            };
            for i in 0..=count {
                for j in 0..=count {
                    let Some(cost) = cost(i, j) else { continue };
                    let left = |set: &&(Vec<usize>, f64)| set.0.contains(&i) && !set.0.contains(&j);
                    let weights: f64 = duals.sets.iter().filter(left).map(|set| set.1).sum();
                    assert!(duals.row_mm[i] + duals.column_mm[j] + weights <= cost + 2e-6, "{i} {j}");
                }
            }
            let quantity =
                |i: usize| layout.sections.get(i).map_or(1.0, |section| f64::from(section.quantity));
            let duals_sum: f64 =
                (0..=count).map(|i| quantity(i) * (duals.row_mm[i] + duals.column_mm[i])).sum();
            duals_sum + duals.sets.iter().map(|set| set.1).sum::<f64>()
        }
    }
}

#[test]
fn certificates_prove_what_they_say() {
    let mut by_joins = 0;
    for seed in 0..12 {
        let mut layout = layout(7, 100 + seed);
        layout.sections[3].quantity = 3;
        layout.gap_mm = if seed % 2 == 0 { 0.0 } else { 1.5 };
        if seed % 3 == 0 {
            layout.sections[0].poses = vec![Pose::AsIs, Pose::HalfTurn];
            layout.last = Some(1);
            layout.forbidden_joins = vec![(3, 3), (2, 5)];
        }
        if seed % 4 == 0 {
            layout.precedences = vec![(4, 3)];
        }
        let answer = ordered(&layout, &permissive(), &Budget::unlimited());
        let duals = matches!(answer.certificate, BoundCertificate::Joins(_));
        if duals {
            by_joins += 1;
            let recomputed = proven(&layout, &answer.certificate);
            assert!((recomputed - answer.certified_lower_bound_mm).abs() < 1e-5, "{seed}: {recomputed}");
        }
        assert!(answer.certified_lower_bound_mm <= answer.lower_bound_mm);
    }
    assert!(by_joins >= 10, "{by_joins}");
}

#[test]
fn certificates_of_hundreds_prove_what_they_say() {
    let mut layout = layout(202, 77);
    layout.sections.iter_mut().enumerate().for_each(|(number, section)| {
        section.quantity = 1 + (number % 6) as u32;
        section.poses.truncate(1);
    });
    layout.sections[5].poses = vec![Pose::AsIs, Pose::HalfTurn];
    layout.gap_mm = 0.5;
    layout.first = Some(8);
    layout.last = Some(16);
    layout.forbidden_joins = vec![(3, 3), (2, 5), (9, 4)];
    let budget = Budget { iterations: Some(3_000), ..Budget::unlimited() };
    let answer = ordered(&layout, &permissive(), &budget);
    let plan = answer.plan.as_ref().expect("most joins are allowed");
    let recomputed = proven(&layout, &answer.certificate);
    assert!(matches!(answer.certificate, BoundCertificate::Joins(_)));
    assert!((recomputed - answer.certified_lower_bound_mm).abs() < 1e-4, "{recomputed}");
    assert!(recomputed > 0.8 * plan.length_mm, "{recomputed} {}", plan.length_mm);
    let again = ordered(&layout, &OrderOptions { threads: 1, ..permissive() }, &budget);
    assert_eq!(again, answer);
}

#[test]
fn published_effects_are_never_below_exact_ones_of_single_parts() {
    let mut larger = 0;
    for seed in 0..60 {
        let mut layout = layout(2, 1_000 + seed);
        layout.sections.iter_mut().for_each(|section| section.parts.truncate(1));
        let (left, right) = (&layout.sections[0], &layout.sections[1]);
        let exact = join((left, Pose::AsIs), (right, Pose::AsIs), 0.0).effect_mm;
        let published = published_effect((left, Pose::AsIs), (right, Pose::AsIs));
        assert!(published >= exact - 1e-9);
        larger += usize::from(published > exact + 1e-6);
    }
    assert!(larger > 5, "{larger}");
}
