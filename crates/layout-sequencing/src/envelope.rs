//! How far right something reaches at each height: pieces of curves, from the lowest height to the highest.
//!
//! The envelope is closed: where pieces meet or end, both values count and the larger one holds. Heights at which there
//! is nothing are left out. Built from runs of curves by merging two at a time: O(n log n) for n pieces in all.

use crate::curve::Curve;

/// A curve over a closed range of heights; a single height is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) curve: Curve,
    /// Whether it does not go on where the piece below it ends: then its lowest point is looked at, too.
    pub(crate) jumps: bool,
}

impl Piece {
    pub(crate) fn new(low: f64, high: f64, curve: Curve) -> Self {
        Self { low, high, curve, jumps: true }
    }
}

/// Pieces whose ends lie this near go on from one to the other, in parts of their x: rounding errors only.
const SAME_X_RATIO: f64 = 1e-14;

/// How far right something reaches at each height.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Envelope {
    /// Ascending; inner heights belong to one piece only, single heights stand between the pieces around them.
    pub(crate) pieces: Vec<Piece>,
}

impl Envelope {
    /// The envelope of runs, each ascending without overlap, and of single heights that may lie anywhere.
    pub(crate) fn of(mut runs: Vec<Vec<Piece>>, points: Vec<Piece>) -> Self {
        while runs.len() > 1 {
            let mut merged = Vec::with_capacity(runs.len().div_ceil(2));
            let mut left = runs.into_iter();
            while let Some(first) = left.next() {
                merged.push(match left.next() {
                    Some(second) => upper(&first, &second),
                    None => first,
                });
            }
            runs = merged;
        }
        let mut envelope = Self { pieces: runs.pop().unwrap_or_default() };
        envelope.insert_points(points);
        envelope.note_jumps();
        envelope
    }

    fn note_jumps(&mut self) {
        let mut before: Option<(f64, f64)> = None;
        for piece in &mut self.pieces {
            let x = piece.curve.x(piece.low);
            piece.jumps = before.is_none_or(|(height, before)| {
                height != piece.low || (before - x).abs() > SAME_X_RATIO * (x.abs() + 1.0)
            });
            before = Some((piece.high, piece.curve.x(piece.high)));
        }
    }

    /// Single heights that reach further than everything else there are pieces of their own.
    fn insert_points(&mut self, mut points: Vec<Piece>) {
        points.retain(|point| self.x(point.low).is_none_or(|x| x < point.curve.x(point.low)));
        if points.is_empty() {
            return;
        }
        points.sort_by(|a, b| a.low.total_cmp(&b.low).then(b.curve.x(b.low).total_cmp(&a.curve.x(a.low))));
        points.dedup_by(|next, kept| next.low == kept.low);
        let mut pieces = Vec::with_capacity(self.pieces.len() + 2 * points.len());
        let mut points = points.into_iter().peekable();
        for mut piece in std::mem::take(&mut self.pieces) {
            while let Some(point) = points.next_if(|point| point.low < piece.high) {
                if point.low > piece.low {
                    pieces.push(Piece { high: point.low, ..piece });
                    piece.low = point.low;
                }
                pieces.push(point);
            }
            pieces.push(piece);
        }
        pieces.extend(points);
        self.pieces = pieces;
    }

    /// How far right it reaches at height y.
    pub(crate) fn x(&self, y: f64) -> Option<f64> {
        let first = self.pieces.partition_point(|piece| piece.high < y);
        let there = self.pieces[first..].iter().take_while(|piece| piece.low <= y);
        there.map(|piece| piece.curve.x(y)).reduce(f64::max)
    }

    /// The same, further right.
    pub(crate) fn shifted(&self, by: f64) -> Self {
        let shifted = |piece: &Piece| Piece { curve: piece.curve.shifted(by), ..*piece };
        Self { pieces: self.pieces.iter().map(shifted).collect() }
    }

    /// The same upside down: what was at y is at `whole` − y.
    pub(crate) fn flipped(&self, whole: f64) -> Self {
        let flipped =
            |piece: &Piece| Piece::new(whole - piece.high, whole - piece.low, piece.curve.flipped(whole));
        let mut envelope = Self { pieces: self.pieces.iter().rev().map(flipped).collect() };
        envelope.note_jumps();
        envelope
    }

    /// The lowest and the highest height; nothing when it is empty.
    pub(crate) fn heights(&self) -> Option<(f64, f64)> {
        Some((self.pieces.first()?.low, self.pieces.last()?.high))
    }
}

/// What of two runs reaches further, as one run.
fn upper(a: &[Piece], b: &[Piece]) -> Vec<Piece> {
    let (Some(first), Some(second)) = (a.first(), b.first()) else {
        return if a.is_empty() { b.to_vec() } else { a.to_vec() };
    };
    let mut merged: Vec<Piece> = Vec::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    let mut y = first.low.min(second.low);
    loop {
        let (own, other) = (a.get(i), b.get(j));
        let end = |piece: Option<&Piece>| {
            piece.map_or(f64::INFINITY, |piece| if piece.low <= y { piece.high } else { piece.low })
        };
        let next = end(own).min(end(other));
        if next == f64::INFINITY {
            return merged;
        }
        match (own.filter(|piece| piece.low <= y), other.filter(|piece| piece.low <= y)) {
            (None, None) => {}
            (Some(only), None) | (None, Some(only)) => append(&mut merged, only.curve, y, next),
            (Some(own), Some(other)) => {
                let mut low = y;
                let cuts = own.curve.crossings(&other.curve, y, next).chain([next]);
                for high in cuts {
                    let middle = low.midpoint(high);
                    let further = own.curve.x(middle) >= other.curve.x(middle);
                    append(&mut merged, if further { own.curve } else { other.curve }, low, high);
                    low = high;
                }
            }
        }
        y = next;
        while a.get(i).is_some_and(|piece| piece.high <= y) {
            i += 1;
        }
        while b.get(j).is_some_and(|piece| piece.high <= y) {
            j += 1;
        }
    }
}

/// Goes on with the last piece when it is the same curve.
fn append(pieces: &mut Vec<Piece>, curve: Curve, low: f64, high: f64) {
    if let Some(last) = pieces.last_mut()
        && last.high == low
        && last.curve == curve
    {
        last.high = high;
    } else if low < high {
        pieces.push(Piece::new(low, high, curve));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::Point;

    fn line(low: f64, high: f64, x_low: f64, x_high: f64) -> Piece {
        Piece::new(low, high, Curve::line(Point::new(x_low, low), Point::new(x_high, high)))
    }

    #[test]
    fn the_further_one_holds_at_every_height() {
        let runs = vec![
            vec![line(0.0, 4.0, 0.0, 4.0), line(4.0, 6.0, 1.0, 1.0)],
            vec![line(1.0, 5.0, 3.0, 3.0)],
            vec![line(8.0, 9.0, 7.0, 7.0)],
        ];
        let point = Piece { low: 2.0, high: 2.0, ..line(2.0, 3.0, 5.0, 5.0) };
        let envelope = Envelope::of(runs, vec![point]);
        for (y, x) in [
            (-1.0, None),
            (0.5, Some(0.5)),
            (1.0, Some(3.0)),
            (2.0, Some(5.0)),
            (2.5, Some(3.0)),
            (3.5, Some(3.5)),
            (4.0, Some(4.0)),
            (4.5, Some(3.0)),
            (5.5, Some(1.0)),
            (7.0, None),
            (9.0, Some(7.0)),
        ] {
            assert_eq!(envelope.x(y), x, "at {y}");
            assert_eq!(envelope.flipped(9.0).shifted(1.0).x(9.0 - y), x.map(|x| x + 1.0), "at {y}");
        }
        assert_eq!(envelope.heights(), Some((0.0, 9.0)));
    }

    #[test]
    fn what_touches_nothing_stays_apart() {
        assert_eq!(Envelope::of(vec![], vec![]).heights(), None);
        let alone = Piece { low: 2.0, high: 2.0, ..line(2.0, 3.0, 5.0, 5.0) };
        assert_eq!(Envelope::of(vec![], vec![alone]).x(2.0), Some(5.0));
    }
}
