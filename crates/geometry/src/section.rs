//! Sections of a cutting layout and how they may be placed: the question that layout sequencing and checker share.

use crate::{Bounds, Motion, Point, Polygon, Vector};

/// Parts that are laid out together and stay together: a block of a cutting layout.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Unique in the question.
    pub id: String,
    /// At least one.
    pub parts: Vec<Part>,
    /// How many copies the layout holds, at least 1.
    pub quantity: u32,
    /// How it may be turned: at least one pose, each once.
    pub poses: Vec<Pose>,
}

/// One piece of material, where it lies in its section.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Unique in its section.
    pub id: String,
    /// In the part's own coordinates.
    pub shape: Polygon,
    /// Where the part's own origin (its pole) lies in the section.
    pub pole: Point,
    /// How it is turned about its pole, counter-clockwise, after the mirror.
    pub rotation_rad: f64,
    /// Whether its own x becomes −x first.
    pub mirrored: bool,
}

/// How a whole section is turned, about the centre of its own bounding box.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Pose {
    /// As it was sent.
    #[default]
    AsIs,
    /// Turned by half a turn.
    HalfTurn,
    /// Left and right swapped.
    MirrorX,
    /// Top and bottom swapped.
    MirrorY,
}

/// How far a section slides left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SlideRule {
    /// Against all earlier sections, and not past the left edge of the one before it: sections can be cut one after
    /// another along the material.
    #[default]
    KeepOrder,
    /// Against all earlier sections and the start of the strip: may tuck in further left.
    Free,
}

/// What is to be laid out, and by which rules.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionLayout {
    /// At least one.
    pub sections: Vec<Section>,
    /// True distance kept between parts of different sections, millimetres, not negative.
    pub gap_mm: f64,
    /// Height of the strip, millimetres: sections must not be higher. Absent: not checked.
    pub strip_height_mm: Option<f64>,
    /// One copy of this section comes first.
    pub first: Option<usize>,
    /// One copy of this section comes last.
    pub last: Option<usize>,
    /// Pairs (before, after): all copies of one come before all copies of the other.
    pub precedences: Vec<(usize, usize)>,
    /// Pairs (left, right) that must not be neighbours in this order.
    pub forbidden_joins: Vec<(usize, usize)>,
    /// How far sections slide left.
    pub slide_rule: SlideRule,
}

impl SectionLayout {
    /// A layout of these sections without a gap, rules for their order, or a strip: each slides as far as the order is kept.
    #[must_use]
    pub fn new(sections: Vec<Section>) -> Self {
        Self {
            sections,
            gap_mm: 0.0,
            strip_height_mm: None,
            first: None,
            last: None,
            precedences: Vec::new(),
            forbidden_joins: Vec::new(),
            slide_rule: SlideRule::KeepOrder,
        }
    }
}

/// One copy of a section in a layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedSection {
    /// Which section.
    pub section: usize,
    /// Which of its copies, from 0.
    pub copy: u32,
    /// How it is turned.
    pub pose: Pose,
    /// Left edge of the posed section's bounding box, millimetres. Its y stays as it was sent.
    pub x_mm: f64,
}

impl Part {
    /// Where the part lies in its section.
    #[must_use]
    pub fn motion(&self) -> Motion {
        let mirror = if self.mirrored { Motion::mirror_x() } else { Motion::IDENTITY };
        let turned = quarter_turns(self.rotation_rad)
            .map_or_else(|| Motion::rotation(self.rotation_rad), Motion::quarter_turns);
        mirror.then(&turned).then(&Motion::translation(self.pole.coords))
    }

    /// The part's shape where it lies in its section.
    #[must_use]
    pub fn in_section(&self) -> Polygon {
        self.shape.moved(&self.motion())
    }
}

/// The count of quarter turns that the angle is, as exactly as a double says it.
fn quarter_turns(angle: f64) -> Option<i32> {
    let turns = angle / std::f64::consts::FRAC_PI_2;
    (turns.fract() == 0.0 && turns.abs() < 1e9).then_some(turns as i32)
}

impl Section {
    /// The bounding box of all parts in the section's own coordinates. Cost: linear.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let boxes = self.parts.iter().map(|part| part.in_section().bounds());
        boxes.fold(Bounds::EMPTY, Bounds::union)
    }
}

impl Pose {
    /// Every pose.
    pub const ALL: [Self; 4] = [Self::AsIs, Self::HalfTurn, Self::MirrorX, Self::MirrorY];

    /// The motion of a section whose bounding box is `bounds`: turned about its centre. The box stays where it is, up
    /// to rounding.
    #[must_use]
    pub fn motion(self, bounds: &Bounds) -> Motion {
        let turn = match self {
            Self::AsIs => return Motion::IDENTITY,
            Self::HalfTurn => Motion::quarter_turns(2),
            Self::MirrorX => Motion::mirror_x(),
            Self::MirrorY => Motion::mirror_x().then(&Motion::quarter_turns(2)),
        };
        turn.about(bounds.center())
    }
}

impl PlacedSection {
    /// The motion from the coordinates of its section, whose bounding box is `bounds`, to the layout.
    #[must_use]
    pub fn motion(&self, bounds: &Bounds) -> Motion {
        let along = Vector::new(self.x_mm - bounds.min.x, 0.0);
        self.pose.motion(bounds).then(&Motion::translation(along))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Ring;

    fn wedge() -> Polygon {
        Polygon::from_ring(Ring::from_xy(&[0.0, 0.0, 4.0, 0.0, 4.0, 2.0], &[]).unwrap())
    }

    #[test]
    fn poses_turn_about_the_centre_of_the_box() {
        let bounds = wedge().bounds();
        let corner = Point::new(4.0, 2.0);
        let to = |pose: Pose| pose.motion(&bounds).point(corner);
        assert_eq!(
            Pose::ALL.map(to),
            [(4.0, 2.0), (0.0, 0.0), (0.0, 2.0), (4.0, 0.0)].map(|(x, y)| Point::new(x, y))
        );
    }

    #[test]
    fn a_part_is_mirrored_turned_and_moved_in_this_order() {
        let part = Part {
            id: "wedge".into(),
            shape: wedge(),
            pole: Point::new(10.0, 20.0),
            rotation_rad: std::f64::consts::FRAC_PI_2,
            mirrored: true,
        };
        assert_eq!(part.motion().point(Point::new(4.0, 2.0)), Point::new(8.0, 16.0));
        let section = Section { id: "s".into(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] };
        assert_eq!(section.bounds(), Bounds { min: Point::new(8.0, 16.0), max: Point::new(10.0, 20.0) });
    }
}
