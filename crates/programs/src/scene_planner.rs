//! Plans and checks round the obstacles of scenes, and over those whose tops are known where that is asked for; others
//! reach up without end, but for a height above which nothing is in the way.

use crate::rapid_planner::{Found, LEAST_GAIN_MM, RapidPlanner, Straight, Travel};
use crate::reason::Reason;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::rc::Rc;
use traverse_checker::{PathCheck, RapidMoveChecker};
use traverse_geometry::{
    ArcOutput, CONTACT_TOLERANCE_MM, CostUnit, HeightRule, Path, Point, RapidMotion, RapidRules, Scene, unit,
};
use traverse_planner::{Algorithm, Answer, PreparedScene, RapidMove, Refusal, travel_cost};
use traverse_solve::{Budget, Interrupt, Silent};

/// An end within the reserve is left by a step of so many reserves.
const STEP_OUT_RESERVES: f64 = 3.0;

/// A way that is quicker by less stays as it is, seconds.
const LEAST_GAIN_S: f64 = 0.001;

/// In so many directions.
const STEP_OUT_DIRECTIONS: u32 = 16;

/// Scenes by tool.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolScenes {
    /// For tools that are not named.
    pub any: Scene,
    /// For these tools: the same obstacles with other clearances.
    pub by_tool: BTreeMap<u32, Scene>,
    /// At this height, in the program's coordinates, and above it nothing is in the way. Absent: nowhere.
    pub safe_z_mm: Option<f64>,
}

/// Lets the tool pass over obstacles whose tops are known. Heights count in the program's coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassingOver {
    /// Kept above every top, millimetres, not negative. Absent: the scene's clearance.
    pub clearance_z_mm: Option<f64>,
    /// No run rises higher, unless it begins or ends higher, millimetres. Absent: no higher than it begins and ends.
    pub highest_z_mm: Option<f64>,
}

/// Plans round the obstacles of scenes.
pub struct ScenePlanner<'a> {
    scenes: &'a ToolScenes,
    /// What ways cost and how G0 runs; nothing else.
    rules: RapidRules,
    over: Option<PassingOver>,
    budget: &'a Budget,
    any: Prepared<'a>,
    by_tool: BTreeMap<u32, Prepared<'a>>,
}

struct Prepared<'a> {
    scene: &'a Scene,
    checker: RapidMoveChecker<'a>,
    /// Scenes with more clearance, by the bits of how much more: each is taken apart once for all links.
    wider: RefCell<BTreeMap<u64, Kept>>,
}

/// A scene that links share: what can be seen in it is worked out once.
type Kept = Rc<RefCell<PreparedScene>>;

impl<'a> Prepared<'a> {
    fn new(scene: &'a Scene) -> Self {
        Self { scene, checker: RapidMoveChecker::new(scene), wider: RefCell::default() }
    }

    /// The scene with so much more clearance.
    fn wider(&self, reserve_mm: f64, budget: &Budget) -> Result<Kept, Interrupt> {
        if let Some(kept) = self.wider.borrow().get(&reserve_mm.to_bits()) {
            return Ok(kept.clone());
        }
        let mut scene = self.scene.clone();
        scene.clearance_mm += reserve_mm;
        scene.work_area_clearance_mm = scene.work_area_clearance_mm.map(|clearance| clearance + reserve_mm);
        for obstacle in &mut scene.obstacles {
            obstacle.clearance_mm = obstacle.clearance_mm.map(|clearance| clearance + reserve_mm);
        }
        let kept = Rc::new(RefCell::new(PreparedScene::new(scene, budget)?));
        self.wider.borrow_mut().insert(reserve_mm.to_bits(), kept.clone());
        Ok(kept)
    }
}

impl<'a> ScenePlanner<'a> {
    /// Makes the scenes ready, for the shortest ways and a G0 in straight lines. Cost: O(n log n) for n vertices, for each.
    #[must_use]
    pub fn new(scenes: &'a ToolScenes, budget: &'a Budget) -> Self {
        Self::by(scenes, &RapidRules::default(), budget)
    }

    /// The same for ways that cost least by the rules' measure, and for a G0 as they say. Of the rules, which have no
    /// findings, nothing else counts.
    #[must_use]
    pub fn by(scenes: &'a ToolScenes, rules: &RapidRules, budget: &'a Budget) -> Self {
        let rules = RapidRules { cost: rules.cost, motion: rules.motion, ..RapidRules::default() };
        Self {
            scenes,
            rules,
            over: None,
            budget,
            any: Prepared::new(&scenes.any),
            by_tool: scenes.by_tool.iter().map(|(tool, scene)| (*tool, Prepared::new(scene))).collect(),
        }
    }

    /// The same, passing over what is low. Costs by axes or with acceleration need a speed of Z.
    #[must_use]
    pub fn passing_over(self, over: PassingOver) -> Self {
        Self { over: Some(over), ..self }
    }

    /// Heights of a way, as far as they count.
    fn heights(&self, travel: &Travel) -> Option<HeightRule> {
        let over = self.over?;
        let [start_z_mm, target_z_mm] = travel.ends_z.or_else(|| travel.z.map(|z| [z, z]))?;
        let least = start_z_mm.max(target_z_mm);
        let highest = over.highest_z_mm.filter(|_| travel.ends_z.is_some());
        Some(HeightRule {
            start_z_mm,
            target_z_mm,
            highest_z_mm: highest.map_or(least, |highest| highest.max(least)),
            clearance_z_mm: over.clearance_z_mm.unwrap_or(self.prepared(travel).scene.clearance_mm),
        })
    }

    fn prepared(&self, travel: &Travel) -> &Prepared<'a> {
        if !travel.tool_is_known {
            let all = self.by_tool.values().chain([&self.any]);
            let clearance = |prepared: &&Prepared<'_>| prepared.scene.clearance_mm;
            return all.max_by(|a, b| clearance(a).total_cmp(&clearance(b))).unwrap_or(&self.any);
        }
        travel.tool.and_then(|tool| self.by_tool.get(&tool)).unwrap_or(&self.any)
    }

    fn is_above_all(&self, travel: &Travel) -> bool {
        travel.z.zip(self.scenes.safe_z_mm).is_some_and(|(z, safe)| z >= safe)
    }

    /// The rules for a way. Arcs of linear machines become chords when they are rounded, and are chords of dog-legs at once.
    fn rules(&self, travel: &Travel) -> RapidRules {
        let motion = if travel.straight == Straight::Fed { RapidMotion::Linear } else { self.rules.motion };
        let arcs = if motion == RapidMotion::DogLeg { travel.arcs } else { ArcOutput::Arcs };
        RapidRules { motion, arcs, heights: self.heights(travel), ..self.rules.clone() }
    }

    /// How much more room a dog-leg needs than a line for the same rounding: where its ends move by as much, its corner
    /// moves by so much more.
    fn more_room(&self, travel: &Travel) -> f64 {
        self.rules(travel).dog_leg().map_or(1.0, |speeds| {
            let ratio = speeds.x_mm_per_s / speeds.y_mm_per_s;
            1.0 + ratio.max(1.0 / ratio)
        })
    }

    fn plan(&self, scene: &Kept, travel: &Travel, from: Point, to: Point) -> Result<Path, Stop> {
        let (algorithm, rules) = (Algorithm::Exact, self.rules(travel));
        let query = RapidMove { start: from, target: to, algorithm, rules };
        let answer = scene.borrow_mut().plan(&query, self.budget, &mut Silent);
        match answer.map_err(Stop::Refused)? {
            (Answer::Plan(plan), _) if travel.ends_z.is_some() => Ok(plan.path),
            (Answer::Plan(plan), _) => Ok(plan.path.in_plane()),
            (Answer::NoPath(no_path), _) => Err(Stop::NoPath(no_path.separating_obstacles)),
        }
    }

    /// Why there is no way in the scene with the reserve; what the reserve alone is to blame for is its fault.
    fn reason(&self, prepared: &Prepared<'_>, travel: &Travel, stop: &Stop, reserve_mm: f64) -> Reason {
        let refusals = match stop {
            Stop::Refused(refusals) => refusals,
            Stop::NoPath(_) => {
                let Ok(scene) = prepared.wider(0.0, self.budget) else { return Reason::Interrupted };
                return match self.plan(&scene, travel, travel.from, travel.to) {
                    Err(Stop::NoPath(separating)) => Reason::NoPath { separating },
                    _ => Reason::Rounding,
                };
            }
        };
        refusals.iter().find_map(|refusal| too_deep(refusal, reserve_mm)).unwrap_or(Reason::Rounding)
    }

    /// A point beside `end` that keeps the reserve, and can be reached from it straight.
    fn step_out(
        &self,
        prepared: &Prepared<'_>,
        wider: &Kept,
        travel: &Travel,
        end: Point,
        reserve_mm: f64,
    ) -> Option<Point> {
        (0..STEP_OUT_DIRECTIONS).find_map(|direction| {
            let angle = TAU * f64::from(direction) / f64::from(STEP_OUT_DIRECTIONS);
            let beside = end + unit(angle) * (STEP_OUT_RESERVES * reserve_mm);
            let mut path = Path::at(end);
            path.line_to(beside);
            let free = self.check(prepared, travel, &path).is_some_and(|check| check.is_sound());
            (free && self.plan(wider, travel, beside, beside).is_ok()).then_some(beside)
        })
    }
}

impl ScenePlanner<'_> {
    /// None: time was over.
    fn check(&self, prepared: &Prepared<'_>, travel: &Travel, path: &Path) -> Option<PathCheck> {
        let rules = self.rules(travel);
        let go_on = || self.budget.check(0).is_ok();
        let at_level = rules.heights.filter(|_| path.start_z_mm.is_none());
        let at_level = at_level.map(|heights| path.clone().at_level(heights.start_z_mm));
        let path = at_level.as_ref().unwrap_or(path);
        prepared.checker.check_while(&rules, path.start, path.end(), path, CONTACT_TOLERANCE_MM, &go_on)
    }
}

/// Why the planner has no path.
enum Stop {
    NoPath(Vec<String>),
    Refused(Vec<Refusal>),
}

impl Stop {
    /// Whether an end lies inside a barrier.
    fn names(&self, which: &str) -> bool {
        let Self::Refused(refusals) = self else { return false };
        let is_end =
            |refusal: &Refusal| matches!(refusal, Refusal::EndInsideBarrier { field, .. } if *field == which);
        refusals.iter().any(is_end)
    }
}

impl RapidPlanner for ScenePlanner<'_> {
    fn look(&self, travel: &Travel, path: &Path) -> Result<Found, Reason> {
        if self.is_above_all(travel) {
            return Ok(Found { hits: Vec::new(), margin_mm: None });
        }
        let check = self.check(self.prepared(travel), travel, path).ok_or(Reason::Interrupted)?;
        let mut hits: Vec<String> = Vec::new();
        for violation in check.violations {
            let id = violation.obstacle.unwrap_or_else(|| violation.reason.to_string());
            if !hits.contains(&id) {
                hits.push(id);
            }
        }
        Ok(Found { hits, margin_mm: check.smallest_margin_mm })
    }

    fn knows_heights(&self) -> bool {
        self.over.is_some()
    }

    fn cost(&self, path: &Path) -> f64 {
        travel_cost(path, &self.rules.cost)
    }

    fn least_gain(&self) -> f64 {
        match self.rules.cost.unit() {
            CostUnit::Millimetres => LEAST_GAIN_MM,
            CostUnit::Seconds => LEAST_GAIN_S,
        }
    }

    fn shortest(&self, travel: &Travel, reserve_mm: f64) -> Result<Path, Reason> {
        let prepared = self.prepared(travel);
        let reserve_mm = reserve_mm * self.more_room(travel);
        let wider = prepared.wider(reserve_mm, self.budget).map_err(|_| Reason::Interrupted)?;
        let stop = match self.plan(&wider, travel, travel.from, travel.to) {
            Ok(path) => return Ok(path),
            Err(stop) => stop,
        };
        let reason = self.reason(prepared, travel, &stop, reserve_mm);
        if reason != Reason::Rounding || matches!(stop, Stop::NoPath(_)) || travel.ends_z.is_some() {
            return Err(reason);
        }
        // Ends that keep the clearance but not the reserve are left by a small step first.
        let leave = |which: &str, end: Point| {
            let out = || self.step_out(prepared, &wider, travel, end, reserve_mm).ok_or(Reason::Rounding);
            if stop.names(which) { out() } else { Ok(end) }
        };
        let (from, to) = (leave("start", travel.from)?, leave("target", travel.to)?);
        let between = self
            .plan(&wider, travel, from, to)
            .map_err(|stop| self.reason(prepared, travel, &stop, reserve_mm))?;
        let mut path = Path::at(travel.from);
        path.line_to(from);
        path.steps.extend(between.steps);
        path.line_to(travel.to);
        Ok(path)
    }
}

/// What a refusal means, unless it is only the reserve that is used up.
fn too_deep(refusal: &Refusal, reserve_mm: f64) -> Option<Reason> {
    match refusal {
        Refusal::EndInsideBarrier { field, obstacle, depth_mm } => {
            let depth_mm = depth_mm - reserve_mm;
            (depth_mm > CONTACT_TOLERANCE_MM).then(|| Reason::EndInside {
                end: field,
                obstacle: obstacle.clone(),
                depth_mm,
            })
        }
        Refusal::EndShutIn { .. } | Refusal::NoRoomForDogLegs => Some(Reason::Refused(refusal.to_string())),
        Refusal::Interrupted { .. } => Some(Reason::Interrupted),
        Refusal::PublishedMethodNotApplicable { why } => Some(Reason::Refused((*why).to_owned())),
    }
}
