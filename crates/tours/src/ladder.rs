//! The ladder: from what decides at once to what takes long, each step with what the steps before have found.
//!
//! 1. Equal nodes become types.
//! 2. The assignment bounds, and may show that there is no tour.
//! 3. Small cases go through the program over counts.
//! 4. Local search makes a good tour.
//! 5. Assignment branch and bound closes small gaps.
//! 6. The root of branch and cut bounds better.
//! 7. The metric closure's program decides what consists of many equal nodes.
//! 8. Branch and cut and local search take turns, or go side by side on two threads.

use crate::TourSpecification;
use crate::answer::{Ending, Tour, TourAnswer};
use crate::assignment::{Assignment, Matched};
use crate::assignment_search::{Branching, Incumbent, Searched, search};
use crate::branch_and_cut::{BranchAndCut, Closed, LARGEST_SIZE, RootDuals};
use crate::certificate::Certificate;
use crate::closure::Closure;
use crate::count_program::{CountProgram, Walk};
use crate::guided_search::GuidedSearch;
use crate::network::Network;
use crate::options::SolveOptions;
use crate::progress::{Progress, Shared};
use crate::types::collapse;
use crate::visits::Visits;
use crate::work::Work;
use std::sync::atomic::{AtomicBool, Ordering};
use traverse_solve::{Budget, Interrupt, Observer, Silent};

/// Tables up to this size are filled before anything else is tried.
const SMALL_TABLE_BYTES: u64 = 24 << 20;
/// Tables up to this size are filled when branch and cut's root left a gap.
const LARGE_TABLE_BYTES: u64 = 256 << 20;
/// Kicks before the first proof is tried, and between two parts of a tree.
const FIRST_KICKS: u64 = 3_000;
/// The same where an order is to be kept: the bounds are weak there, and tours are worth more than proofs.
const FIRST_ORDERED_KICKS: u64 = 30_000;
const GUIDED_KICKS: u64 = 20_000;
const BURST_KICKS: u64 = 3_000;
const NODES_BETWEEN: u64 = 10;
/// Nodes of the assignment search.
const ASSIGNMENT_NODES: u64 = 1_000;

/// The answer of the ladder to a specification without findings.
pub(crate) fn climb(
    specification: &TourSpecification,
    full: &Network,
    options: &SolveOptions,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> TourAnswer {
    let mut work = Work::new(budget);
    let mut progress = Progress::new(observer);
    let mut certificate = Certificate::row_minima(full.entries(), &full.counts);
    progress.raise_bound(certificate.1);
    // Without time to look for equal nodes there is none for anything else.
    let collapsed = collapse(full, &work).ok().flatten();
    let (network, members) = match &collapsed {
        Some((network, members)) => (network, members.clone()),
        None => (full, (0..full.size).map(|node| vec![node]).collect()),
    };
    let visits = Visits::of(network);
    progress.offer(network, &visits.type_of);
    let mut climb = Climb { network, visits: &visits, options, assignment: None, root: None };
    let ending = climb.run(&mut progress, &mut work).unwrap_or_else(Ending::Interrupted);
    let of_assignment = climb
        .assignment
        .map(|(row, column)| Certificate::of_assignment(full.size, &full.counts, &members, &row, &column));
    let of_root = climb
        .root
        .map(|(duals, cuts)| Certificate::expanded(full.size, &full.counts, &members, &duals, &cuts));
    // Which proves more without the root's order is seen here.
    for proven in [of_assignment, of_root].into_iter().flatten() {
        if proven.1 > certificate.1 {
            certificate = proven;
        }
    }
    let ending = if progress.is_proven() { Ending::ProvenOptimal } else { ending };
    progress.raise_bound(certificate.1);
    let (best, lower_bound) = progress.into_found();
    let tour = best.map(|(walk, cost)| Tour { visits: network.visits_of(&walk, specification), cost });
    TourAnswer {
        tour,
        lower_bound,
        certificate: certificate.0,
        certified_bound: certificate.1,
        ending,
        iterations: work.iterations(),
    }
}

struct Climb<'a> {
    network: &'a Network,
    visits: &'a Visits<'a>,
    options: &'a SolveOptions,
    /// Whole duals of the assignment, of rows and columns.
    assignment: Option<(Vec<i64>, Vec<i64>)>,
    /// Duals of branch and cut's root.
    root: Option<RootDuals>,
}

impl Climb<'_> {
    fn run(&mut self, progress: &mut Progress<'_>, work: &mut Work<'_>) -> Result<Ending, Interrupt> {
        let (network, visits) = (self.network, self.visits);
        let (assignment, matched) = Assignment::solve(visits, work)?;
        if matched == Matched::None {
            return Ok(Ending::ProvenInfeasible);
        }
        progress.raise_bound(assignment.bound());
        let (row, column) = (visits.type_duals(&assignment.row), visits.type_duals(&assignment.column));
        self.assignment = Some((row.clone(), column.clone()));
        if let Some(ending) = self.small_table(progress, work)? {
            return Ok(ending);
        }
        let seed = self.options.seed;
        let duals = (assignment.row.as_slice(), assignment.column.as_slice());
        let mut local = GuidedSearch::new(network, visits, duals, seed.part(0), work)?;
        let first = local.first_tour(&assignment.successor, progress, work)?;
        let kicks = if network.precedence.is_empty() { FIRST_KICKS } else { FIRST_ORDERED_KICKS };
        local.improve(kicks, &first, progress, work)?;
        if progress.is_proven() {
            return Ok(Ending::ProvenOptimal);
        }
        if self.assignment_search(&assignment, progress, work)? == Searched::Everything {
            return Ok(closed(progress));
        }
        if network.size > LARGEST_SIZE {
            return local.improve(u64::MAX, &first, progress, work).map(|()| closed_or_open(progress));
        }
        if self.options.threads > 1 {
            return self.side_by_side(&mut local, &first, (&row, &column), progress, work);
        }
        self.prove(Some(&mut local), &first, (&row, &column), progress, work)
    }

    /// Exact at once where the table is small.
    fn small_table(
        &mut self,
        progress: &mut Progress<'_>,
        work: &mut Work<'_>,
    ) -> Result<Option<Ending>, Interrupt> {
        let network = self.network;
        let begin = network.depot.unwrap_or(0);
        let program = CountProgram {
            costs: network.entries(),
            counts: &network.counts,
            begin,
            precedence: &network.precedence,
        };
        if program.bytes() > SMALL_TABLE_BYTES {
            return Ok(None);
        }
        work.step()?;
        Ok(Some(match program.solve(work)? {
            Walk::None => Ending::ProvenInfeasible,
            Walk::Cheapest(walk, cost) => {
                progress.offer(network, &walk);
                progress.raise_bound(cost);
                Ending::ProvenOptimal
            }
        }))
    }

    fn assignment_search(
        &self,
        assignment: &Assignment,
        progress: &mut Progress<'_>,
        work: &mut Work<'_>,
    ) -> Result<Searched, Interrupt> {
        if !self.network.precedence.is_empty() {
            return Ok(Searched::Part);
        }
        let mut incumbent = Offers { network: self.network, visits: self.visits, progress };
        search(self.visits, assignment, Branching::EachArc, ASSIGNMENT_NODES, &mut incumbent, work)
    }

    /// Root, table, tree; local search in turns with them, when it isn't beside them.
    fn prove(
        &mut self,
        mut local: Option<&mut GuidedSearch<'_>>,
        first: &[usize],
        duals: (&[i64], &[i64]),
        progress: &mut Progress<'_>,
        work: &mut Work<'_>,
    ) -> Result<Ending, Interrupt> {
        let mut tree = BranchAndCut::new(self.network, duals.0, duals.1, progress);
        let done = tree.root(progress, work);
        self.root = tree.root_duals();
        done?;
        if let Some(local) = local.as_deref_mut() {
            local.improve(GUIDED_KICKS, first, progress, work)?;
        }
        self.closure(progress, work)?;
        loop {
            if tree.grow(NODES_BETWEEN, progress, work)? {
                break;
            }
            if let Some(local) = local.as_deref_mut() {
                local.improve(BURST_KICKS, first, progress, work)?;
            }
        }
        if tree.closed() == Closed::Yes { Ok(closed(progress)) } else { Ok(closed_or_open(progress)) }
    }

    fn closure(&self, progress: &mut Progress<'_>, work: &mut Work<'_>) -> Result<(), Interrupt> {
        if progress.is_proven() {
            return Ok(());
        }
        if let Some(closure) = Closure::of(self.network, work)?
            && closure.bytes() <= LARGE_TABLE_BYTES
            && let Some(found) = closure.bound(work)?
        {
            work.step()?;
            progress.offer(self.network, &found.walk);
            progress.raise_bound(found.bound);
        }
        Ok(())
    }

    /// The proof on this thread, local search on another.
    fn side_by_side(
        &mut self,
        local: &mut GuidedSearch<'_>,
        first: &[usize],
        duals: (&[i64], &[i64]),
        progress: &mut Progress<'_>,
        work: &mut Work<'_>,
    ) -> Result<Ending, Interrupt> {
        let shared = Shared::new(progress.best());
        let enough = AtomicBool::new(false);
        let budget = work.budget();
        std::thread::scope(|scope| {
            let beside = scope.spawn(|| {
                let mut silent = Silent;
                let mut found = Progress::new(&mut silent);
                let mut found = found.beside(&shared);
                let mut work = Work::beside(budget, &enough);
                while local.improve(GUIDED_KICKS, first, &mut found, &mut work).is_ok() {}
                work.iterations()
            });
            let mut here = progress.beside(&shared);
            let ending = self.prove(None, first, duals, &mut here, work);
            enough.store(true, Ordering::Relaxed);
            let spent = beside.join().unwrap_or(0);
            here.upper();
            let (best, bound) = here.into_found();
            progress.take_over(best, bound);
            work.add(spent);
            ending
        })
    }
}

/// What is true when everything was looked at.
fn closed(progress: &mut Progress<'_>) -> Ending {
    match progress.upper() {
        i64::MAX => Ending::ProvenInfeasible,
        upper => {
            progress.raise_bound(upper);
            Ending::ProvenOptimal
        }
    }
}

fn closed_or_open(progress: &mut Progress<'_>) -> Ending {
    if progress.is_proven() { Ending::ProvenOptimal } else { Ending::Exhausted }
}

/// Takes tours of visits over.
pub(crate) struct Offers<'a, 'b> {
    pub(crate) network: &'a Network,
    pub(crate) visits: &'a Visits<'a>,
    pub(crate) progress: &'a mut Progress<'b>,
}

impl Incumbent for Offers<'_, '_> {
    fn upper(&mut self) -> i64 {
        self.progress.upper()
    }

    fn offer(&mut self, order: &[usize], _cost: i64) {
        self.progress.offer(self.network, &self.visits.walk(order));
    }
}
