//! An ellipse round start and target that grows: which features a path of some cost may touch.
//!
//! A path of cost c touches only points whose distances from both ends add up to at most c.

use crate::barrier::Grid;
use traverse_geometry::{Point, Vector};

/// By how much the ellipse's excess over the straight way grows at once, at least.
const GROWTH: f64 = 1.25;

/// The cells that an ellipse has reached.
pub(super) struct Growth {
    start: Point,
    target: Point,
    straight: f64,
    /// Cost up to which all was found.
    cost: f64,
    /// First row of `done`, and per row the columns that were looked through, from and to before.
    first_row: i64,
    done: Vec<(i64, i64)>,
    is_first: bool,
}

impl Growth {
    pub(super) fn new(start: Point, target: Point) -> Self {
        let straight = (target - start).norm();
        Self { start, target, straight, cost: 0.0, first_row: 0, done: Vec::new(), is_first: true }
    }

    /// No path that touches the circle costs less, millimetres.
    pub(super) fn least_cost(&self, center: Point, radius: f64) -> f64 {
        let by_center = (center - self.start).norm() + (self.target - center).norm();
        // A hair less, so that rounding takes none away.
        ((by_center - 2.0 * radius) * (1.0 - 1e-12)).max(0.0)
    }

    /// Adds to `found` the items of `layer` in cells not looked through yet, until all were that a path of cost `cost`
    /// may touch; answers the cost up to which that holds now: infinity when there are no more.
    pub(super) fn grow(&mut self, layer: &Grid, cost: f64, found: &mut Vec<u32>) -> f64 {
        if self.cost == f64::INFINITY {
            return self.cost;
        }
        if std::mem::take(&mut self.is_first) {
            found.extend_from_slice(layer.outside());
        }
        let excess = (self.cost - self.straight).max(layer.cell().amin() / 4.0);
        let cost = if cost.is_finite() { cost } else { 0.0 };
        self.cost = cost.max(self.straight + GROWTH * excess);
        // A cell that the ellipse reaches has its middle in a larger one.
        let ellipse = Ellipse::new(self.start, self.target, self.cost + layer.cell().norm() * (1.0 + 1e-9));
        let [columns, rows] = layer.size().map(|count| count as i64);
        let at_height = |y: f64| layer.cell_at(Point::new(0.0, y))[1];
        let low = at_height(ellipse.middle.y - ellipse.reach_up);
        let high = at_height(ellipse.middle.y + ellipse.reach_up);
        let (low, high) = ((low - 1).max(0), (high + 1).min(rows - 1));
        if self.done.is_empty() && low <= high {
            self.first_row = low;
        }
        let mut whole = low == 0 && high == rows - 1;
        for row in low..=high {
            let Some((left, right)) = ellipse.across(layer.middle(0, row).y) else {
                whole = false;
                continue;
            };
            let [from, _] = layer.cell_at(Point::new(left, 0.0));
            let [to, _] = layer.cell_at(Point::new(right, 0.0));
            let (from, to) = ((from - 1).max(0), (to + 2).min(columns));
            whole &= from == 0 && to == columns;
            self.look_through(layer, row, from, to, found);
        }
        if whole || columns == 0 || rows == 0 {
            self.cost = f64::INFINITY;
        }
        self.cost
    }

    fn look_through(&mut self, layer: &Grid, row: i64, from: i64, to: i64, found: &mut Vec<u32>) {
        if from >= to {
            return;
        }
        while row < self.first_row {
            self.done.insert(0, (0, 0));
            self.first_row -= 1;
        }
        let at = (row - self.first_row) as usize;
        if self.done.len() <= at {
            self.done.resize(at + 1, (0, 0));
        }
        let (done_from, done_to) = self.done[at];
        let is_new = done_from == done_to;
        let parts = if is_new { [(from, to), (0, 0)] } else { [(from, done_from), (done_to, to)] };
        for (from, to) in parts {
            for column in from..to {
                found.extend(layer.items(column as usize, row as usize));
            }
        }
        self.done[at] = if is_new { (from, to) } else { (from.min(done_from), to.max(done_to)) };
    }
}

/// Points whose distances from two foci add up to at most a sum.
struct Ellipse {
    middle: Point,
    along: Vector,
    /// Half axes.
    long: f64,
    short: f64,
    /// How far it reaches above its middle.
    reach_up: f64,
}

impl Ellipse {
    /// `sum` is more than the distance of the foci.
    fn new(a: Point, b: Point, sum: f64) -> Self {
        let along = (b - a).try_normalize(0.0).unwrap_or_else(Vector::x);
        let long = sum / 2.0;
        let focal = (b - a).norm() / 2.0;
        let short = ((long - focal) * (long + focal)).max(0.0).sqrt();
        let reach_up = (long * along.y).hypot(short * along.x);
        Self { middle: nalgebra::center(&a, &b), along, long, short, reach_up }
    }

    /// From where to where it reaches at height `y`; its extremes where that lies just above or below it.
    fn across(&self, y: f64) -> Option<(f64, f64)> {
        let up = (y - self.middle.y).clamp(-self.reach_up, self.reach_up);
        let (cosine, sine) = (self.along.x, self.along.y);
        let (long, short) = (self.long.powi(2), self.short.powi(2));
        if short == 0.0 {
            return None;
        }
        let square = cosine * cosine / long + sine * sine / short;
        let half = up * cosine * sine * (1.0 / long - 1.0 / short);
        let rest = up * up * (sine * sine / long + cosine * cosine / short) - 1.0;
        let root = (half * half - square * rest).max(0.0).sqrt();
        Some((self.middle.x + (-half - root) / square, self.middle.x + (-half + root) / square))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::barrier::Load;
    use rand::RngExt;
    use traverse_geometry::Bounds;
    use traverse_solve::Seed;

    /// Whatever a path of the cost may touch was found, at most once per cell, and in the end everything.
    #[test]
    fn all_that_a_path_may_touch_is_found() {
        for seed in 0..100 {
            let mut random = Seed(seed).stream();
            let mut at = || Point::new(random.random_range(0.0..100.0), random.random_range(0.0..30.0));
            let items: Vec<Point> = (0..300).map(|_| at()).collect();
            let mut load = Load::NONE;
            items.iter().for_each(|&p| load.add(&Bounds::of([p]), 0.1));
            let mut grid = Grid::new(&load);
            items.iter().enumerate().for_each(|(i, &p)| grid.insert_box(i as u32, &Bounds::of([p]), 0.0));
            let (start, target) = (at(), at());
            let mut growth = Growth::new(start, target);
            let mut found = Vec::new();
            let straight = (target - start).norm();
            for excess in [0.0, 1.0, 1.0, 7.0, 30.0, 400.0] {
                let cost = growth.grow(&grid, straight + excess, &mut found);
                assert!(cost >= straight + excess);
                for (i, &p) in items.iter().enumerate() {
                    let touches = (p - start).norm() + (p - target).norm() <= cost;
                    assert!(
                        !touches || found.contains(&(i as u32)),
                        "seed {seed}: {i} was not found at {cost}"
                    );
                }
            }
            while growth.grow(&grid, f64::INFINITY, &mut found).is_finite() {}
            found.sort_unstable();
            assert_eq!(found, (0..300).collect::<Vec<u32>>());
        }
    }
}
