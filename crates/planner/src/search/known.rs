//! The barriers that a search has met so far. Those that it has not met bend no path; they block all the same.

use super::sector::Sector;
use crate::barrier::Feature;
use crate::barriers::Barriers;
use rustc_hash::FxHashMap;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::ops::{ControlFlow, Range};
use traverse_geometry::{CONTACT_TOLERANCE_MM, Point, Segment, Vector};
use traverse_solve::{Budget, Interrupt};

/// The budget is looked at once for so many features.
const FEATURES_BETWEEN_CHECKS: usize = 4096;

/// A scene's barriers, or some of them, and which of these were met.
pub(crate) struct Known<'a> {
    barriers: &'a Barriers<'a>,
    /// Owners that are there at all.
    there: Marks,
    /// Owners that were met.
    met: Marks,
    /// Features of what was met.
    pub(crate) features: Vec<Feature>,
    /// Their directions, for the quick test.
    sectors: Vec<Sector>,
    /// Per feature the stretches of its range that nothing blocks, worked out when first asked for.
    free: Vec<OnceCell<Stretches>>,
    /// The last feature of each millimetre square that a centre lies in, and for every feature the one before it in
    /// its square.
    last_in: FxHashMap<[i64; 2], usize>,
    before_in_square: Vec<Option<usize>>,
}

/// A yes or no for every owner.
struct Marks {
    obstacles: Vec<bool>,
    work_area: bool,
}

impl Marks {
    fn of(obstacle_count: usize, mark: bool) -> Self {
        Self { obstacles: vec![mark; obstacle_count], work_area: mark }
    }

    fn has(&self, owner: usize) -> bool {
        self.obstacles.get(owner).copied().unwrap_or(self.work_area)
    }

    fn set(&mut self, owner: usize, mark: bool) {
        *self.obstacles.get_mut(owner).unwrap_or(&mut self.work_area) = mark;
    }
}

/// The stretches of a feature's range that no barrier blocks, in order, and whose barriers block the rest.
pub(crate) struct Stretches {
    pub(crate) free: Vec<(f64, f64)>,
    pub(crate) blocked_by: Vec<usize>,
}

/// A barrier that was just met.
pub(crate) struct Met {
    /// Its features.
    pub(crate) features: Range<usize>,
    /// Whether any of them lies on the circle of another.
    pub(crate) has_same_circles: bool,
}

/// What lies in the way of a straight move.
pub(crate) enum Way {
    /// Nothing.
    Free,
    /// A barrier that was met.
    Blocked,
    /// None that was met; nearest to its beginning the barrier of this owner.
    Meets(usize),
}

impl<'a> Known<'a> {
    /// Nothing met yet. `left_out` is taken for not there.
    pub(crate) fn new(barriers: &'a Barriers<'a>, left_out: &BTreeSet<usize>) -> Self {
        let mut there = Marks::of(barriers.scene.obstacles.len(), true);
        left_out.iter().for_each(|&owner| there.set(owner, false));
        Self {
            barriers,
            there,
            met: Marks::of(barriers.scene.obstacles.len(), false),
            features: Vec::new(),
            sectors: Vec::new(),
            free: Vec::new(),
            last_in: FxHashMap::default(),
            before_in_square: Vec::new(),
        }
    }

    /// Owners of the barriers that were met.
    pub(crate) fn met(&self) -> impl Iterator<Item = usize> {
        self.barriers.owners().filter(|&owner| self.met.has(owner))
    }

    pub(crate) fn was_met(&self, owner: usize) -> bool {
        self.met.has(owner)
    }

    pub(crate) fn feature(&self, feature: u32) -> &Feature {
        &self.features[feature as usize]
    }

    pub(super) fn sector(&self, feature: u32) -> &Sector {
        &self.sectors[feature as usize]
    }

    /// Meets the owner's barrier.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn meet(&mut self, owner: usize, budget: &Budget) -> Result<Met, Interrupt> {
        let first = self.features.len();
        self.met.set(owner, true);
        for outline in self.barriers.outlines(owner) {
            outline.add_features(&mut self.features, budget)?;
        }
        for feature in first..self.features.len() {
            if feature % FEATURES_BETWEEN_CHECKS == 0 {
                budget.check(0)?;
            }
            self.sectors.push(Sector::of(&self.features[feature]));
            let before = self.last_in.insert(square_of(self.features[feature].center), feature);
            self.before_in_square.push(before);
        }
        self.free.resize_with(self.features.len(), OnceCell::new);
        let features = first..self.features.len();
        let has_same_circles =
            features.clone().any(|feature| self.on_same_circle(feature as u32).next().is_some());
        Ok(Met { features, has_same_circles })
    }

    /// What lies in the way from `from` to `to`.
    pub(crate) fn way(&self, from: Point, to: Point) -> Way {
        if from == to {
            return Way::Free;
        }
        let mut met = false;
        let mut nearest: Option<(f64, usize)> = None;
        self.barriers.whole.blocking(&Segment::new(from, to), |blocker| {
            if !self.there.has(blocker.owner) {
                return ControlFlow::Continue(());
            }
            if self.met.has(blocker.owner) {
                met = true;
                return ControlFlow::Break(());
            }
            let found = (blocker.edge.distance_to_point(from), blocker.owner);
            if nearest.is_none_or(|known| found < known) {
                nearest = Some(found);
            }
            ControlFlow::Continue(())
        });
        match nearest {
            _ if met => Way::Blocked,
            Some((_, owner)) => Way::Meets(owner),
            None => Way::Free,
        }
    }

    /// The feature's stretches that no barrier blocks, met or not.
    pub(crate) fn stretches(&self, feature: u32) -> &Stretches {
        self.free[feature as usize].get_or_init(|| {
            let feature = &self.features[feature as usize];
            // A control point is no arc: whether it can be passed is decided by the moves that meet there.
            if feature.plan_radius == 0.0 {
                return Stretches { free: vec![(0.0, feature.sweep)], blocked_by: Vec::new() };
            }
            let blocked = self.barriers.whole.blocked_offsets(feature);
            free_of(feature, blocked.filter(|&(_, _, owner)| self.there.has(owner)).collect())
        })
    }

    /// Whether the feature's stretches have been worked out.
    pub(crate) fn knows_stretches(&self, feature: u32) -> bool {
        self.free[feature as usize].get().is_some()
    }

    /// The free stretch of the feature that holds `offset`, if any.
    pub(crate) fn stretch_at(&self, feature: u32, offset: f64) -> Option<usize> {
        let tolerance = self.feature(feature).offset_tolerance();
        self.stretches(feature)
            .free
            .iter()
            .position(|&(from, to)| from - tolerance <= offset && offset <= to + tolerance)
    }

    /// Other features on the same circle.
    pub(crate) fn on_same_circle(&self, feature: u32) -> impl Iterator<Item = usize> {
        let squares = squares_near(self.feature(feature).center);
        let feature = feature as usize;
        let last = squares.into_iter().flatten().filter_map(|square| self.last_in.get(&square).copied());
        let all =
            last.flat_map(|last| std::iter::successors(Some(last), |&other| self.before_in_square[other]));
        all.filter(move |&other| other != feature && self.is_same_circle(feature, other))
    }

    fn is_same_circle(&self, one: usize, other: usize) -> bool {
        let (a, b) = (&self.features[one], &self.features[other]);
        a.plan_radius > 0.0
            && (a.plan_radius - b.plan_radius).abs() < CONTACT_TOLERANCE_MM / 2.0
            && (a.center - b.center).norm() < CONTACT_TOLERANCE_MM / 2.0
    }

    /// Whether a path passes from one feature to the other without a straight move.
    pub(crate) fn goes_over(&self, one: u32, other: u32) -> bool {
        let (one, other) = (one as usize, other as usize);
        let feature = &self.features[one];
        feature.after == Some(other) || feature.before == Some(other) || self.is_same_circle(one, other)
    }
}

/// What `blocked` leaves of the feature's range.
fn free_of(feature: &Feature, mut blocked: Vec<(f64, f64, usize)>) -> Stretches {
    let mut blocked_by: Vec<usize> = blocked.iter().map(|&(_, _, owner)| owner).collect();
    blocked_by.sort_unstable();
    blocked_by.dedup();
    blocked.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut free = Vec::new();
    let mut free_from = 0.0_f64;
    for (from, to, _) in blocked {
        if from >= free_from && (from > 0.0 || free_from > 0.0) {
            free.push((free_from, from));
        }
        free_from = free_from.max(to);
    }
    if free_from < feature.sweep || (free_from == 0.0 && feature.sweep == 0.0) {
        free.push((free_from, feature.sweep));
    }
    Stretches { free, blocked_by }
}

/// The millimetre square of a point.
fn square_of(p: Point) -> [i64; 2] {
    [p.x.floor() as i64, p.y.floor() as i64]
}

/// The squares in which a centre within half a contact tolerance of `center` may lie, each once.
fn squares_near(center: Point) -> [Option<[i64; 2]>; 4] {
    let by = Vector::new(CONTACT_TOLERANCE_MM, CONTACT_TOLERANCE_MM);
    let ([left, low], [right, high]) = (square_of(center - by), square_of(center + by));
    let (wide, tall) = (left < right, low < high);
    [
        Some([left, low]),
        wide.then_some([right, low]),
        tall.then_some([left, high]),
        (wide && tall).then_some([right, high]),
    ]
}
