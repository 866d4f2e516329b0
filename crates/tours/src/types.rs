//! Equal nodes become one type that is visited many times.
//!
//! i and j are equal when their rows and columns agree outside the four entries between them, and those between
//! different members are uniform within the class. (Comparing whole rows would miss copies whose diagonal means
//! nothing.) Comparing with one representative of each class is enough: agreement outside the pair carries the
//! uniform cost over to every other member. O(n · classes) comparisons that mostly end at the first entries.

use crate::cost::{Costs, FORBIDDEN};
use crate::network::Network;
use crate::work::Work;
use traverse_solve::Interrupt;

/// A network with types, and the nodes that each type stands for.
pub(crate) type Collapsed = (Network, Vec<Vec<usize>>);

/// The same network with equal types merged; nothing where there are none, or an order is to be kept.
pub(crate) fn collapse(network: &Network, work: &Work<'_>) -> Result<Option<Collapsed>, Interrupt> {
    if !network.precedence.is_empty() {
        return Ok(None);
    }
    let mut classes: Vec<Class> = vec![];
    for at in 0..network.size {
        work.breathe()?;
        let joined = (network.depot != Some(at))
            .then(|| classes.iter_mut().find_map(|class| class.join(network, at)))
            .flatten();
        if joined.is_none() {
            let within = (network.counts[at] > 1).then(|| network.cost(at, at));
            classes.push(Class { members: vec![at], within });
        }
    }
    if classes.len() == network.size {
        return Ok(None);
    }
    let mut costs = Vec::with_capacity(classes.len() * classes.len());
    for (row, from) in classes.iter().enumerate() {
        work.breathe()?;
        for (column, to) in classes.iter().enumerate() {
            costs.push(if row == column {
                from.within.unwrap_or(FORBIDDEN)
            } else {
                network.cost(from.members[0], to.members[0])
            });
        }
    }
    let members: Vec<Vec<usize>> = classes.into_iter().map(|class| class.members).collect();
    Ok(Some((network.collapsed(&members, costs), members)))
}

struct Class {
    members: Vec<usize>,
    /// The cost between visits of the class; absent while there is only one visit.
    within: Option<i64>,
}

impl Class {
    fn join(&mut self, network: &Network, at: usize) -> Option<()> {
        let representative = self.members[0];
        if network.depot == Some(representative) {
            return None;
        }
        let within = network.cost(representative, at);
        let uniform = network.cost(at, representative) == within
            && self.within.is_none_or(|known| known == within)
            && (network.counts[at] == 1 || network.cost(at, at) == within);
        let agree = |other: usize| {
            other == at
                || other == representative
                || (network.cost(at, other) == network.cost(representative, other)
                    && network.cost(other, at) == network.cost(other, representative))
        };
        if !uniform || !(0..network.size).all(agree) {
            return None;
        }
        self.members.push(at);
        self.within = Some(within);
        Some(())
    }
}
