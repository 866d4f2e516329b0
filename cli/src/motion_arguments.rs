//! What travel costs and how the machine runs it: from the command line, over what its profile says.

use crate::failure::Failure;
use clap::{Args, ValueEnum};
use traverse_drawing::{ArcMotion, Machine, MachineSpeeds};
use traverse_geometry::{ArcOutput, RapidMotion, RapidRules, TravelCost};

/// What travel costs, and how the machine runs it.
#[derive(Args, Debug)]
pub(crate) struct MotionArguments {
    /// What the plan has least of. Default: length; with dog-legs axis-speeds.
    #[arg(long, value_enum)]
    pub(crate) cost: Option<Measure>,
    /// Top speeds of the axes, where each has its own. Default: the profile's.
    #[arg(long, value_name = "X,Y[,Z] MM_PER_MIN", value_delimiter = ',', num_args = 1)]
    pub(crate) axis_speeds: Vec<f64>,
    /// Top speed of G0 along a line. Default: the profile's.
    #[arg(long, value_name = "MM_PER_MIN")]
    pub(crate) rapid_speed: Option<f64>,
    /// Top speed of vertical moves. Default: the profile's, or that of G0.
    #[arg(long, value_name = "MM_PER_MIN")]
    pub(crate) z_speed: Option<f64>,
    /// Speeding up and slowing down along the path. Default: the profile's.
    #[arg(long, value_name = "MM_PER_S2")]
    pub(crate) acceleration: Option<f64>,
    /// Permitted deviation at corners. Default: the profile's, or 0.01.
    #[arg(long, value_name = "MM")]
    pub(crate) junction_deviation: Option<f64>,
    /// How the machine runs G0: in a straight line, or each axis at its own speed. Default: the profile's, or linear.
    #[arg(long, value_enum)]
    pub(crate) g0: Option<G0>,
    /// How arcs are put out: as circular steps, or as rapid chords outside them. Default: arcs; with dog-legs as the
    /// profile writes them.
    #[arg(long, value_enum)]
    pub(crate) arcs: Option<Arcs>,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum Measure {
    /// Millimetres.
    Length,
    /// Seconds, each axis at its own speed: the slower one of each step counts.
    AxisSpeeds,
    /// Seconds, along the path with limits of speed and acceleration.
    Kinematics,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum G0 {
    /// A straight line.
    Linear,
    /// Both axes at full speed until one has arrived, then the other.
    DogLeg,
}

#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
pub(crate) enum Arcs {
    /// Circular steps.
    Arcs,
    /// Straight steps outside the arc, within 0.01 mm.
    Chords,
}

impl MotionArguments {
    /// How fast the machine is: its profile, and the command line over it.
    pub(crate) fn speeds(&self, machine: Option<&Machine>, arc_feed: Option<f64>) -> MachineSpeeds {
        let stated = machine.map(|machine| machine.speeds.clone()).unwrap_or_default();
        let axis = |index: usize| self.axis_speeds.get(index).copied();
        MachineSpeeds {
            rapid_mm_per_min: self.rapid_speed.or(stated.rapid_mm_per_min),
            rapid_x_mm_per_min: axis(0).or(stated.rapid_x_mm_per_min),
            rapid_y_mm_per_min: axis(1).or(stated.rapid_y_mm_per_min),
            rapid_z_mm_per_min: self.z_speed.or(axis(2)).or(stated.rapid_z_mm_per_min),
            arc_feed_mm_per_min: arc_feed.or(stated.arc_feed_mm_per_min),
            acceleration_mm_per_s2: self.acceleration.or(stated.acceleration_mm_per_s2),
            junction_deviation_mm: self.junction_deviation.or(stated.junction_deviation_mm),
        }
    }

    /// How the machine runs G0.
    pub(crate) fn motion(&self, machine: Option<&Machine>) -> RapidMotion {
        match self.g0 {
            Some(G0::Linear) => RapidMotion::Linear,
            Some(G0::DogLeg) => RapidMotion::DogLeg,
            None => machine.and_then(|machine| machine.g0).unwrap_or_default(),
        }
    }

    /// Rules for cost, motion and arcs alone.
    pub(crate) fn rules(
        &self,
        machine: Option<&Machine>,
        arc_feed: Option<f64>,
    ) -> Result<RapidRules, Failure> {
        let speeds = self.speeds(machine, arc_feed);
        let motion = self.motion(machine);
        let usual = if motion == RapidMotion::DogLeg { Measure::AxisSpeeds } else { Measure::Length };
        let measure = self.cost.unwrap_or(usual);
        if motion == RapidMotion::DogLeg && measure != Measure::AxisSpeeds {
            return Err(Failure::Input(
                "dog-legs are planned by the speeds of the axes; leave --cost out or pass --cost axis-speeds"
                    .to_owned(),
            ));
        }
        let cost = match measure {
            Measure::Length => Some(TravelCost::Length),
            Measure::AxisSpeeds => speeds.axis_speeds().map(TravelCost::AxisSpeeds),
            Measure::Kinematics => speeds.kinematics().map(TravelCost::Kinematics),
        };
        let Some(cost) = cost else {
            return Err(Failure::Input(match measure {
                Measure::Kinematics => {
                    "the machine's speed and acceleration are not known; pass --rapid-speed MM_PER_MIN and --acceleration \
                     MM_PER_S2, or state rapid_mm_per_min and acceleration_mm_per_s2 in the profile"
                        .to_owned()
                }
                _ => "the speeds of the axes are not known; pass --axis-speeds X,Y or state rapid_x_mm_per_min and \
                      rapid_y_mm_per_min in the profile"
                    .to_owned(),
            }));
        };
        let writes_chords = machine
            .and_then(|machine| machine.gcode.as_ref())
            .is_some_and(|gcode| matches!(gcode.arcs, ArcMotion::Chords { .. }));
        let arcs = match self.arcs {
            Some(Arcs::Arcs) => ArcOutput::Arcs,
            Some(Arcs::Chords) => ArcOutput::Chords,
            None if motion == RapidMotion::DogLeg && writes_chords => ArcOutput::Chords,
            None => ArcOutput::Arcs,
        };
        Ok(RapidRules { cost, motion, arcs, ..RapidRules::default() })
    }
}
