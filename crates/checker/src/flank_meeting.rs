//! How far apart two flanks keep each other, a gap between them.
//!
//! Any height of the one and any height of the other that is at most the gap away make a floor of it: both reaches, and what
//! of the gap is left along the strip, √(gap² − difference²). The largest such sum lies where both slopes and that of the
//! gap's circle agree, or at ends of flanks; every such pair of heights is tried. Cost: constant.

use crate::exact_sum::two_sum;
use crate::flank::{Flank, Slopes};

/// Roundings of a difference of heights that are added to it.
const APART_ROUNDINGS: f64 = 2.0;

/// Roundings that are taken off what is left of the gap along the strip.
const ALONG_ROUNDINGS: f64 = 4.0;

/// The largest sum of reaches of `one` and `other` and the gap between them; none: no heights are near enough.
pub(crate) fn meeting(one: &Flank, other: &Flank, gap: f64) -> Option<f64> {
    if one.low - other.high > gap || other.low - one.high > gap {
        return None;
    }
    let mut best: Option<f64> = None;
    for a in one.slopes() {
        for b in other.slopes() {
            let Some((y, z)) = heights(a, b, gap) else { continue };
            let (y, z) = (y.clamp(one.low, one.high), z.clamp(other.low, other.high));
            // The end of a flank stays where it is; the other one comes as near as it has to.
            let (y, z) = match a {
                Slopes::Round { radius: 0.0, .. } => (y, within(z, y, gap).clamp(other.low, other.high)),
                _ => (within(y, z, gap).clamp(one.low, one.high), z),
            };
            let Some(along) = along(y, z, gap) else { continue };
            let sum = one.reach(y) + other.reach(z) + along;
            best = Some(best.map_or(sum, |best| best.max(sum)));
        }
    }
    best
}

/// The height nearest to `y` that is at most the gap away from `fixed`.
fn within(y: f64, fixed: f64, gap: f64) -> f64 {
    let near = y.clamp(fixed - gap, fixed + gap);
    if is_within(near, fixed, gap) {
        near
    } else if near < fixed {
        near.next_up()
    } else {
        near.next_down()
    }
}

/// Whether two heights are at most the gap apart: as numbers, not as their difference is rounded.
fn is_within(y: f64, z: f64, gap: f64) -> bool {
    let (low, high) = if y <= z { (y, z) } else { (z, y) };
    let (apart, more) = two_sum(high, -low);
    // Rounding keeps the order, so only a difference that looks like the gap may exceed it.
    apart < gap || (apart == gap && more <= 0.0)
}

/// Where the slopes of both agree with the gap's.
fn heights(a: Slopes, b: Slopes, gap: f64) -> Option<(f64, f64)> {
    match (a, b) {
        (Slopes::Round { center: p, radius: 0.0 }, Slopes::Round { center: q, radius: 0.0 }) => Some((p, q)),
        (Slopes::Round { center: p, radius: r }, Slopes::Round { center: q, radius: t }) => {
            let whole = gap + r + t;
            let s = if whole == 0.0 { return None } else { (p - q) / whole };
            (s.abs() <= 1.0).then_some((p - r * s, q + t * s))
        }
        // Where `a` has slope s, `b` has −s, and `a` lies gap · s higher.
        (Slopes::Straight { s }, Slopes::Round { center, radius }) => {
            let z = center + radius * s;
            Some((z + gap * s, z))
        }
        (Slopes::Round { center, radius }, Slopes::Straight { s }) => {
            let y = center + radius * s;
            Some((y, y + gap * s))
        }
        // Parallel: an end of either is as good.
        (Slopes::Straight { .. }, Slopes::Straight { .. }) => None,
    }
}

/// What of the gap is left along the strip between two heights, not more than that; none: they are farther apart.
fn along(y: f64, z: f64, gap: f64) -> Option<f64> {
    if !is_within(y, z, gap) {
        return None;
    }
    let apart = (y - z).abs() * (1.0 + APART_ROUNDINGS * f64::EPSILON);
    Some(((gap - apart) * (gap + apart)).max(0.0).sqrt() * (1.0 - ALONG_ROUNDINGS * f64::EPSILON))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::Curve;
    use proptest::prelude::*;
    use traverse_geometry::Point;

    fn curve() -> impl Strategy<Value = Curve> {
        let coordinate = || prop_oneof![-10.0..10.0_f64, (-3..4).prop_map(|whole| f64::from(whole) * 2.0)];
        let bulge = prop_oneof![Just(0.0), Just(1.0), Just(-1.0), -1.0..1.0_f64];
        (coordinate(), coordinate(), coordinate(), coordinate(), bulge).prop_map(|(ax, ay, bx, by, bulge)| {
            Curve::from_bulge(Point::new(ax, ay), Point::new(bx, by), bulge)
        })
    }

    fn flanks(curve: &Curve) -> Vec<Flank> {
        let mut flanks = Vec::new();
        Flank::each(curve, |flank| flanks.push(flank));
        flanks
    }

    fn found(one: &Curve, other: &Curve, gap: f64) -> Option<f64> {
        let (ours, theirs) = (flanks(one), flanks(other));
        let pairs = ours.iter().flat_map(|a| theirs.iter().map(move |b| (a, b)));
        pairs.filter_map(|(a, b)| meeting(a, b, gap)).reduce(f64::max)
    }

    proptest! {
        #[test]
        fn no_two_points_keep_farther_apart(one in curve(), other in curve(), gap in 0.1..6.0_f64) {
            const COUNT: i32 = 400;
            let points = |curve: &Curve| -> Vec<Point> {
                (0..=COUNT).map(|i| curve.point_at(f64::from(i) / f64::from(COUNT))).collect()
            };
            let (ours, theirs) = (points(&one), points(&other));
            let mut sampled = f64::NEG_INFINITY;
            for p in &ours {
                for q in &theirs {
                    let apart = p.y - q.y;
                    if apart.abs() < gap {
                        sampled = sampled.max(p.x + q.x + (gap * gap - apart * apart).sqrt());
                    }
                }
            }
            match found(&one, &other, gap) {
                None => prop_assert!(sampled == f64::NEG_INFINITY),
                // No sample is better, and the best of them is not far below: what is found is a pair of points.
                Some(sum) => {
                    prop_assert!(sum >= sampled - 1e-9, "{sum} below {sampled}");
                    let spacing = (one.length() + other.length()) / f64::from(COUNT);
                    let steep = (2.0 * gap * spacing).sqrt();
                    prop_assert!(sum <= sampled + 2.0 * spacing + steep, "{sum} above {sampled}");
                }
            }
        }

        #[test]
        fn without_a_gap_only_common_heights_count(one in curve(), other in curve()) {
            let mut sampled = f64::NEG_INFINITY;
            let (low, high) = (
                one.bounds().min.y.max(other.bounds().min.y),
                one.bounds().max.y.min(other.bounds().max.y),
            );
            let furthest = |curve: &Curve, y: f64| {
                let there = flanks(curve).into_iter().filter(|flank| flank.low <= y && y <= flank.high);
                there.map(|flank| flank.reach(y)).reduce(f64::max)
            };
            for i in 0..=500 {
                let y = low + (high - low) * f64::from(i) / 500.0;
                if low <= high && let Some((p, q)) = furthest(&one, y).zip(furthest(&other, y)) {
                    sampled = sampled.max(p + q);
                }
            }
            // Close to the top or bottom of an arc, reaches and heights are known to rounding only.
            let found = found(&one, &other, 0.0).unwrap_or(f64::NEG_INFINITY);
            prop_assert!(found >= sampled - 1e-5, "{found} below {sampled}");
            let most = one.bounds().max.x + other.bounds().max.x;
            prop_assert!(found <= most + 1e-12);
        }
    }

    #[test]
    fn discs_stand_apart_by_radii_and_gap() {
        let disc = |y: f64| Curve::from_bulge(Point::new(-5.0, y), Point::new(5.0, y), -1.0);
        let under = |y: f64| Curve::from_bulge(Point::new(-5.0, y), Point::new(5.0, y), 1.0);
        // Centres 6 higher, 12 apart in all with a gap of 2: √(12² − 6²).
        let whole = found(&disc(0.0), &under(6.0), 2.0).expect("they share heights");
        assert!((whole - 108.0_f64.sqrt()).abs() < 1e-12, "{whole}");
        assert!(whole <= 108.0_f64.sqrt());
    }
}
