//! What travel costs: length, seconds of axes that each run at their own speed, or seconds along a path with limits of
//! speed and acceleration. The rules that planner and checker share; each works the costs out with code of its own.

use crate::{Finding, Reason};

/// Lowest and highest speed, millimetres per second.
pub const SPEED_RANGE_MM_PER_S: [f64; 2] = [1e-3, 1e6];

/// Lowest and highest acceleration, millimetres per second squared.
pub const ACCELERATION_RANGE_MM_PER_S2: [f64; 2] = [1e-3, 1e9];

/// Largest junction deviation, millimetres.
pub const JUNCTION_DEVIATION_LIMIT_MM: f64 = 10.0;

/// How travel is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TravelCost {
    /// Length in space, millimetres.
    #[default]
    Length,
    /// Seconds, each axis at its own top speed.
    AxisSpeeds(AxisSpeeds),
    /// Seconds, along the path with limits of speed and acceleration.
    Kinematics(Kinematics),
}

/// What a cost counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CostUnit {
    /// Millimetres of travel.
    #[default]
    Millimetres,
    /// Seconds of travel.
    Seconds,
}

/// Top speeds of axes that run independently of each other. A straight step takes as long as its slower axis,
/// max(|dx| / x, |dy| / y); an arc is the limit of ever shorter straight steps; a vertical step takes |dz| / z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisSpeeds {
    /// Of the X axis, millimetres per second.
    pub x_mm_per_s: f64,
    /// Of the Y axis, millimetres per second.
    pub y_mm_per_s: f64,
    /// Of the Z axis, millimetres per second. May be 0 where the rules have no heights.
    pub z_mm_per_s: f64,
}

/// Limits of speed and acceleration along a path that starts and ends at rest.
///
/// On every step the speed stays within the step's limit: [`Self::speed_mm_per_s`] on straight level ones,
/// [`Self::z_mm_per_s`] on vertical ones; on arcs the feed, and √(acceleration · radius), at which turning alone takes all
/// of the acceleration. Between two steps it stays within √(acceleration · deviation · s / (1 − s)), s the sine of half
/// the angle that they enclose: no limit where one goes straight on into the other. Within these limits it is as high as
/// [`Self::acceleration_mm_per_s2`] allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// Top speed of straight level steps, millimetres per second.
    pub speed_mm_per_s: f64,
    /// Top speed of vertical steps, millimetres per second. May be 0 where the rules have no heights.
    pub z_mm_per_s: f64,
    /// Along the path, speeding up and slowing down alike, millimetres per second squared.
    pub acceleration_mm_per_s2: f64,
    /// How far the path could be cut short at a corner, were it rounded: what corner speeds come from. Millimetres; 0:
    /// every corner is a stop.
    pub junction_deviation_mm: f64,
    /// Top speed of arcs, millimetres per second. 0: [`Self::speed_mm_per_s`].
    pub feed_mm_per_s: f64,
}

impl TravelCost {
    /// What it counts.
    #[must_use]
    pub fn unit(&self) -> CostUnit {
        match self {
            Self::Length => CostUnit::Millimetres,
            Self::AxisSpeeds(_) | Self::Kinematics(_) => CostUnit::Seconds,
        }
    }

    /// Everything that is wrong, in the order of the fields; speeds of Z are asked for where there are heights.
    pub(crate) fn findings(&self, has_heights: bool) -> Vec<Finding> {
        match self {
            Self::Length => Vec::new(),
            Self::AxisSpeeds(speeds) => speeds.findings(has_heights),
            Self::Kinematics(kinematics) => kinematics.findings(has_heights),
        }
    }
}

impl AxisSpeeds {
    fn findings(&self, has_heights: bool) -> Vec<Finding> {
        let at = |name: &str| format!("cost.axis_speeds.{name}");
        let found = [
            speed_finding(at("x_mm_per_s"), self.x_mm_per_s),
            speed_finding(at("y_mm_per_s"), self.y_mm_per_s),
            z_speed_finding(at("z_mm_per_s"), self.z_mm_per_s, has_heights),
        ];
        found.into_iter().flatten().collect()
    }
}

impl Kinematics {
    /// Top speed of arcs, but for their radius, millimetres per second.
    #[must_use]
    pub fn arc_speed_mm_per_s(&self) -> f64 {
        if self.feed_mm_per_s == 0.0 { self.speed_mm_per_s } else { self.feed_mm_per_s }
    }

    fn findings(&self, has_heights: bool) -> Vec<Finding> {
        let at = |name: &str| format!("cost.kinematics.{name}");
        let feed = self.feed_mm_per_s;
        let found = [
            speed_finding(at("speed_mm_per_s"), self.speed_mm_per_s),
            z_speed_finding(at("z_mm_per_s"), self.z_mm_per_s, has_heights),
            range_finding(
                at("acceleration_mm_per_s2"),
                self.acceleration_mm_per_s2,
                ACCELERATION_RANGE_MM_PER_S2,
                "mm/s²",
            ),
            range_finding(
                at("junction_deviation_mm"),
                self.junction_deviation_mm,
                [0.0, JUNCTION_DEVIATION_LIMIT_MM],
                "mm",
            ),
            if feed == 0.0 { None } else { speed_finding(at("feed_mm_per_s"), feed) },
        ];
        found.into_iter().flatten().collect()
    }
}

fn speed_finding(field: String, speed: f64) -> Option<Finding> {
    range_finding(field, speed, SPEED_RANGE_MM_PER_S, "mm/s")
}

fn z_speed_finding(field: String, speed: f64, has_heights: bool) -> Option<Finding> {
    if speed == 0.0 && !has_heights { None } else { speed_finding(field, speed) }
}

fn range_finding(field: String, value: f64, [least, most]: [f64; 2], unit: &str) -> Option<Finding> {
    let text = format!("{value:?}");
    if !value.is_finite() {
        let message = format!("{field} is {text}; send a finite number of {unit}");
        return Some(Finding::new(field, Reason::NotFinite, text, message));
    }
    (!(least..=most).contains(&value)).then(|| {
        let message = format!("{field} is {text} {unit}; send {least:?} to {most:?} {unit}");
        Finding::new(field, Reason::OutOfRange, text, message)
    })
}
