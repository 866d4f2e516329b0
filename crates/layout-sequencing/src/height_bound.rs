//! Bounds that hold for both slide rules: no layout is shorter than its widest section, and at any height the sections
//! that reach it stand side by side there, so that their thicknesses add up, with a gap between each two.
//!
//! A section that slides left is stopped before it passes another at a height that both have. The area of all sections
//! over the height of the strip is the mean of those sums, and so never above the largest; only where poses turn
//! sections upside down can it be.

use crate::certificate::BoundCertificate;
use crate::instance::Instance;
use traverse_solve::{Budget, Interrupt};

/// Heights that are looked at, evenly spread.
const HEIGHTS: usize = 256;

/// The best of these bounds, with what proves it.
pub(crate) fn height_bound(
    instance: &Instance,
    budget: &Budget,
) -> Result<(i64, BoundCertificate), Interrupt> {
    let widest = instance.kinds.iter().max_by_key(|kind| instance.items[kind.items.start].width);
    let mut best = widest.map_or((0, BoundCertificate::None), |kind| {
        (instance.items[kind.items.start].width, BoundCertificate::Width { section: kind.section })
    });
    for y in heights(instance, HEIGHTS) {
        budget.check(0)?;
        let sum = (0..instance.kinds.len())
            .map(|kind| least_thickness(instance, kind, y).unwrap_or(0) * instance.quantity(kind) as i64);
        let length = sum.sum::<i64>() - instance.grid.down(instance.gap);
        if length > best.0 {
            best = (length, BoundCertificate::Height { y_mm: y });
        }
    }
    Ok(best)
}

/// Heights spread evenly over the layout.
pub(crate) fn heights(instance: &Instance, count: usize) -> Vec<f64> {
    let spans = || instance.items.iter().filter_map(|item| item.profile.left.heights());
    let low = spans().map(|span| span.0).fold(f64::INFINITY, f64::min);
    let high = spans().map(|span| span.1).fold(f64::NEG_INFINITY, f64::max);
    (0..count).map(|at| low + (high - low) * (at as f64 + 0.5) / count as f64).collect()
}

/// The least thickness of a kind at a height in its poses, and a gap; nothing when a pose leaves the height free.
pub(crate) fn least_thickness(instance: &Instance, kind: usize, y: f64) -> Option<i64> {
    let thickness = |item: usize| instance.items[item].profile.thickness(y);
    let gap = instance.grid.down(instance.gap);
    let all: Option<Vec<f64>> = instance.kinds[kind].items.clone().map(thickness).collect();
    all?.into_iter().map(|thickness| instance.grid.down(thickness) + gap).min()
}
