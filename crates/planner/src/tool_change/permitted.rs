//! Where a tool change is permitted, as far as it matters: the free parts of the regions' borders, and single spots.
//!
//! **Why borders are enough.** Let a path of least cost start → place → target change the tool inside a region and off
//! every barrier that stands there at the height of the change. It can't be shortened near the place, so it is a path that
//! nothing shortens, and every place along it that is permitted costs the same: it may be moved along the path to where
//! that leaves the region, or to the start or target. Only where moves pass over what the place must keep away from,
//! they may also leave what is permitted over a barrier's border: then that border's parts in the regions count as well.
//!
//! Spots are the ends of the parts, corners among them, the points that are permitted themselves, and start and target where
//! they lie in a region. Along a part a place is best only where its slope is 0 ([`super::detour`]).
//!
//! Cost: about linear in the regions' edges and the barrier borders near them, plus their crossings.

use super::way::fraction_of;
use crate::barrier::{Grid, Load};
use crate::barriers::{Barriers, WORK_AREA};
use crate::standing::depth;
use crate::way_out::{barrier_border, crossings};
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use traverse_geometry::{
    Arc, Bounds, CONTACT_TOLERANCE_MM, CornerStyle, Edge, Location, MITER_RATIO_LIMIT, Point, Polygon,
    Segment,
};
use traverse_solve::{Budget, Interrupt};

/// Parts shorter than this are spots, millimetres: rounding.
const SHORTEST_PART_MM: f64 = 1e-9;

/// The budget is looked at once for so many edges.
const EDGES_BETWEEN_CHECKS: usize = 256;

/// Where a tool change is permitted and free.
#[derive(Debug, Default)]
pub(crate) struct Permitted {
    /// Parts of borders on which nothing is in the way.
    pub(crate) parts: Vec<Edge>,
    /// Single places.
    pub(crate) spots: Vec<Point>,
}

/// What is asked for, and what is in the way at the height of the change.
pub(crate) struct Places<'a> {
    pub(crate) barriers: &'a Barriers<'a>,
    pub(crate) regions: &'a [Polygon],
    pub(crate) points: &'a [Point],
    /// Where start and target are clear of barriers.
    pub(crate) ends: [Point; 2],
    /// Owners that are passed over at the height of the change.
    pub(crate) left_out: &'a BTreeSet<usize>,
    /// Owners that are not, but are passed over by a move.
    pub(crate) passed_later: &'a BTreeSet<usize>,
}

impl Places<'_> {
    /// What is permitted and free.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn permitted(&self, budget: &Budget) -> Result<Permitted, Interrupt> {
        let mut bounds: Vec<Bounds> = self.regions.iter().map(Polygon::bounds).collect();
        bounds.extend(self.points.iter().chain(&self.ends).map(|&p| Bounds::of([p])));
        let near = Near::new(self.barriers, self.left_out, &bounds, budget)?;
        let mut permitted = Permitted::default();
        for region in self.regions {
            for (i, edge) in region.rings().flat_map(traverse_geometry::Ring::edges).enumerate() {
                if i.is_multiple_of(EDGES_BETWEEN_CHECKS) {
                    budget.check(0)?;
                }
                near.add_free_parts(&edge, |p| near.is_free(p), &mut permitted);
            }
        }
        for &owner in self.passed_later {
            let mut edges = Vec::new();
            for outline in self.barriers.outlines(owner) {
                barrier_border(&outline, &mut edges, budget)?;
            }
            for edge in edges {
                budget.check(0)?;
                let mut inner = Permitted::default();
                let borders = self.borders_across(&edge);
                near.add_parts(&edge, &borders, |p| self.in_region(p) && near.is_free(p), &mut inner);
                permitted.parts.append(&mut inner.parts);
                permitted.spots.append(&mut inner.spots);
            }
        }
        permitted.spots.extend(self.points.iter().filter(|&&p| near.is_free(p)));
        let is_permitted = |p: &&Point| self.in_region(**p) && near.is_free(**p);
        permitted.spots.extend(self.ends.iter().filter(is_permitted));
        permitted.spots.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        permitted.spots.dedup();
        Ok(permitted)
    }

    /// Owners whose barriers hold the places that are given: corners of regions and points; some of them.
    ///
    /// # Errors
    /// The budget ended.
    pub(crate) fn covering(&self, budget: &Budget) -> Result<BTreeSet<usize>, Interrupt> {
        let mut covering = BTreeSet::new();
        let corners = self.regions.iter().flat_map(|region| region.outer().vertices());
        for &p in corners.chain(self.points) {
            budget.check(0)?;
            let owners =
                self.barriers.owners_at(p).into_iter().filter(|owner| !self.left_out.contains(owner));
            covering.extend(owners.filter(|&owner| depth(self.barriers, owner, p).is_some()));
        }
        Ok(covering)
    }

    fn in_region(&self, p: Point) -> bool {
        self.regions.iter().any(|region| {
            region.bounds().grown(CONTACT_TOLERANCE_MM).contains(p) && region.locate(p) != Location::Outside
        })
    }

    /// The regions' edges near an edge.
    fn borders_across(&self, edge: &Edge) -> Vec<Edge> {
        let bounds = edge.bounds().grown(CONTACT_TOLERANCE_MM);
        let edges =
            self.regions.iter().flat_map(|region| region.rings().flat_map(traverse_geometry::Ring::edges));
        edges.filter(|other| other.bounds().meets(&bounds)).collect()
    }
}

/// The barriers near some boxes.
struct Near<'a> {
    barriers: &'a Barriers<'a>,
    left_out: &'a BTreeSet<usize>,
    /// Edges of barrier borders, and where they are.
    edges: Vec<Edge>,
    borders: Grid,
    /// Obstacles by the boxes of their barriers.
    owners: Grid,
    has_border: bool,
}

impl<'a> Near<'a> {
    fn new(
        barriers: &'a Barriers<'a>,
        left_out: &'a BTreeSet<usize>,
        bounds: &[Bounds],
        budget: &Budget,
    ) -> Result<Self, Interrupt> {
        let ratio = match barriers.scene.corner_style {
            CornerStyle::Round => 1.0,
            CornerStyle::Miter { limit } => limit.unwrap_or(MITER_RATIO_LIMIT),
        };
        let all = bounds.iter().fold(Bounds::EMPTY, |all, each| all.union(*each));
        let (mut edges, mut boxes) = (Vec::new(), Vec::new());
        let mut load = Load::NONE;
        for owner in barriers.owners().filter(|owner| !left_out.contains(owner)) {
            budget.check(0)?;
            let reach = ratio * barriers.clearance(owner).asked + CONTACT_TOLERANCE_MM;
            let reached = barriers.shape(owner).map_or(Bounds::EMPTY, |shape| shape.bounds().grown(reach));
            // The work area's barrier is what lies outside of it.
            if owner != WORK_AREA {
                if !reached.meets(&all) {
                    continue;
                }
                load.add(&reached, 0.0);
                boxes.push((owner, reached));
            }
            for outline in barriers.outlines(owner) {
                barrier_border(&outline, &mut edges, budget)?;
            }
        }
        let mut owners = Grid::new(&load);
        boxes.iter().for_each(|(owner, reached)| owners.insert_box(*owner as u32, reached, 0.0));
        let (all, mut load, mut near) = (all.grown(CONTACT_TOLERANCE_MM), Load::NONE, Vec::new());
        for (i, edge) in edges.into_iter().enumerate() {
            if i.is_multiple_of(EDGES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            let bounds = edge.bounds();
            if bounds.meets(&all) {
                load.add(&bounds, 0.0);
                near.push(edge);
            }
        }
        let edges = near;
        let mut borders = Grid::new(&load);
        for (i, edge) in edges.iter().enumerate() {
            if i.is_multiple_of(EDGES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            borders.insert_box(i as u32, &edge.bounds(), 0.0);
        }
        let has_border = barriers.owners().any(|owner| owner == WORK_AREA);
        Ok(Self { barriers, left_out, edges, borders, owners, has_border })
    }

    /// Whether a place lies in no barrier.
    fn is_free(&self, p: Point) -> bool {
        if self.has_border && depth(self.barriers, WORK_AREA, p).is_some() {
            return false;
        }
        let look = |owner: u32| {
            let owner = owner as usize;
            if !self.left_out.contains(&owner) && depth(self.barriers, owner, p).is_some() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        self.owners.within(&Bounds::of([p]), look).is_continue()
    }

    fn add_free_parts(&self, edge: &Edge, is_free: impl Fn(Point) -> bool, found: &mut Permitted) {
        self.add_parts(edge, &[], is_free, found);
    }

    /// Adds the parts of `edge` that are free, and their ends as far as these are; `others` may bound parts too.
    fn add_parts(
        &self,
        edge: &Edge,
        others: &[Edge],
        is_free: impl Fn(Point) -> bool,
        found: &mut Permitted,
    ) {
        let bounds = edge.bounds().grown(CONTACT_TOLERANCE_MM);
        let mut near = Vec::new();
        let _ = self.borders.within(&bounds, |item| {
            near.push(item);
            ControlFlow::Continue(())
        });
        near.sort_unstable();
        near.dedup();
        let mut crossed = Vec::new();
        let close = near.iter().map(|&item| &self.edges[item as usize]);
        for other in close.chain(others).filter(|other| other.bounds().meets(&bounds)) {
            crossings(edge, other, &mut crossed);
            crossed.extend([other.start(), other.end()]);
        }
        let touches = |p: &Point| edge.distance_to_point(*p) <= CONTACT_TOLERANCE_MM;
        let cuts = crossed.into_iter().filter(touches).map(|p| (fraction_of(edge, p), p));
        let mut cuts: Vec<(f64, Point)> = cuts.filter(|&(at, _)| at > 0.0 && at < 1.0).collect();
        cuts.extend([(0.0, edge.start()), (1.0, edge.end())]);
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let length = edge.length();
        cuts.dedup_by(|a, b| (a.0 - b.0) * length < SHORTEST_PART_MM);
        let mut open: Option<(f64, f64)> = None;
        let close_part = |part: Option<(f64, f64)>, parts: &mut Vec<Edge>| {
            if let Some((from, to)) = part.filter(|part| (part.1 - part.0) * length > SHORTEST_PART_MM) {
                parts.push(part_of(edge, from, to));
            }
        };
        let mut joins = false;
        for pair in cuts.windows(2) {
            let [(from, at), (to, _)] = [pair[0], pair[1]];
            let is_spot_free = is_free(at);
            let is_part_free = is_free(edge.point_at(f64::midpoint(from, to)));
            if !(is_part_free && joins && is_spot_free) {
                close_part(open.take(), &mut found.parts);
                if is_spot_free {
                    found.spots.push(at);
                }
            }
            if is_part_free {
                open = Some((open.map_or(from, |open| open.0), to));
            }
            joins = is_part_free;
        }
        close_part(open.take(), &mut found.parts);
        if is_free(edge.end()) {
            found.spots.push(edge.end());
        }
    }
}

/// The part of an edge between two fractions.
fn part_of(edge: &Edge, from: f64, to: f64) -> Edge {
    if from == 0.0 && to == 1.0 {
        return *edge;
    }
    match edge {
        Edge::Segment(segment) => Edge::Segment(Segment::new(segment.point_at(from), segment.point_at(to))),
        Edge::Arc(arc) => Edge::Arc(Arc::from_angles(
            arc.center,
            arc.radius,
            arc.start_angle + arc.sweep * from,
            arc.sweep * (to - from),
        )),
    }
}
