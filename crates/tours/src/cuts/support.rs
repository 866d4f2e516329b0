//! The arcs that a fractional solution uses, with how much.

/// The arcs that a fractional solution uses.
#[derive(Clone, Debug)]
pub(crate) struct Support {
    pub(crate) size: usize,
    /// From, to, how much.
    pub(crate) arcs: Vec<(usize, usize, f64)>,
}

/// Less than this is no use.
pub(crate) const UNUSED: f64 = 1e-7;

impl Support {
    /// Whether every arc is used a whole number of times.
    pub(crate) fn is_whole(&self) -> bool {
        self.arcs.iter().all(|&(.., value)| (value - value.round()).abs() < 1e-6)
    }

    /// Sets of nodes that are connected with one another.
    pub(crate) fn components(&self) -> Vec<Vec<usize>> {
        let mut leader: Vec<usize> = (0..self.size).collect();
        for &(from, to, _) in &self.arcs {
            let (a, b) = (find(&mut leader, from), find(&mut leader, to));
            leader[a] = b;
        }
        let mut sets = vec![vec![]; self.size];
        for node in 0..self.size {
            sets[find(&mut leader, node)].push(node);
        }
        sets.retain(|set: &Vec<usize>| !set.is_empty());
        sets
    }
}

fn find(leader: &mut [usize], mut node: usize) -> usize {
    while leader[node] != node {
        leader[node] = leader[leader[node]];
        node = leader[node];
    }
    node
}
