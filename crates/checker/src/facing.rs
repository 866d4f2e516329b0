//! A section in a pose as it is seen from one side: its borders turned so that what it reaches with is x.
//!
//! Heights are those that the pose's motion gives, rounded as it rounds: a layout that stands is checked at the same ones.

use crate::curve::Curve;
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
        let motion = pose.motion(&bounds);
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
            Point::new(x, motion.point(p).y)
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
                Flank::each(&Curve::from_bulge(a, b, bulge), &mut show);
            }
        }
        Some(())
    }
}
