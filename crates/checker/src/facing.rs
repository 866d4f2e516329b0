//! A section in a pose as it is seen from one side: its borders turned so that what it reaches with is x.
//!
//! Heights of what is turned upside down are known up to rounding, and each vertex says by how much: flanks that end there
//! are made shorter by that.

use crate::curve::Curve;
use crate::exact_sum::two_sum;
use crate::flank::Flank;
use crate::strided::Strided;
use traverse_geometry::{Point, Pose, Section};

/// Which way a section looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Facing {
    Right,
    Left,
}

impl Facing {
    /// Shows every flank of `section` in `pose`: how far it reaches beyond the left edge of its box (looking right), or how far
    /// that edge lies from where it begins, as a negative number (looking left). None: given up. Cost: linear, and no memory
    /// but for one part.
    pub(crate) fn flanks(
        self,
        section: &Section,
        pose: Pose,
        go_on: &dyn Fn() -> bool,
        mut show: impl FnMut(Flank),
    ) -> Option<()> {
        let bounds = section.bounds();
        let is_mirrored = matches!(pose, Pose::MirrorX | Pose::HalfTurn);
        let is_upside_down = matches!(pose, Pose::MirrorY | Pose::HalfTurn);
        // Both sides look to the right; what is turned round twice is not turned.
        let turned = is_mirrored != (self == Self::Left);
        let edge = match self {
            Self::Right if is_mirrored => bounds.max.x,
            Self::Right => -bounds.min.x,
            Self::Left if is_mirrored => -bounds.max.x,
            Self::Left => bounds.min.x,
        };
        let place = |p: Point| {
            let x = if turned { edge - p.x } else { p.x + edge };
            let (y, slack) =
                if is_upside_down { upside_down(bounds.min.y, bounds.max.y, p.y) } else { (p.y, 0.0) };
            (Point::new(x, y), slack)
        };
        let mut asked = Strided::new(go_on);
        for part in &section.parts {
            asked.ask()?;
            let shape = part.in_section();
            let (ring, count) = (shape.outer(), shape.outer().len());
            for at in 0..count {
                asked.look()?;
                let (a, b) = (place(ring.vertices()[at]), place(ring.vertices()[(at + 1) % count]));
                let bulge = ring.bulges().get(at).copied().unwrap_or(0.0);
                let bulge = if turned == is_upside_down { bulge } else { -bulge };
                Flank::each(&Curve::from_bulge(a.0, b.0, bulge), [a.1, b.1], &mut show);
            }
        }
        Some(())
    }
}

/// A height turned upside down between `low` and `high`, and by how much rounding may have moved it.
fn upside_down(low: f64, high: f64, y: f64) -> (f64, f64) {
    let (sum, lost) = two_sum(low, high);
    let (rest, lost_again) = two_sum(sum, -y);
    let (small, lost_of_small) = two_sum(lost, lost_again);
    let (height, off) = two_sum(rest, small);
    (height, off.abs() + lost_of_small.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_turned_upside_down_says_how_exact_it_is() {
        // The ends change places, exactly, though their sum is rounded.
        assert_eq!(upside_down(0.1, 0.3, 0.1), (0.3, 0.0));
        assert_eq!(upside_down(0.1, 0.3, 0.3), (0.1, 0.0));
        assert_eq!(upside_down(-5.0, 7.0, 3.0), (-1.0, 0.0));
        let (height, slack) = upside_down(0.1, 1000.0, 0.000_123);
        assert!(slack > 0.0 && slack <= height * f64::EPSILON / 2.0, "{height} {slack}");
    }
}
