//! Layouts that touch, one section shifted into another by ten tolerances: refused, every time.
//!
//! Sections touch with a normal that leans: what is shifted along the strip comes nearer by the share of the shift
//! that the normal takes. The shift is ten tolerances along the normal.

use crate::making::*;
use proptest::prelude::*;
use traverse_geometry::PlacedSection;

/// Moves the second section left until the check refuses; by halving, to a hundredth of a tolerance.
fn touching(layout: &traverse_geometry::SectionLayout, widest: f64) -> f64 {
    let is_sound = |x: f64| {
        let found = check(layout, &[at(0, 0.0), at(1, x)]);
        found.smallest_margin_mm.is_none_or(|margin| margin >= 0.0)
    };
    let (mut refused, mut sound) = (0.0, widest);
    for _ in 0..60 {
        let middle = f64::midpoint(refused, sound);
        if is_sound(middle) { sound = middle } else { refused = middle }
    }
    sound
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]
    #[test]
    fn shifted_by_ten_tolerances_is_refused(
        lean in -12.0..12.0_f64,
        corner in 2.0..18.0_f64,
        reach in 1.0..9.0_f64,
        bulge in prop_oneof![Just(0.0), 0.05..0.9_f64],
        gap in prop_oneof![Just(0.0), 0.1..3.0_f64],
    ) {
        // A leaning right edge, and a nose that comes to it.
        let left = part("a", &[0.0, 0.0, 30.0 + lean, 0.0, 30.0 - lean, 20.0, 0.0, 20.0], &[0.0, bulge * 0.3, 0.0, 0.0]);
        let nose = part("b", &[0.0, corner, reach, 0.0, 40.0, 0.0, 40.0, 20.0, reach, 20.0], &[]);
        let mut layout = layout(vec![section("left", vec![left]), section("right", vec![nose])]);
        layout.gap_mm = gap;
        let x = touching(&layout, 90.0);
        let order = |x: f64| -> [PlacedSection; 2] { [at(0, 0.0), at(1, x)] };
        prop_assert!(check(&layout, &order(x)).is_sound());
        // The edge leans by at most 24 in 20, arcs a little more: the normal takes at least 0.4 of a shift along x.
        prop_assert!(!check(&layout, &order(x - 10.0 * TOLERANCE / 0.4)).is_sound());
        prop_assert!(check(&layout, &order(x + 10.0 * TOLERANCE)).is_sound());
    }
}

#[test]
fn straight_edges_shifted_by_ten_tolerances_are_refused_at_every_count_of_sections() {
    let boxes = |count: usize| {
        let of = |i: usize| section(&format!("s{i}"), vec![rectangle("p", 0.0, 0.0, 10.0, 5.0)]);
        layout((0..count).map(of).collect())
    };
    for count in 2..9 {
        let layout = boxes(count);
        let order: Vec<PlacedSection> = (0..count).map(|i| at(i, 10.0 * i as f64)).collect();
        assert!(check(&layout, &order).is_sound());
        for shifted in 1..count {
            let mut order = order.clone();
            order[shifted].x_mm -= 10.0 * TOLERANCE;
            assert!(!check(&layout, &order).is_sound(), "{shifted} of {count}");
        }
    }
}
