//! What is wrong with a scene beyond its shapes, which are valid by construction.

use crate::{
    COORDINATE_LIMIT_MM, CornerStyle, Finding, LARGEST_CLEARANCE_MM, Reason, SMALLEST_CLEARANCE_MM, Scene,
    WORK_AREA_ID,
};
use std::collections::HashMap;

impl Scene {
    /// Everything that is wrong with ids, clearances, tops and the miter limit, in the order of the fields; none for a
    /// scene that engines take. Fields are relative to the scene's message: `obstacles[3].id`,
    /// `obstacles[2].clearance_mm`, `clearance_mm`, `work_area_clearance_mm`, `miter_limit`. Cost: linear.
    #[must_use]
    pub fn findings(&self) -> Vec<Finding> {
        let mut findings = Vec::new();
        let mut first_use = HashMap::new();
        for (number, obstacle) in self.obstacles.iter().enumerate() {
            findings.extend(id_finding(
                number,
                &obstacle.id,
                *first_use.entry(&obstacle.id).or_insert(number),
            ));
            let field = format!("obstacles[{number}].clearance_mm");
            findings.extend(obstacle.clearance_mm.and_then(|clearance| clearance_finding(field, clearance)));
            let field = format!("obstacles[{number}].top_z_mm");
            findings.extend(obstacle.top_z_mm.and_then(|top| height_finding(field, top)));
        }
        findings.extend(clearance_finding("clearance_mm".to_owned(), self.clearance_mm));
        findings.extend(
            self.work_area_clearance_mm
                .and_then(|clearance| clearance_finding("work_area_clearance_mm".to_owned(), clearance)),
        );
        if let CornerStyle::Miter { limit: Some(limit) } = self.corner_style {
            findings.extend(miter_finding(limit));
        }
        findings
    }
}

fn id_finding(number: usize, id: &str, first_use: usize) -> Option<Finding> {
    let field = format!("obstacles[{number}].id");
    if id.is_empty() {
        let message = format!("{field} is empty; give every obstacle an id of its own");
        Some(Finding::new(field, Reason::MissingField, "", message))
    } else if id == WORK_AREA_ID {
        let message = format!("{field} is {id:?}, which stands for the work area; choose another id");
        Some(Finding::new(field, Reason::DuplicateId, id, message))
    } else if first_use != number {
        let message = format!(
            "{field} is {id:?}, as is obstacles[{first_use}].id; give every obstacle an id of its own"
        );
        Some(Finding::new(field, Reason::DuplicateId, id, message))
    } else {
        None
    }
}

pub(crate) fn height_finding(field: String, z_mm: f64) -> Option<Finding> {
    let value = format!("{z_mm:?}");
    if !z_mm.is_finite() {
        let message = format!("{field} is {value}; send a finite number of millimetres");
        Some(Finding::new(field, Reason::NotFinite, value, message))
    } else if z_mm.abs() > COORDINATE_LIMIT_MM {
        let message = format!("{field} is {value} mm; send a height within ±{COORDINATE_LIMIT_MM:?} mm");
        Some(Finding::new(field, Reason::CoordinateTooLarge, value, message))
    } else {
        None
    }
}

pub(crate) fn clearance_finding(field: String, clearance: f64) -> Option<Finding> {
    let value = format!("{clearance:?}");
    if !clearance.is_finite() {
        let message = format!("{field} is {value}; send a finite number of millimetres, 0 for none");
        Some(Finding::new(field, Reason::NotFinite, value, message))
    } else if clearance != 0.0 && !(SMALLEST_CLEARANCE_MM..=LARGEST_CLEARANCE_MM).contains(&clearance) {
        let message = format!(
            "{field} is {value} mm; send 0, or {SMALLEST_CLEARANCE_MM:?} to {LARGEST_CLEARANCE_MM:?} mm"
        );
        Some(Finding::new(field, Reason::OutOfRange, value, message))
    } else {
        None
    }
}

fn miter_finding(limit: f64) -> Option<Finding> {
    let value = format!("{limit:?}");
    if !limit.is_finite() {
        let message = format!("miter_limit is {value}; send a finite number, at least 1, or leave it out");
        Some(Finding::new("miter_limit", Reason::NotFinite, value, message))
    } else if limit < 1.0 {
        let message = format!("miter_limit is {value}; send at least 1, or leave it out");
        Some(Finding::new("miter_limit", Reason::OutOfRange, value, message))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Obstacle, Polygon, Ring};

    fn scene() -> Scene {
        let square = || Ring::from_xy(&[0.0, 0.0, 1.0, 0.0, 1.0, 1.0], &[]).unwrap();
        let obstacle = |id: &str| Obstacle {
            id: id.to_owned(),
            shape: Polygon::from_ring(square()),
            clearance_mm: None,
            top_z_mm: None,
        };
        Scene {
            work_area: None,
            obstacles: vec![obstacle("a"), obstacle("b"), obstacle("c")],
            clearance_mm: 2.0,
            work_area_clearance_mm: None,
            corner_style: CornerStyle::Round,
        }
    }

    fn check(scene: &Scene, expected: &[(&str, Reason, &str)]) {
        let findings = scene.findings();
        let found: Vec<_> = findings
            .iter()
            .map(|finding| (finding.field.as_str(), finding.reason, finding.value.as_str()))
            .collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn a_good_scene_has_none() {
        check(&scene(), &[]);
        for clearance_mm in [0.0, -0.0, SMALLEST_CLEARANCE_MM, LARGEST_CLEARANCE_MM] {
            check(&Scene { clearance_mm, ..scene() }, &[]);
        }
        let corner_style = CornerStyle::Miter { limit: Some(1.0) };
        check(&Scene { corner_style, ..scene() }, &[]);
    }

    #[test]
    fn all_come_at_once() {
        let mut scene = scene();
        scene.obstacles[0].id.clear();
        scene.obstacles[1].id = "work_area".to_owned();
        scene.obstacles[1].clearance_mm = Some(-1.0);
        scene.obstacles.push(scene.obstacles[2].clone());
        scene.obstacles[3].clearance_mm = Some(f64::INFINITY);
        scene.obstacles[3].top_z_mm = Some(f64::NAN);
        scene.clearance_mm = f64::NAN;
        scene.work_area_clearance_mm = Some(1e6);
        scene.corner_style = CornerStyle::Miter { limit: Some(0.5) };
        check(
            &scene,
            &[
                ("obstacles[0].id", Reason::MissingField, ""),
                ("obstacles[1].id", Reason::DuplicateId, "work_area"),
                ("obstacles[1].clearance_mm", Reason::OutOfRange, "-1.0"),
                ("obstacles[3].id", Reason::DuplicateId, "c"),
                ("obstacles[3].clearance_mm", Reason::NotFinite, "inf"),
                ("obstacles[3].top_z_mm", Reason::NotFinite, "NaN"),
                ("clearance_mm", Reason::NotFinite, "NaN"),
                ("work_area_clearance_mm", Reason::OutOfRange, "1000000.0"),
                ("miter_limit", Reason::OutOfRange, "0.5"),
            ],
        );
        check(
            &Scene { clearance_mm: 1e-5, ..super::tests::scene() },
            &[("clearance_mm", Reason::OutOfRange, "1e-5")],
        );
        let corner_style = CornerStyle::Miter { limit: Some(f64::NAN) };
        check(&Scene { corner_style, ..super::tests::scene() }, &[("miter_limit", Reason::NotFinite, "NaN")]);
    }
}
