//! Where on an edge two ways cost least together, by a measure whose gradient is the same for all directions between its
//! kinks: exactly, in closed form.
//!
//! As long as the last tangents of both ways keep between kinks, their sum grows by one constant vector G per millimetre
//! ([`super::way`]). So along a straight edge it is linear between the places that tangents along kinks lead to, and
//! lowest in one of them. Along an arc it is a linear function on a circle in between, highest and lowest where the
//! outward direction is that of G or against it. Cut in all of these places, an edge has parts on which the sum only grows
//! or only falls, and every place at which it is lowest is among the cuts.
//!
//! Norms like this are not strict: a whole stretch may cost the same, and what of it is free is known later. So of several
//! neighbouring cuts that cost the same each is a place; where one is blocked, or a way would have to turn back to it, the
//! next stands in.
//!
//! Cost: some 10 to 60 evaluations.

use super::detour::{Detour, Part};
use super::way::{fraction_of, kinks_on};
use crate::measure::Measure;
use traverse_geometry::{Arc, Edge};

/// Costs that differ by less than this share are equal: rounding.
const EQUAL_RATIO: f64 = 1e-12;

impl<M: Measure> Detour<'_, M> {
    /// Every place between two fractions than which none near it costs less.
    pub(super) fn lowest_between_kinks(&self, from: f64, to: f64) -> Vec<Part> {
        let mut cuts = vec![from, to];
        kinks_on(self.measure, self.before, self.edge, &mut cuts);
        kinks_on(self.measure, self.after, self.edge, &mut cuts);
        let sort = |cuts: &mut Vec<f64>| {
            cuts.retain(|&cut| from <= cut && cut <= to);
            cuts.sort_by(f64::total_cmp);
            cuts.dedup();
        };
        sort(&mut cuts);
        if let Edge::Arc(arc) = self.edge {
            let parts = cuts.windows(2).map(|pair| f64::midpoint(pair[0], pair[1]));
            let turns: Vec<f64> = parts.filter_map(|at| self.turns(arc, at)).flatten().collect();
            cuts.extend(turns);
            sort(&mut cuts);
        }
        let cost = |&at: &f64| self.ways(at).map(|[before, after]| (at, before.cost + after.cost));
        let known: Vec<(f64, f64)> = cuts.iter().filter_map(cost).collect();
        let is_lowest = |&(i, &(_, cost)): &(usize, &(f64, f64))| {
            let beside = [i.checked_sub(1), Some(i + 1)];
            let costs = beside.into_iter().flatten().filter_map(|i| known.get(i));
            costs.into_iter().all(|&(_, other)| cost <= other * (1.0 + EQUAL_RATIO))
        };
        let lowest = known.iter().enumerate().filter(is_lowest);
        lowest.map(|(_, &(at, cost))| Part::Lowest(self.edge.point_at(at), cost)).collect()
    }

    /// Where a sum that grows on all of an arc as it does at a fraction is highest and lowest.
    fn turns(&self, arc: &Arc, at: f64) -> Option<[f64; 2]> {
        let [before, after] = self.ways(at)?;
        let grows = (before.gradient + after.gradient).try_normalize(0.0)?;
        Some([grows, -grows].map(|outward| fraction_of(self.edge, arc.center + outward * arc.radius)))
    }
}
