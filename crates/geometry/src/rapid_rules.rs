//! What a rapid move may do: the rules that planner and checker share.

use crate::scene_findings::{clearance_finding, height_finding};
use crate::{COORDINATE_LIMIT_MM, Finding, Obstacle, Reason, Vector};

/// Most clearances of one list.
pub const CLEARANCE_CHOICES: usize = 16;

/// Most ways round of other kinds.
pub const ALTERNATIVE_LIMIT: usize = 16;

/// What a rapid move may do. The default: no heights, the scene's clearance, ends outside every barrier.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RapidRules {
    /// Lets the tool pass over what is low enough. Absent: everything is gone round.
    pub heights: Option<HeightRule>,
    /// Clearances that stand in turn for the scene's, largest first; the first that admits a path counts. Obstacles and
    /// a border with a clearance of their own keep it. Empty: the scene's.
    pub clearances_mm: Vec<f64>,
    /// What happens where the start lies inside a barrier.
    pub leave: EndRule,
    /// What happens where the target lies inside a barrier.
    pub enter: EndRule,
    /// How many locally shortest ways round of other kinds are wanted as well, at most [`ALTERNATIVE_LIMIT`].
    pub alternative_count: usize,
}

/// Lets the tool rise and pass over what is low enough.
///
/// An obstacle is a prism from its top down without end. At height z it is in the way unless z is at least its top plus
/// [`Self::clearance_z_mm`]; then it is passed over at any distance. This holds for start and target at their own
/// heights as well, and all the way up and down between. The work area's border holds at every height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightRule {
    /// Height of the start, millimetres.
    pub start_z_mm: f64,
    /// Height of the target, millimetres.
    pub target_z_mm: f64,
    /// The tool never goes higher, millimetres; not below start and target.
    pub highest_z_mm: f64,
    /// Kept above every top that is passed over, millimetres, not negative.
    pub clearance_z_mm: f64,
}

/// What happens where an end lies inside a barrier (not inside an obstacle), as after a cut along a contour.
///
/// A way out is straight and keeps to what the end has: from every obstacle at least the clearance, or, where the end
/// is nearer than that, the end's own distance (mitred: it enters no barrier that is smaller by so much that the end
/// lies on its border). At the target the same way is run inwards.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum EndRule {
    /// The move is refused.
    #[default]
    Refuse,
    /// By the shortest of all ways out.
    Nearest,
    /// From the end outwards along this direction, until clear. Any length but 0.
    Direction(Vector),
}

impl RapidRules {
    /// Everything that is wrong, in the order of the fields: `heights.…`, `clearances_mm[i]`, `leave.direction`,
    /// `enter.direction`, `alternative_count`.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = self.heights.map_or_else(Vec::new, |heights| heights.findings());
        findings.extend(clearances_findings(&self.clearances_mm));
        findings.extend(self.leave.finding("leave"));
        findings.extend(self.enter.finding("enter"));
        if self.alternative_count > ALTERNATIVE_LIMIT {
            let count = self.alternative_count;
            let message = format!(
                "{count} alternatives asked for, at most {ALTERNATIVE_LIMIT} permitted; ask for fewer"
            );
            findings.push(Finding::new("alternative_count", Reason::TooMany, count, message));
        }
        findings
    }
}

impl HeightRule {
    /// The height from which on an obstacle with this top is passed over, millimetres.
    #[must_use]
    pub fn pass_z_mm(&self, top_z_mm: f64) -> f64 {
        top_z_mm + self.clearance_z_mm
    }

    /// Whether the obstacle is passed over at height `z_mm`.
    #[must_use]
    pub fn passes_over(&self, obstacle: &Obstacle, z_mm: f64) -> bool {
        obstacle.top_z_mm.is_some_and(|top| self.pass_z_mm(top) <= z_mm)
    }

    fn findings(&self) -> Vec<Finding> {
        let fields = [
            ("heights.start_z_mm", self.start_z_mm),
            ("heights.target_z_mm", self.target_z_mm),
            ("heights.highest_z_mm", self.highest_z_mm),
        ];
        let mut findings: Vec<Finding> =
            fields.into_iter().filter_map(|(field, z)| height_finding(field.to_owned(), z)).collect();
        let least = self.start_z_mm.max(self.target_z_mm);
        if findings.is_empty() && self.highest_z_mm < least {
            let field = "heights.highest_z_mm";
            let value = format!("{:?}", self.highest_z_mm);
            let message = format!("{field} is {value} mm; send at least {least:?} mm, where an end is");
            findings.push(Finding::new(field, Reason::OutOfRange, value, message));
        }
        let field = "heights.clearance_z_mm";
        let value = format!("{:?}", self.clearance_z_mm);
        if !self.clearance_z_mm.is_finite() {
            let message = format!("{field} is {value}; send a finite number of millimetres, 0 for none");
            findings.push(Finding::new(field, Reason::NotFinite, value, message));
        } else if !(0.0..=COORDINATE_LIMIT_MM).contains(&self.clearance_z_mm) {
            let message = format!("{field} is {value} mm; send 0 to {COORDINATE_LIMIT_MM:?} mm");
            findings.push(Finding::new(field, Reason::OutOfRange, value, message));
        }
        findings
    }
}

impl EndRule {
    fn finding(&self, field: &str) -> Option<Finding> {
        let Self::Direction(direction) = self else { return None };
        let field = format!("{field}.direction");
        let value = format!("{:?}, {:?}", direction.x, direction.y);
        if !(direction.x.is_finite() && direction.y.is_finite()) {
            let message = format!("{field} is ({value}); send finite numbers");
            Some(Finding::new(field, Reason::NotFinite, value, message))
        } else if direction.try_normalize(1e-9).is_none() {
            let message = format!("{field} is ({value}), which points nowhere; send a longer one");
            Some(Finding::new(field, Reason::OutOfRange, value, message))
        } else if direction.norm() > 2.0 * COORDINATE_LIMIT_MM {
            let message = format!("{field} is ({value}); send a shorter one");
            Some(Finding::new(field, Reason::OutOfRange, value, message))
        } else {
            None
        }
    }
}

fn clearances_findings(clearances: &[f64]) -> Vec<Finding> {
    let mut findings = Vec::new();
    if clearances.len() > CLEARANCE_CHOICES {
        let message = format!(
            "{} clearances given, at most {CLEARANCE_CHOICES} permitted; send fewer",
            clearances.len()
        );
        return vec![Finding::new("clearances_mm", Reason::TooMany, clearances.len(), message)];
    }
    for (i, &clearance) in clearances.iter().enumerate() {
        let field = format!("clearances_mm[{i}]");
        let range = clearance_finding(field.clone(), clearance);
        let is_sound = range.is_none();
        findings.extend(range);
        if is_sound && i > 0 && clearance >= clearances[i - 1] {
            let message = format!(
                "{field} is {clearance:?} mm after {:?} mm; send them largest first, each once",
                clearances[i - 1]
            );
            findings.push(Finding::new(field, Reason::OutOfRange, format!("{clearance:?}"), message));
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_findings_come_at_once() {
        assert!(RapidRules::default().findings().is_empty());
        let rules = RapidRules {
            heights: Some(HeightRule {
                start_z_mm: 5.0,
                target_z_mm: 9.0,
                highest_z_mm: 8.0,
                clearance_z_mm: -1.0,
            }),
            clearances_mm: vec![3.0, 3.0, f64::NAN, 1e-9],
            leave: EndRule::Direction(Vector::zeros()),
            enter: EndRule::Direction(Vector::new(f64::INFINITY, 0.0)),
            alternative_count: 17,
        };
        let found: Vec<_> = rules.findings().into_iter().map(|found| (found.field, found.reason)).collect();
        let expected = [
            ("heights.highest_z_mm", Reason::OutOfRange),
            ("heights.clearance_z_mm", Reason::OutOfRange),
            ("clearances_mm[1]", Reason::OutOfRange),
            ("clearances_mm[2]", Reason::NotFinite),
            ("clearances_mm[3]", Reason::OutOfRange),
            ("leave.direction", Reason::OutOfRange),
            ("enter.direction", Reason::NotFinite),
            ("alternative_count", Reason::TooMany),
        ];
        assert_eq!(found, expected.map(|(field, reason)| (field.to_owned(), reason)));
        let many = RapidRules { clearances_mm: vec![1.0; 17], ..RapidRules::default() };
        assert_eq!(many.findings()[0].reason, Reason::TooMany);
    }
}
