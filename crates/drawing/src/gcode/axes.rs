//! Axis letters of a plane, and positions in counts of them.

use super::grid::Grid;
use super::settings::{GcodePlane, XWord};
use traverse_geometry::{Point, Vector};

/// Letters of the axes that move x and y, and of the offsets to a centre.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub(crate) x: char,
    pub(crate) y: char,
    x_center: char,
    y_center: char,
    /// What y is multiplied by: 2 for diameters.
    y_factor: f64,
}

impl From<GcodePlane> for Axes {
    fn from(plane: GcodePlane) -> Self {
        match plane {
            GcodePlane::Xy => Self { x: 'X', y: 'Y', x_center: 'I', y_center: 'J', y_factor: 1.0 },
            GcodePlane::Zx { x } => {
                let y_factor = if x == XWord::Diameter { 2.0 } else { 1.0 };
                Self { x: 'Z', y: 'X', x_center: 'K', y_center: 'I', y_factor }
            }
        }
    }
}

/// Two words in counts of the last place: a position, or offsets to a centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Words {
    pub(crate) x: i64,
    pub(crate) y: i64,
}

impl Axes {
    /// The words of a position; the letter and value (millimetres) of the one that is too large.
    pub(crate) fn position(self, grid: Grid, p: Point) -> Result<Words, (char, f64)> {
        let y = p.y * self.y_factor;
        Ok(Words { x: grid.count(p.x).ok_or((self.x, p.x))?, y: grid.count(y).ok_or((self.y, y))? })
    }

    /// The words of an offset, which counts radii; none when it is too large.
    pub(crate) fn offset(self, grid: Grid, v: Vector) -> Option<Words> {
        Some(Words { x: grid.count(v.x)?, y: grid.count(v.y)? })
    }

    /// Where the controller takes the words of a position to be, millimetres.
    pub(crate) fn read_position(self, grid: Grid, words: Words) -> Point {
        Point::new(grid.mm(words.x), grid.mm(words.y) / self.y_factor)
    }

    /// ` X1 Y2`; on a lathe ` X2 Z1`.
    pub(crate) fn position_text(self, grid: Grid, words: Words) -> String {
        pair(grid, (self.x, words.x), (self.y, words.y))
    }

    /// ` I1 J2`; on a lathe ` I2 K1`.
    pub(crate) fn offset_text(self, grid: Grid, words: Words) -> String {
        pair(grid, (self.x_center, words.x), (self.y_center, words.y))
    }
}

fn pair(grid: Grid, a: (char, i64), b: (char, i64)) -> String {
    let (first, second) = if a.0 <= b.0 { (a, b) } else { (b, a) };
    format!(" {}{} {}{}", first.0, grid.text(first.1), second.0, grid.text(second.1))
}
