//! What comes before what, with everything that follows from it: the transitive closure of given pairs, in
//! O(n · pairs) by walking in topological order.

/// A partial order of nodes, closed under what follows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Precedence {
    size: usize,
    before: Vec<bool>,
    /// All nodes after each node.
    pub(crate) successors: Vec<Vec<usize>>,
    /// All nodes before each node.
    pub(crate) predecessors: Vec<Vec<usize>>,
    successor_bits: Vec<u64>,
    predecessor_bits: Vec<u64>,
}

impl Precedence {
    /// The closure of `pairs`, or a node that would come before itself.
    pub(crate) fn closure(size: usize, pairs: &[(usize, usize)]) -> Result<Self, usize> {
        let mut direct = vec![vec![]; size];
        let mut waiting = vec![0_usize; size];
        for &(a, b) in pairs {
            direct[a].push(b);
            waiting[b] += 1;
        }
        let mut order: Vec<usize> = (0..size).filter(|&node| waiting[node] == 0).collect();
        let mut done = 0;
        while done < order.len() {
            for &next in &direct[order[done]] {
                waiting[next] -= 1;
                if waiting[next] == 0 {
                    order.push(next);
                }
            }
            done += 1;
        }
        if let Some(node) = waiting.iter().position(|&left| left > 0) {
            return Err(node);
        }
        if pairs.is_empty() {
            return Ok(Self::none(size));
        }
        let mut before = vec![false; size * size];
        for &node in order.iter().rev() {
            for &next in &direct[node] {
                before[node * size + next] = true;
                for later in 0..size {
                    before[node * size + later] |= before[next * size + later];
                }
            }
        }
        let related = |from: usize, to: usize| before[from * size + to];
        let successors: Vec<Vec<usize>> =
            (0..size).map(|a| (0..size).filter(|&b| related(a, b)).collect()).collect();
        let predecessors: Vec<Vec<usize>> =
            (0..size).map(|b| (0..size).filter(|&a| related(a, b)).collect()).collect();
        let (successor_bits, predecessor_bits) = (bits(size, &successors), bits(size, &predecessors));
        Ok(Self { size, before, successors, predecessors, successor_bits, predecessor_bits })
    }

    /// No order at all.
    pub(crate) fn none(size: usize) -> Self {
        Self {
            size,
            before: vec![],
            successors: vec![vec![]; size],
            predecessors: vec![vec![]; size],
            successor_bits: vec![],
            predecessor_bits: vec![],
        }
    }

    /// The node's successors as bits, 64 to a word.
    pub(crate) fn successor_bits(&self, node: usize) -> &[u64] {
        row(&self.successor_bits, self.size, node)
    }

    /// The node's predecessors as bits, 64 to a word.
    pub(crate) fn predecessor_bits(&self, node: usize) -> &[u64] {
        row(&self.predecessor_bits, self.size, node)
    }

    /// Whether `a` must come before `b`.
    pub(crate) fn is_before(&self, a: usize, b: usize) -> bool {
        !self.before.is_empty() && self.before[a * self.size + b]
    }

    /// Whether nothing is ordered.
    pub(crate) fn is_empty(&self) -> bool {
        self.before.is_empty()
    }

    /// Whether `b` can follow `a` at once: not when it must come earlier, nor when something must stand between.
    pub(crate) fn may_follow(&self, a: usize, b: usize) -> bool {
        self.is_empty()
            || !(self.is_before(b, a)
                || (self.is_before(a, b) && self.successors[a].iter().any(|&mid| self.is_before(mid, b))))
    }

    /// Whether the sequence keeps the order.
    pub(crate) fn is_kept_by(&self, sequence: &[usize]) -> bool {
        let mut seen = vec![false; self.size];
        sequence.iter().all(|&node| {
            seen[node] = true;
            !self.successors[node].iter().any(|&later| seen[later])
        })
    }
}

fn bits(size: usize, lists: &[Vec<usize>]) -> Vec<u64> {
    let words = size.div_ceil(64);
    let mut bits = vec![0; size * words];
    for (node, list) in lists.iter().enumerate() {
        for &other in list {
            bits[node * words + other / 64] |= 1 << (other % 64);
        }
    }
    bits
}

fn row(bits: &[u64], size: usize, node: usize) -> &[u64] {
    let words = size.div_ceil(64);
    if bits.is_empty() { &[] } else { &bits[node * words..][..words] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_is_closed_and_circles_are_found() {
        let order = Precedence::closure(4, &[(0, 1), (1, 2)]).expect("no circle");
        assert!(order.is_before(0, 2) && !order.is_before(2, 0) && !order.is_before(0, 3));
        assert!(!order.may_follow(0, 2) && !order.may_follow(2, 1) && order.may_follow(0, 1));
        assert!(order.is_kept_by(&[0, 3, 1, 2]) && !order.is_kept_by(&[1, 0, 2, 3]));
        assert!(Precedence::closure(3, &[(0, 1), (1, 2), (2, 0)]).is_err());
        assert_eq!(Precedence::closure(1, &[(0, 0)]), Err(0));
    }
}
