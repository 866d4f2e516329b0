//! Where one section that slides left meets another: the largest of how far the left one reaches right and the right
//! one reaches left, together, over all heights that both have. One merge of two envelopes, linear in their pieces.

use crate::envelope::{Envelope, Piece};

/// Where two sections meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Meeting {
    /// From left edge to left edge, millimetres.
    pub(crate) offset: f64,
    /// At which height.
    pub(crate) y: f64,
}

/// Where what stands at x = 0 and reaches right as `right` says stops what slides left and reaches left as `left`
/// says. Nothing when they share no height; one height that both touch is enough.
pub(crate) fn meeting(right: &Envelope, left: &Envelope) -> Option<Meeting> {
    let mut best = Meeting { offset: f64::NEG_INFINITY, y: 0.0 };
    let (stands, slides) = (&right.pieces[..], &left.pieces[..]);
    let (Some(first), Some(other)) = (stands.first(), slides.first()) else { return None };
    // Pieces below the other's lowest are passed at once.
    let mut i = stands.partition_point(|piece| piece.high < other.low);
    let mut j = slides.partition_point(|piece| piece.high < first.low);
    while let (Some(a), Some(b)) = (stands.get(i), slides.get(j)) {
        best.meet(a, b);
        let (a_ends, b_ends) = (a.high <= b.high, b.high <= a.high);
        if a_ends && b_ends {
            // Both end here: what ends and what begins touch crosswise, too.
            if let Some(next) = slides.get(j + 1) {
                best.meet(a, next);
            }
            i += 1;
        } else {
            i += usize::from(a_ends);
            j += usize::from(b_ends);
        }
    }
    (best.offset > f64::NEG_INFINITY).then_some(best)
}

impl Meeting {
    #[inline]
    fn meet(&mut self, a: &Piece, b: &Piece) {
        let (low, high) = (a.low.max(b.low), a.high.min(b.high));
        if low > high {
            return;
        }
        // Where a piece goes on from the one below, its lowest point was looked at as the other's highest.
        if (a.jumps && a.low == low) || (b.jumps && b.low == low) {
            self.at(a, b, low);
        }
        self.at(a, b, high);
        if let Some(y) = a.curve.crest(&b.curve)
            && low < y
            && y < high
        {
            self.at(a, b, y);
        }
    }

    #[inline]
    fn at(&mut self, a: &Piece, b: &Piece, y: f64) {
        let offset = a.curve.x(y) + b.curve.x(y);
        if offset > self.offset {
            *self = Self { offset, y };
        }
    }
}
