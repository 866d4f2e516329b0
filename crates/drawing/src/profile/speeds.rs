//! How fast a machine moves: what seconds of travel are worked out from.

use super::convert::Check;
use super::raw::{RawMachine, RawMotion};
use toml::Spanned;
use traverse_geometry::{
    ACCELERATION_RANGE_MM_PER_S2, AxisSpeeds, JUNCTION_DEVIATION_LIMIT_MM, Kinematics, RapidMotion,
};

/// Junction deviation where none is stated, millimetres: what Grbl comes with.
pub const JUNCTION_DEVIATION_MM: f64 = 0.01;

/// Least and most speed, millimetres per minute.
const SPEED_RANGE_MM_PER_MIN: [f64; 2] = [1.0, 1e6];

/// How fast a machine moves. What the file does not state is absent.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MachineSpeeds {
    /// How fast G0 moves along a line.
    pub rapid_mm_per_min: Option<f64>,
    /// How fast G0 moves the X axis, where each axis has its own speed.
    pub rapid_x_mm_per_min: Option<f64>,
    /// The same of the Y axis.
    pub rapid_y_mm_per_min: Option<f64>,
    /// The same of the Z axis.
    pub rapid_z_mm_per_min: Option<f64>,
    /// How arcs are fed.
    pub arc_feed_mm_per_min: Option<f64>,
    /// Along a path, speeding up and slowing down alike.
    pub acceleration_mm_per_s2: Option<f64>,
    /// Permitted deviation at a corner.
    pub junction_deviation_mm: Option<f64>,
}

impl MachineSpeeds {
    /// Speeds of the axes, if those of X and Y are known; of Z 0 if it is not.
    #[must_use]
    pub fn axis_speeds(&self) -> Option<AxisSpeeds> {
        Some(AxisSpeeds {
            x_mm_per_s: self.rapid_x_mm_per_min? / 60.0,
            y_mm_per_s: self.rapid_y_mm_per_min? / 60.0,
            z_mm_per_s: self.rapid_z_mm_per_min.unwrap_or(0.0) / 60.0,
        })
    }

    /// Limits of speed and acceleration, if the speed of G0 and the acceleration are known. Z is as fast as G0 unless it is
    /// stated, the junction deviation [`JUNCTION_DEVIATION_MM`].
    #[must_use]
    pub fn kinematics(&self) -> Option<Kinematics> {
        let speed = self.rapid_mm_per_min?;
        Some(Kinematics {
            speed_mm_per_s: speed / 60.0,
            z_mm_per_s: self.rapid_z_mm_per_min.unwrap_or(speed) / 60.0,
            acceleration_mm_per_s2: self.acceleration_mm_per_s2?,
            junction_deviation_mm: self.junction_deviation_mm.unwrap_or(JUNCTION_DEVIATION_MM),
            feed_mm_per_s: self.arc_feed_mm_per_min.unwrap_or(0.0) / 60.0,
        })
    }
}

impl Check<'_> {
    /// How fast the machine moves. Where there is a table for G-code, the feed of arcs is looked at there.
    pub(super) fn speeds(&mut self, machine: &RawMachine) -> MachineSpeeds {
        let raw = &machine.speeds;
        let mut speed = |key: &str, stated: &Option<Spanned<f64>>| {
            self.number(&format!("speeds.{key}"), stated, SPEED_RANGE_MM_PER_MIN, "mm/min")
        };
        let arc_feed = &raw.arc_feed_mm_per_min;
        if machine.gcode.is_none() {
            speed("arc_feed_mm_per_min", arc_feed);
        }
        let rapid_mm_per_min = speed("rapid_mm_per_min", &raw.rapid_mm_per_min);
        let rapid_x_mm_per_min = speed("rapid_x_mm_per_min", &raw.rapid_x_mm_per_min);
        let rapid_y_mm_per_min = speed("rapid_y_mm_per_min", &raw.rapid_y_mm_per_min);
        let rapid_z_mm_per_min = speed("rapid_z_mm_per_min", &raw.rapid_z_mm_per_min);
        let acceleration = &raw.acceleration_mm_per_s2;
        let deviation = [0.0, JUNCTION_DEVIATION_LIMIT_MM];
        MachineSpeeds {
            rapid_mm_per_min,
            rapid_x_mm_per_min,
            rapid_y_mm_per_min,
            rapid_z_mm_per_min,
            arc_feed_mm_per_min: arc_feed.as_ref().map(|stated| *stated.get_ref()),
            acceleration_mm_per_s2: self.number(
                "speeds.acceleration_mm_per_s2",
                acceleration,
                ACCELERATION_RANGE_MM_PER_S2,
                "mm/s²",
            ),
            junction_deviation_mm: self.number(
                "speeds.junction_deviation_mm",
                &raw.junction_deviation_mm,
                deviation,
                "mm",
            ),
        }
    }

    /// How G0 runs; a dog-leg needs speeds of the axes.
    pub(super) fn g0(&mut self, raw: &RawMachine) -> Option<RapidMotion> {
        let stated = raw.g0.as_ref()?;
        let speeds = &raw.speeds;
        let has_speeds = speeds.rapid_x_mm_per_min.is_some() && speeds.rapid_y_mm_per_min.is_some();
        match stated.get_ref() {
            RawMotion::Linear => Some(RapidMotion::Linear),
            RawMotion::DogLeg => {
                if !has_speeds {
                    let message = "dog-legs need the speeds of the axes; write rapid_x_mm_per_min and rapid_y_mm_per_min \
                                   under speeds";
                    self.add(self.line_of(stated), "g0", message);
                }
                Some(RapidMotion::DogLeg)
            }
        }
    }

    fn number(
        &mut self,
        key: &str,
        stated: &Option<Spanned<f64>>,
        [least, most]: [f64; 2],
        unit: &str,
    ) -> Option<f64> {
        let stated = stated.as_ref()?;
        let value = *stated.get_ref();
        if !(least..=most).contains(&value) {
            self.add(self.line_of(stated), key, format!("is {value}: use {least} to {most} {unit}"));
        }
        Some(value)
    }
}
