//! Layouts of chance against an oracle without trees: intervals of every part at very many heights, and distances of
//! very many points.

use crate::making::*;
use proptest::prelude::*;
use traverse_geometry::{Edge, Part, Point, Polygon};

/// A star-shaped part round the origin, some of its edges arcs.
fn star() -> impl Strategy<Value = Part> {
    proptest::collection::vec((4.0..20.0_f64, -0.4..0.4_f64, any::<bool>()), 4..9).prop_filter_map(
        "edges must not cross",
        |spokes| {
            let count = spokes.len() as f64;
            let (mut xy, mut bulges) = (Vec::new(), Vec::new());
            for (i, &(radius, bulge, is_arc)) in spokes.iter().enumerate() {
                let angle = std::f64::consts::TAU * i as f64 / count;
                xy.extend([radius * angle.cos(), radius * angle.sin()]);
                bulges.push(if is_arc { bulge } else { 0.0 });
            }
            let ring = traverse_geometry::Ring::from_xy(&xy, &bulges).ok()?;
            Some(Part {
                id: "star".into(),
                shape: Polygon::from_ring(ring),
                pole: Point::origin(),
                rotation_rad: 0.0,
                mirrored: false,
            })
        },
    )
}

fn placed(part: &Part, by: traverse_geometry::Vector) -> Polygon {
    part.in_section().moved(&traverse_geometry::Motion::translation(by))
}

fn sampled(edges: impl Iterator<Item = Edge>) -> Vec<Point> {
    edges.flat_map(|edge| (0..40).map(move |i| edge.point_at(f64::from(i) / 40.0))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]
    #[test]
    fn two_parts_of_chance_are_judged_as_samples_say(one in star(), other in star(), x in 0.0..45.0_f64, gap in prop_oneof![Just(0.0), 0.0..4.0_f64]) {
        let mut layout = layout(vec![section("a", vec![one.clone()]), section("b", vec![other.clone()])]);
        layout.gap_mm = gap;
        let found = check(&layout, &[at(0, 0.0), at(1, x)]);
        let shift = |part: &Part, x: f64| {
            placed(part, traverse_geometry::Vector::new(x - part.in_section().bounds().min.x, 0.0))
        };
        let (a, b) = (shift(&one, 0.0), shift(&other, x));
        let into = |from: &Polygon, to: &Polygon| {
            sampled(from.outer().edges())
                .into_iter()
                .map(|p| match to.locate(p) {
                    traverse_geometry::Location::Inside => -to.distance_to_border(p),
                    _ => to.distance_to_border(p),
                })
                .fold(f64::INFINITY, f64::min)
        };
        let sampled_margin = into(&a, &b).min(into(&b, &a)) - gap;
        let margin = found.smallest_margin_mm.expect("two sections");
        if sampled_margin > -gap {
            // Apart, or only just not: samples are up to half a step of an edge beside the worst place.
            prop_assert!(margin <= sampled_margin + 1e-9, "{margin} above {sampled_margin}");
            prop_assert!(margin >= sampled_margin - 1.6, "{margin} far below {sampled_margin}");
        } else {
            // Depth is measured at corners and a few places of each edge.
            let (depth, sampled) = (-margin - gap, -sampled_margin - gap);
            prop_assert!(depth >= 0.6 * sampled.max(TOLERANCE), "{depth} deep, and {sampled} at a sample");
        }
        prop_assert_eq!(found.is_sound(), margin >= -TOLERANCE);
    }
}
