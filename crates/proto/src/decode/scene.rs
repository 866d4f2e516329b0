//! Scenes.

use super::reader::Reader;
use super::shape::wire_vertices;
use crate::limits::ID_BYTES;
use crate::text::shortened;
use crate::v1;
use std::collections::HashMap;
use traverse_geometry::WORK_AREA_ID;
use traverse_geometry::{CornerStyle, Finding, Obstacle, Reason, Scene};

impl Reader<'_> {
    /// Whether the scene is small enough to be read. Cheap: nothing is validated yet.
    pub(crate) fn scene_fits(&mut self, field: &str, scene: &v1::Scene) {
        let obstacles = scene.obstacles.len();
        self.at_most(&format!("{field}.obstacles"), "obstacles", obstacles, self.limits.obstacle_count);
        let shapes =
            scene.obstacles.iter().filter_map(|obstacle| obstacle.shape.as_ref()).chain(&scene.work_area);
        let vertices: usize = shapes.map(wire_vertices).sum();
        self.at_most(field, "vertices", vertices, self.limits.vertex_count);
    }

    /// A scene; absent: nothing is in the way.
    pub(crate) fn scene(&mut self, field: &str, scene: Option<v1::Scene>) -> Option<Scene> {
        let scene = scene.unwrap_or_default();
        let clearance_mm = self.clearance(&format!("{field}.clearance_mm"), scene.clearance_mm);
        let work_area_clearance_mm = scene
            .work_area_clearance_mm
            .and_then(|mm| self.clearance(&format!("{field}.work_area_clearance_mm"), mm));
        let corner_style = self.corner_style(field, scene.corner_style, scene.miter_limit);
        let has_work_area = scene.work_area.is_some();
        let work_area =
            scene.work_area.and_then(|polygon| self.polygon(&format!("{field}.work_area"), Some(polygon)));
        let obstacles = self.obstacles(&format!("{field}.obstacles"), scene.obstacles);
        if has_work_area && work_area.is_none() {
            return None;
        }
        Some(Scene {
            work_area,
            obstacles: obstacles?,
            clearance_mm: clearance_mm?,
            work_area_clearance_mm,
            corner_style: corner_style?,
        })
    }

    fn corner_style(&mut self, field: &str, style: i32, miter_limit: Option<f64>) -> Option<CornerStyle> {
        let limit_field = format!("{field}.miter_limit");
        let limit =
            miter_limit.and_then(|limit| self.within(&limit_field, limit, |limit| limit >= 1.0, "1 or more"));
        match v1::CornerStyle::try_from(style) {
            Ok(v1::CornerStyle::Miter) => Some(CornerStyle::Miter { limit }),
            Ok(v1::CornerStyle::Unspecified | v1::CornerStyle::Round) => {
                if let Some(limit) = miter_limit {
                    let message =
                        "round corners have no miter limit; leave it out or ask for CORNER_STYLE_MITER";
                    self.report(Finding::new(limit_field, Reason::NotApplicable, limit, message));
                }
                Some(CornerStyle::Round)
            }
            Err(_) => {
                let known = ["CORNER_STYLE_ROUND (1)", "CORNER_STYLE_MITER (2)"];
                self.unknown_enum_value(&format!("{field}.corner_style"), style, &known);
                None
            }
        }
    }

    /// A list of obstacles with ids that differ.
    pub(crate) fn obstacles(&mut self, list: &str, obstacles: Vec<v1::Obstacle>) -> Option<Vec<Obstacle>> {
        let mut first_with: HashMap<String, usize> = HashMap::new();
        let mut read = Vec::with_capacity(obstacles.len());
        let mut complete = true;
        for (index, obstacle) in obstacles.into_iter().enumerate() {
            if !self.goes_on() {
                return None;
            }
            let field = format!("{list}[{index}]");
            self.id(list, index, &obstacle.id, &mut first_with);
            let clearance_mm =
                obstacle.clearance_mm.and_then(|mm| self.clearance(&format!("{field}.clearance_mm"), mm));
            let top_z_mm = obstacle.top_z_mm.and_then(|mm| self.coordinate(&format!("{field}.top_z_mm"), mm));
            match self.polygon(&format!("{field}.shape"), obstacle.shape) {
                Some(shape) => read.push(Obstacle { id: obstacle.id, shape, clearance_mm, top_z_mm }),
                None => complete = false,
            }
        }
        complete.then_some(read)
    }

    fn id(&mut self, list: &str, index: usize, id: &str, first_with: &mut HashMap<String, usize>) {
        let field = format!("{list}[{index}].id");
        if id.is_empty() {
            self.missing(&field, "an id of your own; answers name obstacles by it");
        } else if id.len() > ID_BYTES {
            self.out_of_range(&field, id, &format!("an id of at most {ID_BYTES} bytes"));
        } else if id == WORK_AREA_ID {
            self.out_of_range(&field, id, "another id: answers call the border so");
        } else if let Some(first) = first_with.get(id) {
            let message =
                format!("{list}[{first}] has the id {} already; send each id once", shortened(id, 100));
            self.report(Finding::new(field, Reason::DuplicateId, id, message));
        } else {
            first_with.insert(id.to_owned(), index);
        }
    }
}
