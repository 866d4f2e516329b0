//! Every rung of the ladder against brute force, each on its own, since the small table would answer all small cases.

use crate::assignment::{Assignment, Matched};
use crate::assignment_search::{Branching, Incumbent, Searched, search};
use crate::branch_and_cut::{BranchAndCut, Closed};
use crate::certificate::{Certificate, verify_certificate};
use crate::closure::Closure;
use crate::cost::{Costs, FORBIDDEN, LARGEST_COST};
use crate::count_program::{CountProgram, Walk};
use crate::guided_search::GuidedSearch;
use crate::network::Network;
use crate::progress::Progress;
use crate::specification::{Shape, TourSpecification};
use crate::test_support::{brute_force, cost_of, random_matrix};
use crate::types::collapse;
use crate::visits::Visits;
use crate::work::Work;
use crate::{CostMatrix, Ending, Method, SectionModel, SolveOptions, order_with_every_end, solve};
use rand::RngExt;
use rand_xoshiro::Xoshiro256PlusPlus;
use traverse_solve::{Budget, Seed, Silent, Trace};

/// Repeats, equal nodes, forbidden arcs, negative costs, ends, order.
fn random_specification(chance: &mut Xoshiro256PlusPlus) -> TourSpecification {
    let size = chance.random_range(1..=7);
    let forbidden = [0.0, 0.0, 0.15, 0.4][chance.random_range(0..4)];
    let all = -LARGEST_COST..=LARGEST_COST;
    let (least, most) = (-LARGEST_COST..=3 - LARGEST_COST, LARGEST_COST - 3..=LARGEST_COST);
    let costs = [0..=1, -9..=9, 0..=100, all, least, most][chance.random_range(0..6)].clone();
    let mut matrix = random_matrix(size, costs, forbidden, chance);
    if size > 2 && chance.random_bool(0.4) {
        matrix = with_an_equal_node(&matrix, chance.random_range(0..size - 1));
    }
    let mut visits = size;
    let mut quantities = vec![1; size];
    while visits < 8 && chance.random_bool(0.4) {
        quantities[chance.random_range(0..size)] += 1;
        visits += 1;
    }
    let mut specification = TourSpecification { quantities, ..TourSpecification::cycle(matrix) };
    if chance.random_bool(0.5) {
        specification.shape = Shape::Path;
    }
    let end = |chance: &mut Xoshiro256PlusPlus| chance.random_bool(0.3).then(|| chance.random_range(0..size));
    specification.first = end(chance);
    specification.last = end(chance);
    let mut order: Vec<usize> = (0..size).collect();
    order.sort_by_cached_key(|_| chance.random_range(0..1000));
    while size > 1 && chance.random_bool(0.3) {
        let (a, b) = (chance.random_range(0..size), chance.random_range(0..size));
        if a < b {
            specification.precedence.push((order[a], order[b]));
        }
    }
    specification
}

/// The last node becomes equal to another one.
fn with_an_equal_node(matrix: &CostMatrix, node: usize) -> CostMatrix {
    let size = matrix.size();
    let copy = size - 1;
    let within = matrix.cost(node, copy);
    let image = |at: usize| if at == copy { node } else { at };
    let entries = (0..size * size)
        .map(|at| match (at / size, at % size) {
            (from, to) if image(from) == node && image(to) == node => within,
            (from, to) => matrix.cost(image(from), image(to)),
        })
        .collect();
    CostMatrix::new(size, entries).expect("small costs")
}

/// Calls `check` with random specifications that can be solved, and their optima.
fn for_random_cases(
    seed: u64,
    count: usize,
    mut check: impl FnMut(&TourSpecification, &Network, Option<i64>),
) {
    let mut chance = Seed(seed).stream();
    let (mut done, mut solved) = (0, 0);
    while done < count {
        let specification = random_specification(&mut chance);
        let network = Network::of(&specification);
        if !specification.findings().is_empty() || network.visits() < 2 {
            continue;
        }
        let optimum = brute_force(&specification);
        check(&specification, &network, optimum);
        done += 1;
        solved += usize::from(optimum.is_some());
    }
    assert!(solved * 2 > count, "most cases have a tour");
}

fn collapsed(network: &Network) -> Network {
    let budget = Budget::unlimited();
    let collapsed = collapse(network, &Work::new(&budget)).expect("no limit");
    collapsed.map_or_else(|| network.clone(), |collapsed| collapsed.0)
}

struct Best<'a> {
    network: &'a Network,
    visits: &'a Visits<'a>,
    walk: Option<(Vec<usize>, i64)>,
}

impl Incumbent for Best<'_> {
    fn upper(&mut self) -> i64 {
        self.walk.as_ref().map_or(i64::MAX, |walk| walk.1)
    }

    fn offer(&mut self, order: &[usize], cost: i64) {
        let walk = self.visits.walk(order);
        assert_eq!(self.network.walk_cost(&walk), Some(cost));
        self.walk = Some((walk, cost));
    }
}

#[test]
fn the_ladder_finds_what_brute_force_finds() {
    for_random_cases(1, 1500, |specification, _, optimum| {
        let mut trace = Trace::default();
        let answer = solve(specification, &SolveOptions::default(), &Budget::unlimited(), &mut trace)
            .expect("no findings");
        assert_eq!(answer.tour.as_ref().map(|tour| tour.cost), optimum, "{specification:?}");
        match &answer.tour {
            Some(tour) => {
                assert_eq!(cost_of(specification, &tour.visits), Some(tour.cost), "{specification:?}");
                assert_eq!((answer.ending, answer.lower_bound), (Ending::ProvenOptimal, tour.cost));
                assert!(answer.certified_bound <= tour.cost);
                assert_eq!(trace.costs.last(), Some(&(tour.cost as f64)));
            }
            None => assert_eq!(answer.ending, Ending::ProvenInfeasible),
        }
        let proven = verify_certificate(specification, &answer.certificate);
        assert_eq!(proven, Ok(answer.certified_bound), "{specification:?}");
    });
}

#[test]
fn the_count_program_is_exact_with_and_without_types() {
    for_random_cases(2, 600, |specification, network, optimum| {
        for network in [network, &collapsed(network)] {
            for begin in network.depot.map_or(0..network.size, |depot| depot..depot + 1) {
                let program = CountProgram {
                    costs: network.entries(),
                    counts: &network.counts,
                    begin,
                    precedence: &network.precedence,
                };
                let budget = Budget::unlimited();
                match program.solve(&Work::new(&budget)).expect("no limit") {
                    Walk::None => assert_eq!(optimum, None, "{specification:?}"),
                    Walk::Cheapest(walk, cost) => {
                        assert_eq!(Some(cost), optimum, "{specification:?}");
                        assert_eq!(network.walk_cost(&walk), Some(cost));
                        let visits = network.visits_of(&walk, specification);
                        assert_eq!(cost_of(specification, &visits), Some(cost), "{specification:?}");
                    }
                }
            }
        }
    });
}

#[test]
fn branch_and_cut_is_exact_from_any_feasible_duals() {
    let mut undecided = 0;
    for_random_cases(3, 1500, |specification, network, optimum| {
        let network = collapsed(network);
        let visits = Visits::of(&network);
        let budget = Budget::unlimited();
        let mut work = Work::new(&budget);
        let (assignment, matched) = Assignment::solve(&visits, &work).expect("no limit");
        if matched == Matched::None {
            assert_eq!(optimum, None, "{specification:?}");
            return;
        }
        let (row, column) = (visits.type_duals(&assignment.row), visits.type_duals(&assignment.column));
        let mut silent = Silent;
        let mut progress = Progress::new(&mut silent);
        let mut tree = BranchAndCut::new(&network, &row, &column, &mut progress);
        tree.root(&mut progress, &mut work).expect("no limit");
        assert!(tree.grow(u64::MAX, &mut progress, &mut work).expect("no limit"));
        if tree.closed() == Closed::No {
            undecided += 1;
            println!("undecided: {specification:?} {optimum:?}");
            return;
        }
        assert_eq!(progress.best().map(|best| best.1), optimum, "{specification:?}");
        if let Some((walk, cost)) = progress.best() {
            assert_eq!(cost_of(specification, &network.visits_of(walk, specification)), Some(cost));
            assert_eq!(progress.bound(), cost);
        }
        let (duals, cuts) = tree.root_duals().expect("few nodes: duals fit");
        let every: Vec<Vec<usize>> = (0..network.size).map(|node| vec![node]).collect();
        let (_, bound) = Certificate::expanded(network.size, &network.counts, &every, &duals, &cuts);
        assert!(optimum.is_none_or(|optimum| bound <= optimum), "{bound} {optimum:?} {specification:?}");
    });
    assert_eq!(undecided, 0);
}

#[test]
fn assignment_searches_are_exact() {
    for_random_cases(4, 800, |specification, network, optimum| {
        if !specification.precedence.is_empty() {
            return;
        }
        let visits = Visits::of(network);
        for branching in [Branching::EachArc, Branching::OneArc] {
            let budget = Budget::unlimited();
            let mut work = Work::new(&budget);
            let (assignment, matched) = Assignment::solve(&visits, &work).expect("no limit");
            if matched == Matched::None {
                assert_eq!(optimum, None, "{specification:?}");
                return;
            }
            let mut best = Best { network, visits: &visits, walk: None };
            let searched = search(&visits, &assignment, branching, u64::MAX, &mut best, &mut work);
            assert_eq!(searched, Ok(Searched::Everything));
            assert_eq!(best.walk.map(|walk| walk.1), optimum, "{branching:?} {specification:?}");
        }
    });
}

#[test]
fn the_closure_bounds_and_its_walk_visits_what_was_asked() {
    let mut reached = 0;
    for_random_cases(5, 800, |specification, network, optimum| {
        let network = collapsed(network);
        let budget = Budget::unlimited();
        let work = Work::new(&budget);
        let Some(closure) = Closure::of(&network, &work).expect("no limit") else { return };
        let Some(found) = closure.bound(&work).expect("no limit") else {
            assert_eq!(optimum, None, "{specification:?}");
            return;
        };
        assert!(optimum.is_none_or(|optimum| found.bound <= optimum), "{specification:?}");
        assert_eq!(found.walk.len(), network.visits());
        reached += usize::from(network.walk_cost(&found.walk) == Some(found.bound));
    });
    assert!(reached > 100, "{reached}");
}

#[test]
fn local_search_tours_cost_what_they_say_and_are_mostly_best() {
    let (mut all, mut best) = (0, 0);
    for_random_cases(6, 300, |specification, network, optimum| {
        let visits = Visits::of(network);
        let budget = Budget::unlimited();
        let mut work = Work::new(&budget);
        let (assignment, matched) = Assignment::solve(&visits, &work).expect("no limit");
        let Some(optimum) = optimum.filter(|_| matched == Matched::All) else { return };
        let mut silent = Silent;
        let mut progress = Progress::new(&mut silent);
        let duals = (assignment.row.as_slice(), assignment.column.as_slice());
        let mut local = GuidedSearch::new(network, &visits, duals, Seed(1), &work).expect("no limit");
        let first = local.first_tour(&assignment.successor, &mut progress, &work).expect("no limit");
        local.improve(200, &first, &mut progress, &mut work).expect("no limit");
        all += 1;
        if let Some((walk, cost)) = progress.best() {
            assert_eq!(cost_of(specification, &network.visits_of(walk, specification)), Some(cost));
            assert!(cost >= optimum);
            best += usize::from(cost == optimum);
        }
    });
    assert!(best * 10 > all * 6, "{best} of {all}");
}

#[test]
fn forbidden_arcs_are_never_used() {
    for_random_cases(7, 200, |specification, _, _| {
        let answer = solve(specification, &SolveOptions::default(), &Budget::unlimited(), &mut Silent)
            .expect("no findings");
        let Some(tour) = answer.tour else { return };
        for pair in tour.visits.windows(2) {
            assert_ne!(specification.costs.cost(pair[0], pair[1]), FORBIDDEN);
        }
    });
}

#[test]
fn branch_and_cut_agrees_with_the_count_program_beyond_brute_force() {
    let mut chance = Seed(8).stream();
    for round in 0..60 {
        let size = chance.random_range(9..=13);
        let matrix = random_matrix(size, if round % 2 == 0 { 0..=9 } else { 0..=1000 }, 0.1, &mut chance);
        let mut specification = TourSpecification::path(matrix);
        if round % 3 == 0 {
            specification.precedence = vec![(0, 1), (1, 2), (3, 1), (4, 5)];
        } else if round % 3 == 1 {
            specification.quantities = (0..size).map(|node| 1 + u32::from(node % 4 == 0)).collect();
        }
        let network = Network::of(&specification);
        let budget = Budget::unlimited();
        let mut work = Work::new(&budget);
        let program = CountProgram {
            costs: network.entries(),
            counts: &network.counts,
            begin: network.size - 1,
            precedence: &network.precedence,
        };
        let optimum = match program.solve(&work).expect("no limit") {
            Walk::Cheapest(_, cost) => Some(cost),
            Walk::None => None,
        };
        let visits = Visits::of(&network);
        let (assignment, matched) = Assignment::solve(&visits, &work).expect("no limit");
        if matched == Matched::None {
            assert_eq!(optimum, None);
            continue;
        }
        let (row, column) = (visits.type_duals(&assignment.row), visits.type_duals(&assignment.column));
        let mut silent = Silent;
        let mut progress = Progress::new(&mut silent);
        let mut tree = BranchAndCut::new(&network, &row, &column, &mut progress);
        tree.root(&mut progress, &mut work).expect("no limit");
        assert!(tree.grow(u64::MAX, &mut progress, &mut work).expect("no limit"));
        assert_eq!(tree.closed(), Closed::Yes);
        assert_eq!(progress.best().map(|best| best.1), optimum, "{specification:?}");
    }
}

#[test]
fn both_published_models_and_every_end_give_the_order_that_one_path_gives() {
    let mut chance = Seed(10).stream();
    for _ in 0..40 {
        let sections = chance.random_range(2..=7);
        let effects = random_matrix(sections, 0..=50, 0.1, &mut chance).entries().to_vec();
        let negated = effects.iter().map(|&effect| if effect == FORBIDDEN { FORBIDDEN } else { -effect });
        let path = TourSpecification::path(CostMatrix::new(sections, negated.collect()).expect("small"));
        let optimum = brute_force(&path).map(|cost| -cost);
        for model in [SectionModel::ShareOfLength { whole_length: 1000 }, SectionModel::Complement] {
            for method in [Method::Ladder, Method::BranchAndBound] {
                let options = SolveOptions { method, ..SolveOptions::default() };
                let mut heard = None;
                let mut hear = |_: &[usize], saved: i64| heard = Some(saved);
                let budget = Budget::unlimited();
                let best = order_with_every_end(&effects, sections, model, &options, &budget, &mut hear);
                let best = best.expect("small effects").map(|(_, saved)| saved);
                assert_eq!(heard, best);
                // A circuit must exist with the end held: where forbidden joins leave a path there is one.
                assert_eq!(best, optimum, "{model:?} {method:?}");
            }
        }
    }
}

#[test]
fn published_methods_give_tours_that_cost_what_they_say() {
    for_random_cases(11, 150, |specification, _, optimum| {
        if !specification.precedence.is_empty() {
            return;
        }
        for method in [Method::BranchAndBound, Method::AntColony, Method::SuccessiveImprovement] {
            let budget = Budget { iterations: Some(2000), ..Budget::unlimited() };
            let options = SolveOptions { method, ..SolveOptions::default() };
            let answer = solve(specification, &options, &budget, &mut Silent).expect("no findings");
            let proven = verify_certificate(specification, &answer.certificate);
            assert_eq!(proven, Ok(answer.certified_bound), "{specification:?}");
            match (&answer.tour, optimum) {
                (Some(tour), Some(optimum)) => {
                    assert_eq!(cost_of(specification, &tour.visits), Some(tour.cost));
                    assert!(tour.cost >= optimum && answer.lower_bound <= optimum);
                    assert!(method != Method::BranchAndBound || tour.cost == optimum, "{specification:?}");
                }
                (None, Some(_)) => assert_ne!(method, Method::BranchAndBound, "{specification:?}"),
                (tour, None) => assert_eq!(*tour, None),
            }
        }
    });
}
