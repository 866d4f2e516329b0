//! Seconds that a program's ways take, as far as the machine's speeds are known.

use traverse_drawing::{MachineSpeeds, StraightMotion};
use traverse_geometry::{AxisSpeeds, Edge, Kinematics, Path, RapidMotion, TravelCost};
use traverse_planner::travel_cost;

/// Says how long ways take.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Clock {
    /// By limits of speed and acceleration.
    Limits(Kinematics),
    /// Straight moves by each axis at its own speed, arcs at their feed.
    Axes(AxisSpeeds, Feed),
    /// At one speed, arcs at their feed.
    Steady {
        /// Of straight moves.
        mm_per_min: f64,
        feed: Feed,
    },
}

/// Millimetres per minute on arcs, if it is known.
pub(crate) type Feed = Option<f64>;

impl Clock {
    /// The clock of ways as G0 runs them: by limits of acceleration where they are known and G0 runs straight, by the axes
    /// where it runs dog-legs. None: too little is known.
    pub(crate) fn of(speeds: &MachineSpeeds, motion: RapidMotion, feed: Feed) -> Option<Self> {
        if motion == RapidMotion::DogLeg {
            return speeds.axis_speeds().map(|axes| Self::Axes(axes, feed));
        }
        let fed = MachineSpeeds { arc_feed_mm_per_min: feed, ..speeds.clone() };
        let limits = fed.kinematics().map(Self::Limits);
        limits.or_else(|| speeds.rapid_mm_per_min.map(|mm_per_min| Self::Steady { mm_per_min, feed }))
    }

    /// The clock of ways whose straight moves are written like this.
    pub(crate) fn written(self, straight: StraightMotion) -> Self {
        let StraightMotion::Fed { feed_mm_per_min } = straight else { return self };
        match self {
            Self::Limits(limits) => {
                Self::Limits(Kinematics { speed_mm_per_s: feed_mm_per_min / 60.0, ..limits })
            }
            Self::Axes(_, feed) | Self::Steady { feed, .. } => {
                Self::Steady { mm_per_min: feed_mm_per_min, feed }
            }
        }
    }

    /// Seconds of a way; none where it has arcs and their feed is not known.
    pub(crate) fn seconds(&self, path: &Path) -> Option<f64> {
        let (cost, feed) = match self {
            Self::Limits(limits) => return Some(travel_cost(path, &TravelCost::Kinematics(*limits))),
            Self::Axes(axes, feed) => (TravelCost::AxisSpeeds(*axes), *feed),
            Self::Steady { feed, .. } => (TravelCost::Length, *feed),
        };
        let seconds_per_unit =
            if let Self::Steady { mm_per_min, .. } = self { 60.0 / mm_per_min } else { 1.0 };
        let mut height = path.start_z_mm;
        let seconds = path.edges().zip(&path.steps).map(|(edge, moved)| {
            let from_z = std::mem::replace(&mut height, moved.z_mm);
            match edge {
                Edge::Arc(arc) => feed.map(|mm_per_min| 60.0 * arc.length() / mm_per_min),
                Edge::Segment(segment) => {
                    let step = Path { start: segment.start, start_z_mm: from_z, steps: vec![*moved] };
                    Some(seconds_per_unit * travel_cost(&step, &cost))
                }
            }
        });
        seconds.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::Point;

    fn speeds() -> MachineSpeeds {
        MachineSpeeds {
            rapid_mm_per_min: Some(6000.0),
            rapid_x_mm_per_min: Some(6000.0),
            rapid_y_mm_per_min: Some(3000.0),
            ..MachineSpeeds::default()
        }
    }

    #[test]
    fn what_is_known_decides_how_seconds_are_told() {
        let mut path = Path::at(Point::new(0.0, 0.0));
        path.line_to(Point::new(60.0, 80.0));
        let seconds = |speeds: &MachineSpeeds, motion| {
            Clock::of(speeds, motion, None).map(|clock| clock.seconds(&path))
        };
        assert_eq!(seconds(&speeds(), RapidMotion::Linear), Some(Some(1.0)));
        assert_eq!(seconds(&speeds(), RapidMotion::DogLeg), Some(Some(1.6)));
        let mut lifted = Path::at_height(Point::new(0.0, 0.0), 5.0);
        lifted.height_to(105.0);
        lifted.line_to(Point::new(60.0, 80.0));
        let steady = Clock::of(&speeds(), RapidMotion::Linear, None);
        assert_eq!(steady.unwrap().seconds(&lifted), Some(2.0));
        let limited = MachineSpeeds { acceleration_mm_per_s2: Some(1000.0), ..speeds() };
        assert_eq!(seconds(&limited, RapidMotion::Linear), Some(Some(1.1)));
        assert_eq!(seconds(&MachineSpeeds::default(), RapidMotion::Linear), None);
        let fed = Clock::of(&speeds(), RapidMotion::DogLeg, None).unwrap();
        let fed = fed.written(StraightMotion::Fed { feed_mm_per_min: 600.0 });
        assert_eq!(fed.seconds(&path), Some(10.0));
        path.arc_to(Point::new(60.0, 100.0), Point::new(60.0, 90.0), std::f64::consts::PI);
        assert_eq!(fed.seconds(&path), None);
    }
}
