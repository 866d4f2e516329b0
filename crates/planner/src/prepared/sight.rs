//! What can be seen from a feature: the tangents to other features that nothing blocks.
//!
//! Cells are looked through ring by ring; what stands in nearer rings covers directions, and the search ends where all
//! of them are covered. Covers only leave out what is hidden for sure: every tangent that is left is tested.

use super::link::Link;
use super::occlusion::Occlusion;
use super::terrain::{Terrain, middle_and_reach};
use crate::barrier::{Feature, Side};
use crate::search::{Ground, Sector, Tangent};
use std::f64::consts::TAU;
use traverse_geometry::{Bounds, Point, Vector, left_of, positive_angle};
use traverse_solve::{Budget, Interrupt};

/// Sine of half the angle over which a change is looked at by itself, at most.
const WIDEST_TOWARDS: f64 = 0.6;

/// Wider ranges of directions are looked through in parts, radians.
const WIDEST_PART_RAD: f64 = 1.5;

/// All that can be seen from a feature on one side.
#[derive(Clone, Debug, Default)]
pub(super) struct Sight {
    /// By the offsets at which they leave, once sorted.
    pub(super) links: Vec<Link>,
    is_sorted: bool,
    /// How far the direction of any link may be off by rounding, radians.
    angle_error: f64,
    /// Nothing further away than this was looked at: it is hidden. Millimetres.
    pub(super) reach: f64,
}

impl Sight {
    /// Adds a link unless it is known: parts that are looked through overlap.
    pub(super) fn add(&mut self, link: Link) {
        if !self.links.iter().any(|known| known.leads_where(&link)) {
            self.links.push(link);
            self.is_sorted = false;
        }
    }

    /// Puts the links in order.
    pub(super) fn sort(&mut self) {
        if self.is_sorted {
            return;
        }
        self.is_sorted = true;
        self.links.sort_unstable_by(|a, b| a.left_at.total_cmp(&b.left_at));
        self.angle_error = self.links.iter().map(Link::angle_error).fold(0.0, f64::max);
    }

    /// Shows `visit` the links that leave at `offset` or ahead of it on `side`, and those behind by what their directions
    /// may be off. From the far end on, so that the ones behind are not touched.
    pub(super) fn ahead(&self, side: Side, offset: f64, mut visit: impl FnMut(&Link)) {
        match side {
            Side::Left => {
                let ahead =
                    self.links.iter().rev().take_while(|link| link.left_at >= offset - self.angle_error);
                ahead.for_each(&mut visit);
            }
            Side::Right => {
                let ahead = self.links.iter().take_while(|link| link.left_at <= offset + self.angle_error);
                ahead.for_each(&mut visit);
            }
        }
    }
}

/// Marks of what was looked at; kept from one sight to the next.
#[derive(Default)]
pub(super) struct Looked {
    now: u32,
    runs: Vec<u32>,
    features: Vec<u32>,
}

impl Looked {
    fn begin(&mut self) {
        self.now += 1;
    }

    fn is_first(marks: &mut Vec<u32>, now: u32, at: u32) -> bool {
        let at = at as usize;
        if marks.len() <= at {
            marks.resize(at + 1, 0);
        }
        std::mem::replace(&mut marks[at], now) != now
    }
}

/// What can be seen from `feature`, which lies on `side` of the way.
///
/// # Errors
/// The budget ended.
pub(super) fn sight(
    terrain: &Terrain,
    feature: u32,
    side: Side,
    looked: &mut Looked,
    budget: &Budget,
) -> Result<Sight, Interrupt> {
    let circle = terrain.feature(feature);
    let parts = (circle.sweep / WIDEST_PART_RAD).ceil().max(1.0);
    let mut sight = Sight::default();
    for part in 0..parts as u32 {
        let range = [f64::from(part), f64::from(part + 1)].map(|end| circle.sweep * end / parts);
        Look { terrain, feature, circle, side, range, sight: &mut sight }.around(looked, budget)?;
    }
    sight.links.shrink_to_fit();
    sight.sort();
    Ok(sight)
}

/// Adds to a sight what can be seen where something within `bounds` is gone; false where that is most of it.
///
/// # Errors
/// The budget ended.
pub(super) fn look_towards(
    terrain: &Terrain,
    feature: u32,
    side: Side,
    bounds: &Bounds,
    sight: &mut Sight,
    looked: &mut Looked,
    budget: &Budget,
) -> Result<bool, Interrupt> {
    let circle = terrain.feature(feature);
    let (middle, half) = middle_and_reach(bounds);
    let by = middle - circle.center;
    // Ways leave the circle to its side.
    let sine = (half + 2.0 * circle.plan_radius) / by.norm();
    if sine.is_nan() || sine > WIDEST_TOWARDS {
        return Ok(false);
    }
    let half_angle = sine.asin() + 1e-6;
    let outward = -left_of(by) * side.sign();
    let toward = positive_angle(outward.y.atan2(outward.x) - circle.start_angle);
    for turn in [0.0, -TAU] {
        let from = (toward + turn - half_angle).max(0.0);
        let to = (toward + turn + half_angle).min(circle.sweep);
        if from <= to {
            Look { terrain, feature, circle, side, range: [from, to], sight }.around(looked, budget)?;
        }
    }
    Ok(true)
}

/// The link from one feature to another, if there is a tangent that nothing blocks.
pub(super) fn link(terrain: &Terrain, from: u32, side: Side, to: u32, other_side: Side) -> Option<Link> {
    let (circle, other) = (terrain.feature(from), terrain.feature(to));
    if from == to || side == other_side && terrain.goes_over(from, to) {
        return None;
    }
    let rho = |feature: &Feature, side: Side| {
        (feature.plan_radius * side.sign(), feature.price_radius * side.sign())
    };
    let ((rho1, price1), (rho2, price2)) = (rho(circle, side), rho(other, other_side));
    let along_border = border(terrain, from, side, to, other_side);
    let planned = along_border.or_else(|| Tangent::between(circle.center, rho1, other.center, rho2))?;
    let offset = other.offset_of(-planned.normal * other_side.sign(), planned.angle_error)?;
    let left_at = circle.offset_of(-planned.normal * side.sign(), planned.angle_error)?;
    if !terrain.is_free(planned.from, planned.to) {
        return None;
    }
    let price = along_border.or_else(|| Tangent::between(circle.center, price1, other.center, price2));
    // What both arcs are longer by because the answered way leaves and arrives in a slightly different direction.
    let length = price.map_or(0.0, |price| price.length + planned.angle_to(&price) * (price1 - price2));
    let mut link = Link::to(to, other_side, planned.angle_error);
    (link.left_at, link.offset, link.length) = (left_at, offset, length);
    Some(link)
}

/// The straight move of a link.
pub(super) fn line(terrain: &Terrain, from: u32, side: Side, link: &Link) -> Option<(Point, Point)> {
    let (circle, other) = (terrain.feature(from), terrain.feature(link.feature()));
    let (rho1, rho2) = (circle.plan_radius * side.sign(), other.plan_radius * link.side().sign());
    let planned = border(terrain, from, side, link.feature(), link.side())
        .or_else(|| Tangent::between(circle.center, rho1, other.center, rho2))?;
    Some((planned.from, planned.to))
}

/// The straight move along a mitred barrier's border, between neighbours of which one is an arc.
fn border(terrain: &Terrain, from: u32, side: Side, to: u32, other_side: Side) -> Option<Tangent> {
    if side == other_side { terrain.along_border(from, to, side) } else { None }
}

/// The budget is looked at once for so many features, or cells of a ring.
const FEATURES_BETWEEN_CHECKS: usize = 256;
const CELLS_BETWEEN_CHECKS: usize = 16;

/// Looking round from a part of a feature's range.
struct Look<'a> {
    terrain: &'a Terrain,
    feature: u32,
    circle: &'a Feature,
    side: Side,
    range: [f64; 2],
    sight: &'a mut Sight,
}

impl Look<'_> {
    fn around(&mut self, looked: &mut Looked, budget: &Budget) -> Result<(), Interrupt> {
        looked.begin();
        let [from, to] = self.range;
        let ahead = Sector::over(self.circle, from, to);
        let middle = left_of(self.circle.direction_at((from + to) / 2.0)) * self.side.sign();
        let half_width = self.circle.plan_radius;
        let mut occlusion = Occlusion::new(self.circle.center, middle, half_width);
        let grid = self.terrain.obstruction.grid();
        let layer = &self.terrain.layer;
        for (i, &feature) in layer.outside().iter().enumerate() {
            if i.is_multiple_of(FEATURES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            self.look_at(feature, &ahead, &occlusion, half_width, looked);
        }
        let rings = Rings::round(self.circle.center, grid.size(), grid.cell_at(self.circle.center));
        let slack = self.circle.plan_radius + grid.cell().norm() / 2.0;
        let half_angle = (to - from) / 2.0;
        for ring in rings.first().. {
            budget.check(0)?;
            let near = rings.distance(ring, grid);
            occlusion.advance(near);
            if self.is_covered(&occlusion, half_angle, half_width, near) {
                self.sight.reach = self.sight.reach.max(near);
                return Ok(());
            }
            let (mut cells, mut ended) = (0_usize, Ok(()));
            rings.cells(ring, |column, row| {
                cells += 1;
                if ended.is_ok() && cells.is_multiple_of(CELLS_BETWEEN_CHECKS) {
                    ended = budget.check(0);
                }
                if ended.is_err() {
                    return;
                }
                let middle = grid.middle(column as i64, row as i64);
                if !ahead.may_lead_to(self.side, middle, slack) {
                    return;
                }
                for feature in layer.items(column, row) {
                    self.look_at(feature, &ahead, &occlusion, half_width, looked);
                }
                for run in grid.items(column, row) {
                    let is_new = Looked::is_first(&mut looked.runs, looked.now, run);
                    if is_new && self.terrain.there.has(self.terrain.obstruction.owner_of_run(run)) {
                        occlusion.add_chain(self.terrain.obstruction.chain_of_run(run));
                    }
                }
            });
            ended?;
            if rings.is_over(ring) {
                break;
            }
        }
        self.sight.reach = f64::INFINITY;
        Ok(())
    }

    /// Whether all that lies at least `near` away is hidden.
    fn is_covered(&self, occlusion: &Occlusion, half_angle: f64, half_width: f64, near: f64) -> bool {
        if near <= 4.0 * half_width {
            return false;
        }
        // Circles that the way touches lie to its side.
        let angle = half_angle + (2.0 * half_width / near).asin() + 1e-7;
        let (sine, cosine) = angle.sin_cos();
        cosine > 0.0 && {
            let measure = sine / (sine + cosine);
            occlusion.covers(-measure, measure)
        }
    }

    fn look_at(
        &mut self,
        other: u32,
        ahead: &Sector,
        occlusion: &Occlusion,
        half_width: f64,
        looked: &mut Looked,
    ) {
        if !Looked::is_first(&mut looked.features, looked.now, other) || !self.terrain.is_there(other) {
            return;
        }
        let there = self.terrain.feature(other);
        let between: Vector = there.center - self.circle.center;
        let hidden = there.plan_radius <= half_width
            && occlusion.measure(between).is_some_and(|at| occlusion.covers(at, at));
        if hidden {
            return;
        }
        let sides = ahead.may_reach(self.side, self.terrain.sector(other));
        for other_side in sides.into_iter().flatten() {
            let Some(link) = link(self.terrain, self.feature, self.side, other, other_side) else { continue };
            self.sight.add(link);
        }
    }
}

/// Whether a barrier within `bounds` may matter to what is seen from a feature.
pub(super) fn may_matter(terrain: &Terrain, feature: u32, side: Side, reach: f64, bounds: &Bounds) -> bool {
    let circle = terrain.feature(feature);
    let (middle, half) = middle_and_reach(bounds);
    (middle - circle.center).norm() <= reach + half + circle.plan_radius
        && terrain.sector(feature).may_lead_to(side, middle, half + circle.plan_radius)
}

/// Cells by their distance, in cells, from the one that a point lies in.
struct Rings {
    center: Point,
    size: [i64; 2],
    at: [i64; 2],
}

impl Rings {
    fn round(center: Point, size: [usize; 2], at: [i64; 2]) -> Self {
        Self { center, size: size.map(|count| count as i64), at }
    }

    /// How far from the centre the cells of this ring begin, at least, millimetres.
    fn distance(&self, ring: i64, grid: &crate::barrier::Grid) -> f64 {
        if ring == 0 {
            return 0.0;
        }
        let half = grid.cell() / 2.0;
        let low = grid.middle(self.at[0] - ring + 1, self.at[1] - ring + 1) - half;
        let high = grid.middle(self.at[0] + ring - 1, self.at[1] + ring - 1) + half;
        let (below, above) = (self.center - low, high - self.center);
        below.x.min(below.y).min(above.x).min(above.y).max(0.0) * (1.0 - 1e-9)
    }

    /// The first ring that reaches into the grid.
    fn first(&self) -> i64 {
        let beyond = |at: i64, count: i64| (-at).max(at - count + 1);
        beyond(self.at[0], self.size[0]).max(beyond(self.at[1], self.size[1])).max(0)
    }

    /// Whether this ring and all further ones lie outside the grid.
    fn is_over(&self, ring: i64) -> bool {
        let [columns, rows] = self.size;
        let [column, row] = self.at;
        column - ring < 0 && row - ring < 0 && column + ring >= columns && row + ring >= rows
    }

    fn cells(&self, ring: i64, mut visit: impl FnMut(usize, usize)) {
        let [columns, rows] = self.size;
        let [column, row] = self.at;
        for y in (row - ring).max(0)..=(row + ring).min(rows - 1) {
            let is_edge = y == row - ring || y == row + ring;
            let (low, high) = (column - ring, column + ring);
            if is_edge {
                for x in low.max(0)..=high.min(columns - 1) {
                    visit(x as usize, y as usize);
                }
            } else {
                for x in [low, high] {
                    if (0..columns).contains(&x) {
                        visit(x as usize, y as usize);
                    }
                }
            }
        }
    }
}
