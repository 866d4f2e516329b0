//! Steps as they are held against barriers: whole, or cut where a way out of a barrier gets clear.
//!
//! A way out is the beginning of the first step, if it is straight and level. From each barrier that holds the start it
//! may keep what the start has, and no less, up to the first place that is clear of all of them; what comes after is a
//! step like any other. A way in is the same, seen from the target. That no shorter way out exists is not checked, as
//! little as that no shorter path does.
//!
//! The first clear place is looked for at [`SAMPLES`] places and then bisected: a window of clear ground narrower than
//! that may be overlooked, on the side of accepting.

use crate::clearance::Surroundings;
use crate::curve::{Curve, cross, normalized};
use crate::heights::Heights;
use crate::inside::solids_around;
use crate::message::millimetres;
use crate::{Violation, ViolationReason};
use std::collections::BTreeMap;
use traverse_geometry::{EndRule, Point, RapidRules};

/// Places of a way out at which it is asked whether it is clear.
const SAMPLES: u32 = 256;

/// Halvings of the stretch between two of them.
const HALVINGS: u32 = 50;

/// How far inside the barriers of some solids an end lies, millimetres.
type Slack = BTreeMap<u32, f64>;

/// A step or a part of one.
pub(crate) struct Leg {
    /// Of the path's step.
    pub(crate) index: usize,
    /// None: the step's arc is wrong.
    pub(crate) curve: Option<Curve>,
    slack: Slack,
}

impl Leg {
    /// How far inside the solid's barrier the leg may lie.
    pub(crate) fn slack_for(&self, solid: u32) -> f64 {
        self.slack.get(&solid).copied().unwrap_or(0.0)
    }
}

/// The legs of the steps `steps`. Reports ways out and in that run in a wrong direction.
pub(crate) fn legs(
    around: Surroundings<'_>,
    heights: &Heights,
    rules: &RapidRules,
    steps: &[Option<Curve>],
    mut report: impl FnMut(Violation),
) -> Vec<Leg> {
    let whole = |(index, curve): (usize, &Option<Curve>)| Leg { index, curve: *curve, slack: Slack::new() };
    let mut legs: Vec<Leg> = steps.iter().enumerate().map(whole).collect();
    let last = steps.len() - 1;
    let way = |index: usize, rule: &EndRule, outwards: Option<Curve>| {
        let Some(Curve::Straight(way)) = outwards else { return None };
        let slack = match rule {
            EndRule::Refuse => Slack::new(),
            EndRule::Nearest | EndRule::Direction(_) => slack_at(around, heights, index, way.a),
        };
        (!slack.is_empty() && heights.is_level(index)).then_some((Curve::Straight(way), slack))
    };
    let leaves = way(0, &rules.leave, steps[0]);
    let enters = way(last, &rules.enter, steps[last].map(|curve| reversed(&curve)));
    if last == 0 && steps[0].is_some_and(|curve| curve.length() == 0.0) {
        // A path that stays where both ends may lie.
        if let (Some((_, slack)), Some(_)) = (leaves, enters) {
            legs[0].slack = slack;
        }
        return legs;
    }
    let mut wrong =
        |index: usize, rule: &EndRule, way: &Curve| report_direction(around, index, rule, way, &mut report);
    // The way in first: it is cut off the end, so that places before it stay what they are.
    let (mut head, mut tail) = (Vec::new(), Vec::new());
    let mut rest = (0.0, 1.0);
    if let Some((curve, slack)) = enters {
        wrong(last, &rules.enter, &curve);
        let clear = first_clear(around, &curve, &slack);
        tail = cut(last, &curve, clear, slack).into_iter().rev().map(turned).collect();
        rest.1 = 1.0 - clear.unwrap_or(1.0);
    }
    if let Some((curve, slack)) = leaves {
        wrong(0, &rules.leave, &curve);
        let clear = first_clear(around, &curve, &slack);
        head = cut(0, &curve, clear, slack);
        rest.0 = clear.unwrap_or(1.0);
    }
    let (has_head, has_tail) = (!head.is_empty(), !tail.is_empty());
    let mut cut_up = head;
    for (index, leg) in legs.into_iter().enumerate() {
        let (from, to) = (
            if index == 0 && has_head { rest.0 } else { 0.0 },
            if index == last && has_tail { rest.1 } else { 1.0 },
        );
        if (from, to) == (0.0, 1.0) {
            cut_up.push(leg);
        } else if let Some(curve) = leg.curve.filter(|_| from < to) {
            let curve = Some(Curve::straight(curve.point_at(from), curve.point_at(to)));
            cut_up.push(Leg { curve, ..leg });
        }
    }
    cut_up.extend(tail);
    cut_up
}

/// The way up to where it is clear, and that place without slack; nothing else if it never is.
fn cut(index: usize, way: &Curve, clear: Option<f64>, slack: Slack) -> Vec<Leg> {
    let end = way.point_at(clear.unwrap_or(1.0));
    let straight = |a, b, slack| Leg { index, curve: Some(Curve::straight(a, b)), slack };
    vec![straight(way.start(), end, slack), straight(end, end, Slack::new())]
}

fn turned(leg: Leg) -> Leg {
    Leg { curve: leg.curve.map(|curve| reversed(&curve)), ..leg }
}

/// The straight curve run backwards; others stay.
fn reversed(curve: &Curve) -> Curve {
    match curve {
        Curve::Straight(straight) => Curve::straight(straight.b, straight.a),
        Curve::Circular(_) => *curve,
    }
}

/// How far inside barriers `end` lies, but not inside solids. What is passed over does not count.
fn slack_at(around: Surroundings<'_>, heights: &Heights, index: usize, end: Point) -> Slack {
    let Surroundings { boundary, tree, tolerance, .. } = around;
    let approaches = around.approaches(&Curve::straight(end, end));
    let holds = solids_around(boundary, tree, end);
    let is_in_barrier = |(solid, approach): (u32, crate::clearance::Approach)| {
        let passed = heights.lack(around.scene, boundary.solids[solid as usize].obstacle, index);
        let depth = -approach.worst?.distance;
        let is_buried = holds.contains(&solid) && approach.touched.is_empty();
        let counts = depth > tolerance && !is_buried && passed.is_none_or(|lack| lack > tolerance);
        counts.then_some((solid, depth))
    };
    approaches.into_iter().filter_map(is_in_barrier).collect()
}

/// The first place of `way`, as a fraction, that lies in none of the barriers in `slack`.
fn first_clear(around: Surroundings<'_>, way: &Curve, slack: &Slack) -> Option<f64> {
    let is_clear = |fraction: f64| {
        let place = way.point_at(fraction);
        let approaches = around.approaches(&Curve::straight(place, place));
        slack.keys().all(|solid| {
            let worst = approaches.get(solid).and_then(|approach| approach.worst);
            worst.is_none_or(|worst| worst.distance >= -around.tolerance)
        })
    };
    let found = (1..=SAMPLES).find(|&sample| is_clear(f64::from(sample) / f64::from(SAMPLES)))?;
    let (mut blocked, mut clear) =
        (f64::from(found - 1) / f64::from(SAMPLES), f64::from(found) / f64::from(SAMPLES));
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(blocked, clear);
        if is_clear(middle) {
            clear = middle;
        } else {
            blocked = middle;
        }
    }
    Some(clear)
}

fn report_direction(
    around: Surroundings<'_>,
    index: usize,
    rule: &EndRule,
    outwards: &Curve,
    report: &mut dyn FnMut(Violation),
) {
    let EndRule::Direction(direction) = rule else { return };
    let direction = normalized(*direction);
    let way = outwards.end() - outwards.start();
    let amount = if direction.dot(&way) < 0.0 { way.norm() } else { cross(direction, way).abs() };
    if amount > around.tolerance {
        let index = around.step_of[index];
        let message = format!("step {index} runs {} mm off the direction asked for", millimetres(amount));
        report(Violation {
            field: format!("path.steps[{index}]"),
            reason: ViolationReason::WrongDirection,
            message,
            amount,
            at: Some(outwards.end()),
            obstacle: None,
        });
    }
}
