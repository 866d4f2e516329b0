//! Costs at the limits with as many visits as make sums large: what is proven there must hold.

use crate::branch_and_cut::{BranchAndCut, Closed};
use crate::certificate::{Certificate, verify_certificate};
use crate::cost::{Costs, FORBIDDEN, LARGEST_COST};
use crate::network::Network;
use crate::progress::Progress;
use crate::test_support::random_matrix;
use crate::work::Work;
use crate::{
    CostMatrix, Ending, Method, SectionModel, SolveOptions, TourAnswer, TourSpecification,
    order_with_every_end, search_lazily, solve,
};
use rand::RngExt;
use traverse_solve::{Budget, Observer, Seed, Silent, Trace};

/// The same matrix with every allowed arc dearer by `by`: every tour is dearer by as much for each visit.
fn shifted(matrix: &CostMatrix, by: i64) -> CostMatrix {
    let dearer = |&cost: &i64| if cost == FORBIDDEN { FORBIDDEN } else { cost + by };
    CostMatrix::new(matrix.size(), matrix.entries().iter().map(dearer).collect()).expect("within the limits")
}

/// What branch and cut finds and proves alone, from the cheapest arc out of each node.
fn by_branch_and_cut(specification: &TourSpecification) -> (Closed, Option<i64>, i64) {
    let network = Network::of(specification);
    let budget = Budget::unlimited();
    let mut work = Work::new(&budget);
    let (row, column) =
        (Certificate::row_minima(network.entries(), &network.counts).0.row, vec![0; network.size]);
    let mut silent = Silent;
    let mut progress = Progress::new(&mut silent);
    let mut tree = BranchAndCut::new(&network, &row, &column, &mut progress);
    tree.root(&mut progress, &mut work).expect("no limit");
    assert!(tree.grow(u64::MAX, &mut progress, &mut work).expect("no limit"));
    (tree.closed(), progress.best().map(|best| best.1), progress.bound())
}

#[test]
fn many_visits_at_the_least_cost_are_proven_as_at_small_ones() {
    let mut chance = Seed(21).stream();
    for round in 0..12 {
        let size = 3 + round % 4;
        let matrix = random_matrix(size, 0..=9, 0.1, &mut chance);
        // Sums below −1 400 of the largest costs.
        let quantities: Vec<u32> =
            (0..size).map(|_| chance.random_range(1..1_500 / size as u32) + 1_500 / size as u32).collect();
        let visits: i64 = quantities.iter().map(|&quantity| i64::from(quantity)).sum();
        let small = TourSpecification { quantities, ..TourSpecification::cycle(matrix) };
        let (closed, cost, bound) = by_branch_and_cut(&small);
        assert_eq!((closed, cost), (Closed::Yes, Some(bound)));
        for by in [-LARGEST_COST, LARGEST_COST - 9] {
            let far = TourSpecification { costs: shifted(&small.costs, by), ..small.clone() };
            let found = by_branch_and_cut(&far);
            assert_eq!(found, (Closed::Yes, Some(bound + by * visits), bound + by * visits), "{round} {by}");
        }
    }
}

#[test]
fn the_ladder_proves_nothing_false_at_the_least_cost() {
    let mut chance = Seed(22).stream();
    let matrix = random_matrix(6, 0..=9, 0.2, &mut chance);
    let small = TourSpecification { quantities: vec![240; 6], ..TourSpecification::cycle(matrix) };
    let far = TourSpecification { costs: shifted(&small.costs, -LARGEST_COST), ..small.clone() };
    let budget = Budget { iterations: Some(4_000), ..Budget::unlimited() };
    let [small, far] = [&small, &far].map(|specification| {
        let answer = solve(specification, &SolveOptions::default(), &budget, &mut Silent);
        let answer = answer.expect("no findings");
        let proven = verify_certificate(specification, &answer.certificate);
        assert_eq!(proven, Ok(answer.certified_bound));
        answer
    });
    let cost = |answer: &TourAnswer| answer.tour.as_ref().expect("few arcs are forbidden").cost;
    let by = LARGEST_COST * 6 * 240;
    assert!(far.lower_bound + by <= cost(&small) && small.lower_bound <= cost(&far) + by);
    assert_eq!(far.certified_bound + by, small.certified_bound);
}

/// Every row has its own column at the least cost and the next one's at the largest; the last row has the first column
/// only. So every row must give way to the one before it, and duals add up along all of them.
fn a_row_of_givers(size: usize, column: impl Fn(usize) -> usize) -> Vec<i64> {
    let mut entries = vec![FORBIDDEN; size * size];
    for row in 0..size {
        if row + 1 < size {
            entries[row * size + column(row)] = -LARGEST_COST;
            entries[row * size + column(row + 1)] = LARGEST_COST;
        } else {
            entries[row * size + column(0)] = LARGEST_COST;
        }
    }
    entries
}

#[test]
fn duals_too_large_for_parts_still_make_certificates() {
    // Scaled to parts of a unit such duals exceed a machine word from 704 nodes on.
    let size = 900;
    let costs = CostMatrix::new(size, a_row_of_givers(size, |at| (at + 1) % size)).expect("within limits");
    let specification = TourSpecification::cycle(costs);
    let budget = Budget { iterations: Some(20), ..Budget::unlimited() };
    for method in [Method::Ladder, Method::SuccessiveImprovement] {
        let options = SolveOptions { method, ..SolveOptions::default() };
        let answer = solve(&specification, &options, &budget, &mut Silent).expect("no findings");
        assert_eq!(verify_certificate(&specification, &answer.certificate), Ok(answer.certified_bound));
        assert_eq!(answer.certified_bound, LARGEST_COST * size as i64, "{method:?}");
        assert!(answer.lower_bound >= answer.certified_bound && answer.lower_bound < i64::MAX);
    }
}

#[test]
fn lazy_bounds_hold_at_the_limits() {
    let mut chance = Seed(23).stream();
    for round in 0..20 {
        let size = 40 + 7 * round;
        let costs = match round % 3 {
            0 => random_matrix(size, -LARGEST_COST..=9 - LARGEST_COST, 0.1, &mut chance),
            1 => random_matrix(size, -LARGEST_COST..=LARGEST_COST, 0.6, &mut chance),
            _ => CostMatrix::new(size, a_row_of_givers(size, |at| (at + 1) % size)).expect("within limits"),
        };
        let specification = TourSpecification::cycle(costs.clone());
        let budget = Budget { iterations: Some(500), ..Budget::unlimited() };
        let lazy = search_lazily(&costs, Seed(1), 1, &budget, &mut Silent);
        let dense =
            solve(&specification, &SolveOptions::default(), &budget, &mut Silent).expect("no findings");
        let Some(bound) = lazy.lower_bound else { continue };
        let sum: i128 = lazy.row.iter().chain(&lazy.column).map(|&dual| i128::from(dual)).sum();
        assert_eq!(sum, i128::from(bound), "{round}");
        let best = [lazy.cost, dense.tour.map(|tour| tour.cost)].into_iter().flatten().min();
        assert!(best.is_none_or(|best| bound <= best), "{round}: {bound} {best:?}");
    }
}

/// Hears bounds; none may be what no tour can cost.
struct Hears(Vec<f64>);

impl Observer for Hears {
    fn better_cost(&mut self, _cost: f64) {}

    fn better_bound(&mut self, lower_bound: f64) {
        self.0.push(lower_bound);
    }
}

#[test]
fn that_there_is_no_tour_is_an_ending_and_no_bound() {
    let mut chance = Seed(24).stream();
    // Two halves: each node has arcs within its own only, so that there is an assignment.
    for size in [8, 24] {
        for by in [0, -LARGEST_COST, LARGEST_COST] {
            // No two nodes are equal, or they would be one.
            let mut entry = |at: usize| {
                let apart = chance.random_range(0..1_000) * if by > 0 { -1 } else { 1 };
                if at / size % 2 == at % size % 2 { by + apart } else { FORBIDDEN }
            };
            let entries = (0..size * size).map(&mut entry).collect();
            let costs = CostMatrix::new(size, entries).expect("within limits");
            for quantity in [1, 30] {
                let specification = TourSpecification {
                    quantities: vec![quantity; size],
                    ..TourSpecification::cycle(costs.clone())
                };
                let mut hears = Hears(vec![]);
                let answer =
                    solve(&specification, &SolveOptions::default(), &Budget::unlimited(), &mut hears)
                        .expect("no findings");
                assert_eq!((answer.ending, answer.tour), (Ending::ProvenInfeasible, None), "{size} {by}");
                let most = (LARGEST_COST * size as i64 * i64::from(quantity)) as f64;
                assert!(hears.0.iter().all(|bound| bound.abs() <= most), "{size} {by}: {:?}", hears.0);
                assert!((answer.lower_bound as f64).abs() <= most, "{size} {by}");
            }
        }
    }
}

#[test]
fn effects_whose_sums_are_not_exact_are_refused() {
    for (effect, whole_length) in [(i64::MAX - 1, 0), (i64::MIN, 0), (-1, i64::MIN), (1, i64::MAX)] {
        let effects = vec![effect; 16];
        let share = SectionModel::ShareOfLength { whole_length };
        for model in [share, SectionModel::Complement] {
            let (options, budget) = (SolveOptions::default(), Budget::unlimited());
            let found = order_with_every_end(&effects, 4, model, &options, &budget, &mut |_, _| {});
            let refused = effect.unsigned_abs() > LARGEST_COST as u64 || model == share;
            assert_eq!(found.is_err(), refused, "{effect} {model:?}");
        }
    }
    let mut trace = Trace::default();
    let costs = CostMatrix::new(2, vec![FORBIDDEN, LARGEST_COST, -LARGEST_COST, FORBIDDEN]).expect("allowed");
    let answer =
        solve(&TourSpecification::cycle(costs), &SolveOptions::default(), &Budget::unlimited(), &mut trace);
    assert_eq!(answer.expect("no findings").lower_bound, 0);
    assert!(CostMatrix::new(1, vec![i64::MIN]).is_err() && CostMatrix::new(1, vec![i64::MAX - 1]).is_err());
}
