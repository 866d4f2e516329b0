//! Sections with ragged sides, made by chance.

use rand::RngExt;
use traverse_geometry::{Part, Point, Polygon, Pose, Ring, Section, SectionLayout};
use traverse_solve::Seed;

/// A layout of `count` sections of `vertices` vertices each, 1000 mm high and about 500 mm wide; each side is a chain of
/// half of them, up to 100 mm deep.
pub(crate) fn layout(count: usize, vertices: usize, seed: u64) -> SectionLayout {
    let mut chance = Seed(seed).stream();
    let half = (vertices / 2).max(2);
    let mut section = |number: usize| {
        let mut xy = vec![];
        for (base, upwards) in [(500.0, true), (0.0, false)] {
            for step in 0..half {
                let y = 1000.0 * step as f64 / (half - 1) as f64;
                xy.extend([base + chance.random_range(0.0..100.0), if upwards { y } else { 1000.0 - y }]);
            }
        }
        let ring = Ring::from_xy(&xy, &[]).expect("a chain up and a chain down never cross");
        let part = Part {
            id: "part".into(),
            shape: Polygon::from_ring(ring),
            pole: Point::origin(),
            rotation_rad: 0.0,
            mirrored: false,
        };
        Section { id: number.to_string(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
    };
    SectionLayout::new((0..count).map(&mut section).collect())
}
