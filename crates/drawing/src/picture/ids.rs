//! Ids of obstacles and names of the ends, where they cover neither path nor marks nor each other.

use super::Shown;
use super::frame::{Box2, Frame};
use super::label::{Places, box_at};
use super::route::{MARK_RADIUS, samples};
use super::style::SMALL;
use super::text::{fitted, push_text, width_of};
use std::f64::consts::TAU;
use std::fmt::Write;
use traverse_geometry::{Edge, Obstacle, Path, Point, Scene, Segment};

/// A label that lies farther than this from what it names gets a line to it.
const LEADER_FROM: f64 = 22.0;
/// Distance between points of that line.
const LEADER_STEP: f64 = 6.0;
/// How far from its anchor a label is tried, canvas units.
const REACH: [f64; 9] = [0.0, 14.0, 24.0, 36.0, 50.0, 66.0, 84.0, 104.0, 130.0];
/// Longest id that is written, canvas units.
const LONGEST: f64 = 260.0;
/// So many edges of the scene are kept free of ids.
const MOST_EDGES: usize = 20_000;
/// Scenes with more obstacles than this are labelled inside the obstacles only.
const CROWDED: usize = 80;

pub(super) fn draw(svg: &mut String, scene: &Scene, shown: &Shown<'_>, frame: &Frame) {
    let crowded = scene.obstacles.len() > CROWDED;
    let mut path = samples(shown.paths().iter().flat_map(Path::edges), frame);
    if let Shown::NoPath { start, target, .. } = *shown {
        path.extend(samples(std::iter::once(Edge::Segment(Segment::new(start, target))), frame));
    }
    let borders = samples(scene.rings().flat_map(|ring| ring.edges()).take(MOST_EDGES), frame);
    let mut places = Places::new(frame.area, &path, &borders);
    let ends = shown.ends();
    for (start, target) in &ends {
        for end in [start, target] {
            let (x, y) = frame.place(*end);
            let r = MARK_RADIUS + 2.0;
            places.take(Box2 { left: x - r, top: y - r, right: x + r, bottom: y + r });
        }
    }
    for (start, target) in ends.iter().take(CROWDED) {
        for (end, name) in [(start, "start"), (target, "target")] {
            end_name(svg, &mut places, frame.place(*end), name);
        }
    }
    // The largest first: they have the most room, the small ones then find theirs beside them.
    let mut order: Vec<&Obstacle> = scene.obstacles.iter().collect();
    order.sort_by(|a, b| {
        shown.parts(&b.id).cmp(&shown.parts(&a.id)).then(b.shape.area().total_cmp(&a.shape.area()))
    });
    let anchors: Vec<Vec<Point>> = order.iter().map(|obstacle| anchors(obstacle)).collect();
    let hardest = if crowded { 1 } else { 3 };
    let mut waiting: Vec<usize> = (0..order.len()).collect();
    for effort in 0..hardest {
        waiting.retain(|&i| {
            !obstacle_id(svg, &mut places, order[i], &anchors[i], frame, effort, &scene.obstacles)
        });
    }
}

fn end_name(svg: &mut String, places: &mut Places, (x, y): (f64, f64), name: &str) {
    let width = width_of(name, SMALL);
    let spots = (0..24).map(|i| {
        let angle = TAU * f64::from(i) / 12.0 - TAU / 4.0;
        let away = if i < 12 { 0.0 } else { 18.0 };
        let (dx, dy) = (MARK_RADIUS + 8.0 + width / 2.0 + away, MARK_RADIUS + 6.0 + SMALL / 2.0 + away);
        box_at(x + dx * angle.cos(), y + dy * angle.sin(), width, SMALL)
    });
    if let Some(free) = spots.into_iter().find(|spot| places.is_free(spot)) {
        write_at(svg, places, "end", free, name);
    }
}

/// Writes the id where there is room: at first inside the obstacle, then beside it in the open, then anywhere off the
/// path. Whether it could.
fn obstacle_id(
    svg: &mut String,
    places: &mut Places,
    obstacle: &Obstacle,
    anchors: &[Point],
    frame: &Frame,
    effort: u8,
    all: &[Obstacle],
) -> bool {
    let text = fitted(&obstacle.id, SMALL, LONGEST);
    let width = width_of(&text, SMALL);
    let reach = if effort == 0 { &REACH[..1] } else { &REACH[..] };
    for &away in reach {
        for &anchor in anchors {
            let (x, y) = frame.place(anchor);
            let turns = if away == 0.0 { 1 } else { 16 };
            for turn in 0..turns {
                let angle = TAU * f64::from(turn) / 16.0;
                let (dx, dy) = ((away + width / 2.0) * angle.cos(), (away + SMALL / 2.0) * angle.sin());
                let (dx, dy) = if away == 0.0 { (0.0, 0.0) } else { (dx, dy) };
                let spot = box_at(x + dx, y + dy, width, SMALL);
                let suits = effort == 2
                    || places.is_clear(&spot) && {
                        let middle = frame.point((x + dx, y + dy));
                        if effort == 0 {
                            holds(obstacle, middle)
                        } else {
                            !all.iter().any(|other| holds(other, middle))
                        }
                    };
                if !suits || !places.is_free(&spot) {
                    continue;
                }
                let line = leader_points((x, y), &spot);
                if effort < 2 && line.iter().any(|&point| places.is_taken(point)) {
                    continue;
                }
                if !line.is_empty() {
                    leader(svg, places, (x, y), &line);
                }
                write_at(svg, places, "id", spot, &text);
                return true;
            }
        }
    }
    false
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

/// Points inside the obstacle, the middle of its box first.
fn anchors(obstacle: &Obstacle) -> Vec<Point> {
    let bounds = obstacle.shape.bounds();
    let size = bounds.size();
    let at = |u: f64, v: f64| Point::new(bounds.min.x + u * size.x, bounds.min.y + v * size.y);
    let shares = [0.5, 0.25, 0.75, 0.12, 0.88, 0.05, 0.95];
    let grid = shares.iter().flat_map(|&v| shares.iter().map(move |&u| at(u, v)));
    let mut inside: Vec<Point> = grid.filter(|&p| holds(obstacle, p)).take(12).collect();
    inside.extend(obstacle.shape.outer().vertices().first());
    inside
}

/// Even-odd rule over all rings by a ray to the right; exact enough for a label.
fn holds(obstacle: &Obstacle, p: Point) -> bool {
    if !obstacle.shape.bounds().contains(p) {
        return false;
    }
    let crossings = |ring: &traverse_geometry::Ring| {
        let chain = crate::Loop {
            vertices: ring.vertices().to_vec(),
            bulges: if ring.has_arcs() { ring.bulges().to_vec() } else { vec![0.0; ring.len()] },
            first_curve: 0,
        };
        let pieces = crate::monotone::pieces_of(&chain);
        pieces.iter().filter(|piece| piece.spans(p.y) && piece.x_at(p.y) > p.x).count()
    };
    obstacle.shape.rings().map(crossings).sum::<usize>() % 2 == 1
}
