//! Work area, barriers and obstacles.

use super::Shown;
use super::frame::{Box2, Frame};
use super::outline::polygon_data;
use super::square_cut;
use super::style::BARRIER_LINE;
use super::text::{escaped, millimetres};
use std::fmt::Write;
use traverse_geometry::{CornerStyle, MITER_RATIO_LIMIT, Polygon, Scene, WORK_AREA_ID};

/// More obstacles than this are drawn with finer lines.
const FINE_FROM: usize = 400;

pub(super) fn draw(svg: &mut String, scene: &Scene, shown: &Shown<'_>, frame: &Frame) {
    let obstacles: Vec<String> =
        scene.obstacles.iter().map(|obstacle| polygon_data(&obstacle.shape, frame)).collect();
    let border = scene.work_area.as_ref().map(|area| polygon_data(area, frame));
    if let Some(border) = &border {
        let _ = writeln!(
            svg,
            "{}\n\
             <path class=\"inside\" fill-rule=\"evenodd\" d=\"{border}\"/>\n\
             <clipPath id=\"work-area\"><path clip-rule=\"evenodd\" d=\"{border}\"/></clipPath>",
            rect(&frame.area, " class=\"outside\"")
        );
    }
    let passed: Vec<bool> =
        scene.obstacles.iter().map(|obstacle| shown.passes_over(scene, obstacle)).collect();
    let mitred = scene.corner_style != CornerStyle::Round;
    if border.is_none() && mitred {
        // Control points may lie far outside.
        let _ = writeln!(svg, "<clipPath id=\"work-area\">{}</clipPath>", rect(&frame.area, ""));
    }
    // All rims first, then all barriers: what remains of the rims is the outline of the union.
    let fine = scene.obstacles.len() > FINE_FROM;
    let line = if fine { BARRIER_LINE / 2.0 } else { BARRIER_LINE };
    for (class, rim) in [("rim", 2.0 * line), ("barrier", 0.0)] {
        // Where the tool may not be at all, barriers say nothing.
        let clip = if border.is_some() || mitred { " clip-path=\"url(#work-area)\"" } else { "" };
        let _ = writeln!(svg, "<g class=\"{class}\"{}{clip}>", joins(scene.corner_style));
        let gone_round = scene.obstacles.iter().zip(&obstacles).zip(&passed).filter(|(_, passed)| !**passed);
        for ((obstacle, data), _) in gone_round {
            let clearance = scene.clearance_of(obstacle);
            stroke(svg, data, 2.0 * clearance * frame.scale, rim);
            let rings = obstacle.shape.region_left_rings();
            fill(svg, &square_cut::data(rings, clearance, scene.corner_style, frame), rim);
        }
        if let Some(border) = &border {
            let width = 2.0 * scene.border_clearance() * frame.scale;
            stroke(svg, border, width, rim);
            // Here what lies outside is grown.
            let rings =
                scene.work_area.iter().flat_map(Polygon::region_left_rings).map(|ring| ring.reversed());
            fill(svg, &square_cut::data(rings, scene.border_clearance(), scene.corner_style, frame), rim);
        }
        svg.push_str("</g>\n");
    }
    svg.push_str(if fine { "<g class=\"fine\">\n" } else { "<g>\n" });
    for ((obstacle, data), passed) in scene.obstacles.iter().zip(&obstacles).zip(&passed) {
        let class = match (shown.parts(&obstacle.id), passed) {
            (true, _) => "obstacle parts",
            (false, true) => "obstacle passed",
            (false, false) => "obstacle",
        };
        let top =
            obstacle.top_z_mm.map_or_else(String::new, |top| format!(", top at z = {}", millimetres(top)));
        let id = escaped(&format!("{}{top}", obstacle.id));
        let _ = writeln!(svg, "<path class=\"{class}\" d=\"{data}\"><title>{id}</title></path>");
    }
    svg.push_str("</g>\n");
    if let Some(border) = &border {
        let class = if shown.parts(WORK_AREA_ID) { "border parts" } else { "border" };
        let _ = writeln!(svg, "<path class=\"{class}\" d=\"{border}\"/>");
    }
}

fn rect(area: &Box2, class: &str) -> String {
    let (width, height) = (area.right - area.left, area.bottom - area.top);
    format!(
        "<rect{class} x=\"{:.1}\" y=\"{:.1}\" width=\"{width:.1}\" height=\"{height:.1}\"/>",
        area.left, area.top
    )
}

/// The band within the clearance of a border; none for clearance 0.
fn stroke(svg: &mut String, data: &str, width: f64, rim: f64) {
    if width > 0.0 {
        let _ = writeln!(svg, "<path d=\"{data}\" stroke-width=\"{:.2}\"/>", width + rim);
    }
}

/// What a stroke leaves out; nothing when there is none.
fn fill(svg: &mut String, data: &str, rim: f64) {
    if !data.is_empty() {
        let _ = writeln!(svg, "<path class=\"cut\" d=\"{data}\" stroke-width=\"{rim:.2}\"/>");
    }
}

fn joins(style: CornerStyle) -> String {
    match style {
        CornerStyle::Round => String::from(" stroke-linejoin=\"round\""),
        CornerStyle::Miter { limit } => {
            let limit = limit.unwrap_or(MITER_RATIO_LIMIT).max(1.0);
            format!(" stroke-linejoin=\"miter\" stroke-miterlimit=\"{limit}\"")
        }
    }
}
