//! Edges cut into pieces that only rise: what a horizontal line meets at most once.

use traverse_geometry::Edge;

/// A piece of an edge on which y only rises, from `low` up to but without `high`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    pub(crate) low: f64,
    pub(crate) high: f64,
    shape: Shape,
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Line {
        x_low: f64,
        slope: f64,
    },
    /// `side` is +1 on the right half of the circle, −1 on the left.
    Arc {
        x: f64,
        y: f64,
        radius: f64,
        side: f64,
    },
}

impl Piece {
    /// Whether the horizontal line at `y` meets the piece.
    pub(crate) fn spans(&self, y: f64) -> bool {
        self.low <= y && y < self.high
    }

    /// Where it does.
    pub(crate) fn x_at(&self, y: f64) -> f64 {
        match self.shape {
            Shape::Line { x_low, slope } => x_low + (y - self.low) * slope,
            Shape::Arc { x, y: center_y, radius, side } => {
                let rise = y - center_y;
                x + side * (radius * radius - rise * rise).max(0.0).sqrt()
            }
        }
    }
}

/// The pieces of the edges. Level edges have none.
pub(crate) fn pieces_of(edges: impl Iterator<Item = Edge>) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(edges.size_hint().0);
    for edge in edges {
        match edge {
            Edge::Segment(segment) => {
                let (a, b) = (segment.start, segment.end);
                let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
                let shape = Shape::Line { x_low: low.x, slope: (high.x - low.x) / (high.y - low.y) };
                push(&mut pieces, low.y, high.y, shape);
            }
            Edge::Arc(arc) => {
                let (top, bottom) = (arc.center.y + arc.radius, arc.center.y - arc.radius);
                let half = |side| Shape::Arc { x: arc.center.x, y: arc.center.y, radius: arc.radius, side };
                // The turning points inside the arc, in the order in which it runs through them.
                let mut turns: Vec<(f64, f64)> =
                    [(std::f64::consts::FRAC_PI_2, top), (-std::f64::consts::FRAC_PI_2, bottom)]
                        .into_iter()
                        .map(|(angle, y)| {
                            (
                                traverse_geometry::positive_angle(
                                    (angle - arc.start_angle) * arc.sweep.signum(),
                                ),
                                y,
                            )
                        })
                        .filter(|&(turned, _)| turned > 0.0 && turned < arc.sweep.abs())
                        .collect();
                turns.sort_by(|a, b| a.0.total_cmp(&b.0));
                let stops = turns.into_iter().chain([(arc.sweep.abs(), arc.end.y)]);
                let (mut turned, mut y) = (0.0, arc.start.y);
                for (next_turned, next_y) in stops {
                    let middle = arc.start_angle + arc.sweep.signum() * (turned + next_turned) / 2.0;
                    push(&mut pieces, y.min(next_y), y.max(next_y), half(middle.cos().signum()));
                    (turned, y) = (next_turned, next_y);
                }
            }
        }
    }
    pieces
}

fn push(pieces: &mut Vec<Piece>, low: f64, high: f64, shape: Shape) {
    if low < high {
        pieces.push(Piece { low, high, shape });
    }
}
