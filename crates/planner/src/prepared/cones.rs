//! What may be seen from a start, through the triangles of a mesh: cones of directions that edges divide, as far as a path
//! of some cost may get (bounds as in Polyanya: M. Cui, D. Harabor, A. Grastien 2017).
//!
//! A corner that a tangent from the start reaches is seen from there itself: what stood between it and the tangent would be
//! nearer to the tangent than the clearance. So the corners that no triangle hides are all that can matter; each
//! tangent is tested when it is its turn.
//!
//! Cost: a few nanoseconds for each triangle that is seen and lies within the ellipse of the cost.

use super::mesh::{Mesh, Way, next};
use super::terrain::Terrain;
use traverse_geometry::{Point, Vector, cross, left_of};
use traverse_solve::{Budget, Interrupt};

/// By how much the excess over the straight way grows at once, at least.
const GROWTH: f64 = 1.25;

/// The budget is looked at once for so many cones.
const CONES_BETWEEN_CHECKS: usize = 4096;

/// More cones than so many for each triangle are too many: no start sees that much, only rounding among slivers does.
const CONES_PER_TRIANGLE: usize = 4;

/// A corner so near to the border of a cone is within it, millimetres: far above rounding, far below a contact tolerance.
const RAY_TOLERANCE_MM: f64 = 1e-8;

/// Directions from a root between two rays, about to enter a triangle.
#[derive(Clone, Copy, Debug)]
struct Cone {
    root: Point,
    left: Vector,
    right: Vector,
    /// Into the triangle.
    way: Way,
    /// No path through it costs less, millimetres.
    bound: f64,
}

/// The memory of cones, to be used again.
#[derive(Default)]
pub(super) struct ConeRoom {
    /// To be looked into.
    open: Vec<Cone>,
    /// Too dear as yet.
    waiting: Vec<Cone>,
    /// Features at the corners of the triangles that the places lie in.
    near: Vec<u32>,
}

/// Cones from the places of a start, as far as they were looked into.
pub(super) struct Cones<'a> {
    terrain: &'a Terrain,
    mesh: &'a Mesh,
    target: Point,
    straight: f64,
    /// How much less a path may cost than one through the corners that it bends round.
    slack: f64,
    cost: f64,
    is_first: bool,
    looked_into: usize,
}

impl<'a> Cones<'a> {
    /// From `places`, which stand for `start`. None where a place lies beyond the mesh, or on one of its edges.
    pub(super) fn new(
        terrain: &'a Terrain,
        mesh: &'a Mesh,
        [start, target]: [Point; 2],
        places: &[Point],
        room: &mut ConeRoom,
    ) -> Option<Self> {
        room.open.clear();
        room.waiting.clear();
        room.near.clear();
        let aside = places.iter().map(|place| (place - start).norm()).fold(0.0, f64::max);
        // What a path touches lies within the radius of its corner.
        let slack = 2.0 * mesh.radius + aside + RAY_TOLERANCE_MM;
        let straight = (target - start).norm();
        let cones =
            Self { terrain, mesh, target, straight, slack, cost: 0.0, is_first: true, looked_into: 0 };
        for &root in places {
            let at = mesh.triangle_at(root, RAY_TOLERANCE_MM)?;
            let triangle = &mesh.triangles[at as usize];
            for i in 0..3 {
                room.near.extend_from_slice(mesh.features_at(triangle.corners[i]));
                // Seen from inside, an edge runs from right to left.
                let [right, left] = [triangle.corners[i], triangle.corners[next(i)]]
                    .map(|corner| mesh.corners[corner as usize] - root);
                let cone = Cone { root, left, right, way: Way::NONE, bound: 0.0 };
                cones.enter(room, cone, triangle.across[i], 0.0);
            }
        }
        Some(cones)
    }

    /// Adds to `found` the features that come into view, until all were found by which a path of cost `cost` may leave the
    /// start; answers the cost up to which that holds now: infinity when there are no more.
    ///
    /// None: there are too many cones.
    ///
    /// # Errors
    /// The budget ended.
    pub(super) fn grow(
        &mut self,
        room: &mut ConeRoom,
        cost: f64,
        found: &mut Vec<u32>,
        budget: &Budget,
    ) -> Result<Option<f64>, Interrupt> {
        if self.cost == f64::INFINITY {
            return Ok(Some(self.cost));
        }
        if std::mem::take(&mut self.is_first) {
            found.extend_from_slice(&self.mesh.added);
            found.append(&mut room.near);
        }
        let cost = if cost.is_finite() { cost } else { 0.0 };
        let excess = (self.cost - self.straight).max(self.mesh.step);
        self.cost = cost.max(self.straight + GROWTH * excess);
        let limit = self.cost + self.slack;
        let due = room.waiting.extract_if(.., |cone| cone.bound <= limit);
        room.open.extend(due);
        while let Some(cone) = room.open.pop() {
            self.looked_into += 1;
            if self.looked_into.is_multiple_of(CONES_BETWEEN_CHECKS) {
                budget.check(0)?;
            }
            if self.looked_into > CONES_PER_TRIANGLE * self.mesh.triangles.len() {
                return Ok(None);
            }
            self.look_into(room, &cone, limit, found);
        }
        if room.waiting.is_empty() {
            self.cost = f64::INFINITY;
        }
        Ok(Some(self.cost))
    }

    fn look_into(&self, room: &mut ConeRoom, cone: &Cone, limit: f64, found: &mut Vec<u32>) {
        let triangle = &self.mesh.triangles[cone.way.triangle() as usize];
        let right_edge = next(cone.way.edge());
        let left_edge = next(right_edge);
        let apex = triangle.corners[left_edge];
        let by = self.mesh.corners[apex as usize] - cone.root;
        let tolerance = |ray: Vector| RAY_TOLERANCE_MM * (ray.x.abs() + ray.y.abs());
        let (from_left, from_right) = (cross(cone.left, by), cross(cone.right, by));
        if from_left <= tolerance(cone.left) && from_right >= -tolerance(cone.right) {
            found.extend_from_slice(self.mesh.features_at(apex));
        }
        // Only parts of some width: what lies on a ray itself is within the tolerance of either part beside it.
        if from_left < 0.0 {
            let right = if from_right > 0.0 { by } else { cone.right };
            self.enter(room, Cone { right, ..*cone }, triangle.across[left_edge], limit);
        }
        if from_right > 0.0 {
            let left = if from_left < 0.0 { by } else { cone.left };
            self.enter(room, Cone { left, ..*cone }, triangle.across[right_edge], limit);
        }
    }

    /// Opens a cone that leaves its triangle by a way, unless what is there hides what lies behind it.
    fn enter(&self, room: &mut ConeRoom, mut cone: Cone, way: Way, limit: f64) {
        if way == Way::NONE || self.mesh.is_covered(self.terrain, way.triangle()) {
            return;
        }
        let (triangle, edge) = (&self.mesh.triangles[way.triangle() as usize], way.edge());
        let ends = [triangle.corners[edge], triangle.corners[next(edge)]];
        cone.way = way;
        cone.bound = self.bound(&cone, ends.map(|corner| self.mesh.corners[corner as usize]));
        if cone.bound <= limit { room.open.push(cone) } else { room.waiting.push(cone) }
    }

    /// What a path by a cone costs at least that crosses the edge between `left` and `right`.
    fn bound(&self, cone: &Cone, [left, right]: [Point; 2]) -> f64 {
        let along = right - left;
        // A target on this side of the edge is as far from it as its mirror image on the other.
        let off = cross(along, self.target - left);
        let mirrored = if off < 0.0 {
            self.target - left_of(along) * (2.0 * off / along.norm_squared())
        } else {
            self.target
        };
        let ahead = mirrored - cone.root;
        let ray = if cross(cone.left, ahead) > 0.0 {
            cone.left
        } else if cross(cone.right, ahead) < 0.0 {
            cone.right
        } else {
            return ahead.norm();
        };
        // Where the ray crosses the edge, as a share of it from the left.
        let (from_left, from_right) = (cross(ray, left - cone.root), cross(ray, right - cone.root));
        let share = from_left / (from_left - from_right);
        let by = left + along * if share.is_nan() { 0.5 } else { share.clamp(0.0, 1.0) };
        (by - cone.root).norm() + (mirrored - by).norm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PreparedScene;
    use crate::barrier::Side;
    use crate::search::{Ground, Tangent};
    use rand::RngExt;
    use traverse_geometry::{CornerStyle, Location, Obstacle, Polygon, Ring, Scene, unit};
    use traverse_solve::Seed;

    /// Stars that may cross each other, some of them in rows that share borders.
    fn scene(random: &mut impl RngExt, clearance_mm: f64) -> Scene {
        let is_row = random.random_bool(0.3);
        let obstacles = (0..random.random_range(1..30)).map(|i| {
            let center = if is_row {
                Point::new(10.0 * f64::from(i), 20.0)
            } else {
                Point::new(random.random_range(0.0..100.0), random.random_range(0.0..60.0))
            };
            let corners = if is_row { 4 } else { random.random_range(3..9) };
            let step = std::f64::consts::TAU / f64::from(corners);
            let points = (0..corners).map(|corner| {
                if is_row {
                    return center
                        + [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
                            .map(|(x, y)| Vector::new(x, y))[corner as usize];
                }
                center + unit(step * f64::from(corner)) * random.random_range(3.0..12.0)
            });
            let shape = Polygon::from_ring(Ring::new(points.collect(), vec![]).unwrap());
            Obstacle { id: format!("o{i}"), shape, clearance_mm: None, top_z_mm: None }
        });
        let obstacles = obstacles.collect();
        let (work_area, work_area_clearance_mm) = (None, None);
        Scene { work_area, obstacles, clearance_mm, work_area_clearance_mm, corner_style: CornerStyle::Round }
    }

    /// Every corner that a free tangent leads to is found, before any that only a dearer path can touch is needed.
    #[test]
    fn all_that_can_be_seen_is_found_in_time() {
        let (mut seen_count, mut found_count) = (0, 0);
        for seed in 0..200 {
            let mut random = Seed(seed).stream();
            let clearance = [0.0, 0.0, 0.7][seed as usize % 3];
            let scene = scene(&mut random, clearance);
            let mut prepared = PreparedScene::new(scene, &Budget::unlimited()).unwrap();
            prepared.triangulate(&Budget::unlimited()).unwrap();
            let (terrain, mesh) = (&prepared.terrain, prepared.mesh.get().unwrap());
            let mut at = || Point::new(random.random_range(-10.0..310.0), random.random_range(-10.0..70.0));
            for _ in 0..10 {
                let (start, target) = (at(), at());
                let straight = (target - start).norm();
                let is_covered = |obstacle: &Obstacle| obstacle.shape.locate(start) != Location::Outside;
                if prepared.scene.obstacles.iter().any(is_covered) {
                    continue;
                }
                let mut room = ConeRoom::default();
                let Some(mut cones) = Cones::new(terrain, mesh, [start, target], &[start], &mut room) else {
                    continue;
                };
                let (mut found, mut offered) = (Vec::new(), 0.0);
                while offered < f64::INFINITY {
                    offered =
                        cones.grow(&mut room, offered, &mut found, &Budget::unlimited()).unwrap().unwrap();
                    for feature in 0..terrain.features.len() as u32 {
                        let circle = terrain.feature(feature);
                        let least = (circle.center - start).norm() + (target - circle.center).norm()
                            - 2.0 * circle.plan_radius;
                        let is_seen = [Side::Left, Side::Right].iter().any(|side| {
                            let tangent =
                                Tangent::between(start, 0.0, circle.center, circle.plan_radius * side.sign());
                            tangent.is_some_and(|tangent| terrain.is_free(tangent.from, tangent.to))
                        });
                        if is_seen && least <= offered {
                            seen_count += 1;
                            assert!(
                                found.contains(&feature),
                                "seed {seed}: {feature} from {start:?}, {offered} of {straight}"
                            );
                        }
                    }
                }
                found_count += found.len();
            }
        }
        assert!(found_count < seen_count, "{found_count} for {seen_count}");
    }
}
