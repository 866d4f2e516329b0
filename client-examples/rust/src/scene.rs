//! What is in the way, as the service wants it: millimetres, x to the right, y up.

use crate::traverse::{CornerStyle, Obstacle, Point, Polygon, Ring, Scene};

/// A point.
#[must_use]
pub fn point(x_mm: f64, y_mm: f64) -> Point {
    Point { x_mm, y_mm }
}

/// A rectangle. Vertices are x0, y0, x1, y1, …; the first is not repeated.
#[must_use]
pub fn rectangle(id: &str, x: f64, y: f64, width: f64, height: f64) -> Obstacle {
    let (right, top) = (x + width, y + height);
    obstacle(id, Ring { xy_mm: vec![x, y, right, y, right, top, x, top], bulges: vec![] })
}

/// A disc: two half circles, each with bulge tan(π / 4) = 1, as in a DXF polyline.
#[must_use]
pub fn disc(id: &str, x: f64, y: f64, radius: f64) -> Obstacle {
    obstacle(id, Ring { xy_mm: vec![x - radius, y, x + radius, y], bulges: vec![1.0, 1.0] })
}

/// Everything that the tool keeps `clearance_mm` away from.
#[must_use]
pub fn scene(obstacles: Vec<Obstacle>, clearance_mm: f64) -> Scene {
    Scene { obstacles, clearance_mm, corner_style: CornerStyle::Round.into(), ..Scene::default() }
}

fn obstacle(id: &str, outer: Ring) -> Obstacle {
    let shape = Polygon { outer: Some(outer), holes: vec![] };
    Obstacle { id: id.to_owned(), shape: Some(shape), clearance_mm: None, top_z_mm: None }
}
