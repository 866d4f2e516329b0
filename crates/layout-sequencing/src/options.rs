//! How sections are ordered: by which method, on which effects, and how hard.

use traverse_geometry::PlacedSection;
use traverse_solve::Seed;

/// Which method decides the order. Placing is exact whatever the method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Algorithm {
    /// The best that is known for the question.
    #[default]
    Best,
    /// None: evaluates [`OrderOptions::initial_order`].
    GivenOrder,
    /// Branch and bound with an assignment bound, every section held at the end in turn, as published in 2009.
    BranchAndBound,
    /// An ant colony, as published in 2009.
    AntColony,
    /// Successive improvement of one order, as published in 2009.
    LocalImprovement,
}

impl Algorithm {
    /// Every method.
    pub const ALL: [Self; 5] =
        [Self::Best, Self::GivenOrder, Self::BranchAndBound, Self::AntColony, Self::LocalImprovement];

    /// Its name in answers, lower case.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Best => "best",
            Self::GivenOrder => "given order",
            Self::BranchAndBound => "branch and bound",
            Self::AntColony => "ant colony",
            Self::LocalImprovement => "local improvement",
        }
    }

    /// Whether it is one of the methods published in 2009. They know neither poses to choose from nor precedence nor
    /// the free slide rule.
    #[must_use]
    pub fn is_published(self) -> bool {
        matches!(self, Self::BranchAndBound | Self::AntColony | Self::LocalImprovement)
    }
}

/// Which effects of joins decide the order. Placing is exact whatever the model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum EffectModel {
    /// The true ones.
    #[default]
    Exact,
    /// From local extremes only, as published in 2009: too large in places.
    Published,
}

/// What parts of one section may do among themselves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum InnerOverlap {
    /// Overlapping deeper than the contact tolerance is a finding.
    #[default]
    Refused,
    /// They may overlap; the section is what they cover together.
    Allowed,
}

/// Whether a plan lists what stopped each section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ContactList {
    /// One join of neighbours or so for each section, after the search.
    #[default]
    Listed,
    /// Nobody asks for them: the list is empty.
    Omitted,
}

/// How sections are ordered.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OrderOptions {
    /// The method.
    pub algorithm: Algorithm,
    /// The effects that decide.
    pub effect_model: EffectModel,
    /// An order to start from, or to evaluate: every copy of every section once, left to right. `x_mm` is not read.
    /// Absent: none.
    pub initial_order: Option<Vec<PlacedSection>>,
    /// Whether parts may overlap inside their section.
    pub inner_overlap: InnerOverlap,
    /// Whether the plan lists contacts.
    pub contacts: ContactList,
    /// Where chance comes from.
    pub seed: Seed,
    /// How many threads work, at least 1; 0 counts as 1. With 1 the same question, seed and iteration limit give the
    /// same answer.
    pub threads: usize,
    /// Stop when (length − bound) / length is at most this, from 0 to 1. Absent: only a proof ends the search.
    pub gap_limit: Option<f64>,
}
