//! The one form of all cuts here: at least one arc leads from the nodes of one set to the nodes of another.
//!
//! With the sets complementary it is the subtour elimination of Dantzig, Fulkerson and Johnson; with nodes left
//! out of both it is a precedence inequality of Balas, Fischetti and Pulleyblank.

/// Where a node stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Side {
    From,
    To,
    Neither,
}

/// At least one arc leads from `Side::From` to `Side::To`.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Crossing {
    sides: Vec<Side>,
    from: Vec<usize>,
    to: Vec<usize>,
}

impl Crossing {
    pub(crate) fn new(sides: Vec<Side>) -> Self {
        let of = |side| (0..sides.len()).filter(|&node| sides[node] == side).collect();
        Self { from: of(Side::From), to: of(Side::To), sides }
    }

    /// Out of a set into all others.
    pub(crate) fn out_of(size: usize, nodes: &[usize]) -> Self {
        let mut sides = vec![Side::To; size];
        for &node in nodes {
            sides[node] = Side::From;
        }
        Self::new(sides)
    }

    pub(crate) fn contains(&self, from: usize, to: usize) -> bool {
        self.sides[from] == Side::From && self.sides[to] == Side::To
    }

    pub(crate) fn from(&self) -> &[usize] {
        &self.from
    }

    pub(crate) fn to(&self) -> &[usize] {
        &self.to
    }

    /// Whether every node is on one side.
    pub(crate) fn is_connectivity(&self) -> bool {
        self.from.len() + self.to.len() == self.sides.len()
    }
}
