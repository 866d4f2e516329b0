//! Branch and cut over types with counts: linear relaxations with lazily priced arcs, connectivity and precedence
//! cuts, reduced-cost fixing, branching on the arc whose two sides raise the bound most.
//!
//! With all counts 1 this is branch and cut for the asymmetric travelling salesman (Fischetti, Lodi, Toth 2002);
//! with counts it is the many-visits model, whose solutions become tours by an Euler walk. Nodes are kept best
//! first; each is a list of bound changes, and one linear program serves them all. Every bound that prunes is
//! recomputed in whole numbers (`exact_bound`).

mod branching;
mod pricing;
mod relaxation;
mod tree;

use crate::exact_bound::Duals;
use crate::network::Network;
use crate::progress::Progress;
use crate::work::Work;
use relaxation::{Relaxation, Relaxed};
use traverse_solve::Interrupt;
use tree::{Node, Tree};

/// The most types of a network that this is tried on.
pub(crate) const LARGEST_SIZE: usize = 500;

/// How branch and cut ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Closed {
    /// No tour is cheaper than the best known, or there is none.
    Yes,
    /// Rounding kept some node from being decided.
    No,
}

/// Duals of the root with the cuts that they weigh, for the certificate.
pub(crate) type RootDuals = (Duals, Vec<crate::cuts::crossing::Crossing>);

/// Branch and cut that can be looked at between root and tree.
pub(crate) struct BranchAndCut<'a> {
    network: &'a Network,
    relaxation: Relaxation<'a>,
    tree: Tree,
    closed: Closed,
}

impl<'a> BranchAndCut<'a> {
    /// Begins from feasible duals, one for each row and column.
    pub(crate) fn new(
        network: &'a Network,
        row: &[i64],
        column: &[i64],
        progress: &mut Progress<'_>,
    ) -> Self {
        let relaxation = Relaxation::new(network, row, column, progress);
        Self { network, relaxation, tree: Tree::default(), closed: Closed::Yes }
    }

    /// Solves the root: bound, cuts, fixed arcs.
    pub(crate) fn root(&mut self, progress: &mut Progress<'_>, work: &mut Work<'_>) -> Result<(), Interrupt> {
        self.visit(Node::default(), progress, work)
    }

    /// The duals that the root has come to.
    pub(crate) fn root_duals(&self) -> Option<RootDuals> {
        self.relaxation.root_duals()
    }

    /// Visits up to `nodes` more nodes. Whether the tree is done.
    pub(crate) fn grow(
        &mut self,
        nodes: u64,
        progress: &mut Progress<'_>,
        work: &mut Work<'_>,
    ) -> Result<bool, Interrupt> {
        for _ in 0..nodes {
            let Some(node) = self.tree.pop() else { return Ok(true) };
            self.visit(node, progress, work)?;
        }
        Ok(self.tree.is_empty())
    }

    /// How it ended, once the tree is done.
    pub(crate) fn closed(&self) -> Closed {
        self.closed
    }

    fn visit(
        &mut self,
        node: Node,
        progress: &mut Progress<'_>,
        work: &mut Work<'_>,
    ) -> Result<(), Interrupt> {
        work.step()?;
        if self.closed == Closed::Yes {
            progress.raise_bound(node.bound_cost());
        }
        if node.bound_cost() >= progress.upper() {
            return Ok(());
        }
        self.relaxation.enter(&node);
        let sides = match self.relaxation.relax(&node, self.network, progress, work)? {
            Relaxed::Pruned => Some((None, node.parts)),
            Relaxed::Undecided => {
                let halves = self.relaxation.halve();
                if halves.is_none() {
                    self.relaxation.decide_pinned(self.network, progress);
                }
                Some((halves, node.parts))
            }
            Relaxed::Fractional { parts } => self.relaxation.branch(work)?.map(|sides| (Some(sides), parts)),
        };
        match sides {
            Some((sides, parts)) => {
                for side in sides.into_iter().flatten() {
                    self.tree.push(node.child(side, parts));
                }
            }
            None => self.closed = Closed::No,
        }
        if self.tree.is_full() {
            return Err(Interrupt::Memory);
        }
        if self.closed == Closed::Yes {
            let bound = self.tree.bound().unwrap_or(progress.upper());
            progress.raise_bound(bound);
        }
        Ok(())
    }
}
