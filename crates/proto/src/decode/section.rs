//! Sections, their parts, poses and quantities.

use super::reader::Reader;
use super::shape::wire_vertices;
use crate::limits::ID_BYTES;
use crate::text::shortened;
use crate::v1;
use std::collections::HashMap;
use traverse_geometry::{Finding, Part, Point, Pose, Reason, Section, SectionLayout};

/// The ids of a list, by place.
#[derive(Default)]
pub(crate) struct Ids(HashMap<String, usize>);

impl Ids {
    /// Those of the sections of a layout.
    pub(crate) fn of(layout: &SectionLayout) -> Self {
        Self(layout.sections.iter().enumerate().map(|(place, section)| (section.id.clone(), place)).collect())
    }

    /// The place of an id.
    pub(crate) fn place(&self, id: &str) -> Option<usize> {
        self.0.get(id).copied()
    }
}

impl Reader<'_> {
    /// Whether the sections are few enough to be read. Cheap: nothing is validated yet.
    pub(crate) fn sections_fit(&mut self, field: &str, sections: &[v1::Section]) {
        let copies = sections.iter().map(|section| copies(section).max(1)).fold(0, usize::saturating_add);
        self.at_most(field, "sections with all their copies", copies, self.limits.section_count);
        let parts = sections.iter().map(|section| section.parts.len()).sum();
        self.at_most(field, "parts", parts, self.limits.part_count);
        let shapes =
            sections.iter().flat_map(|section| &section.parts).filter_map(|part| part.shape.as_ref());
        self.at_most(field, "vertices", shapes.map(wire_vertices).sum(), self.limits.vertex_count);
    }

    /// The sections of a layout, and their ids.
    pub(crate) fn sections(
        &mut self,
        field: &str,
        sections: Vec<v1::Section>,
    ) -> (Option<Vec<Section>>, Ids) {
        if sections.is_empty() {
            self.missing(field, "at least one section");
        }
        let mut ids = Ids::default();
        let mut read = Vec::with_capacity(sections.len());
        let mut is_complete = !sections.is_empty();
        for (index, section) in sections.into_iter().enumerate() {
            if !self.goes_on() {
                return (None, ids);
            }
            let what = || (format!("{field}[{index}]"), "section");
            self.unique_id(what, field, index, &section.id, &mut ids);
            match self.section(&format!("{field}[{index}]"), section) {
                Some(section) => read.push(section),
                None => is_complete = false,
            }
        }
        (is_complete.then_some(read), ids)
    }

    fn section(&mut self, field: &str, section: v1::Section) -> Option<Section> {
        let quantity = self.quantity(&format!("{field}.quantity"), section.quantity);
        let poses = self.poses(&format!("{field}.allowed_poses"), &section.allowed_poses);
        let parts = self.parts(&format!("{field}.parts"), section.parts);
        Some(Section { id: section.id, parts: parts?, quantity: quantity?, poses: poses? })
    }

    fn quantity(&mut self, field: &str, quantity: Option<i32>) -> Option<u32> {
        let quantity = quantity.unwrap_or(1);
        match u32::try_from(quantity) {
            Ok(quantity) if quantity > 0 => Some(quantity),
            _ => {
                self.out_of_range(field, quantity, "1 or more, or leave it out for 1");
                None
            }
        }
    }

    fn poses(&mut self, field: &str, poses: &[i32]) -> Option<Vec<Pose>> {
        if poses.is_empty() {
            return Some(vec![Pose::AsIs]);
        }
        let mut read = Vec::new();
        let mut is_complete = true;
        // What is repeated without end is told once.
        for (index, &pose) in poses.iter().enumerate().take(Pose::ALL.len() + 1) {
            let field = format!("{field}[{index}]");
            match self.pose(&field, pose) {
                Some(pose) if read.contains(&pose) => {
                    let message = "the pose is listed already; send each once";
                    self.report(Finding::new(field, Reason::DuplicateId, pose_name(pose), message));
                    is_complete = false;
                }
                Some(pose) => read.push(pose),
                None => is_complete = false,
            }
        }
        is_complete.then_some(read)
    }

    /// A pose; unspecified: as is.
    pub(crate) fn pose(&mut self, field: &str, pose: i32) -> Option<Pose> {
        match v1::SectionPose::try_from(pose) {
            Ok(v1::SectionPose::Unspecified | v1::SectionPose::AsIs) => Some(Pose::AsIs),
            Ok(v1::SectionPose::HalfTurn) => Some(Pose::HalfTurn),
            Ok(v1::SectionPose::MirrorX) => Some(Pose::MirrorX),
            Ok(v1::SectionPose::MirrorY) => Some(Pose::MirrorY),
            Err(_) => {
                let known = [
                    "SECTION_POSE_AS_IS (1)",
                    "SECTION_POSE_HALF_TURN (2)",
                    "SECTION_POSE_MIRROR_X (3)",
                    "SECTION_POSE_MIRROR_Y (4)",
                ];
                self.unknown_enum_value(field, pose, &known);
                None
            }
        }
    }

    fn parts(&mut self, field: &str, parts: Vec<v1::Part>) -> Option<Vec<Part>> {
        if parts.is_empty() {
            self.missing(field, "at least one part: a section without parts takes no place");
            return None;
        }
        let mut ids = Ids::default();
        let mut read = Vec::with_capacity(parts.len());
        let mut is_complete = true;
        for (index, part) in parts.into_iter().enumerate() {
            if !self.goes_on() {
                return None;
            }
            let what = || (format!("{field}[{index}]"), "part");
            self.unique_id(what, field, index, &part.id, &mut ids);
            match self.part(&format!("{field}[{index}]"), part) {
                Some(part) => read.push(part),
                None => is_complete = false,
            }
        }
        is_complete.then_some(read)
    }

    fn part(&mut self, field: &str, part: v1::Part) -> Option<Part> {
        let pole = match part.pole {
            None => Some(Point::origin()),
            pole => self.point(&format!("{field}.pole"), pole),
        };
        let rotation_rad = self.finite(&format!("{field}.rotation_rad"), part.rotation_rad);
        let shape = self.polygon(&format!("{field}.shape"), part.shape);
        let part = Part {
            id: part.id,
            shape: shape?,
            pole: pole?,
            rotation_rad: rotation_rad?,
            mirrored: part.mirrored,
        };
        Some(part)
    }

    /// Reports an id that is missing, too long or taken.
    fn unique_id(
        &mut self,
        what: impl Fn() -> (String, &'static str),
        list: &str,
        index: usize,
        id: &str,
        ids: &mut Ids,
    ) {
        let (field, kind) = what();
        let field = format!("{field}.id");
        if id.is_empty() {
            self.missing(&field, &format!("an id of your own; answers name each {kind} by it"));
        } else if id.len() > ID_BYTES {
            self.out_of_range(&field, id, &format!("an id of at most {ID_BYTES} bytes"));
        } else if let Some(first) = ids.place(id) {
            let message =
                format!("{list}[{first}] has the id {} already; send each id once", shortened(id, 100));
            self.report(Finding::new(field, Reason::DuplicateId, id, message));
        } else {
            ids.0.insert(id.to_owned(), index);
        }
    }

    /// The place of a section named by its id.
    pub(crate) fn section_named(&mut self, field: &str, id: &str, ids: &Ids) -> Option<usize> {
        if id.is_empty() {
            self.missing(field, "the id of a section of the request");
            return None;
        }
        let place = ids.place(id);
        if place.is_none() {
            let shown = shortened(id, 100);
            let message = format!("no section has the id {shown}; send one of the ids in sections");
            self.report(Finding::new(field, Reason::UnknownId, shown, message));
        }
        place
    }
}

/// The count of copies; what is wrong counts as none.
fn copies(section: &v1::Section) -> usize {
    usize::try_from(section.quantity.unwrap_or(1)).unwrap_or(0)
}

fn pose_name(pose: Pose) -> &'static str {
    crate::encode::pose(pose).as_str_name()
}
