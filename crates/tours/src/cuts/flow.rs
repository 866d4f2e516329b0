//! Maximum flow on a sparse graph (Dinic 1970), for cuts that leave some nodes out.

use super::support::Support;

/// A flow network that is filled anew for each pair of ends.
#[derive(Debug)]
pub(crate) struct Flow {
    size: usize,
    heads: Vec<usize>,
    capacities: Vec<f64>,
    original: Vec<f64>,
    starts: Vec<Vec<usize>>,
    levels: Vec<u32>,
}

const EPSILON: f64 = 1e-9;
const UNSEEN: u32 = u32::MAX;

impl Flow {
    pub(crate) fn new(support: &Support, skip: Option<usize>) -> Self {
        let mut flow = Self {
            size: support.size,
            heads: vec![],
            capacities: vec![],
            original: vec![],
            starts: vec![vec![]; support.size],
            levels: vec![],
        };
        for &(from, to, value) in &support.arcs {
            if from != to && skip != Some(from) && skip != Some(to) {
                flow.starts[from].push(flow.heads.len());
                flow.starts[to].push(flow.heads.len() + 1);
                flow.heads.extend([to, from]);
                flow.original.extend([value, 0.0]);
            }
        }
        flow
    }

    /// How much flows from source to target through nodes that are not `left_out`, stopping at `enough`, and which
    /// nodes the source reaches in what is left.
    pub(crate) fn run(
        &mut self,
        source: usize,
        target: usize,
        left_out: &[bool],
        enough: f64,
    ) -> (f64, Vec<bool>) {
        self.capacities.clone_from(&self.original);
        let mut total = 0.0;
        loop {
            self.level(source, left_out);
            if self.levels[target] == UNSEEN || total >= enough {
                return (total, self.levels.iter().map(|&level| level != UNSEEN).collect());
            }
            let mut next = vec![0; self.size];
            loop {
                let pushed = self.push(source, target, f64::INFINITY, &mut next);
                if pushed <= EPSILON {
                    break;
                }
                total += pushed;
            }
        }
    }

    fn level(&mut self, source: usize, left_out: &[bool]) {
        self.levels.clear();
        self.levels.resize(self.size, UNSEEN);
        self.levels[source] = 0;
        let mut queue = vec![source];
        let mut done = 0;
        while let Some(&node) = queue.get(done) {
            done += 1;
            for &arc in &self.starts[node] {
                let head = self.heads[arc];
                if self.capacities[arc] > EPSILON && self.levels[head] == UNSEEN && !left_out[head] {
                    self.levels[head] = self.levels[node] + 1;
                    queue.push(head);
                }
            }
        }
    }

    /// Pushes along one path of rising levels; paths are no longer than the graph has nodes.
    fn push(&mut self, node: usize, target: usize, most: f64, next: &mut [usize]) -> f64 {
        if node == target {
            return most;
        }
        while next[node] < self.starts[node].len() {
            let arc = self.starts[node][next[node]];
            let head = self.heads[arc];
            if self.capacities[arc] > EPSILON && self.levels[head] == self.levels[node] + 1 {
                let pushed = self.push(head, target, most.min(self.capacities[arc]), next);
                if pushed > EPSILON {
                    self.capacities[arc] -= pushed;
                    self.capacities[arc ^ 1] += pushed;
                    return pushed;
                }
            }
            next[node] += 1;
        }
        0.0
    }
}
