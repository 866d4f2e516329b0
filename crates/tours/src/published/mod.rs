//! The methods published in 2009, by name: what users compare with. They decide what they decided then; bounds and
//! certificates beside them are ours.

mod ant_colony;
mod section_models;
mod successive_improvement;

pub use section_models::{SectionModel, order_with_every_end};

use crate::TourSpecification;
use crate::answer::{Ending, Tour, TourAnswer};
use crate::assignment::{Assignment, Matched};
use crate::assignment_search::{Branching, Searched, search};
use crate::certificate::Certificate;
use crate::ladder::Offers;
use crate::network::Network;
use crate::options::{Method, SolveOptions};
use crate::patching::patch;
use crate::progress::Progress;
use crate::visits::{GuideCosts, Visits};
use crate::work::Work;
use traverse_solve::{Budget, Interrupt, Observer};

/// The answer of a published method to a specification without findings and without an order to keep.
pub(crate) fn run(
    specification: &TourSpecification,
    network: &Network,
    options: &SolveOptions,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> TourAnswer {
    let visits = Visits::of(network);
    let mut progress = Progress::new(observer);
    let mut work = Work::new(budget);
    let mut certificate = Certificate::row_minima(network.entries(), &network.counts);
    progress.raise_bound(certificate.1);
    let ending = by_method(network, &visits, options, &mut certificate, &mut progress, &mut work)
        .unwrap_or_else(Ending::Interrupted);
    let ending = if progress.is_proven() { Ending::ProvenOptimal } else { ending };
    let (best, lower_bound) = progress.into_found();
    TourAnswer {
        tour: best.map(|(walk, cost)| Tour { visits: network.visits_of(&walk, specification), cost }),
        lower_bound,
        certificate: certificate.0,
        certified_bound: certificate.1,
        ending,
        iterations: work.iterations(),
    }
}

fn by_method(
    network: &Network,
    visits: &Visits<'_>,
    options: &SolveOptions,
    certificate: &mut (Certificate, i64),
    progress: &mut Progress<'_>,
    work: &mut Work<'_>,
) -> Result<Ending, Interrupt> {
    let (assignment, matched) = Assignment::solve(visits, work)?;
    if matched == Matched::None {
        return Ok(Ending::ProvenInfeasible);
    }
    let (row, column) = (visits.type_duals(&assignment.row), visits.type_duals(&assignment.column));
    let every: Vec<Vec<usize>> = (0..network.size).map(|node| vec![node]).collect();
    *certificate = Certificate::of_assignment(network.size, &network.counts, &every, &row, &column);
    progress.raise_bound(assignment.bound());
    let guide = GuideCosts::of(visits, &assignment.row, &assignment.column, work)?;
    let mut offers = Offers { network, visits, progress };
    match options.method {
        Method::AntColony => ant_colony::search(&guide, options.seed, &mut offers, work)?,
        Method::SuccessiveImprovement => {
            let order = patch(&guide, &assignment.successor, work)?;
            successive_improvement::search(&guide, order, &mut offers, work)?;
        }
        Method::BranchAndBound | Method::Ladder => {
            let searched = search(visits, &assignment, Branching::OneArc, u64::MAX, &mut offers, work)?;
            if searched == Searched::Everything {
                let upper = progress.upper();
                if upper == i64::MAX {
                    return Ok(Ending::ProvenInfeasible);
                }
                progress.raise_bound(upper);
            }
        }
    }
    Ok(Ending::Exhausted)
}
