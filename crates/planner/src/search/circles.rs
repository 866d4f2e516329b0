//! Features that lie on the same circle: a path passes from one to the other without a straight move.

use crate::barrier::Feature;
use rustc_hash::FxHashMap;
use traverse_geometry::{CONTACT_TOLERANCE_MM, Point, Vector};

/// Which features have their centres where. Adding and asking cost constant time.
#[derive(Default)]
pub(crate) struct Circles {
    /// The last feature of each millimetre square that a centre lies in, and for every feature the one before it in
    /// its square.
    last_in: FxHashMap<[i32; 2], u32>,
    before_in_square: Vec<Option<u32>>,
}

impl Circles {
    /// Adds the next feature.
    pub(crate) fn push(&mut self, feature: &Feature) {
        let before = self.last_in.insert(square_of(feature.center), self.before_in_square.len() as u32);
        self.before_in_square.push(before);
    }

    /// Features with centres near that of `feature`, itself among them.
    pub(crate) fn near(&self, feature: &Feature) -> impl Iterator<Item = u32> {
        let squares = squares_near(feature.center);
        let last = squares.into_iter().flatten().filter_map(|square| self.last_in.get(&square).copied());
        last.flat_map(|last| {
            std::iter::successors(Some(last), |&other| self.before_in_square[other as usize])
        })
    }
}

/// Whether two features lie on the same circle.
pub(crate) fn is_same_circle(a: &Feature, b: &Feature) -> bool {
    a.plan_radius > 0.0
        && (a.plan_radius - b.plan_radius).abs() < CONTACT_TOLERANCE_MM / 2.0
        && (a.center - b.center).norm() < CONTACT_TOLERANCE_MM / 2.0
}

/// The millimetre square of a point. What lies beyond two million metres shares the outermost ones.
fn square_of(p: Point) -> [i32; 2] {
    // A cast from a float saturates.
    [p.x.floor() as i32, p.y.floor() as i32]
}

/// The squares in which a centre within half a contact tolerance of `center` may lie, each once.
fn squares_near(center: Point) -> [Option<[i32; 2]>; 4] {
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
