//! Checks a rapid move: ends, arcs, heights, clearance, ways out of and into barriers, and at clearance 0 what touches.

use crate::as_run::AsRun;
use crate::boundary::Boundary;
use crate::boundary_tree::BoundaryTree;
use crate::clearance::{Surroundings, nearer};
use crate::corridor::Corridor;
use crate::cost::cost;
use crate::curve::Curve;
use crate::heights::Heights;
use crate::inside::{is_inside, solids_around};
use crate::leg::{Leg, legs};
use crate::message::{millimetres, solid_id, solid_name};
use crate::path_shape::{curves, not_finite, wrong_ends};
use crate::seam::seam;
use crate::touching::passages;
use crate::{Violation, ViolationReason};
use std::borrow::Cow;
use std::collections::BTreeSet;
use traverse_geometry::{CostUnit, Path, Point, RapidRules, Scene};

/// Most violations that are listed for one path.
pub const VIOLATION_LIMIT: usize = 1000;

/// Least tolerance that is used, millimetres: below it rounding alone would decide.
pub const SMALLEST_TOLERANCE_MM: f64 = 1e-9;

/// A path that touches or crosses more edges of clearance 0 is not looked at for passages between obstacles that touch:
/// that test needs memory for each.
const TOUCH_LIMIT: usize = 500_000;

/// What checking a path found.
#[derive(Clone, Debug, PartialEq)]
pub struct PathCheck {
    /// What is wrong, along the path, at most [`VIOLATION_LIMIT`]; empty: the path is sound.
    pub violations: Vec<Violation>,
    /// What the path costs by the rules, recomputed. 0 when a number of the path is not finite.
    pub cost: f64,
    /// What it counts.
    pub cost_unit: CostUnit,
    /// Over the whole path: distance to the nearest obstacle or border less the clearance asked for it; inside,
    /// minus the depth less the clearance. None: nothing is in the way, or no step could be measured.
    /// Negative: too near, or on a way out of or into a barrier that the rules allow. What is passed over counts by
    /// height above its top less the vertical clearance.
    pub smallest_margin_mm: Option<f64>,
    /// The scene's clearance that was held against the path, millimetres.
    pub clearance_mm: f64,
}

impl PathCheck {
    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.violations.is_empty()
    }
}

/// Checks `path` from `start` to `target` in `scene`. What lies less than `tolerance_mm` inside a barrier counts as
/// touching it; [`traverse_geometry::CONTACT_TOLERANCE_MM`] is what planned paths are made for.
///
/// To check several paths in one scene, keep a [`RapidMoveChecker`].
#[must_use]
pub fn check_rapid_move(
    scene: &Scene,
    start: Point,
    target: Point,
    path: &Path,
    tolerance_mm: f64,
) -> PathCheck {
    RapidMoveChecker::new(scene).check(start, target, path, tolerance_mm)
}

/// As [`check_rapid_move`], given up when `go_on`, asked between its parts, says no: then there is no answer.
#[must_use]
pub fn check_rapid_move_while(
    scene: &Scene,
    start: Point,
    target: Point,
    path: &Path,
    tolerance_mm: f64,
    go_on: &dyn Fn() -> bool,
) -> Option<PathCheck> {
    let checker = RapidMoveChecker::new_while(scene, go_on)?;
    checker.check_while(&RapidRules::default(), start, target, path, tolerance_mm, go_on)
}

/// A scene, made ready to check any number of paths in it.
pub struct RapidMoveChecker<'a> {
    scene: &'a Scene,
    boundary: Boundary,
    tree: BoundaryTree,
}

impl<'a> RapidMoveChecker<'a> {
    /// Makes `scene` ready. Cost: O(n log n) for n vertices.
    #[must_use]
    pub fn new(scene: &'a Scene) -> Self {
        Self::new_while(scene, &|| true).expect("invariant: only a no gives up")
    }

    /// As [`RapidMoveChecker::new`], given up when `go_on`, asked every few milliseconds, says no.
    #[must_use]
    pub fn new_while(scene: &'a Scene, go_on: &dyn Fn() -> bool) -> Option<Self> {
        let boundary = Boundary::of(scene);
        let tree = BoundaryTree::over(&boundary, go_on)?;
        Some(Self { scene, boundary, tree })
    }

    /// Checks one path, as [`check_rapid_move`] does. Cost: O(log n + what it touches) for each step.
    #[must_use]
    pub fn check(&self, start: Point, target: Point, path: &Path, tolerance_mm: f64) -> PathCheck {
        let check = self.check_while(&RapidRules::default(), start, target, path, tolerance_mm, &|| true);
        check.expect("invariant: only a no gives up")
    }

    /// As [`RapidMoveChecker::check`], by `rules` at the scene's own clearance, given up when `go_on`, asked at every
    /// step, says no.
    #[must_use]
    pub fn check_while(
        &self,
        rules: &RapidRules,
        start: Point,
        target: Point,
        path: &Path,
        tolerance_mm: f64,
        go_on: &dyn Fn() -> bool,
    ) -> Option<PathCheck> {
        let mut violations = not_finite(start, target, path);
        let clearance_mm = self.scene.clearance_mm;
        if !violations.is_empty() {
            let cost_unit = rules.cost.unit();
            return Some(PathCheck {
                violations,
                cost: 0.0,
                cost_unit,
                smallest_margin_mm: None,
                clearance_mm,
            });
        }
        // Also turns NaN into the least tolerance.
        let tolerance = tolerance_mm.max(SMALLEST_TOLERANCE_MM);
        violations.extend(wrong_ends(start, target, path, tolerance));
        let mut steps = curves(path, tolerance, &mut |violation| push(&mut violations, violation));
        let cost = cost(path, &rules.cost);
        Heights::new(rules.heights, path, tolerance).violations(|violation| push(&mut violations, violation));
        let only_a_point = path.steps.is_empty();
        let AsRun { path, step_of } = AsRun::of(path, rules.dog_leg());
        if let Cow::Owned(path) = &path {
            steps = curves(path, tolerance, &mut |_| {});
        }
        if steps.is_empty() {
            steps.push(Some(Curve::straight(path.start, path.start)));
        }
        let heights = Heights::new(rules.heights, &path, tolerance);
        let mut walk = Walk {
            checker: self,
            around: Surroundings {
                scene: self.scene,
                boundary: &self.boundary,
                tree: &self.tree,
                tolerance,
                step_of: &step_of,
                go_on,
            },
            only_a_point,
            heights: &heights,
            violations,
            smallest: None,
            inside: None,
            unsure: BTreeSet::new(),
            pierced: BTreeSet::new(),
            touched: vec![Vec::new(); steps.len()],
            touches: 0,
        };
        let legs =
            legs(walk.around, &heights, rules, &steps, |violation| push(&mut walk.violations, violation));
        for leg in &legs {
            if !go_on() {
                return None;
            }
            match leg.curve {
                Some(curve) => walk.step(leg, &curve),
                None => walk.inside = None,
            }
        }
        walk.passages(&steps, go_on);
        let smallest_margin_mm = walk.smallest;
        go_on().then_some(PathCheck {
            violations: walk.violations,
            cost,
            cost_unit: rules.cost.unit(),
            smallest_margin_mm,
            clearance_mm,
        })
    }
}

/// Goes along a path and collects.
struct Walk<'a> {
    checker: &'a RapidMoveChecker<'a>,
    around: Surroundings<'a>,
    only_a_point: bool,
    heights: &'a Heights,
    violations: Vec<Violation>,
    smallest: Option<f64>,
    /// Solids that hold the end of the last step, as far as it did not touch them; none: nothing is known.
    inside: Option<BTreeSet<u32>>,
    /// Solids that the last step touched.
    unsure: BTreeSet<u32>,
    /// Step and solid of every violation of depth.
    pierced: BTreeSet<(usize, u32)>,
    /// Edges of solids with clearance 0 within the tolerance of each step.
    touched: Vec<Vec<u32>>,
    /// How many they are.
    touches: usize,
}

impl Walk<'_> {
    fn step(&mut self, leg: &Leg, step: &Curve) {
        let index = leg.index;
        let mut approaches = self.around.approaches(step);
        let touched: BTreeSet<u32> =
            approaches.iter().filter(|(_, near)| !near.touched.is_empty()).map(|(&solid, _)| solid).collect();
        self.locate(step, &touched);
        for &solid in self.inside.iter().flatten() {
            approaches
                .entry(solid)
                .or_insert(crate::clearance::Approach { worst: None, touched: Vec::new() });
        }
        for (solid, approach) in approaches {
            let obstacle = self.around.boundary.solids[solid as usize].obstacle;
            let lack = self.heights.lack(self.checker.scene, obstacle, index);
            if let Some(lack) = lack.filter(|&lack| lack <= self.around.tolerance) {
                let is_in = self.inside.as_ref().is_some_and(|inside| inside.contains(&solid));
                let beside = approach.worst.filter(|_| !is_in).map_or(-lack, |worst| worst.distance);
                let margin = beside.max(-lack);
                self.smallest = Some(self.smallest.map_or(margin, |least| least.min(margin)));
                continue;
            }
            let parts = if touched.contains(&solid) {
                self.around.parts_inside(step, solid, &approach.touched)
            } else if self.inside.as_ref().is_some_and(|inside| inside.contains(&solid)) {
                vec![(0.0, 1.0)]
            } else {
                Vec::new()
            };
            let worst = nearer(approach.worst, self.around.deepest(step, solid, &parts));
            if let Some(worst) = worst {
                self.smallest = Some(self.smallest.map_or(worst.distance, |least| least.min(worst.distance)));
                if worst.distance < -self.around.tolerance - leg.slack_for(solid) {
                    self.report_depth(index, solid, worst, lack, !parts.is_empty());
                }
            }
            if self.around.boundary.solids[solid as usize].clearance == 0.0 && self.touches < TOUCH_LIMIT {
                self.touches += approach.touched.len();
                self.touched[index].extend(approach.touched);
            }
        }
        let most = self.smallest.unwrap_or(f64::INFINITY);
        if most > 0.0
            && let Some(margin) = self.around.least_margin(step, most, &|solid| {
                let obstacle = self.around.boundary.solids[solid as usize].obstacle;
                let lack = self.heights.lack(self.checker.scene, obstacle, index);
                lack.is_none_or(|lack| lack > self.around.tolerance)
            })
        {
            self.smallest = Some(margin);
        }
    }

    /// Brings `inside` to the start of `step`, but for the solids that it touches.
    fn locate(&mut self, step: &Curve, touched: &BTreeSet<u32>) {
        let Surroundings { boundary, tree, .. } = self.around;
        let start = step.start();
        let inside = match &mut self.inside {
            Some(inside) => {
                for &solid in self.unsure.difference(touched) {
                    if is_inside(boundary, tree, start, solid) {
                        inside.insert(solid);
                    }
                }
                inside
            }
            unknown => unknown.insert(solids_around(boundary, tree, start)),
        };
        inside.retain(|solid| !touched.contains(solid));
        self.unsure.clone_from(touched);
    }

    fn report_depth(
        &mut self,
        index: usize,
        solid: u32,
        worst: crate::arc_distance::Nearest,
        lack: Option<f64>,
        is_inside: bool,
    ) {
        let about = &self.around.boundary.solids[solid as usize];
        let name = solid_name(self.checker.scene, about.obstacle);
        let (place, field) = self.place(index);
        let amount = -worst.distance;
        let (found, asked) = (millimetres(about.clearance + worst.distance), millimetres(about.clearance));
        let depth = millimetres(amount - about.clearance);
        let too_low = lack.filter(|&lack| lack < amount);
        let (reason, message) = match (is_inside, about.obstacle) {
            _ if too_low.is_some() => {
                let lack = millimetres(lack.unwrap_or(0.0));
                let message = format!(
                    "{place} passes over {name} {lack} mm too low; asked is its top plus clearance_z_mm"
                );
                (ViolationReason::TooLow, message)
            }
            (true, Some(_)) => {
                let message =
                    format!("{place} is {depth} mm inside {name}; asked are {asked} mm of clearance");
                (ViolationReason::InsideObstacle, message)
            }
            (true, None) => {
                let message = format!(
                    "{place} is {depth} mm outside the work area; asked are {asked} mm inside its border"
                );
                (ViolationReason::OutsideWorkArea, message)
            }
            (false, _) if about.mitred().is_some() => {
                let message =
                    format!("{place} is {} mm inside the mitred barrier of {name}", millimetres(amount));
                (ViolationReason::TooClose, message)
            }
            (false, _) => (
                ViolationReason::TooClose,
                format!("{place} comes within {found} mm of {name}; asked are {asked} mm"),
            ),
        };
        let amount = too_low.unwrap_or(amount);
        self.pierced.insert((index, solid));
        let obstacle = Some(solid_id(self.checker.scene, about.obstacle).to_owned());
        push(
            &mut self.violations,
            Violation { field, reason, message, amount, at: Some(worst.at), obstacle },
        );
    }

    /// Reports where the path passes between what touches, unless it goes through the same solid anyway.
    fn passages(&mut self, steps: &[Option<Curve>], go_on: &dyn Fn() -> bool) {
        let Surroundings { boundary, tree, tolerance, .. } = self.around;
        if self.touches == 0 || self.touches >= TOUCH_LIMIT {
            return;
        }
        let corridor = Corridor::along(steps, tolerance);
        // Parts of one step may touch the same edge.
        for edges in &mut self.touched {
            edges.sort_unstable();
            edges.dedup();
        }
        let edges: Vec<Vec<u32>> =
            corridor.steps.iter().map(|step| self.touched[step.index].clone()).collect();
        let mut reported = BTreeSet::new();
        let mut found: Vec<_> = passages(boundary, tree, &corridor, &edges, go_on)
            .into_iter()
            .map(|passage| (passage.step, passage.at, passage.solids))
            .collect();
        for (step, edges) in corridor.steps.iter().zip(&edges).take_while(|_| go_on()) {
            found.extend(
                seam(boundary, tree, &step.curve, edges, tolerance)
                    .map(|(at, solids)| (step.index, at, solids)),
            );
        }
        found.sort_by_key(|&(step, _, solids)| (step, solids));
        for (index, at, solids) in found {
            let pierced = solids.iter().any(|&solid| {
                (index.saturating_sub(1)..=index + 1).any(|near| self.pierced.contains(&(near, solid)))
            });
            if pierced || !reported.insert((index, solids[0])) {
                continue;
            }
            let [one, other] = solids.map(|solid| boundary.solids[solid as usize].obstacle);
            let (place, field) = self.place(index);
            let name = solid_name(self.checker.scene, one);
            let message = if one == other {
                format!("{place} passes through {name} where it touches itself or has no width")
            } else {
                format!(
                    "{place} passes between {name} and {}, which touch",
                    solid_name(self.checker.scene, other)
                )
            };
            push(
                &mut self.violations,
                Violation {
                    field,
                    reason: ViolationReason::BetweenTouchingObstacles,
                    message,
                    amount: 0.0,
                    at: Some(at),
                    obstacle: Some(solid_id(self.checker.scene, one).to_owned()),
                },
            );
        }
    }

    /// A step's name for people and for programs.
    fn place(&self, index: usize) -> (String, String) {
        if self.only_a_point {
            ("the path".to_owned(), "path.start".to_owned())
        } else {
            let step = self.around.step_of[index];
            (format!("step {step}"), format!("path.steps[{step}]"))
        }
    }
}

fn push(violations: &mut Vec<Violation>, violation: Violation) {
    if violations.len() < VIOLATION_LIMIT {
        violations.push(violation);
    }
}
