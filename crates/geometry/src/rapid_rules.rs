//! What a rapid move may do: the rules that planner and checker share.

use crate::scene_findings::{clearance_finding, height_finding};
use crate::{AxisSpeeds, COORDINATE_LIMIT_MM, Finding, Obstacle, Reason, TravelCost, Vector};

/// Most clearances of one list.
pub const CLEARANCE_CHOICES: usize = 16;

/// Most ways round of other kinds.
pub const ALTERNATIVE_LIMIT: usize = 16;

/// How far outside of an arc the chords may lie that stand for it, millimetres.
pub const ARC_CHORD_TOLERANCE_MM: f64 = 0.01;

/// How far a direction may lie off one in which a dog-leg is straight, as a share of its length: rounding.
const DIRECTION_RATIO: f64 = 1e-9;

/// What a rapid move may do, and what it costs. The default: the shortest, no heights, the scene's clearance, ends outside
/// every barrier, G0 in straight lines, arcs as arcs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RapidRules {
    /// How travel is measured.
    pub cost: TravelCost,
    /// Lets the tool pass over what is low enough. Absent: everything is gone round.
    pub heights: Option<HeightRule>,
    /// Clearances that stand in turn for the scene's, largest first; the first that admits a path counts. Obstacles and
    /// a border with a clearance of their own keep it. Empty: the scene's.
    pub clearances_mm: Vec<f64>,
    /// What happens where the start lies inside a barrier.
    pub leave: EndRule,
    /// What happens where the target lies inside a barrier.
    pub enter: EndRule,
    /// How the machine runs straight rapid steps.
    pub motion: RapidMotion,
    /// How arcs are put out.
    pub arcs: ArcOutput,
    /// How many locally shortest ways round of other kinds are wanted as well, at most [`ALTERNATIVE_LIMIT`]. For
    /// [`TravelCost::Length`] and [`RapidMotion::Linear`] alone.
    pub alternative_count: usize,
}

/// How the machine runs straight level rapid steps (G0).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RapidMotion {
    /// Interpolated: a straight line.
    #[default]
    Linear,
    /// Both axes start at once, each at its own speed: first along a diagonal whose slope is the ratio of the speeds, until
    /// one axis has arrived, then straight along the other. Both parts must be clear. Needs
    /// [`TravelCost::AxisSpeeds`].
    DogLeg,
}

/// How arcs are put out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ArcOutput {
    /// As circular steps, which the machine feeds.
    #[default]
    Arcs,
    /// As straight rapid steps outside of the arc, touching it and within [`ARC_CHORD_TOLERANCE_MM`] of it.
    Chords,
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
    /// Everything that is wrong, in the order of the fields: `cost.…`, `heights.…`, `clearances_mm[i]`,
    /// `leave.direction`, `enter.direction`, `motion`, `alternative_count`.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = self.cost.findings(self.heights.is_some());
        findings.extend(self.heights.map_or_else(Vec::new, |heights| heights.findings()));
        findings.extend(clearances_findings(&self.clearances_mm));
        let dog_leg = self.dog_leg().filter(|_| findings.is_empty());
        findings.extend(self.leave.finding("leave", dog_leg));
        findings.extend(self.enter.finding("enter", dog_leg));
        if self.motion == RapidMotion::DogLeg && !matches!(self.cost, TravelCost::AxisSpeeds(_)) {
            let message = "motion is DOG_LEG without speeds of the axes; send cost.axis_speeds, or LINEAR";
            findings.push(Finding::new("motion", Reason::MissingField, "DOG_LEG", message));
        }
        findings.extend(self.alternatives_finding());
        findings
    }

    fn alternatives_finding(&self) -> Option<Finding> {
        let (field, count) = ("alternative_count", self.alternative_count);
        (count > ALTERNATIVE_LIMIT).then(|| {
            let message = format!(
                "{count} alternatives asked for, at most {ALTERNATIVE_LIMIT} permitted; ask for fewer"
            );
            Finding::new(field, Reason::TooMany, count, message)
        })
    }

    /// The axes' speeds where the machine runs dog-legs.
    #[must_use]
    pub fn dog_leg(&self) -> Option<AxisSpeeds> {
        match self.cost {
            TravelCost::AxisSpeeds(speeds) if self.motion == RapidMotion::DogLeg => Some(speeds),
            _ => None,
        }
    }
}

impl AxisSpeeds {
    /// The directions in which a dog-leg is a straight line: along an axis, or both axes at full speed. Of length 1.
    #[must_use]
    pub fn straight_directions(&self) -> [Vector; 8] {
        let both = Vector::new(self.x_mm_per_s, self.y_mm_per_s).normalize();
        let (x, y) = (Vector::new(1.0, 0.0), Vector::new(0.0, 1.0));
        let other = Vector::new(-both.x, both.y);
        [x, both, y, other, -x, -both, -y, -other]
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
    fn finding(&self, field: &str, dog_leg: Option<AxisSpeeds>) -> Option<Finding> {
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
        } else if dog_leg.is_some_and(|speeds| !runs_straight(&speeds, *direction)) {
            let message = format!(
                "{field} is ({value}), in which a dog-leg does not run straight; send one along an axis or with both at \
                 full speed"
            );
            Some(Finding::new(field, Reason::OutOfRange, value, message))
        } else {
            None
        }
    }
}

/// Whether a dog-leg in this direction is a straight line.
fn runs_straight(speeds: &AxisSpeeds, direction: Vector) -> bool {
    let direction = direction.normalize();
    speeds.straight_directions().iter().any(|straight| (straight - direction).norm() <= DIRECTION_RATIO)
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
    use crate::Kinematics;

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
            motion: RapidMotion::DogLeg,
            ..RapidRules::default()
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
            ("motion", Reason::MissingField),
            ("alternative_count", Reason::TooMany),
        ];
        assert_eq!(found, expected.map(|(field, reason)| (field.to_owned(), reason)));
        let many = RapidRules { clearances_mm: vec![1.0; 17], ..RapidRules::default() };
        assert_eq!(many.findings()[0].reason, Reason::TooMany);
    }

    fn fields(rules: &RapidRules) -> Vec<(String, Reason)> {
        rules.findings().into_iter().map(|found| (found.field, found.reason)).collect()
    }

    #[test]
    fn speeds_are_finite_and_within_their_range() {
        let speeds = AxisSpeeds { x_mm_per_s: 0.0, y_mm_per_s: f64::NAN, z_mm_per_s: 0.0 };
        let mut rules = RapidRules { cost: TravelCost::AxisSpeeds(speeds), ..RapidRules::default() };
        let of_plane = [
            ("cost.axis_speeds.x_mm_per_s".to_owned(), Reason::OutOfRange),
            ("cost.axis_speeds.y_mm_per_s".to_owned(), Reason::NotFinite),
        ];
        assert_eq!(fields(&rules), of_plane);
        // Heights need a speed of Z.
        let flat = HeightRule { start_z_mm: 0.0, target_z_mm: 0.0, highest_z_mm: 0.0, clearance_z_mm: 0.0 };
        rules.heights = Some(flat);
        assert_eq!(fields(&rules).last().unwrap().0, "cost.axis_speeds.z_mm_per_s");
        rules.cost = TravelCost::Kinematics(Kinematics {
            speed_mm_per_s: 1e9,
            z_mm_per_s: -1.0,
            acceleration_mm_per_s2: 0.0,
            junction_deviation_mm: f64::INFINITY,
            feed_mm_per_s: -0.5,
        });
        let expected = [
            "speed_mm_per_s",
            "z_mm_per_s",
            "acceleration_mm_per_s2",
            "junction_deviation_mm",
            "feed_mm_per_s",
        ];
        let found: Vec<String> = fields(&rules).into_iter().map(|(field, _)| field).collect();
        assert_eq!(found, expected.map(|name| format!("cost.kinematics.{name}")));
        rules.cost = TravelCost::Kinematics(Kinematics {
            speed_mm_per_s: 100.0,
            z_mm_per_s: 50.0,
            acceleration_mm_per_s2: 1000.0,
            junction_deviation_mm: 0.0,
            feed_mm_per_s: 0.0,
        });
        assert!(rules.findings().is_empty());
    }

    #[test]
    fn dog_legs_leave_and_enter_barriers_where_they_run_straight() {
        let speeds = AxisSpeeds { x_mm_per_s: 200.0, y_mm_per_s: 100.0, z_mm_per_s: 0.0 };
        let towards = |x, y| RapidRules {
            cost: TravelCost::AxisSpeeds(speeds),
            motion: RapidMotion::DogLeg,
            leave: EndRule::Direction(Vector::new(x, y)),
            ..RapidRules::default()
        };
        for (x, y) in [(1.0, 0.0), (0.0, -3.0), (2.0, 1.0), (-20.0, 10.0)] {
            assert!(towards(x, y).findings().is_empty(), "{x} {y}");
        }
        assert_eq!(fields(&towards(1.0, 1.0)), [("leave.direction".to_owned(), Reason::OutOfRange)]);
    }
}
