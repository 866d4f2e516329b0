//! Seconds from rest to rest under limits of speed and acceleration, worked out anew: the speed that is permitted at a
//! place is the least that any limit along the path leaves there, going away from it at the acceleration.
//!
//! Unlike the planner's two passes over joints, this takes for each joint the least over all joints and steps of what their
//! limits leave: quadratic where no joint is a stop, so it stops looking where the distance alone permits more.

use crate::cost::Travelled;
use crate::curve::Curve;
use nalgebra::Vector3;
use traverse_geometry::{Kinematics, Vector};

/// Steps whose directions differ by less than this go straight on into each other, radians.
const STRAIGHT_ON_RAD: f64 = 1e-6;

/// A step: length, top speed, directions at its ends.
struct Piece {
    length: f64,
    top: f64,
    directions: [Vector3<f64>; 2],
}

/// Seconds of all steps, the path beginning and ending at rest.
pub(crate) fn seconds(steps: &[Travelled], limits: &Kinematics) -> f64 {
    let pieces: Vec<Piece> =
        steps.iter().map(|step| piece(step, limits)).filter(|piece| piece.length > 0.0).collect();
    let count = pieces.len();
    let own: Vec<f64> = (0..=count)
        .map(|joint| match (joint.checked_sub(1).map(|before| &pieces[before]), pieces.get(joint)) {
            (Some(before), Some(after)) => joint_speed(before, after, limits),
            _ => 0.0,
        })
        .collect();
    let most = own.iter().copied().fold(0.0, f64::max);
    let speeds: Vec<f64> = (0..=count).map(|joint| permitted(joint, &own, &pieces, most, limits)).collect();
    (0..count)
        .map(|at| duration(&pieces[at], speeds[at], speeds[at + 1], limits.acceleration_mm_per_s2))
        .sum()
}

fn piece(step: &Travelled, limits: &Kinematics) -> Piece {
    let level = |direction: Vector| Vector3::new(direction.x, direction.y, 0.0);
    match &step.curve {
        Curve::Circular(circular) => {
            let fed = if limits.feed_mm_per_s == 0.0 { limits.speed_mm_per_s } else { limits.feed_mm_per_s };
            let turning = (limits.acceleration_mm_per_s2 * circular.radius).sqrt();
            let directions = [0.0, 1.0].map(|end| level(step.curve.direction_at(end)));
            Piece { length: step.curve.length(), top: fed.min(turning), directions }
        }
        Curve::Straight(straight) => {
            let by = straight.b - straight.a;
            let by = Vector3::new(by.x, by.y, step.rise);
            let length = by.norm();
            let top = if step.rise == 0.0 { limits.speed_mm_per_s } else { limits.z_mm_per_s };
            let direction = if length > 0.0 { by / length } else { by };
            Piece { length, top, directions: [direction; 2] }
        }
    }
}

/// The speed between two steps by their own limits and the corner between them.
fn joint_speed(before: &Piece, after: &Piece, limits: &Kinematics) -> f64 {
    let slower = before.top.min(after.top);
    let (arriving, leaving) = (before.directions[1], after.directions[0]);
    let turned = arriving.cross(&leaving).norm().atan2(arriving.dot(&leaving));
    if turned < STRAIGHT_ON_RAD {
        return slower;
    }
    // s = cos(turned / 2), 1 − s = 2 sin²(turned / 4).
    let share = (turned / 2.0).cos().max(0.0) / (2.0 * (turned / 4.0).sin().powi(2));
    slower.min((limits.acceleration_mm_per_s2 * limits.junction_deviation_mm * share).sqrt())
}

/// The speed at a joint from which every limit on either side can be met and into which one can come.
fn permitted(joint: usize, own: &[f64], pieces: &[Piece], most: f64, limits: &Kinematics) -> f64 {
    let mut square = own[joint] * own[joint];
    let mut look = |other: usize, distance: f64| {
        let gained = 2.0 * limits.acceleration_mm_per_s2 * distance;
        square = square.min(own[other] * own[other] + gained);
        gained < most * most
    };
    let mut distance = 0.0;
    for other in joint + 1..own.len() {
        distance += pieces[other - 1].length;
        if !look(other, distance) {
            break;
        }
    }
    distance = 0.0;
    for other in (0..joint).rev() {
        distance += pieces[other].length;
        if !look(other, distance) {
            break;
        }
    }
    square.sqrt()
}

/// Seconds of one step between two speeds.
fn duration(piece: &Piece, from: f64, to: f64, acceleration: f64) -> f64 {
    let up = (piece.top * piece.top - from * from) / (2.0 * acceleration);
    let down = (piece.top * piece.top - to * to) / (2.0 * acceleration);
    if up + down <= piece.length {
        let cruise = (piece.length - up - down) / piece.top;
        return (piece.top - from) / acceleration + cruise + (piece.top - to) / acceleration;
    }
    // The top speed is not reached.
    let peak = ((from * from + to * to) / 2.0 + acceleration * piece.length).max(0.0).sqrt();
    ((peak - from).max(0.0) + (peak - to).max(0.0)) / acceleration
}
