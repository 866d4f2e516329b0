//! Numbered markers of findings, beside what they point to.
//!
//! A marker is put where it covers no place of a finding and no other marker, if possible no curve either; a line
//! leads to its place, which is ringed.

use super::extent::can_be_drawn;
use super::frame::{Box2, Frame};
use super::gap;
use super::label::Places;
use super::route::samples;
use super::style::NUMBER;
use super::text_line::push_text;
use crate::{DrawingFinding, Fault};
use std::f64::consts::TAU;
use std::fmt::Write;
use traverse_geometry::{Edge, Point, Segment};

/// So many findings are marked in a picture and listed below it; the rest is counted.
pub const MARKED_FINDINGS: usize = 40;

/// Radius of a marker.
const RADIUS: f64 = 14.0;
/// Radius of the ring round a place.
const RING: f64 = 8.0;
/// How far from its place a marker is tried, canvas units.
const REACH: [f64; 10] = [30.0, 40.0, 52.0, 66.0, 84.0, 106.0, 134.0, 170.0, 220.0, 300.0];
/// Directions in which it is tried.
const TURNS: u8 = 24;
/// Distance between the points of a leader that are kept free.
const STEP: f64 = 8.0;

/// What became of what a finding is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// It is left out.
    Lost,
    /// It is in the result.
    Kept,
}

impl Kind {
    pub(super) fn of(finding: &DrawingFinding) -> Self {
        if finding.fault.loses_something() { Self::Lost } else { Self::Kept }
    }
}

/// Points along the gaps of the findings that are marked: what markers and text must not cover.
pub(super) fn gap_points(findings: &[DrawingFinding], frame: &Frame) -> Vec<(f64, f64)> {
    let gaps = findings.iter().take(MARKED_FINDINGS).filter(|finding| can_be_drawn(finding.place));
    let lines = gaps.filter_map(gap_of).map(|([a, b], _)| Edge::Segment(Segment::new(a, b)));
    samples(lines, frame)
}

/// Rings, gaps, leaders and markers.
pub(super) fn draw(svg: &mut String, findings: &[DrawingFinding], places: &mut Places, frame: &Frame) {
    let marked: Vec<(usize, &DrawingFinding)> = findings
        .iter()
        .take(MARKED_FINDINGS)
        .enumerate()
        .filter(|(_, finding)| can_be_drawn(finding.place))
        .collect();
    for (_, finding) in &marked {
        let (x, y) = frame.place(finding.place);
        places.take(Box2::around((x, y), RING));
        match gap_of(finding) {
            Some((ends, _)) => {
                gap::draw(svg, ends, frame);
                places.take(Box2::around(frame.place(ends[1]), RING));
            }
            None => {
                let _ = writeln!(svg, "<circle class=\"spot\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{RING}\"/>");
            }
        }
    }
    let mut discs = String::new();
    for (i, finding) in &marked {
        let place = frame.place(finding.place);
        let Some(middle) = spot_beside(places, place, frame) else { continue };
        let leader = leader(place, middle);
        if let (Some((x0, y0)), Some((x1, y1))) = (leader.first(), leader.last()) {
            let _ = writeln!(svg, "<path class=\"pointer\" d=\"M{x0:.2} {y0:.2}L{x1:.2} {y1:.2}\"/>");
        }
        places.take(Box2::around(middle, RADIUS));
        leader.iter().for_each(|&point| places.take(Box2::around(point, 0.0)));
        disc(&mut discs, Kind::of(finding), middle, &(i + 1).to_string());
    }
    svg.push_str(&discs);
    for (_, finding) in marked {
        if let Some((ends, gap_mm)) = gap_of(finding) {
            gap::write_length(svg, places, ends, gap_mm, frame);
        }
    }
}

/// A disc with a number in it.
pub(super) fn disc(svg: &mut String, kind: Kind, (x, y): (f64, f64), number: &str) {
    let (class, number_class) = match kind {
        Kind::Lost => ("lost", "number on"),
        Kind::Kept => ("kept", "number"),
    };
    let _ = writeln!(svg, "<circle class=\"{class}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{RADIUS}\"/>");
    push_text(svg, number_class, x, y + NUMBER * 0.36, number);
}

/// The loose ends and the gap of an open chain.
fn gap_of(finding: &DrawingFinding) -> Option<([Point; 2], f64)> {
    match finding.fault {
        Fault::OpenChain { other_end, gap_mm, .. } if can_be_drawn(other_end) => {
            Some(([finding.place, other_end], gap_mm))
        }
        _ => None,
    }
}

/// Where a marker may stand: off the curves and with a free way if possible, then off everything marked.
fn spot_beside(places: &Places, place: (f64, f64), frame: &Frame) -> Option<(f64, f64)> {
    let around = REACH.iter().flat_map(|&away| {
        (0..TURNS).map(move |turn| {
            let angle = TAU * (f64::from(turn) + 0.5) / f64::from(TURNS);
            (place.0 + away * angle.cos(), place.1 - away * angle.sin())
        })
    });
    let area = &frame.area;
    let columns = ((area.right - area.left) / (2.5 * RADIUS)) as usize;
    let rows = ((area.bottom - area.top) / (2.5 * RADIUS)) as usize;
    let at = |i: usize, j: usize| {
        (area.left + (i as f64 + 0.5) * 2.5 * RADIUS, area.top + (j as f64 + 0.5) * 2.5 * RADIUS)
    };
    let free = |middle: (f64, f64)| places.is_free(&Box2::around(middle, RADIUS));
    let open = |middle: (f64, f64)| places.is_clear(&Box2::around(middle, RADIUS));
    let reached = |middle: (f64, f64)| !leader(place, middle).into_iter().any(|point| places.is_taken(point));
    let near: Vec<(f64, f64)> = around.filter(|&middle| free(middle)).collect();
    near.iter()
        .copied()
        .find(|&middle| open(middle) && reached(middle))
        .or_else(|| near.iter().copied().find(|&middle| reached(middle)))
        .or_else(|| near.first().copied())
        .or_else(|| {
            let all = (0..rows).flat_map(|j| (0..columns).map(move |i| at(i, j)));
            let away = |(x, y): (f64, f64)| (x - place.0).hypot(y - place.1);
            all.filter(|&middle| free(middle)).min_by(|&a, &b| away(a).total_cmp(&away(b)))
        })
}

/// Points from the ring of a place to the rim of its marker.
fn leader((x, y): (f64, f64), (to_x, to_y): (f64, f64)) -> Vec<(f64, f64)> {
    let length = (to_x - x).hypot(to_y - y);
    let (from, to) = (RING + 3.0, length - RADIUS);
    if to <= from {
        return Vec::new();
    }
    let count = ((to - from) / STEP).ceil().max(1.0) as usize;
    let at = |i: usize| (from + (to - from) * i as f64 / count as f64) / length;
    (0..=count).map(|i| (x + (to_x - x) * at(i), y + (to_y - y) * at(i))).collect()
}
