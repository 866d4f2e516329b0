//! Layouts of sections: requests for clients, placed sections of answers.

use super::path::point;
use super::request::polygon;
use crate::v1;
use traverse_checker::{CERTIFICATE_NODE_LIMIT, CERTIFIED_PAIR_LIMIT};
use traverse_geometry::{Motion, Part, PlacedSection, Pose, Section, SectionLayout, SlideRule, Vector};
use traverse_layout_sequencing::{Algorithm, EffectModel, InnerOverlap, OrderOptions};

/// The request that asks to order `layout`, by `options`, within the default time.
#[must_use]
pub fn order_request(layout: &SectionLayout, options: &OrderOptions) -> v1::OrderSectionsRequest {
    let id =
        |section: usize| layout.sections.get(section).map(|section| section.id.clone()).unwrap_or_default();
    let slide_rule = match layout.slide_rule {
        SlideRule::KeepOrder => v1::SlideRule::KeepOrder,
        SlideRule::Free => v1::SlideRule::Free,
    };
    let algorithm = match options.algorithm {
        Algorithm::Best => v1::SectionAlgorithm::Unspecified,
        Algorithm::GivenOrder => v1::SectionAlgorithm::GivenOrder,
        Algorithm::BranchAndBound => v1::SectionAlgorithm::BranchAndBound,
        Algorithm::AntColony => v1::SectionAlgorithm::AntColony,
        Algorithm::LocalImprovement => v1::SectionAlgorithm::LocalImprovement,
    };
    let effect_model = match options.effect_model {
        EffectModel::Exact => v1::EffectModel::Exact,
        EffectModel::Published => v1::EffectModel::Published,
    };
    v1::OrderSectionsRequest {
        sections: layout.sections.iter().map(section).collect(),
        gap_mm: layout.gap_mm,
        strip_height_mm: layout.strip_height_mm,
        first_section_id: layout.first.map(id).unwrap_or_default(),
        last_section_id: layout.last.map(id).unwrap_or_default(),
        precedences: (layout.precedences.iter())
            .map(|&(before, after)| v1::Precedence {
                before_section_id: id(before),
                after_section_id: id(after),
            })
            .collect(),
        forbidden_joins: (layout.forbidden_joins.iter())
            .map(|&(left, right)| v1::ForbiddenJoin {
                left_section_id: id(left),
                right_section_id: id(right),
            })
            .collect(),
        slide_rule: slide_rule.into(),
        effect_model: effect_model.into(),
        algorithm: algorithm.into(),
        options: Some(v1::SolveOptions {
            gap_limit: options.gap_limit.unwrap_or(0.0),
            seed: i64::try_from(options.seed.0).unwrap_or(i64::MAX),
            thread_count: i32::try_from(options.threads).unwrap_or(i32::MAX),
            ..Default::default()
        }),
        initial_order: (options.initial_order.iter().flatten())
            .map(|placed| placed_section(placed, layout))
            .collect(),
        allow_overlap_inside: options.inner_overlap == InnerOverlap::Allowed,
        ..Default::default()
    }
}

/// The request that asks whether what OrderSections answered is an answer to `request`: the layout, and what certifies its bound where
/// that was returned and is not more than CheckSections takes.
#[must_use]
pub fn check_sections_request(
    request: v1::OrderSectionsRequest,
    answer: &v1::OrderSectionsResponse,
) -> v1::CheckSectionsRequest {
    let report = answer.report.as_ref().filter(|report| {
        report.certificate.as_ref().is_some_and(|certificate| is_checkable(&request.sections, certificate))
    });
    let (certificate, claimed_lower_bound_mm) = match report {
        Some(report) => (report.certificate.clone(), report.certified_lower_bound),
        None => (None, None),
    };
    v1::CheckSectionsRequest {
        request: Some(request),
        order: answer.order.clone(),
        tolerance_mm: None,
        certificate,
        claimed_lower_bound_mm,
    }
}

/// Whether the checker takes a certificate of that many sections: duals are held against every pair.
fn is_checkable(sections: &[v1::Section], certificate: &v1::Certificate) -> bool {
    if certificate.row_duals.is_empty() {
        return true;
    }
    let items: usize = sections.iter().map(|section| section.allowed_poses.len().max(1)).sum();
    let listed: usize = certificate.sets.iter().map(|set| set.nodes.len()).sum();
    items.saturating_mul(items) <= CERTIFIED_PAIR_LIMIT && listed <= CERTIFICATE_NODE_LIMIT
}

fn section(section: &Section) -> v1::Section {
    v1::Section {
        id: section.id.clone(),
        parts: section.parts.iter().map(part).collect(),
        quantity: (section.quantity != 1).then(|| i32::try_from(section.quantity).unwrap_or(i32::MAX)),
        allowed_poses: section.poses.iter().map(|&it| pose(it).into()).collect(),
    }
}

fn part(part: &Part) -> v1::Part {
    v1::Part {
        id: part.id.clone(),
        shape: Some(polygon(&part.shape)),
        pole: Some(point(part.pole)),
        rotation_rad: part.rotation_rad,
        mirrored: part.mirrored,
    }
}

/// A pose on the wire.
pub(crate) fn pose(pose: Pose) -> v1::SectionPose {
    match pose {
        Pose::AsIs => v1::SectionPose::AsIs,
        Pose::HalfTurn => v1::SectionPose::HalfTurn,
        Pose::MirrorX => v1::SectionPose::MirrorX,
        Pose::MirrorY => v1::SectionPose::MirrorY,
    }
}

/// A placed section without its parts.
pub(super) fn placed_section(placed: &PlacedSection, layout: &SectionLayout) -> v1::PlacedSection {
    let section = layout.sections.get(placed.section);
    v1::PlacedSection {
        section_id: section.map(|section| section.id.clone()).unwrap_or_default(),
        copy: i32::try_from(placed.copy).unwrap_or(i32::MAX),
        pose: pose(placed.pose).into(),
        x_mm: placed.x_mm,
        y_mm: section.map_or(0.0, |section| section.bounds().min.y),
        parts: Vec::new(),
    }
}

/// Where the parts of a placed section lie: equation 1 of the paper.
pub(super) fn placed_parts(placed: &PlacedSection, section: &Section) -> Vec<v1::PlacedPart> {
    let into_layout = placed.motion(&section.bounds());
    let placed_part = |part: &Part| {
        let motion = part.motion().then(&into_layout);
        v1::PlacedPart {
            part_id: part.id.clone(),
            pole: Some(point(motion.point(traverse_geometry::Point::origin()))),
            rotation_rad: rotation_of(&motion),
            mirrored: motion.is_mirrored(),
        }
    };
    section.parts.iter().map(placed_part).collect()
}

/// The angle of a motion's rotation, in (−π, π]. The mirror leaves y alone, so y tells.
fn rotation_of(motion: &Motion) -> f64 {
    let up = motion.vector(Vector::y());
    let angle = (-up.x).atan2(up.y) + 0.0;
    if angle <= -std::f64::consts::PI { std::f64::consts::PI } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use traverse_geometry::{Point, Polygon, Ring};

    #[test]
    fn a_certificate_that_the_checker_would_refuse_is_left_out_with_its_bound() {
        let certificate = v1::Certificate { row_duals: vec![0.0], ..Default::default() };
        let report = v1::SolveReport {
            certificate: Some(certificate),
            certified_lower_bound: Some(1.0),
            ..Default::default()
        };
        let answer = v1::OrderSectionsResponse { report: Some(report), ..Default::default() };
        let asked = |count: usize| {
            let sections = vec![v1::Section::default(); count];
            let request = v1::OrderSectionsRequest { sections, ..Default::default() };
            let check = check_sections_request(request, &answer);
            (check.certificate.is_some(), check.claimed_lower_bound_mm)
        };
        assert_eq!(asked(2_400), (true, Some(1.0)));
        assert_eq!(asked(2_450), (false, None));
    }

    #[test]
    fn placed_parts_stand_where_their_section_puts_them() {
        let ring = Ring::from_xy(&[0.0, 0.0, 4.0, 0.0, 4.0, 2.0], &[]).expect("valid");
        let part = Part {
            id: "wedge".into(),
            shape: Polygon::from_ring(ring),
            pole: Point::new(10.0, 20.0),
            rotation_rad: 0.4,
            mirrored: true,
        };
        let section =
            Section { id: "s".into(), parts: vec![part.clone()], quantity: 1, poses: Pose::ALL.to_vec() };
        for pose in Pose::ALL {
            let placed = PlacedSection { section: 0, copy: 0, pose, x_mm: 7.0 };
            let into_layout = placed.motion(&section.bounds());
            let found = &placed_parts(&placed, &section)[0];
            let pole = found.pole.as_ref().expect("told");
            let again = Part {
                pole: Point::new(pole.x_mm, pole.y_mm),
                rotation_rad: found.rotation_rad,
                mirrored: found.mirrored,
                ..part.clone()
            };
            for vertex in part.shape.outer().vertices() {
                let wanted = into_layout.point(part.motion().point(*vertex));
                assert!((again.motion().point(*vertex) - wanted).norm() < 1e-9, "{pose:?}");
            }
            let left = part.in_section().moved(&into_layout).bounds().min.x;
            assert!((left - 7.0).abs() < 1e-9, "{pose:?}: {left}");
        }
    }
}
