//! The one entry: validates, solves by the method asked for, answers.

use crate::answer::{Ending, Tour, TourAnswer};
use crate::certificate::Certificate;
use crate::network::Network;
use crate::options::{Method, SolveOptions};
use crate::{Finding, TourSpecification, ladder, published};
use traverse_solve::{Budget, Observer};

/// Orders what is to be ordered.
///
/// # Errors
/// Everything that is wrong with the specification.
pub fn solve(
    specification: &TourSpecification,
    options: &SolveOptions,
    budget: &Budget,
    observer: &mut dyn Observer,
) -> Result<TourAnswer, Vec<Finding>> {
    let mut findings = specification.findings();
    if options.method != Method::Ladder && !specification.precedence.is_empty() {
        findings.push(Finding::MethodWithoutPrecedence);
    }
    if !findings.is_empty() {
        return Err(findings);
    }
    let network = Network::of(specification);
    let visits: Vec<usize> = network.members.concat();
    if let [only] = visits[..] {
        observer.better_bound(0.0);
        observer.better_cost(0.0);
        return Ok(TourAnswer {
            tour: Some(Tour { visits: vec![only], cost: 0 }),
            lower_bound: 0,
            certificate: Certificate { parts: 1, ..Certificate::default() },
            certified_bound: 0,
            ending: Ending::ProvenOptimal,
            iterations: 0,
        });
    }
    Ok(match options.method {
        Method::Ladder => ladder::climb(specification, &network, options, budget, observer),
        _ => published::run(specification, &network, options, budget, observer),
    })
}
