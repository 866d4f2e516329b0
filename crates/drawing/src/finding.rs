//! What is wrong with a drawing, with the layer and the place.

use crate::Source;
use std::fmt;
use traverse_geometry::{Finding, Point, Reason};

/// One thing that is wrong with a drawing. It says where, so that a picture can mark it.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawingFinding {
    /// Layer name.
    pub layer: String,
    /// Id of the entity that is meant, the first one of several, if the file says one: a handle in DXF.
    pub entity: Option<String>,
    /// Where to look, millimetres: the crossing of loops that cross, a loose end of an open chain, the meeting point
    /// of a junction, otherwise a vertex of what is meant.
    pub place: Point,
    /// What is wrong.
    pub fault: Fault,
}

impl DrawingFinding {
    /// Something wrong with what has that source.
    pub(crate) fn new(layer: &str, source: &Source, place: Point, fault: Fault) -> Self {
        Self { layer: layer.to_owned(), entity: source.id.clone(), place, fault }
    }
}

/// What is wrong at a place of a drawing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// Lines and arcs that join to a chain but not to a loop. The finding's place is one loose end.
    OpenChain {
        /// The other loose end.
        other_end: Point,
        /// Distance between both ends, millimetres.
        gap_mm: f64,
        /// Length of the chain, millimetres.
        length_mm: f64,
    },
    /// Three or more ends meet, so it can't be told which belong together.
    Junction {
        /// How many.
        ends: usize,
    },
    /// An entity that is drawn once more on top of an equal one; it counts once.
    Duplicate,
    /// An entity shorter than the joining tolerance; it is left out.
    TooShort {
        /// Millimetres.
        length_mm: f64,
    },
    /// A curve with a coordinate or bulge that is no finite number; it is left out. Readers let none through.
    NotFinite,
    /// A loop that is no valid ring, or does not fit the loop around it; it is left out.
    InvalidLoop {
        /// What geometry says.
        finding: Finding,
    },
    /// A loop that lies partly inside another loop of its layer; both count as solid obstacles.
    CrossingLoops {
        /// What geometry says.
        finding: Finding,
    },
    /// Two loops of a layer, side by side, that cross; both count as solid obstacles.
    LoopsCross,
    /// Two curves that run along one another: a machine would cut there twice.
    Overlap {
        /// For how long, millimetres.
        length_mm: f64,
    },
    /// So many curves lie beside one another that not all pairs were compared: more may cross or overlap.
    NotAllCompared,
    /// A loop inside a hole of the work area: unreachable from outside, so it is left out.
    IslandInWorkArea,
}

impl Fault {
    /// Whether something that was drawn is missing from the result because of this.
    #[must_use]
    pub fn loses_something(&self) -> bool {
        !matches!(
            self,
            Self::Duplicate
                | Self::TooShort { .. }
                | Self::CrossingLoops { .. }
                | Self::LoopsCross
                | Self::Overlap { .. }
                | Self::NotAllCompared
        )
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OpenChain { other_end, gap_mm, length_mm } => write!(
                f,
                "open chain of {length_mm:.3} mm; its other end lies at {:.3},{:.3}, a gap of {gap_mm:.4} mm; close it",
                other_end.x, other_end.y
            ),
            Self::Junction { ends } => {
                write!(f, "{ends} ends meet, so loops can't be told apart; leave two ends at this point")
            }
            Self::Duplicate => f.write_str("drawn twice; counted once, delete one of both"),
            Self::TooShort { length_mm } => {
                write!(f, "only {length_mm:.6} mm long, less than the joining tolerance; left out, delete it")
            }
            Self::InvalidLoop { finding } => write!(f, "{}; left out", in_the_shop(finding)),
            Self::CrossingLoops { finding } => {
                write!(f, "{}; both taken as solid", in_the_shop(finding))
            }
            Self::NotFinite => f.write_str("a number of it is not finite; left out, draw it again"),
            Self::LoopsCross => f.write_str("two loops cross; both taken as solid, part them or join them"),
            Self::Overlap { length_mm } => write!(
                f,
                "two curves run along one another for {length_mm:.3} mm; delete one there unless both are meant"
            ),
            Self::NotAllCompared => f.write_str(
                "too many curves lie beside one another to look for every crossing and overlap; split the drawing",
            ),
            Self::IslandInWorkArea => f.write_str("loop inside a hole of the work area; left out, delete it"),
        }
    }
}

/// What geometry says of a loop, without its numbers of edges and holes.
fn in_the_shop(finding: &Finding) -> &str {
    match (finding.reason, finding.field.starts_with("holes")) {
        (Reason::EdgesCross, false) => "the loop crosses itself here: move a corner, or split it",
        (Reason::EdgesCross, true) => "two loops, one around the other, cross here: part them or join them",
        (Reason::NoArea, false) => "the loop encloses no area: open it, or delete it",
        (Reason::NoArea, true) => "the loops inside leave nothing of the loop around them: delete one",
        (Reason::TooFewVertices, _) => "the loop has too few corners to enclose anything: delete it",
        (Reason::ArcTooFlat, _) => "an arc of the loop is too flat from here on: draw a line instead",
        (Reason::HoleOutside, _) => "the loop is not inside the one around it: part them",
        (Reason::HoleInHole, _) => "loops inside another one overlap here: part them or join them",
        (Reason::TooMany, _) => "too many edges lie over one another to be checked: split the loop",
        _ => &finding.message,
    }
}

impl fmt::Display for DrawingFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "layer {} at {:.3},{:.3} mm", self.layer, self.place.x, self.place.y)?;
        if let Some(entity) = &self.entity {
            write!(f, " (entity {entity})")?;
        }
        write!(f, ": {}", self.fault)
    }
}
