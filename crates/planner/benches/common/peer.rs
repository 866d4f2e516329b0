//! The peer: navigation meshes by the crate `polyanya`.

use glam::Vec2;
use polyanya::{Mesh, Triangulation};
use traverse_geometry::{Point, Ring, Scene};

pub(crate) fn mesh(scene: &Scene, merged: bool) -> Mesh {
    let ring = |ring: &Ring| ring.vertices().iter().map(|&p| to_vec2(p)).collect::<Vec<_>>();
    let mut triangulation = Triangulation::from_outer_edges(&ring(scene.work_area.as_ref().unwrap().outer()));
    triangulation.add_obstacles(scene.obstacles.iter().map(|obstacle| ring(obstacle.shape.outer())));
    let mut mesh = triangulation.as_navmesh();
    if merged {
        for layer in &mut mesh.layers {
            while layer.merge_polygons() {}
        }
    }
    mesh.bake();
    mesh
}

pub(crate) fn to_vec2(p: Point) -> Vec2 {
    Vec2::new(p.x as f32, p.y as f32)
}
