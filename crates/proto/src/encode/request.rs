//! Requests, for clients that plan from domain types.

use super::path;
use crate::v1::{self, travel_cost::Measure};
use traverse_geometry::{
    ArcOutput, CornerStyle, EndRule, Obstacle, Path, Polygon, RapidMotion, RapidRules, Ring, Scene,
    TravelCost,
};
use traverse_planner::{Algorithm, RapidMove};

/// The request that asks for `query` in `scene`, within the default effort.
#[must_use]
pub fn plan_request(scene: &Scene, query: &RapidMove) -> v1::PlanRapidMoveRequest {
    let algorithm = match query.algorithm {
        Algorithm::Exact => v1::RapidAlgorithm::Exact,
        Algorithm::SupportingLines => v1::RapidAlgorithm::SupportingLines,
    };
    v1::PlanRapidMoveRequest {
        scene: Some(scene_message(scene)),
        start: Some(path::point(query.start)),
        target: Some(path::point(query.target)),
        rules: Some(v1::RapidRules { algorithm: algorithm.into(), ..rules(&query.rules) }),
        validate_only: false,
    }
}

/// The request that asks whether `path` answers `request`.
#[must_use]
pub fn check_request(request: v1::PlanRapidMoveRequest, path: &Path) -> v1::CheckRapidMoveRequest {
    v1::CheckRapidMoveRequest { request: Some(request), path: Some(path::path(path)), tolerance_mm: None }
}

pub(super) fn rules(rules: &RapidRules) -> v1::RapidRules {
    v1::RapidRules {
        cost: cost(&rules.cost),
        motion: match rules.motion {
            RapidMotion::Linear => v1::RapidMotion::Unspecified,
            RapidMotion::DogLeg => v1::RapidMotion::DogLeg,
        }
        .into(),
        arcs: match rules.arcs {
            ArcOutput::Arcs => v1::ArcOutput::Unspecified,
            ArcOutput::Chords => v1::ArcOutput::Chords,
        }
        .into(),
        heights: rules.heights.map(|rule| v1::HeightRule {
            start_z_mm: rule.start_z_mm,
            target_z_mm: rule.target_z_mm,
            highest_z_mm: rule.highest_z_mm,
            clearance_z_mm: rule.clearance_z_mm,
        }),
        clearances_mm: rules.clearances_mm.clone(),
        leave: end_rule(rules.leave),
        enter: end_rule(rules.enter),
        alternative_count: i32::try_from(rules.alternative_count).unwrap_or(i32::MAX),
        ..Default::default()
    }
}

fn cost(cost: &TravelCost) -> Option<v1::TravelCost> {
    let measure = match cost {
        TravelCost::Length => return None,
        TravelCost::AxisSpeeds(speeds) => Measure::AxisSpeeds(v1::travel_cost::AxisSpeeds {
            x_mm_per_s: speeds.x_mm_per_s,
            y_mm_per_s: speeds.y_mm_per_s,
            z_mm_per_s: speeds.z_mm_per_s,
        }),
        TravelCost::Kinematics(limits) => Measure::Kinematics(v1::travel_cost::Kinematics {
            speed_mm_per_s: limits.speed_mm_per_s,
            z_mm_per_s: limits.z_mm_per_s,
            acceleration_mm_per_s2: limits.acceleration_mm_per_s2,
            junction_deviation_mm: limits.junction_deviation_mm,
            feed_mm_per_s: limits.feed_mm_per_s,
        }),
    };
    Some(v1::TravelCost { measure: Some(measure) })
}

fn end_rule(rule: EndRule) -> Option<v1::EndRule> {
    let rule = match rule {
        EndRule::Refuse => return None,
        EndRule::Nearest => v1::end_rule::Rule::Nearest(v1::end_rule::NearestWay {}),
        EndRule::Direction(direction) => {
            v1::end_rule::Rule::Direction(v1::Point { x_mm: direction.x, y_mm: direction.y })
        }
    };
    Some(v1::EndRule { rule: Some(rule) })
}

/// A scene as its message.
#[must_use]
pub fn scene_message(scene: &Scene) -> v1::Scene {
    let (corner_style, miter_limit) = match scene.corner_style {
        CornerStyle::Round => (v1::CornerStyle::Round, None),
        CornerStyle::Miter { limit } => (v1::CornerStyle::Miter, limit),
    };
    v1::Scene {
        work_area: scene.work_area.as_ref().map(polygon),
        obstacles: scene.obstacles.iter().map(obstacle).collect(),
        clearance_mm: scene.clearance_mm,
        corner_style: corner_style.into(),
        work_area_clearance_mm: scene.work_area_clearance_mm,
        miter_limit,
    }
}

fn obstacle(obstacle: &Obstacle) -> v1::Obstacle {
    v1::Obstacle {
        id: obstacle.id.clone(),
        shape: Some(polygon(&obstacle.shape)),
        clearance_mm: obstacle.clearance_mm,
        top_z_mm: obstacle.top_z_mm,
    }
}

pub(super) fn polygon(polygon: &Polygon) -> v1::Polygon {
    v1::Polygon { outer: Some(ring(polygon.outer())), holes: polygon.holes().iter().map(ring).collect() }
}

fn ring(ring: &Ring) -> v1::Ring {
    v1::Ring {
        xy_mm: ring.vertices().iter().flat_map(|p| [p.x, p.y]).collect(),
        bulges: ring.bulges().to_vec(),
    }
}
