//! What prices of joins prove: a path through all copies from the ends of the strip and back pays, for each section that it
//! leaves and enters, what every arc pays at least.
//!
//! With row prices u, column prices v and weights w of sets S such that every arc from i to j costs u_i + v_j + Σ w(S: i in, j out)
//! or more, no layout is shorter than Σ q·u + Σ q·v + Σ w, q being the numbers of copies. Where an arc costs less, the price
//! of its row or its column comes down by what is missing: either makes the prices right, and the better of both counts.

use crate::certificate::JoinPrices;
use crate::exact_sum::ExactSum;
use crate::extent::Extent;
use crate::facing::Facing;
use crate::least_offset::LeastOffset;
use crate::silhouette::Silhouette;
use std::collections::HashSet;
use traverse_geometry::{Pose, Section, SectionLayout};

/// Roundings of the prices of an arc that are added to what they ask.
const ASKED_ROUNDINGS: f64 = 4.0;

/// Roundings of widths and gap that are taken off an offset.
const OFFSET_ROUNDINGS: f64 = 16.0;

/// Edges of boxes from and to which an arc is measured.
const EDGES_OF_ARC: f64 = 2.0;

/// The bound that `prices`, which have no findings, prove of `layout`, millimetres. None: given up.
///
/// Cost: for every two sections, pose by pose, what [`LeastOffset::between`] costs where prices ask for something; and
/// nodes of sets times sections.
pub(crate) fn bound_by_prices(
    layout: &SectionLayout,
    prices: &JoinPrices,
    go_on: &dyn Fn() -> bool,
) -> Option<f64> {
    let ends = layout.sections.len();
    let copies = |node: usize| layout.sections.get(node).map_or(1.0, |section| f64::from(section.quantity));
    let mut arcs = Arcs::of(layout, go_on)?;
    let mut weights = Weights::of(&prices.sets, ends + 1);
    let (mut short_rows, mut short_columns) = (vec![0.0_f64; ends + 1], vec![0.0_f64; ends + 1]);
    for (from, short_row) in short_rows.iter_mut().enumerate() {
        let (left_sets, weight_rounding) = weights.of_row(from, &prices.sets, go_on)?;
        for (to, short_column) in short_columns.iter_mut().enumerate() {
            if !go_on() {
                return None;
            }
            let (row, column, weight) = (prices.rows_mm[from], prices.columns_mm[to], left_sets[to]);
            let rounding = weight_rounding
                + ASKED_ROUNDINGS * f64::EPSILON * (row.abs() + column.abs() + weight.abs())
                + EDGES_OF_ARC * arcs.edge_slack;
            let asked = row + column + weight + rounding;
            // No arc costs less than nothing.
            if asked <= 0.0 || !arcs.is_arc(from, to) {
                continue;
            }
            let short = asked - arcs.cost(from, to, asked)?;
            *short_row = short_row.max(short);
            *short_column = short_column.max(short);
        }
    }
    let bound = |rows: &[f64], columns: &[f64]| {
        let mut sum = ExactSum::default();
        for node in 0..=ends {
            let down = |short: &[f64]| short.get(node).map_or(0.0, |short| -short);
            for price in [prices.rows_mm[node], prices.columns_mm[node], down(rows), down(columns)] {
                sum.add_product(copies(node), price);
            }
        }
        prices.sets.iter().for_each(|(_, weight)| sum.add(*weight));
        sum.at_most()
    };
    Some(bound(&short_rows, &[]).max(bound(&[], &short_columns)).max(0.0))
}

/// What sets ask of the arcs out of one node.
struct Weights {
    /// Sets that hold each node.
    sets_of: Vec<Vec<u32>>,
}

impl Weights {
    fn of(sets: &[(Vec<usize>, f64)], nodes: usize) -> Self {
        let mut sets_of = vec![Vec::new(); nodes];
        for (number, (members, _)) in sets.iter().enumerate() {
            members.iter().for_each(|&node| sets_of[node].push(number as u32));
        }
        Self { sets_of }
    }

    /// The weights of the sets that an arc out of `from` leaves, by the node that it enters, and how much rounding may have
    /// taken from each.
    fn of_row(
        &mut self,
        from: usize,
        sets: &[(Vec<usize>, f64)],
        go_on: &dyn Fn() -> bool,
    ) -> Option<(Vec<f64>, f64)> {
        let own = std::mem::take(&mut self.sets_of[from]);
        let all: f64 = own.iter().map(|&set| sets[set as usize].1).sum();
        let mut left = vec![all; self.sets_of.len()];
        for &set in &own {
            if !go_on() {
                return None;
            }
            let (members, weight) = &sets[set as usize];
            members.iter().for_each(|&node| left[node] -= weight);
        }
        Some((left, 2.0 * f64::EPSILON * all * (own.len() + 1) as f64))
    }
}

/// The arcs between sections and the ends of the strip.
struct Arcs<'a> {
    layout: &'a SectionLayout,
    forbidden: HashSet<(usize, usize)>,
    /// Of each section in each of its poses.
    looking_right: Vec<Vec<Silhouette>>,
    looking_left: Vec<Vec<Silhouette>>,
    widths: Vec<f64>,
    /// By how much the edges may lie off from and to which offsets are measured.
    edge_slack: f64,
    offsets: LeastOffset<'a>,
}

impl<'a> Arcs<'a> {
    fn of(layout: &'a SectionLayout, go_on: &'a dyn Fn() -> bool) -> Option<Self> {
        let all = |facing: Facing| -> Option<Vec<Vec<Silhouette>>> {
            let of = |section: &Section| {
                let in_pose = |&pose: &Pose| Silhouette::of(section, pose, facing, go_on);
                section.poses.iter().map(in_pose).collect()
            };
            layout.sections.iter().map(of).collect()
        };
        let extents: Vec<Extent> =
            layout.sections.iter().map(|section| Extent::of(section, go_on)).collect::<Option<_>>()?;
        Some(Self {
            layout,
            forbidden: layout.forbidden_joins.iter().copied().collect(),
            looking_right: all(Facing::Right)?,
            looking_left: all(Facing::Left)?,
            widths: extents.iter().map(|extent| extent.width_mm).collect(),
            edge_slack: extents.iter().map(|extent| extent.edge_slack_mm).fold(0.0, f64::max),
            offsets: LeastOffset::new(layout.gap_mm, go_on),
        })
    }

    /// Whether a layout may go from one node to the other.
    fn is_arc(&self, from: usize, to: usize) -> bool {
        let SectionLayout { sections, first, last, .. } = self.layout;
        match (sections.get(from), sections.get(to)) {
            (None, None) => false,
            (None, Some(_)) => first.is_none_or(|first| first == to),
            (Some(_), None) => last.is_none_or(|last| last == from),
            (Some(section), Some(_)) => {
                (from != to || section.quantity > 1) && !self.forbidden.contains(&(from, to))
            }
        }
    }

    /// A floor of what an arc costs, not below 0; what exceeds `enough` is not looked for. None: given up.
    fn cost(&mut self, from: usize, to: usize, enough: f64) -> Option<f64> {
        let width = |node: usize| self.widths.get(node).copied();
        // The strip begins at 0, where the first section may stand.
        let Some(left_width) = width(from) else { return Some(0.0) };
        let Some(right_width) = width(to) else { return Some(left_width) };
        let rounding = OFFSET_ROUNDINGS * f64::EPSILON * (left_width + right_width + self.layout.gap_mm);
        let mut least = enough + rounding;
        for left in &self.looking_right[from] {
            for right in &self.looking_left[to] {
                least = least.min(self.offsets.between(left, right, least)?);
                if least <= rounding {
                    return Some(0.0);
                }
            }
        }
        Some(least - rounding)
    }
}
