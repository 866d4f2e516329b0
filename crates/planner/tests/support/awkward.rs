//! Scenes that break planners: contacts everywhere, slivers, frames, own clearances, notched work areas, far origins.

use rand::RngExt;
use traverse_geometry::{Obstacle, Point, Polygon, Ring, Scene, Vector};

use super::{point, polygon, rectangle, ring, scene, star};

/// How far ends lie off a corner or border, millimetres.
const OFFSETS: [f64; 6] = [0.0, 1e-9, 1e-7, 1e-5, 1e-3, 0.1];

/// A scene of some kind within about 100 × 100 mm of `origin`.
pub fn awkward_scene(random: &mut impl RngExt, origin: Vector) -> Scene {
    let clearance = [0.0, 0.0, 0.5, 1.5][random.random_range(0..4)];
    let count = random.random_range(1..24);
    let shapes: Vec<Polygon> = (0..count).map(|_| awkward_shape(random, origin)).collect();
    let mut made = scene(shapes, clearance);
    if random.random_bool(0.3) {
        for obstacle in &mut made.obstacles {
            if random.random_bool(0.5) {
                obstacle.clearance_mm = Some([0.0, 0.3, 2.0][random.random_range(0..3)]);
            }
        }
    }
    if random.random_bool(0.4) {
        made.work_area = Some(work_area(random, origin));
        if random.random_bool(0.5) {
            made.work_area_clearance_mm = Some([0.0, 0.2, 2.5][random.random_range(0..3)]);
        }
    }
    made
}

/// An obstacle that a grid, a frame, a sliver or chance made.
pub fn awkward_obstacle(random: &mut impl RngExt, origin: Vector, id: String) -> Obstacle {
    let clearance_mm = random.random_bool(0.2).then(|| random.random_range(0.0..2.0)).filter(|c| *c > 0.01);
    Obstacle { id, shape: awkward_shape(random, origin), clearance_mm, top_z_mm: None }
}

fn awkward_shape(random: &mut impl RngExt, origin: Vector) -> Polygon {
    let cell = |random: &mut dyn rand::Rng| 10.0 * f64::from(random.random_range(0_i32..10));
    let (x, y) = (cell(random), cell(random));
    let at = |points: &[(f64, f64)]| {
        polygon(&points.iter().map(|&(x, y)| (x + origin.x, y + origin.y)).collect::<Vec<_>>())
    };
    match random.random_range(0..6) {
        // Cells of a grid: they touch in edges and corners.
        0 | 1 => {
            let (width, height) = (cell(random).clamp(10.0, 30.0), 10.0);
            at(&[(x, y), (x + width, y), (x + width, y + height), (x, y + height)])
        }
        // A frame with a hole.
        2 => {
            let wall = [1.0, 2.0, 5.0][random.random_range(0..3)];
            let square = |inset: f64| {
                let (x, y) = (x + origin.x + inset, y + origin.y + inset);
                let side = 30.0 - 2.0 * inset;
                ring(&[(x, y), (x + side, y), (x + side, y + side), (x, y + side)])
            };
            Polygon::new(square(0.0), vec![square(wall)]).unwrap()
        }
        // A sliver.
        3 => {
            let thin = [1e-7, 1e-5, 1e-3][random.random_range(0..3)];
            let long = random.random_range(5.0..40.0);
            if random.random_bool(0.5) {
                at(&[(x, y), (x + long, y), (x + long, y + thin)])
            } else {
                at(&[(x, y), (x + long, y + long), (x + long - thin, y + long + thin)])
            }
        }
        // Corners of the same grid, anything between.
        4 => at(&[(x, y), (x + 20.0, y + 10.0), (x + 10.0, y + 20.0)]),
        _ => {
            let center = point(random.random_range(0.0..100.0), random.random_range(0.0..100.0)) + origin;
            let (radius, corners) = (random.random_range(2.0..15.0), random.random_range(3..10));
            star(random, center, radius, corners)
        }
    }
}

fn work_area(random: &mut impl RngExt, origin: Vector) -> Polygon {
    let moved = |points: &[(f64, f64)]| {
        ring(&points.iter().map(|&(x, y)| (x + origin.x, y + origin.y)).collect::<Vec<_>>())
    };
    let notched = [(-5.0, -5.0), (110.0, -5.0), (110.0, 110.0), (60.0, 110.0), (60.0, 50.0), (50.0, 50.0)];
    match random.random_range(0..3) {
        0 => rectangle(origin.x - 5.0, origin.y - 5.0, origin.x + 110.0, origin.y + 110.0),
        1 => Polygon::from_ring(moved(&[&notched[..], &[(50.0, 110.0), (-5.0, 110.0)]].concat())),
        _ => {
            let hole = moved(&[(40.0, 40.0), (55.0, 40.0), (55.0, 60.0), (40.0, 60.0)]);
            let border = moved(&[(-5.0, -5.0), (110.0, -5.0), (110.0, 110.0), (-5.0, 110.0)]);
            Polygon::new(border, vec![hole]).unwrap()
        }
    }
}

/// A point anywhere, or on, or a little off, a corner or an edge of what the scene holds.
pub fn awkward_point(random: &mut impl RngExt, scene: &Scene, origin: Vector) -> Point {
    let rings: Vec<&Ring> = scene.rings().collect();
    if rings.is_empty() || random.random_bool(0.4) {
        return point(random.random_range(-4.0..108.0), random.random_range(-4.0..108.0)) + origin;
    }
    let corners = rings[random.random_range(0..rings.len())].vertices();
    let i = random.random_range(0..corners.len());
    let (corner, next) = (corners[i], corners[(i + 1) % corners.len()]);
    let along = [0.0, 0.5, random.random_range(0.0..1.0)][random.random_range(0..3)];
    let grown = [0.0, scene.clearance_mm, 2.0][random.random_range(0..3)];
    let off = OFFSETS[random.random_range(0..OFFSETS.len())] + grown;
    let direction = traverse_geometry::unit(random.random_range(0.0..std::f64::consts::TAU));
    let normal = (next - corner).try_normalize(0.0).map_or(direction, |d| Vector::new(d.y, -d.x));
    let direction = if random.random_bool(0.5) { normal } else { direction };
    corner + (next - corner) * along + direction * off
}
