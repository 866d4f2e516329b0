//! What travel costs, and how the machine runs it.

use super::reader::Reader;
use crate::v1::{self, travel_cost::Measure};
use traverse_geometry::{ArcOutput, AxisSpeeds, Kinematics, RapidMotion, TravelCost};

/// A cost as it is meant; what is wrong with its numbers the rules say.
pub(super) fn cost(cost: Option<v1::TravelCost>) -> TravelCost {
    match cost.and_then(|cost| cost.measure) {
        None | Some(Measure::Euclidean(_)) => TravelCost::Length,
        Some(Measure::AxisSpeeds(speeds)) => TravelCost::AxisSpeeds(AxisSpeeds {
            x_mm_per_s: speeds.x_mm_per_s + 0.0,
            y_mm_per_s: speeds.y_mm_per_s + 0.0,
            z_mm_per_s: speeds.z_mm_per_s + 0.0,
        }),
        Some(Measure::Kinematics(limits)) => TravelCost::Kinematics(Kinematics {
            speed_mm_per_s: limits.speed_mm_per_s + 0.0,
            z_mm_per_s: limits.z_mm_per_s + 0.0,
            acceleration_mm_per_s2: limits.acceleration_mm_per_s2 + 0.0,
            junction_deviation_mm: limits.junction_deviation_mm + 0.0,
            feed_mm_per_s: limits.feed_mm_per_s + 0.0,
        }),
    }
}

impl Reader<'_> {
    /// How the machine runs G0; linear where the number is not known, which is reported.
    pub(super) fn motion(&mut self, field: &str, motion: i32) -> RapidMotion {
        match v1::RapidMotion::try_from(motion) {
            Ok(v1::RapidMotion::Unspecified | v1::RapidMotion::Linear) => RapidMotion::Linear,
            Ok(v1::RapidMotion::DogLeg) => RapidMotion::DogLeg,
            Err(_) => {
                let known = ["RAPID_MOTION_LINEAR (1)", "RAPID_MOTION_DOG_LEG (2)"];
                self.unknown_enum_value(field, motion, &known);
                RapidMotion::Linear
            }
        }
    }

    /// How arcs are put out; as arcs where the number is not known, which is reported.
    pub(super) fn arcs(&mut self, field: &str, arcs: i32) -> ArcOutput {
        match v1::ArcOutput::try_from(arcs) {
            Ok(v1::ArcOutput::Unspecified | v1::ArcOutput::Arcs) => ArcOutput::Arcs,
            Ok(v1::ArcOutput::Chords) => ArcOutput::Chords,
            Err(_) => {
                self.unknown_enum_value(field, arcs, &["ARC_OUTPUT_ARCS (1)", "ARC_OUTPUT_CHORDS (2)"]);
                ArcOutput::Arcs
            }
        }
    }
}
