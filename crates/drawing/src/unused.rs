//! What a drawing holds that could not be used: counted, never silently dropped.

use std::fmt;

/// Entities of one type on one layer that were not used, and why.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Unused {
    /// Layer name as in the file; empty when the file does not let it be known.
    pub layer: String,
    /// Entity type as in the file, such as `HATCH`.
    pub entity: String,
    /// Why.
    pub why: WhyUnused,
    /// How many.
    pub count: usize,
}

/// Why an entity was not used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum WhyUnused {
    /// This version does not read entities of its type.
    Type,
    /// Its extrusion direction is neither +Z nor −Z: drawn in another plane.
    Extrusion,
    /// On a layout sheet (paper space), not in the model.
    PaperSpace,
    /// It has no length, or is inserted with a scale of 0.
    NoLength,
    /// Text, a dimension or the like: nothing that a machine could meet. Text is not converted to outlines.
    Annotation,
    /// Not visible: `display: none` or `visibility: hidden`.
    Hidden,
    /// Clipped or masked in the picture; here it was read whole.
    Clipped,
    /// What it refers to is not in the file.
    Reference,
    /// A style rule whose selector is not read: colours may differ, and hidden elements be read.
    Selector,
    /// A face, mesh or body in space.
    Body,
    /// A picture or another file's page behind the drawing: what it shows is not known.
    Picture,
    /// A filling whose border is drawn too: by curves on its layer that the file ties to it.
    Filling,
    /// It inserts a block that the file does not hold, or that lies in another file.
    UnknownBlock,
    /// Its own numbers contradict one another, such as a spline's knots and control points, or are none that it can
    /// have: a negative radius.
    Inconsistent,
    /// It is a band: drawn with a width, of which only the centre line was read.
    Width,
    /// It climbs; here it was read as seen from above.
    Height,
}

impl fmt::Display for WhyUnused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Type => "entities of this type are not read",
            Self::Extrusion => "extrusion direction is neither +Z nor -Z",
            Self::PaperSpace => "in paper space",
            Self::NoLength => "without length",
            Self::Annotation => "annotation",
            Self::Hidden => "not visible",
            Self::Clipped => "clipped in the picture, read whole",
            Self::Reference => "refers to what is not in the file",
            Self::Selector => "style rules with such selectors are not read",
            Self::Body => "a face, mesh or body in space",
            Self::Picture => "a picture",
            Self::Filling => "a filling whose border is drawn too",
            Self::UnknownBlock => "its block is not in the file",
            Self::Inconsistent => "its numbers contradict one another",
            Self::Width => "its width is not read, only its centre line",
            Self::Height => "in 3D: its height varies, read as seen from above",
        })
    }
}

impl fmt::Display for Unused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} × {} on layer {}: {}", self.count, self.entity, self.layer, self.why)?;
        match self.what_to_do() {
            Some(advice) => write!(f, "; {advice}"),
            None => Ok(()),
        }
    }
}

impl Unused {
    /// What to do where a machine could meet it.
    fn what_to_do(&self) -> Option<&'static str> {
        match self.why {
            WhyUnused::Type if self.entity == "HATCH" => Some(
                "draw its border as a closed polyline on its layer, and tie the hatch to it or delete it",
            ),
            WhyUnused::Type => Some("explode it to lines, arcs and polylines"),
            WhyUnused::Extrusion | WhyUnused::Body => Some("draw its outline in the plane from above"),
            WhyUnused::Picture => Some("draw over what matters of it, and take it out"),
            WhyUnused::UnknownBlock => Some("bind what it refers to into the file, or explode it"),
            WhyUnused::Inconsistent => Some("draw it again"),
            WhyUnused::Width => Some("draw the outline of the band, and set the width to 0"),
            WhyUnused::Reference => Some("draw what is meant here"),
            WhyUnused::PaperSpace
            | WhyUnused::NoLength
            | WhyUnused::Annotation
            | WhyUnused::Filling
            | WhyUnused::Hidden
            | WhyUnused::Clipped
            | WhyUnused::Selector
            | WhyUnused::Height => None,
        }
    }
}

impl WhyUnused {
    /// Whether a machine could meet what was not used.
    #[must_use]
    pub fn loses_something(self) -> bool {
        match self {
            Self::Type
            | Self::Extrusion
            | Self::Body
            | Self::Picture
            | Self::UnknownBlock
            | Self::Inconsistent
            | Self::Reference
            | Self::Width => true,
            Self::PaperSpace
            | Self::NoLength
            | Self::Annotation
            | Self::Filling
            | Self::Hidden
            | Self::Clipped
            | Self::Selector
            | Self::Height => false,
        }
    }
}
