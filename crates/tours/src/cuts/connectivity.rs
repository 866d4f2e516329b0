//! Violated subtour eliminations: sets of nodes that less than one arc leaves.
//!
//! What comes into a set equals what goes out, so that both together are a cut of an undirected graph and a minimum
//! cut finds the worst set. First connected components; then nodes that no cut below the target separates are
//! merged (Padberg and Rinaldi 1990), and what is left goes through the minimum cut of Stoer and Wagner (1997),
//! every phase of which yields a candidate. O(n³) at worst, on what is left after merging.

use super::crossing::Crossing;
use super::support::Support;
use crate::work::Work;
use std::collections::HashSet;
use traverse_solve::Interrupt;

/// Both directions together: a tour has 2 at least.
const TARGET: f64 = 2.0 - 1e-4;

/// Violated subtour eliminations, none when there are none.
pub(crate) fn violated(support: &Support, work: &Work<'_>) -> Result<Vec<Crossing>, Interrupt> {
    let size = support.size;
    let components = support.components();
    if components.len() > 1 {
        let smaller = components.iter().filter(|set| set.len() * 2 <= size || components.len() > 2);
        let mut cuts: Vec<Crossing> = smaller.map(|set| Crossing::out_of(size, set)).collect();
        if cuts.is_empty() {
            cuts.push(Crossing::out_of(size, &components[0]));
        }
        return Ok(cuts);
    }
    let mut graph = Graph::of(support);
    let mut found: HashSet<Vec<usize>> = HashSet::new();
    graph.merge_safe(work)?;
    while graph.alive.len() > 1 {
        work.breathe()?;
        let (before, last, value) = graph.phase();
        if value < TARGET {
            found.insert(canonical(size, &graph.members[last]));
        }
        graph.merge(before, last);
    }
    let mut sets: Vec<Vec<usize>> = found.into_iter().collect();
    sets.sort_unstable();
    Ok(sets.iter().map(|set| Crossing::out_of(size, set)).collect())
}

/// The smaller side; of halves the one without node 0.
fn canonical(size: usize, nodes: &[usize]) -> Vec<usize> {
    let mut inside = vec![false; size];
    nodes.iter().for_each(|&node| inside[node] = true);
    let small = nodes.len() * 2 < size || (nodes.len() * 2 == size && !inside[0]);
    (0..size).filter(|&node| inside[node] == small).collect()
}

struct Graph {
    size: usize,
    weights: Vec<f64>,
    degrees: Vec<f64>,
    alive: Vec<usize>,
    members: Vec<Vec<usize>>,
}

impl Graph {
    fn of(support: &Support) -> Self {
        let size = support.size;
        let mut weights = vec![0.0; size * size];
        for &(from, to, value) in &support.arcs {
            if from != to {
                weights[from * size + to] += value;
                weights[to * size + from] += value;
            }
        }
        let degrees = (0..size).map(|node| weights[node * size..][..size].iter().sum()).collect();
        let members = (0..size).map(|node| vec![node]).collect();
        Self { size, weights, degrees, alive: (0..size).collect(), members }
    }

    fn merge(&mut self, into: usize, gone: usize) {
        let size = self.size;
        for &other in &self.alive {
            if other != into && other != gone {
                let weight = self.weights[gone * size + other];
                self.weights[into * size + other] += weight;
                self.weights[other * size + into] += weight;
            }
        }
        self.degrees[into] += self.degrees[gone] - 2.0 * self.weights[into * size + gone];
        self.alive.retain(|&node| node != gone);
        let moved = std::mem::take(&mut self.members[gone]);
        self.members[into].extend(moved);
    }

    /// Merges neighbours so close that a cut between them is no better than one of the two alone.
    fn merge_safe(&mut self, work: &Work<'_>) -> Result<(), Interrupt> {
        let mut again = true;
        while again {
            again = false;
            let mut at = 0;
            while at < self.alive.len() {
                work.breathe()?;
                let node = self.alive[at];
                let safe = |other: &&usize| {
                    let weight = self.weights[node * self.size + **other];
                    **other != node
                        && weight > 1e-9
                        && weight * 2.0 >= self.degrees[node].min(self.degrees[**other]) - 1e-9
                        && self.degrees[node] >= TARGET
                        && self.degrees[**other] >= TARGET
                };
                match self.alive.iter().find(safe).copied() {
                    Some(other) => {
                        self.merge(node, other);
                        again = true;
                        at = self.alive.iter().position(|&alive| alive == node).unwrap_or(at);
                    }
                    None => at += 1,
                }
            }
        }
        Ok(())
    }

    /// One maximum adjacency order: the last node but one, the last, and the cut that parts the last from all.
    fn phase(&self) -> (usize, usize, f64) {
        let mut strength: Vec<f64> = vec![0.0; self.size];
        let mut waiting = self.alive.clone();
        let mut before = waiting[0];
        let mut last = waiting[0];
        let mut value = 0.0;
        while !waiting.is_empty() {
            let most = (0..waiting.len())
                .max_by(|&a, &b| strength[waiting[a]].total_cmp(&strength[waiting[b]]).then(b.cmp(&a)))
                .unwrap_or(0);
            let node = waiting.swap_remove(most);
            (before, last, value) = (last, node, strength[node]);
            for &other in &waiting {
                strength[other] += self.weights[node * self.size + other];
            }
        }
        (before, last, value)
    }
}
