//! A simple block builder: sections out of a part set, as a nesting program would hand them over.
//!
//! Pieces are taken in an order drawn by the seed. A block is filled column by column: each column from the bottom up with
//! the first piece of those left that still fits under the strip's height, the gap kept between bounding boxes; a piece stands as far
//! left as the boxes of the columns before it let it. When nothing fits any more, or the block has its columns, the
//! next block begins. So blocks are as high as the pieces allow, their sides are as ragged as the pieces are, and no two
//! pieces of a block overlap. Equal arguments give equal blocks. Cost: for each piece of a block, the pieces left.

use super::from_drawing::at_pole;
use super::part_set::{PartSet, PartSetError, Piece};
use traverse_geometry::{Bounds, Motion, Part, Point, Polygon, Pose, Section, Vector};

/// How blocks are built.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockRules {
    /// Columns of a block, at least 1. Default: 2.
    pub columns: usize,
    /// How many blocks; the demand begins anew when it is used up. Absent: as many as the demand fills.
    pub count: Option<usize>,
    /// Kept between bounding boxes of pieces in a block, millimetres. Default: 0.
    pub gap_mm: f64,
    /// Draws the order of the pieces and their turns. Default: 0.
    pub seed: u64,
    /// How each block may be turned. Default: as is.
    pub poses: Vec<Pose>,
}

impl Default for BlockRules {
    fn default() -> Self {
        Self { columns: 2, count: None, gap_mm: 0.0, seed: 0, poses: vec![Pose::AsIs] }
    }
}

/// Builds blocks of the strip's height out of the pieces: `block-1`, `block-2`, …
///
/// # Errors
/// A piece that is higher than the strip in every orientation that it may have.
pub fn build_blocks(set: &PartSet, rules: &BlockRules) -> Result<Vec<Section>, PartSetError> {
    let fitting: Vec<Vec<Polygon>> =
        set.pieces.iter().map(|piece| turns(piece, set.strip_height_mm)).collect::<Result<_, _>>()?;
    let mut chance = Chance(rules.seed);
    let mut left: Vec<Turned<'_>> = Vec::new();
    let mut blocks = Vec::new();
    while rules.count.is_none_or(|count| blocks.len() < count) {
        if left.is_empty() {
            if rules.count.is_none() && !blocks.is_empty() {
                break;
            }
            left = all_pieces(set, &fitting, &mut chance);
        }
        let parts = block(&mut left, set.strip_height_mm, rules);
        blocks.push(Section {
            id: format!("block-{}", blocks.len() + 1),
            parts,
            quantity: 1,
            poses: rules.poses.clone(),
        });
    }
    Ok(blocks)
}

/// A piece in one of its orientations, the lower left corner of its box at the origin.
struct Turned<'a> {
    id: String,
    shape: &'a Polygon,
}

/// The orientations in which a piece is no higher than the strip; of a free piece, quarter turns.
fn turns(piece: &Piece, strip_height_mm: f64) -> Result<Vec<Polygon>, PartSetError> {
    const QUARTERS: [f64; 4] = [0.0, 90.0, 180.0, 270.0];
    let angles = piece.orientations_deg.as_deref().unwrap_or(&QUARTERS);
    let turned = |&angle: &f64| {
        let quarters = angle / 90.0;
        let motion = match quarters.fract() == 0.0 && quarters.abs() < 1e6 {
            true => Motion::quarter_turns(quarters as i32),
            false => Motion::rotation(angle.to_radians()),
        };
        let shape = piece.shape.moved(&motion);
        shape.moved(&Motion::translation(-shape.bounds().min.coords))
    };
    let fits = |shape: &Polygon| shape.bounds().size().y <= strip_height_mm;
    let fitting: Vec<Polygon> = angles.iter().map(turned).filter(fits).collect();
    if fitting.is_empty() {
        let message = format!(
            "piece {} is higher than the strip ({strip_height_mm}) however it may be turned; leave it out or make the \
             strip higher",
            piece.id
        );
        return Err(PartSetError::Value { field: "strip_height".to_owned(), message });
    }
    Ok(fitting)
}

/// Every piece as often as it is wanted, in an order of chance, turned by chance.
fn all_pieces<'a>(set: &PartSet, fitting: &'a [Vec<Polygon>], chance: &mut Chance) -> Vec<Turned<'a>> {
    let mut all = Vec::new();
    for (piece, shapes) in set.pieces.iter().zip(fitting) {
        for copy in 0..piece.demand {
            let shape = &shapes[chance.below(shapes.len())];
            all.push(Turned { id: format!("{}.{}", piece.id, copy + 1), shape });
        }
    }
    for last in (1..all.len()).rev() {
        all.swap(last, chance.below(last + 1));
    }
    all
}

/// Takes the pieces of one block out of `left`.
fn block(left: &mut Vec<Turned<'_>>, strip_height_mm: f64, rules: &BlockRules) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    let mut boxes: Vec<Bounds> = Vec::new();
    for _ in 0..rules.columns.max(1) {
        let earlier = boxes.len();
        let mut floor = 0.0;
        loop {
            let fits = |piece: &Turned<'_>| floor + piece.shape.bounds().size().y <= strip_height_mm;
            let Some(next) = left.iter().position(fits) else { break };
            let piece = left.remove(next);
            let size = piece.shape.bounds().size();
            let at =
                |x: f64| Bounds { min: Point::new(x, floor), max: Point::new(x + size.x, floor + size.y) };
            let shares_heights = |other: &&Bounds| {
                other.min.y - rules.gap_mm < floor + size.y && floor - rules.gap_mm < other.max.y
            };
            let x = boxes[..earlier].iter().filter(shares_heights).map(|other| other.max.x + rules.gap_mm);
            let x = x.fold(0.0, f64::max);
            let placed = piece.shape.moved(&Motion::translation(Vector::new(x, floor)));
            parts.push(at_pole(piece.id, &placed));
            boxes.push(at(x));
            floor += size.y + rules.gap_mm;
        }
    }
    parts
}

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Chance(u64);

impl Chance {
    /// A number below `count`, which is not 0.
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        // The high bits of the product: as good as even for counts far below 2^64.
        ((u128::from(z) * count as u128) >> 64) as usize
    }
}
