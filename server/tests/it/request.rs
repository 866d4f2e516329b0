//! Requests to send.

use traverse_proto::v1;

pub(crate) fn point(x_mm: f64, y_mm: f64) -> Option<v1::Point> {
    Some(v1::Point { x_mm, y_mm })
}

pub(crate) fn square(x: f64, y: f64, side: f64) -> v1::Polygon {
    let (right, top) = (x + side, y + side);
    let outer = v1::Ring { xy_mm: vec![x, y, right, y, right, top, x, top], bulges: vec![] };
    v1::Polygon { outer: Some(outer), holes: vec![] }
}

pub(crate) fn obstacle(id: &str, shape: v1::Polygon) -> v1::Obstacle {
    v1::Obstacle { id: id.to_owned(), shape: Some(shape), clearance_mm: None, top_z_mm: None }
}

/// Past a square of 10 mm between start and target, 3 mm away from it.
pub(crate) fn past_a_block() -> v1::PlanRapidMoveRequest {
    v1::PlanRapidMoveRequest {
        scene: Some(v1::Scene {
            obstacles: vec![obstacle("block", square(0.0, 0.0, 10.0))],
            clearance_mm: 3.0,
            ..Default::default()
        }),
        start: point(-5.0, 2.0),
        target: point(15.0, 2.0),
        ..Default::default()
    }
}

pub(crate) fn with_time_limit(seconds: i64, nanos: i32) -> v1::PlanRapidMoveRequest {
    let options =
        v1::SolveOptions { time_limit: Some(prost_types::Duration { seconds, nanos }), ..Default::default() };
    v1::PlanRapidMoveRequest {
        rules: Some(v1::RapidRules { options: Some(options), ..Default::default() }),
        ..past_a_block()
    }
}

/// [`past_a_block`] as proto3 JSON.
pub(crate) const PAST_A_BLOCK: &str = r#"{
  "scene": {
    "obstacles": [{"id": "block", "shape": {"outer": {"xy_mm": [0, 0, 10, 0, 10, 10, 0, 10]}}}],
    "clearance_mm": 3
  },
  "start": {"x_mm": -5, "y_mm": 2},
  "target": {"x_mm": 15, "y_mm": 2}
}"#;

pub(crate) const PAST_A_BLOCK_MM: f64 = 24.772_546_673;
