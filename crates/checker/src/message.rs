//! Wording of violations.

use traverse_geometry::{Scene, WORK_AREA_ID};

/// A length for people: up to nine decimals, no trailing zeros.
pub(crate) fn millimetres(length: f64) -> String {
    if length.abs() >= 1e9 {
        return format!("{length:e}");
    }
    let text = format!("{length:.9}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The obstacle's id, or that of the work area.
pub(crate) fn solid_id(scene: &Scene, obstacle: Option<usize>) -> &str {
    obstacle.map_or(WORK_AREA_ID, |index| scene.obstacles[index].id.as_str())
}

/// `obstacle a`, or `the border of the work area`.
pub(crate) fn solid_name(scene: &Scene, obstacle: Option<usize>) -> String {
    match obstacle {
        Some(index) => format!("obstacle {}", scene.obstacles[index].id),
        None => "the border of the work area".to_owned(),
    }
}
