//! What the curves of a drawing stand for.

use crate::{Drawing, Selector, Source};
use std::fmt;

/// Layers of these names are the work area unless [`Roles`] says otherwise.
pub const WORK_AREA_LAYERS: [&str; 3] = ["WORK_AREA", "WORKAREA", "TABLE"];

/// What a curve of a drawing stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Role {
    /// Its outermost loop bounds the work area.
    WorkArea,
    /// Its loops are parts to be cut out.
    Part,
    /// Its loops are sections of a cutting layout.
    Section,
    /// Its loops are obstacles.
    Obstacle,
    /// Nothing chose it.
    None,
}

/// What the curves of a drawing stand for. The first list in this order that chooses a curve decides.
#[derive(Clone, Debug, PartialEq)]
pub struct Roles {
    /// What bounds the work area. Default: [`WORK_AREA_LAYERS`].
    pub work_area: Vec<Selector>,
    /// Parts: every outermost loop is one, with the loops directly inside it as holes. Default: none.
    pub parts: Vec<Selector>,
    /// Sections: all that is chosen by the same name (one group, one layer) is one section. Default: none.
    pub sections: Vec<Selector>,
    /// Obstacles. Default: everything, without a top.
    pub obstacles: Vec<ObstacleRole>,
}

/// Curves that are obstacles, and what is the same for all of them.
#[derive(Clone, Debug, PartialEq)]
pub struct ObstacleRole {
    /// Which.
    pub selector: Selector,
    /// How high they reach, millimetres. Absent: higher than any move.
    pub top_mm: Option<f64>,
    /// Clearance that is kept from them, millimetres. Absent: the scene's.
    pub clearance_mm: Option<f64>,
}

impl ObstacleRole {
    /// Obstacles higher than any move, with the scene's clearance.
    #[must_use]
    pub fn new(selector: &str) -> Self {
        Self { selector: Selector::new(selector), top_mm: None, clearance_mm: None }
    }
}

/// The role of a curve, the place of the selector that chose it in its list, and the name that it was chosen by.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Chosen {
    pub(crate) role: Role,
    pub(crate) place: usize,
    pub(crate) name: String,
}

impl Default for Roles {
    fn default() -> Self {
        Self {
            work_area: WORK_AREA_LAYERS.map(Selector::new).to_vec(),
            parts: Vec::new(),
            sections: Vec::new(),
            obstacles: vec![ObstacleRole::new("*")],
        }
    }
}

impl Roles {
    /// What a curve on that layer, of that source, stands for.
    #[must_use]
    pub fn of(&self, layer: &str, source: &Source) -> Role {
        self.choose(layer, source).role
    }

    pub(crate) fn choose(&self, layer: &str, source: &Source) -> Chosen {
        let found = self.selectors().find_map(|(role, place, selector)| {
            selector.name_chosen(layer, source).map(|name| Chosen { role, place, name })
        });
        found.unwrap_or(Chosen { role: Role::None, place: 0, name: layer.to_owned() })
    }

    fn selectors(&self) -> impl Iterator<Item = (Role, usize, &Selector)> {
        let lists =
            [(Role::WorkArea, &self.work_area), (Role::Part, &self.parts), (Role::Section, &self.sections)];
        let named = lists.into_iter().flat_map(|(role, list)| {
            list.iter().enumerate().map(move |(place, selector)| (role, place, selector))
        });
        let obstacles = self.obstacles.iter().enumerate();
        named.chain(obstacles.map(|(place, each)| (Role::Obstacle, place, &each.selector)))
    }

    /// Whether something on that layer, of which no more is known, may stand for something.
    pub(crate) fn may_choose_on(&self, layer: &str) -> bool {
        self.selectors().any(|(_, _, selector)| selector.may_choose_on(layer))
    }

    /// Selectors that were asked for and choose no curve.
    pub(crate) fn unmatched(&self, drawing: &Drawing) -> Vec<Selector> {
        let defaults = Self::default();
        let is_default = |selector: &Selector| defaults.selectors().any(|(_, _, each)| each == selector);
        let chooses_none = |selector: &Selector| {
            !drawing
                .layers
                .iter()
                .any(|layer| layer.curves.iter().any(|curve| selector.chooses(&layer.name, &curve.source)))
        };
        let asked = self.selectors().map(|(_, _, selector)| selector);
        asked.filter(|each| !is_default(each) && chooses_none(each)).cloned().collect()
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::WorkArea => "work area",
            Self::Part => "parts",
            Self::Section => "sections",
            Self::Obstacle => "obstacles",
            Self::None => "not used",
        })
    }
}
