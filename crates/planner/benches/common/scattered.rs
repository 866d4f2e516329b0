//! Scenes of scattered obstacles and moves among them.

use rand::RngExt;
use traverse_geometry::{CornerStyle, Obstacle, Point, Polygon, RapidRules, Ring, Scene, unit};
use traverse_planner::{Algorithm, RapidMove};
use traverse_solve::Seed;

/// One obstacle per square of this side, millimetres.
const PITCH: f64 = 50.0;

/// Star-shaped obstacles of 5 to 11 corners, one in every square of a field, within a work area.
pub(crate) fn scattered(n: usize, clearance_mm: f64) -> Scene {
    let mut random = Seed(n as u64).stream();
    let columns = (n as f64).sqrt().ceil();
    let obstacles = (0..n)
        .map(|i| {
            let (column, row) = ((i as f64) % columns, ((i as f64) / columns).floor());
            let aside = || Point::new((column + 0.5) * PITCH, (row + 0.5) * PITCH);
            let size: f64 = random.random_range(8.0..20.0);
            let free = PITCH / 2.0 - size - 2.0;
            let jitter = |random: &mut dyn FnMut() -> f64| random() * free;
            let mut draw = || random.random_range(-1.0..1.0);
            let center = aside() + traverse_geometry::Vector::new(jitter(&mut draw), jitter(&mut draw));
            let corners = random.random_range(5..12);
            let step = std::f64::consts::TAU / f64::from(corners);
            let points = (0..corners).map(|corner| {
                let angle = step * (f64::from(corner) + random.random_range(0.1..0.9));
                center + unit(angle) * size * random.random_range(0.4..1.0)
            });
            let ring = Ring::new(points.collect(), vec![]).unwrap();
            Obstacle {
                id: format!("o{i}"),
                shape: Polygon::from_ring(ring),
                clearance_mm: None,
                top_z_mm: None,
            }
        })
        .collect();
    let side = columns * PITCH + 10.0;
    let border = [(-10.0, -10.0), (side, -10.0), (side, side), (-10.0, side)];
    let border = Ring::new(border.map(|(x, y)| Point::new(x, y)).to_vec(), vec![]).unwrap();
    Scene {
        work_area: Some(Polygon::from_ring(border)),
        obstacles,
        clearance_mm,
        work_area_clearance_mm: Some(0.0),
        corner_style: CornerStyle::Round,
    }
}

/// Moves between free points, some millimetres away from everything.
pub(crate) fn moves(scene: &Scene, count: usize) -> Vec<RapidMove> {
    let mut random = Seed(99).stream();
    let bounds = scene.work_area.as_ref().unwrap().bounds();
    let mut free = || loop {
        let x = random.random_range(bounds.min.x + 3.0..bounds.max.x - 3.0);
        let p = Point::new(x, random.random_range(bounds.min.y + 3.0..bounds.max.y - 3.0));
        if scene.obstacles.iter().all(|obstacle| !obstacle.shape.bounds().grown(2.0).contains(p)) {
            return p;
        }
    };
    (0..count)
        .map(|_| RapidMove {
            start: free(),
            target: free(),
            algorithm: Algorithm::Exact,
            rules: RapidRules::default(),
        })
        .collect()
}
