//! GetLimits' answer.

use crate::config::Config;
use std::time::Duration;
use traverse_geometry::{COORDINATE_LIMIT_MM, RADIUS_LIMIT_MM};
use traverse_proto::v1::GetLimitsResponse;

/// What this server accepts.
pub(crate) fn limits_answer(config: &Config) -> GetLimitsResponse {
    let limits = &config.limits;
    GetLimitsResponse {
        server_version: env!("CARGO_PKG_VERSION").to_owned(),
        message_bytes: wide(limits.message_bytes),
        coordinate_mm: COORDINATE_LIMIT_MM,
        vertex_count: wide(limits.vertex_count),
        obstacle_count: narrow(limits.obstacle_count),
        section_count: narrow(limits.section_count),
        part_count: narrow(limits.part_count),
        join_count: wide(limits.join_count),
        default_time_limit: duration(config.default_time_limit),
        longest_time_limit: duration(config.longest_time_limit),
        queued_call_count: narrow(config.queued_call_count),
        radius_mm: RADIUS_LIMIT_MM,
        step_count: wide(limits.step_count),
    }
}

fn narrow(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

fn wide(count: usize) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

fn duration(duration: Duration) -> Option<prost_types::Duration> {
    duration.try_into().ok()
}
