//! The question and the answer of a tool change.

use crate::{Algorithm, NoPath, RapidMove, RapidPlan};
use traverse_geometry::{
    COORDINATE_LIMIT_MM, EndRule, Finding, HeightRule, Point, Polygon, RapidRules, Reason,
};

/// A tool change to place.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolChange {
    /// Where the tool's centre is.
    pub start: Point,
    /// Where the new tool has to go.
    pub target: Point,
    /// The change may happen anywhere in one of these, their borders included.
    pub regions: Vec<Polygon>,
    /// Or at one of these points.
    pub points: Vec<Point>,
    /// Height at which the tool is changed, millimetres; counts where the rules have heights. Absent: the highest height.
    pub place_z_mm: Option<f64>,
    /// What the moves may do: `leave` counts at the start, `enter` at the target. The place lies outside of every barrier.
    /// Must have no findings.
    pub rules: RapidRules,
}

/// What came of a tool change.
#[derive(Clone, Debug, PartialEq)]
pub enum ToolChangeAnswer {
    /// The best place.
    Plan(Box<ToolChangePlan>),
    /// Proven: no place that is permitted can be reached from the start and left for the target.
    NoPath(NoPath),
}

/// The best place for a tool change, and the moves there and on.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolChangePlan {
    /// Where the tool is changed.
    pub place: Point,
    /// From the start to the place.
    pub approach: RapidPlan,
    /// From the place to the target.
    pub departure: RapidPlan,
    /// Of both moves, by the rules' measure.
    pub cost: f64,
    /// No permitted place costs less. Equal to `cost` when proven to rounding; by length lower by at most 1e-9 of it where
    /// places on arcs cost nearly the same. With limits of acceleration the cost at top speed, with what beginning and
    /// ending at rest adds to both moves.
    pub lower_bound: f64,
}

impl ToolChange {
    /// Everything that is wrong beyond the rules themselves: `regions`, where there is no place at all, `place_z_mm`.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        if self.regions.is_empty() && self.points.is_empty() {
            let message =
                "neither regions nor points are given; send at least one place where the tool may be changed";
            findings.push(Finding::new("regions", Reason::MissingField, "", message));
        }
        let Some(z) = self.place_z_mm else { return findings };
        let field = "place_z_mm";
        let value = format!("{z:?}");
        if !z.is_finite() {
            let message = format!("{field} is {value}; send a finite number of millimetres");
            findings.push(Finding::new(field, Reason::NotFinite, value, message));
        } else if let Some(heights) = self.rules.heights {
            if z > heights.highest_z_mm || z < -COORDINATE_LIMIT_MM {
                let message = format!(
                    "{field} is {value} mm; send {:?} mm (rules.heights.highest_z_mm) at most",
                    heights.highest_z_mm
                );
                findings.push(Finding::new(field, Reason::OutOfRange, value, message));
            }
        } else {
            let message =
                format!("{field} is {value} mm, but rules.heights is absent; leave it out or send heights");
            findings.push(Finding::new(field, Reason::NotApplicable, value, message));
        }
        findings
    }

    /// The height of the change; none where heights do not count.
    #[must_use]
    pub fn change_z_mm(&self) -> Option<f64> {
        self.rules.heights.map(|heights| self.place_z_mm.unwrap_or(heights.highest_z_mm))
    }

    /// The rules of the move from the start to the place.
    #[must_use]
    pub fn approach_rules(&self) -> RapidRules {
        let z = self.change_z_mm();
        let heights = |heights| HeightRule { target_z_mm: z.unwrap_or_default(), ..heights };
        RapidRules {
            heights: self.rules.heights.map(heights),
            enter: EndRule::Refuse,
            alternative_count: 0,
            ..self.rules.clone()
        }
    }

    /// The rules of the move from the place to the target.
    #[must_use]
    pub fn departure_rules(&self) -> RapidRules {
        let z = self.change_z_mm();
        let heights = |heights| HeightRule { start_z_mm: z.unwrap_or_default(), ..heights };
        RapidRules {
            heights: self.rules.heights.map(heights),
            leave: EndRule::Refuse,
            alternative_count: 0,
            ..self.rules.clone()
        }
    }

    /// The move without a change.
    pub(crate) fn whole(&self) -> RapidMove {
        RapidMove {
            start: self.start,
            target: self.target,
            algorithm: Algorithm::Exact,
            rules: self.rules.clone(),
        }
    }

    /// The move from the start to `place`.
    pub(crate) fn approach(&self, place: Point) -> RapidMove {
        RapidMove {
            start: self.start,
            target: place,
            algorithm: Algorithm::Exact,
            rules: self.approach_rules(),
        }
    }

    /// The move from `place` to the target.
    pub(crate) fn departure(&self, place: Point) -> RapidMove {
        RapidMove {
            start: place,
            target: self.target,
            algorithm: Algorithm::Exact,
            rules: self.departure_rules(),
        }
    }
}
