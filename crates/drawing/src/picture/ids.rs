//! Ids of obstacles and names of the ends, where they cover neither path nor marks nor each other.

use super::Shown;
use super::frame::{Box2, Frame};
use super::label::{Places, box_at};
use super::route::{MARK_RADIUS, mark_size, samples};
use super::style::SMALL;
use super::text::{Weight, fitted, width_of};
use super::text_line::push_text;
use crate::monotone::{Piece, pieces_of};
use std::f64::consts::TAU;
use std::fmt::Write;
use traverse_geometry::{Bounds, Edge, Obstacle, Path, Point, Scene, Segment};

/// A label that lies farther than this from what it names gets a line to it.
const LEADER_FROM: f64 = 22.0;
/// Distance between points of that line.
const LEADER_STEP: f64 = 10.0;
/// How far from its anchor a label is tried, canvas units.
const REACH: [f64; 9] = [0.0, 14.0, 24.0, 36.0, 50.0, 66.0, 84.0, 104.0, 130.0];
/// Directions in which a label is tried.
const TURNS: u8 = 16;
/// Longest id that is written, canvas units.
const LONGEST: f64 = 260.0;
/// Places inside an obstacle at which its id is tried.
const MOST_ANCHORS: usize = 40;
/// So many edges of the scene are kept free of ids.
const MOST_EDGES: usize = 20_000;
/// Ends of so many moves are named; of more, the legend explains the marks.
const NAMED_MOVES: usize = 3;
/// Names keep off barriers up to this width, where there is a choice, canvas units.
const WIDEST_BARRIER: f64 = 24.0;
/// Scenes with more obstacles than this are labelled inside the obstacles only.
const CROWDED: usize = 80;

/// Writes what finds room; the ids that found none.
pub(super) fn draw<'a>(svg: &mut String, scene: &'a Scene, shown: &Shown<'_>, frame: &Frame) -> Vec<&'a str> {
    let crowded = scene.obstacles.len() > CROWDED;
    let paths = shown.paths().iter().chain(shown.before());
    let mut path = samples(paths.flat_map(Path::edges), frame);
    if let Shown::NoPath { start, target, .. } = *shown {
        path.extend(samples(std::iter::once(Edge::Segment(Segment::new(start, target))), frame));
    }
    let borders = samples(scene.rings().flat_map(traverse_geometry::Ring::edges).take(MOST_EDGES), frame);
    let mut places = Places::new(frame.area, &path, &borders);
    let ends = shown.ends();
    let size = mark_size(ends.len());
    let barrier = (scene.clearance_mm.max(scene.border_clearance()) * frame.scale).min(WIDEST_BARRIER) + 2.0;
    for (start, target) in &ends {
        for end in [start, target] {
            places.take(Box2::around(frame.place(*end), size * (MARK_RADIUS + 2.0)));
        }
    }
    if let Some(place) = shown.place() {
        places.take(Box2::around(frame.place(place), MARK_RADIUS + 2.0));
        end_name(svg, &mut places, frame.place(place), "tool change", barrier);
    }
    for (start, target) in ends.iter().filter(|_| ends.len() <= NAMED_MOVES) {
        for (end, name) in [(start, "start"), (target, "target")] {
            end_name(svg, &mut places, frame.place(*end), name, barrier);
        }
    }
    // The largest first: they have the most room, the small ones then find theirs beside them.
    let mut order: Vec<&Obstacle> = scene.obstacles.iter().collect();
    order.sort_by(|a, b| {
        shown.parts(&b.id).cmp(&shown.parts(&a.id)).then(b.shape.area().total_cmp(&a.shape.area()))
    });
    let named: Vec<Named<'_>> = order.into_iter().map(Named::new).collect();
    let hardest = if crowded { 1 } else { 4 };
    let mut waiting: Vec<usize> = (0..named.len()).collect();
    for effort in 0..hardest {
        waiting.retain(|&i| !named[i].write(svg, &mut places, frame, (effort, barrier), &named));
    }
    waiting.into_iter().map(|i| named[i].obstacle.id.as_str()).filter(|id| !id.is_empty()).collect()
}

fn end_name(svg: &mut String, places: &mut Places, (x, y): (f64, f64), name: &str, barrier: f64) {
    let width = width_of(name, SMALL, Weight::Bold);
    // Round the mark on a rectangle, from above it on, then on wider ones.
    let spots = [0.0, 12.0, 26.0].into_iter().flat_map(|away| {
        (0..48).map(move |i| {
            let angle = TAU * (f64::from(i) / 48.0 - 0.25);
            let on_square = angle.cos().abs().max(angle.sin().abs());
            let (dx, dy) = (MARK_RADIUS + 8.0 + width / 2.0 + away, MARK_RADIUS + 6.0 + SMALL / 2.0 + away);
            box_at(x + dx * angle.cos() / on_square, y + dy * angle.sin() / on_square, width, SMALL)
        })
    });
    // Where the least of the borders is covered, then the least of the barriers.
    let free = spots.filter(|spot| places.is_free(spot));
    let cost = |spot: &Box2| (places.borders_in(spot), places.borders_in(&spot.grown(barrier)));
    if let Some(free) = free.min_by_key(cost) {
        write_at(svg, places, "end", free, name);
    }
}

/// An obstacle that wants its id written.
struct Named<'a> {
    obstacle: &'a Obstacle,
    bounds: Bounds,
    pieces: Vec<Piece>,
    anchors: Vec<Point>,
}

impl<'a> Named<'a> {
    fn new(obstacle: &'a Obstacle) -> Self {
        let bounds = obstacle.shape.bounds();
        let edges = obstacle.shape.rings().flat_map(traverse_geometry::Ring::edges);
        let mut named = Self { obstacle, bounds, pieces: pieces_of(edges), anchors: Vec::new() };
        let size = bounds.size();
        let at = |u: f64, v: f64| Point::new(bounds.min.x + u * size.x, bounds.min.y + v * size.y);
        let shares = [0.5, 0.25, 0.75, 0.12, 0.88, 0.38, 0.62, 0.05, 0.95];
        let grid = shares.iter().flat_map(|&v| shares.iter().map(move |&u| at(u, v)));
        named.anchors = grid.filter(|&p| named.holds(p)).take(MOST_ANCHORS).collect();
        named.anchors.extend(obstacle.shape.outer().vertices().first());
        named
    }

    /// Even-odd rule over all rings; exact enough for a label.
    fn holds(&self, p: Point) -> bool {
        let right = self.pieces.iter().filter(|piece| piece.spans(p.y) && piece.x_at(p.y) > p.x);
        self.bounds.contains(p) && right.count() % 2 == 1
    }

    /// Writes the id where there is room: at first inside the obstacle, then beside it off all barriers, then in the
    /// open, then anywhere off the path. Whether it could.
    fn write(
        &self,
        svg: &mut String,
        places: &mut Places,
        frame: &Frame,
        (effort, barrier): (u8, f64),
        all: &[Self],
    ) -> bool {
        if self.obstacle.id.is_empty() {
            return false;
        }
        let text = fitted(&self.obstacle.id, SMALL, Weight::Regular, LONGEST);
        let width = width_of(&text, SMALL, Weight::Regular);
        let reach = if effort == 0 { &REACH[..1] } else { &REACH[..] };
        // Inside there is often just one place; beside it any of a few points will do to start from.
        let anchors =
            if effort == 0 { &self.anchors[..] } else { &self.anchors[..self.anchors.len().min(4)] };
        let tries = reach.iter().flat_map(|&away| {
            let turns = if away == 0.0 { 1 } else { TURNS };
            let spots = (0..turns).map(move |turn| (away, TAU * f64::from(turn) / f64::from(TURNS)));
            anchors
                .iter()
                .flat_map(move |&anchor| spots.clone().map(move |(away, angle)| (anchor, away, angle)))
        });
        for (anchor, away, angle) in tries {
            let (x, y) = frame.place(anchor);
            let middle = match away {
                0.0 => (x, y),
                _ => (x + (away + width / 2.0) * angle.cos(), y + (away + SMALL / 2.0) * angle.sin()),
            };
            let spot = box_at(middle.0, middle.1, width, SMALL);
            let p = frame.point(middle);
            let suits = |spot: &Box2| match effort {
                0 => places.is_clear(spot) && self.holds(p),
                1 => places.is_clear(&spot.grown(barrier)) && !all.iter().any(|other| other.holds(p)),
                2 => places.is_clear(spot) && !all.iter().any(|other| other.holds(p)),
                _ => true,
            };
            if !places.is_free(&spot) || !suits(&spot) {
                continue;
            }
            let line = leader_points((x, y), &spot);
            if effort == 3 || !line.iter().any(|&point| places.is_taken(point)) {
                if !line.is_empty() {
                    leader(svg, places, (x, y), &line);
                }
                write_at(svg, places, "id", spot, &text);
                return true;
            }
        }
        false
    }
}

/// Points on the way from the anchor to a label that lies far from it; none when it lies near.
fn leader_points((x, y): (f64, f64), spot: &Box2) -> Vec<(f64, f64)> {
    let length = spot.distance((x, y));
    if length <= LEADER_FROM {
        return Vec::new();
    }
    let (to_x, to_y) = (x.clamp(spot.left, spot.right), y.clamp(spot.top, spot.bottom));
    let count = (length / LEADER_STEP).ceil();
    (0..=count as usize)
        .map(|i| i as f64 / count)
        .map(|share| (x + (to_x - x) * share, y + (to_y - y) * share))
        .collect()
}

fn leader(svg: &mut String, places: &mut Places, (x, y): (f64, f64), line: &[(f64, f64)]) {
    let (to_x, to_y) = line.last().copied().unwrap_or((x, y));
    let _ = writeln!(
        svg,
        "<line class=\"leader\" x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{to_x:.1}\" y2=\"{to_y:.1}\"/>\
         <circle class=\"dot\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.5\"/>"
    );
    for &(x, y) in line {
        places.take(Box2 { left: x, top: y, right: x, bottom: y });
    }
}

fn write_at(svg: &mut String, places: &mut Places, class: &str, spot: Box2, text: &str) {
    let middle = (spot.left + spot.right) / 2.0;
    push_text(svg, class, middle, (spot.top + spot.bottom) / 2.0 + SMALL * 0.35, text);
    places.take(spot);
}
