//! Finds places for labels where nothing else is.

use super::frame::Box2;
use std::collections::HashMap;

/// Free space around a label.
const AIR: f64 = 4.0;
/// How near a label may come to the path.
const PATH_AIR: f64 = 8.0;
/// How near a label may come to borders.
const BORDER_AIR: f64 = 2.0;
/// Side of the cells that points are kept in.
const CELL: f64 = 40.0;

/// Points of the canvas by cell.
struct Points(HashMap<(i32, i32), Vec<(f64, f64)>>);

impl Points {
    fn new(points: &[(f64, f64)]) -> Self {
        let mut cells: HashMap<_, Vec<_>> = HashMap::new();
        for &(x, y) in points {
            cells.entry(cell(x, y)).or_default().push((x, y));
        }
        Self(cells)
    }

    fn near<'a>(&'a self, area: &'a Box2, air: f64) -> impl Iterator<Item = &'a (f64, f64)> + 'a {
        let (first_x, first_y) = cell(area.left - air, area.top - air);
        let (last_x, last_y) = cell(area.right + air, area.bottom + air);
        (first_x..=last_x)
            .flat_map(move |x| (first_y..=last_y).map(move |y| (x, y)))
            .filter_map(|key| self.0.get(&key))
            .flatten()
            .filter(move |&&point| area.distance(point) < air)
    }

    fn any_near(&self, area: &Box2, air: f64) -> bool {
        self.near(area, air).next().is_some()
    }
}

/// What labels keep away from.
pub(super) struct Places {
    within: Box2,
    taken: Vec<Box2>,
    path: Points,
    borders: Points,
}

impl Places {
    /// Labels must stay off the path and should stay off borders.
    pub(super) fn new(within: Box2, path: &[(f64, f64)], borders: &[(f64, f64)]) -> Self {
        Self { within, taken: Vec::new(), path: Points::new(path), borders: Points::new(borders) }
    }

    /// Keeps labels away from a box.
    pub(super) fn take(&mut self, area: Box2) {
        self.taken.push(area);
    }

    /// Whether a label or a mark, or the path, covers the point.
    pub(super) fn is_taken(&self, (x, y): (f64, f64)) -> bool {
        let point = Box2 { left: x, top: y, right: x, bottom: y };
        self.taken.iter().any(|other| other.distance((x, y)) <= 1.0) || self.path.any_near(&point, PATH_AIR)
    }

    /// Whether the box is free of labels, marks and path.
    pub(super) fn is_free(&self, area: &Box2) -> bool {
        let near = area.grown(AIR);
        area.within(&self.within)
            && !self.taken.iter().any(|other| other.meets(&near))
            && !self.path.any_near(area, PATH_AIR)
    }

    /// How much of the borders runs through the box.
    pub(super) fn borders_in(&self, area: &Box2) -> usize {
        self.borders.near(area, BORDER_AIR).count()
    }

    /// Whether no border runs through the box.
    pub(super) fn is_clear(&self, area: &Box2) -> bool {
        !self.borders.any_near(area, BORDER_AIR)
    }
}

fn cell(x: f64, y: f64) -> (i32, i32) {
    ((x / CELL).floor() as i32, (y / CELL).floor() as i32)
}

/// The box of a text of that width and letter size whose middle is at `(x, y)`.
pub(super) fn box_at(x: f64, y: f64, width: f64, size: f64) -> Box2 {
    Box2 { left: x - width / 2.0, top: y - size * 0.6, right: x + width / 2.0, bottom: y + size * 0.6 }
}
