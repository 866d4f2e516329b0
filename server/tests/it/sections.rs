//! OrderSections and CheckSections over the socket.

use crate::bad_input::{findings, found, reason};
use crate::http::call;
use crate::request::{point, square};
use crate::running::Running;
use rand::RngExt;
use std::time::Duration;
use tonic::Code;
use traverse_geometry::Finding;
use traverse_layout_sequencing::{Algorithm, LayoutAnswer, OrderOptions, order_sections};
use traverse_proto::{OrderQuestion, v1};
use traverse_server::{Config, Engines};
use traverse_solve::{Budget, Observer, Seed, Silent};

fn part(id: &str, xy_mm: Vec<f64>) -> v1::Part {
    let outer = v1::Ring { xy_mm, bulges: vec![] };
    let shape = Some(v1::Polygon { outer: Some(outer), holes: vec![] });
    v1::Part { id: id.to_owned(), shape, ..Default::default() }
}

fn section(id: &str, parts: Vec<v1::Part>) -> v1::Section {
    v1::Section { id: id.to_owned(), parts, ..Default::default() }
}

/// A point to the right, a notch for it at the left, and a block: the arrow joins the notch tightly.
fn arrows() -> v1::OrderSectionsRequest {
    let arrow = part("arrow", vec![0.0, 0.0, 60.0, 0.0, 100.0, 50.0, 60.0, 100.0, 0.0, 100.0]);
    let notch = part("notch", vec![0.0, 0.0, 90.0, 0.0, 90.0, 100.0, 0.0, 100.0, 40.0, 50.0]);
    let mut block = part("block", vec![0.0, 0.0, 30.0, 0.0, 30.0, 100.0, 0.0, 100.0]);
    block.pole = point(5.0, 0.0);
    let mut twice = section("block", vec![block]);
    twice.quantity = Some(2);
    v1::OrderSectionsRequest {
        sections: vec![section("notch", vec![notch]), twice, section("arrow", vec![arrow])],
        ..Default::default()
    }
}

async fn ordered(server: &Running, request: v1::OrderSectionsRequest) -> v1::OrderSectionsResponse {
    server.client().await.order_sections(request).await.expect("sound").into_inner()
}

async fn refused(server: &Running, request: v1::OrderSectionsRequest) -> tonic::Status {
    server.client().await.order_sections(request).await.expect_err("something is wrong")
}

#[tokio::test]
async fn sections_are_ordered_and_their_check_finds_the_layout_sound() {
    let server = Running::start().await;
    let request = v1::OrderSectionsRequest {
        return_joins: true,
        return_contacts: true,
        return_parts: true,
        options: Some(v1::SolveOptions { return_certificate: true, ..Default::default() }),
        ..arrows()
    };
    let answer = ordered(&server, request.clone()).await;
    assert!((answer.length_mm - 210.0).abs() < 1e-5, "{answer:?}");
    assert_eq!(answer.bounding_box_length_mm, 250.0);
    let arrow = answer.order.iter().position(|placed| placed.section_id == "arrow").expect("placed");
    assert_eq!(answer.order[arrow + 1].section_id, "notch");
    let mut copies: Vec<i32> =
        answer.order.iter().filter(|placed| placed.section_id == "block").map(|placed| placed.copy).collect();
    copies.sort_unstable();
    assert_eq!(copies, [0, 1]);
    for placed in answer.order.iter().filter(|placed| placed.section_id == "block") {
        let [part] = &placed.parts[..] else { panic!("{placed:?}") };
        let pole = part.pole.as_ref().expect("told");
        assert!((pole.x_mm - placed.x_mm).abs() < 1e-9 && part.part_id == "block", "{placed:?}");
    }

    let report = answer.report.as_ref().expect("told");
    assert!(report.proven_optimal && report.cost == answer.length_mm, "{report:?}");
    assert_eq!(report.lower_bound, Some(answer.length_mm));
    assert_eq!((report.cost_unit(), report.stop_reason()), (v1::CostUnit::Mm, v1::StopReason::ProvenOptimal));
    assert!(report.certified_lower_bound.is_some_and(|bound| bound <= answer.length_mm && bound > 0.0));
    assert!(
        report.certificate.is_some() && !report.improvements.is_empty() && report.solve_duration.is_some()
    );
    let joins = answer.joins.as_ref().expect("asked for");
    assert_eq!((joins.items.len(), joins.effect_mm.len()), (3, 9));
    // The notch (item 0) joins the arrow (item 2) by 40 mm.
    assert!((joins.effect_mm[2 * 3] - 40.0).abs() < 1e-5, "{joins:?}");
    assert_eq!(answer.contacts.len(), 3);

    let check = v1::CheckSectionsRequest {
        request: Some(request),
        order: answer.order.clone(),
        ..Default::default()
    };
    let sound = server.client().await.check_sections(check.clone()).await.expect("sound").into_inner();
    assert_eq!(sound.violations, []);
    assert!((sound.length_mm - answer.length_mm).abs() < 1e-9 && sound.smallest_margin_mm.is_some());
    assert_eq!(sound.certified_lower_bound_mm, None);
    let mut nearer = check;
    nearer.order[arrow + 1].x_mm -= 0.5;
    let found = server.client().await.check_sections(nearer).await.expect("sound").into_inner();
    let [violation] = &found.violations[..] else { panic!("{found:?}") };
    assert_eq!((violation.reason.as_str(), violation.obstacle_id.as_str()), ("SECTIONS_OVERLAP", "arrow"));
    assert_eq!(violation.field, format!("order[{}]", arrow + 1));
}

#[tokio::test]
async fn what_is_not_asked_for_is_not_answered() {
    let server = Running::start().await;
    let answer = ordered(&server, arrows()).await;
    assert_eq!((answer.joins, answer.contacts.len()), (None, 0));
    assert!(answer.order.iter().all(|placed| placed.parts.is_empty()));
    assert_eq!(answer.report.expect("told").certificate, None);
    let valid = ordered(&server, v1::OrderSectionsRequest { validate_only: true, ..arrows() }).await;
    assert_eq!(valid, v1::OrderSectionsResponse::default());
}

#[tokio::test]
async fn curl_orders_and_checks() {
    let server = Running::start().await;
    let sections = r#"[{"id": "a", "parts": [{"id": "p", "shape": {"outer": {"xyMm": [0, 0, 10, 0, 10, 10]}}}],
        "allowedPoses": ["SECTION_POSE_AS_IS", "SECTION_POSE_HALF_TURN"], "quantity": 2}]"#;
    let request = format!(r#"{{"sections": {sections}, "gapMm": 0.5, "slideRule": "SLIDE_RULE_FREE"}}"#);
    let answer = call(server.address, "OrderSections", request.clone()).await.json();
    assert_eq!(answer["order"].as_array().map(Vec::len), Some(2), "{answer}");
    assert_eq!(answer["report"]["stopReason"], "STOP_REASON_PROVEN_OPTIMAL");
    assert_eq!(answer["noOrder"], false);
    let check = format!(r#"{{"request": {request}, "order": {}}}"#, answer["order"]);
    let found = call(server.address, "CheckSections", check).await.json();
    assert_eq!(found["violations"].as_array().map(Vec::len), Some(0), "{found}");
    assert_eq!(found["lengthMm"], answer["lengthMm"]);
}

#[tokio::test]
async fn options_and_rules_reach_the_engine() {
    let server = Running::start().await;
    let rules = v1::OrderSectionsRequest {
        first_section_id: "notch".to_owned(),
        last_section_id: "arrow".to_owned(),
        ..arrows()
    };
    let answer = ordered(&server, rules).await;
    assert_eq!(answer.order.first().map(|placed| placed.section_id.as_str()), Some("notch"));
    assert_eq!(answer.order.last().map(|placed| placed.section_id.as_str()), Some("arrow"));
    let given = |algorithm: v1::SectionAlgorithm, initial_order: Vec<v1::PlacedSection>| {
        let request = v1::OrderSectionsRequest { algorithm: algorithm.into(), initial_order, ..arrows() };
        ordered(&server, request)
    };
    let order = given(v1::SectionAlgorithm::GivenOrder, answer.order.clone()).await;
    assert_eq!(order.order, answer.order);
    assert_eq!(order.report.expect("told").algorithm, "given order");
    for (algorithm, name) in [
        (v1::SectionAlgorithm::BranchAndBound, "branch and bound"),
        (v1::SectionAlgorithm::AntColony, "ant colony"),
        (v1::SectionAlgorithm::LocalImprovement, "local improvement"),
    ] {
        let answer = given(algorithm, Vec::new()).await;
        assert_eq!((answer.order.len(), answer.report.expect("told").algorithm.as_str()), (4, name));
    }
}

#[tokio::test]
async fn that_there_is_no_order_is_an_answer() {
    let server = Running::start().await;
    let forbidden = |left: &str, right: &str| v1::ForbiddenJoin {
        left_section_id: left.to_owned(),
        right_section_id: right.to_owned(),
    };
    let mut request = arrows();
    request.sections[1].quantity = None;
    // The block joins nothing.
    request.forbidden_joins = vec![
        forbidden("block", "arrow"),
        forbidden("arrow", "block"),
        forbidden("block", "notch"),
        forbidden("notch", "block"),
    ];
    let answer = ordered(&server, request).await;
    assert!(answer.no_order && answer.order.is_empty(), "{answer:?}");
    assert!(answer.report.is_some_and(|report| report.proven_optimal));
}

#[tokio::test]
async fn every_wrong_value_is_found_at_once() {
    let server = Running::start().await;
    let id = |id: &str| id.to_owned();
    let mut bad =
        section("bad", vec![part("p", vec![0.0, 0.0, 1.0]), part("p", vec![0.0, 0.0, 1.0, 0.0, 1.0, 1.0])]);
    bad.quantity = Some(0);
    bad.allowed_poses = vec![1, 1, 9];
    let request = v1::OrderSectionsRequest {
        sections: vec![section("empty", vec![]), section("empty", arrows().sections[0].parts.clone()), bad],
        gap_mm: -1.0,
        strip_height_mm: Some(f64::NAN),
        first_section_id: id("nobody"),
        last_section_id: id("nothing"),
        precedences: vec![v1::Precedence { before_section_id: id("empty"), after_section_id: id("none") }],
        forbidden_joins: vec![v1::ForbiddenJoin { left_section_id: id(""), right_section_id: id("bad") }],
        slide_rule: 5,
        effect_model: 5,
        algorithm: 5,
        options: Some(v1::SolveOptions { gap_limit: 2.0, seed: -1, thread_count: -1, ..Default::default() }),
        ..Default::default()
    };
    let status = refused(&server, request).await;
    assert_eq!((status.code(), reason(&status).as_str()), (Code::InvalidArgument, "INVALID_REQUEST"));
    let expected = found(&[
        ("gap_mm", "OUT_OF_RANGE"),
        ("strip_height_mm", "NOT_FINITE"),
        ("slide_rule", "UNKNOWN_ENUM_VALUE"),
        ("sections[0].parts", "MISSING_FIELD"),
        ("sections[1].id", "DUPLICATE_ID"),
        ("sections[2].quantity", "OUT_OF_RANGE"),
        ("sections[2].allowed_poses[1]", "DUPLICATE_ID"),
        ("sections[2].allowed_poses[2]", "UNKNOWN_ENUM_VALUE"),
        ("sections[2].parts[0].shape.outer.xy_mm", "ODD_COORDINATE_COUNT"),
        ("sections[2].parts[1].id", "DUPLICATE_ID"),
        ("first_section_id", "UNKNOWN_ID"),
        ("last_section_id", "UNKNOWN_ID"),
        ("precedences[0].after_section_id", "UNKNOWN_ID"),
        ("forbidden_joins[0].left_section_id", "MISSING_FIELD"),
        ("algorithm", "UNKNOWN_ENUM_VALUE"),
        ("effect_model", "UNKNOWN_ENUM_VALUE"),
        ("options.gap_limit", "OUT_OF_RANGE"),
        ("options.seed", "OUT_OF_RANGE"),
        ("options.thread_count", "OUT_OF_RANGE"),
    ]);
    assert_eq!(findings(&status), expected);
}

#[tokio::test]
async fn values_that_contradict_one_another_are_found() {
    let server = Running::start().await;
    let precedence = |before: &str, after: &str| v1::Precedence {
        before_section_id: before.to_owned(),
        after_section_id: after.to_owned(),
    };
    let circle = v1::OrderSectionsRequest {
        precedences: vec![precedence("arrow", "notch"), precedence("notch", "arrow")],
        ..arrows()
    };
    let status = refused(&server, circle.clone()).await;
    assert!(findings(&status).iter().any(|(_, reason)| reason == "PRECEDENCE_CONTRADICTION"), "{status:?}");
    let validated = refused(&server, v1::OrderSectionsRequest { validate_only: true, ..circle }).await;
    assert_eq!(findings(&validated), findings(&status));

    let mut overlapping = arrows();
    let again = v1::Part { id: "again".to_owned(), ..overlapping.sections[0].parts[0].clone() };
    overlapping.sections[0].parts.push(again);
    let status = refused(&server, overlapping.clone()).await;
    assert!(findings(&status).iter().any(|(_, reason)| reason == "PARTS_OVERLAP"), "{status:?}");
    overlapping.allow_overlap_inside = true;
    assert_eq!(ordered(&server, overlapping).await.order.len(), 4);

    let low = v1::OrderSectionsRequest { strip_height_mm: Some(99.0), ..arrows() };
    let status = refused(&server, low).await;
    assert!(!findings(&status).is_empty(), "{status:?}");
    let given = v1::OrderSectionsRequest { algorithm: v1::SectionAlgorithm::GivenOrder.into(), ..arrows() };
    assert_eq!(findings(&refused(&server, given).await), found(&[("initial_order", "MISSING_FIELD")]));
    assert_eq!(
        findings(&refused(&server, v1::OrderSectionsRequest::default()).await),
        found(&[("sections", "MISSING_FIELD")])
    );
}

#[tokio::test]
async fn heights_that_differ_wildly_are_ordered() {
    let server = Running::start().await;
    let block = |id: &str, height: f64| {
        section(id, vec![part("p", vec![0.0, 0.0, 10.0, 0.0, 10.0, height, 0.0, height])])
    };
    let request = v1::OrderSectionsRequest {
        sections: vec![block("a", 1e-3), block("b", 1e5), block("c", 1.0)],
        ..Default::default()
    };
    let answer = ordered(&server, request).await;
    assert!((answer.length_mm - 30.0).abs() < 1e-5, "{answer:?}");
}

#[tokio::test]
async fn too_many_sections_copies_parts_and_returns_are_refused() {
    let server = Running::start().await;
    let many = |count: usize| {
        let of = |i: usize| section(&format!("s{i}"), arrows().sections[1].parts.clone());
        v1::OrderSectionsRequest { sections: (0..count).map(of).collect(), ..Default::default() }
    };
    let fields = |status: tonic::Status| findings(&status);
    assert_eq!(fields(refused(&server, many(100_000)).await), found(&[("sections", "TOO_MANY")]));
    let mut copies = arrows();
    copies.sections[0].quantity = Some(i32::MAX);
    assert_eq!(fields(refused(&server, copies).await), found(&[("sections", "TOO_MANY")]));
    let joins = v1::OrderSectionsRequest { return_joins: true, ..many(700) };
    assert_eq!(fields(refused(&server, joins).await), found(&[("return_joins", "TOO_MANY")]));
    let mut parts = arrows();
    parts.sections[1].quantity = Some(10_000);
    let ten = |i: i32| v1::Part {
        id: format!("p{i}"),
        shape: Some(square(40.0 * f64::from(i), 0.0, 30.0)),
        ..Default::default()
    };
    parts.sections[1].parts = (0..10).map(ten).collect();
    parts.return_parts = true;
    assert_eq!(fields(refused(&server, parts).await), found(&[("return_parts", "TOO_MANY")]));
}

/// A request, its answer, and the check of both with the certificate.
async fn certified(server: &Running) -> (v1::OrderSectionsResponse, v1::CheckSectionsRequest) {
    let options = Some(v1::SolveOptions { return_certificate: true, ..Default::default() });
    let request = v1::OrderSectionsRequest { options, ..arrows() };
    let answer = ordered(server, request.clone()).await;
    let check = traverse_proto::check_sections_request(request, &answer);
    (answer, check)
}

#[tokio::test]
async fn what_an_answer_certifies_is_recomputed() {
    let server = Running::start().await;
    let (answer, check) = certified(&server).await;
    let claimed = answer.report.expect("told").certified_lower_bound.expect("certified");
    assert_eq!(check.claimed_lower_bound_mm, Some(claimed));
    let ask = |check: v1::CheckSectionsRequest| async {
        server.client().await.check_sections(check).await.expect("sound").into_inner()
    };
    let found = ask(check.clone()).await;
    assert_eq!(found.violations, []);
    let proven = found.certified_lower_bound_mm.expect("recomputed");
    assert!((proven - claimed).abs() < 1e-5 && proven <= answer.length_mm, "{proven} of {claimed}");

    // Claimed too much: a violation. Duals that ask too much prove no more than before.
    let dearer = v1::CheckSectionsRequest { claimed_lower_bound_mm: Some(claimed + 1.0), ..check.clone() };
    let found = ask(dearer).await;
    let [violation] = &found.violations[..] else { panic!("{found:?}") };
    assert_eq!(violation.reason, "BOUND_NOT_PROVEN");
    assert_eq!(violation.field, "claimed_lower_bound_mm");
    assert!((violation.amount - 1.0).abs() < 1e-5, "{violation:?}");
    let proves = |first: f64| {
        let row_duals = vec![first, 30.0, 60.0, 0.0];
        let certificate =
            Some(v1::Certificate { row_duals, column_duals: vec![0.0; 4], ..Default::default() });
        let check = v1::CheckSectionsRequest { certificate, claimed_lower_bound_mm: None, ..check.clone() };
        async { ask(check).await.certified_lower_bound_mm.expect("recomputed") }
    };
    // The notch, twice the block, and the arrow up to the notch.
    let proven = proves(90.0).await;
    assert!(proven <= 210.0 && proven > 210.0 - 1e-6, "{proven}");
    let dearer = proves(1_090.0).await;
    assert!(dearer <= 210.0 && dearer > 210.0 - 1e-6, "{dearer}");
}

#[tokio::test]
async fn certificates_that_do_not_fit_are_refused_with_their_fields() {
    let server = Running::start().await;
    let (_, check) = certified(&server).await;
    let refused = |certificate: Option<v1::Certificate>| {
        let check = v1::CheckSectionsRequest { certificate, ..check.clone() };
        async {
            let status = server.client().await.check_sections(check).await.expect_err("it does not fit");
            assert_eq!(status.code(), Code::InvalidArgument);
            findings(&status)
        }
    };
    let duals = |count: usize| v1::Certificate {
        row_duals: vec![0.0; count],
        column_duals: vec![0.0; count],
        ..Default::default()
    };
    let with_set = |nodes: Vec<i32>, weight: f64| v1::Certificate {
        sets: vec![v1::DualSet { nodes, weight }],
        ..duals(4)
    };
    assert_eq!(refused(None).await, found(&[("claimed_lower_bound_mm", "NOT_APPLICABLE")]));
    let nothing = v1::Certificate::default();
    assert_eq!(refused(Some(nothing)).await, found(&[("certificate", "MISSING_FIELD")]));
    let two_kinds = v1::Certificate { height_mm: Some(1.0), ..duals(4) };
    assert_eq!(refused(Some(two_kinds)).await, found(&[("certificate", "NOT_APPLICABLE")]));
    assert_eq!(
        refused(Some(duals(3))).await,
        found(&[("certificate.row_duals", "OUT_OF_RANGE"), ("certificate.column_duals", "OUT_OF_RANGE")])
    );
    let mut broken = duals(4);
    broken.row_duals[2] = f64::NAN;
    assert_eq!(refused(Some(broken)).await, found(&[("certificate.row_duals[2]", "NOT_FINITE")]));
    for (nodes, weight, field) in [
        (vec![0], -1.0, "certificate.sets[0].weight"),
        (vec![0, 4], 1.0, "certificate.sets[0].nodes[1]"),
        (vec![-1], 1.0, "certificate.sets[0].nodes[0]"),
        (vec![1, 1], 1.0, "certificate.sets[0].nodes[1]"),
        (vec![0, 1, 2, 3], 1.0, "certificate.sets[0].nodes"),
    ] {
        assert_eq!(
            refused(Some(with_set(nodes, weight))).await,
            found(&[(field, "OUT_OF_RANGE")]),
            "{field}"
        );
    }
    let unknown = v1::Certificate { section_id: "nobody".to_owned(), ..Default::default() };
    assert_eq!(refused(Some(unknown)).await, found(&[("certificate.section_id", "UNKNOWN_ID")]));
    let nowhere = v1::Certificate { height_mm: Some(f64::INFINITY), ..Default::default() };
    assert_eq!(refused(Some(nowhere)).await, found(&[("certificate.height_mm", "NOT_FINITE")]));
}

#[tokio::test]
async fn what_is_wrong_with_a_check_is_found() {
    let server = Running::start().await;
    let placed = |id: &str, pose: i32, y_mm: f64| v1::PlacedSection {
        section_id: id.to_owned(),
        pose,
        y_mm,
        ..Default::default()
    };
    let check = v1::CheckSectionsRequest {
        request: Some(arrows()),
        order: vec![placed("arrow", 1, 0.0), placed("nobody", 1, 0.0), placed("notch", 9, 0.0)],
        tolerance_mm: Some(2.0),
        ..Default::default()
    };
    let refused = |check: v1::CheckSectionsRequest| async {
        server.client().await.check_sections(check).await.expect_err("something is wrong")
    };
    let status = refused(check.clone()).await;
    let expected = found(&[
        ("tolerance_mm", "OUT_OF_RANGE"),
        ("order[1].section_id", "UNKNOWN_ID"),
        ("order[2].pose", "UNKNOWN_ENUM_VALUE"),
    ]);
    assert_eq!(findings(&status), expected);
    let up = v1::CheckSectionsRequest { order: vec![placed("arrow", 1, 3.0)], tolerance_mm: None, ..check };
    assert_eq!(findings(&refused(up).await), found(&[("order[0].y_mm", "OUT_OF_RANGE")]));
    let nothing = v1::CheckSectionsRequest::default();
    assert_eq!(findings(&refused(nothing).await), found(&[("request", "MISSING_FIELD")]));
}

/// Works until its budget ends, then answers with the order as it was sent.
struct Patient;

impl Engines for Patient {
    fn order_sections(
        &self,
        question: &OrderQuestion,
        budget: &Budget,
        _: &mut dyn Observer,
    ) -> Result<LayoutAnswer, Vec<Finding>> {
        while budget.check(0).is_ok() {
            std::thread::park_timeout(Duration::from_millis(1));
        }
        let interrupt = budget.check(0).expect_err("it ended");
        let layout = &question.layout;
        let as_sent = |(section, of): (usize, &traverse_geometry::Section)| {
            let pose = of.poses[0];
            (0..of.quantity).map(move |copy| traverse_geometry::PlacedSection {
                section,
                copy,
                pose,
                x_mm: 0.0,
            })
        };
        let options = OrderOptions {
            algorithm: Algorithm::GivenOrder,
            initial_order: Some(layout.sections.iter().enumerate().flat_map(as_sent).collect()),
            ..OrderOptions::default()
        };
        let answer = order_sections(layout, &options, &Budget::unlimited(), &mut Silent)?;
        Ok(LayoutAnswer { ending: traverse_layout_sequencing::Ending::Interrupted(interrupt), ..answer })
    }
}

#[tokio::test]
async fn the_best_layout_at_the_time_limit_is_an_answer() {
    let server = Running::with(Config::on_free_port(), Patient).await;
    let time_limit = Some(prost_types::Duration { seconds: 0, nanos: 200_000_000 });
    let options = Some(v1::SolveOptions { time_limit, ..Default::default() });
    let answer = ordered(&server, v1::OrderSectionsRequest { options, ..arrows() }).await;
    assert_eq!(answer.order.len(), 4);
    assert_eq!(answer.report.expect("told").stop_reason(), v1::StopReason::TimeLimit);

    let mut request = tonic::Request::new(arrows());
    request.set_timeout(Duration::from_millis(400));
    let answer = server.client().await.order_sections(request).await.expect("in time").into_inner();
    assert_eq!(answer.report.expect("told").stop_reason(), v1::StopReason::Deadline);
}

/// Ragged sections of so many corners, all as high.
fn ragged(count: usize, corners: usize) -> Vec<v1::Section> {
    let mut random = Seed(1).stream();
    let rows = corners / 2;
    let ragged = |number: usize| {
        let mut xy = vec![];
        for row in 0..rows {
            xy.extend([20.0 + random.random_range(0.0..9.0), 100.0 * row as f64 / (rows - 1) as f64]);
        }
        for row in (0..rows).rev() {
            xy.extend([random.random_range(0.0..9.0), 100.0 * row as f64 / (rows - 1) as f64]);
        }
        section(&format!("s{number}"), vec![part("p", xy)])
    };
    (0..count).map(ragged).collect()
}

#[tokio::test]
async fn thousands_of_rich_sections_have_a_layout_when_the_time_is_over() {
    let server = Running::start().await;
    let time_limit = Some(prost_types::Duration { seconds: 3, nanos: 0 });
    let request = v1::OrderSectionsRequest {
        sections: ragged(2_000, 40),
        return_contacts: true,
        options: Some(v1::SolveOptions { time_limit, ..Default::default() }),
        ..Default::default()
    };
    let answer = ordered(&server, request).await;
    assert_eq!(answer.order.len(), 2_000);
    assert!(answer.contacts.len() > 1_900);
}

/// Finds no order, and does not know whether there is one.
struct Clueless;

impl Engines for Clueless {
    fn order_sections(
        &self,
        _: &OrderQuestion,
        _: &Budget,
        _: &mut dyn Observer,
    ) -> Result<LayoutAnswer, Vec<Finding>> {
        Ok(LayoutAnswer {
            plan: None,
            lower_bound_mm: 10.0,
            certificate: traverse_layout_sequencing::BoundCertificate::None,
            certified_lower_bound_mm: 0.0,
            ending: traverse_layout_sequencing::Ending::Exhausted,
            iterations: 1,
            algorithm: "best",
        })
    }
}

#[tokio::test]
async fn an_order_that_was_not_found_is_not_said_to_be_good() {
    let server = Running::with(Config::on_free_port(), Clueless).await;
    let answer = ordered(&server, arrows()).await;
    assert!(answer.order.is_empty() && !answer.no_order);
    let report = answer.report.expect("told");
    assert_eq!((report.gap_ratio, report.stop_reason()), (1.0, v1::StopReason::Converged));
}
