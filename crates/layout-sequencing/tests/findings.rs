//! What is wrong with a question is said at once, with field, reason and what to do.

mod oracle;

use oracle::{Borders, section};
use traverse_geometry::{
    Finding, PlacedSection, Point, Polygon, Pose, Reason, Ring, Section, SectionLayout, Vector,
};
use traverse_layout_sequencing::{
    Algorithm, Ending, InnerOverlap, LARGEST_COPIES, OrderOptions, layout_findings, order_sections,
};
use traverse_solve::{Budget, CancelToken, Interrupt, Seed, Silent};

fn block(id: &str) -> Section {
    let mut section = section(id, Borders::Steps, &mut Seed(1).stream());
    section.parts.truncate(1);
    section
}

fn layout() -> SectionLayout {
    oracle::layout(["a", "b", "c"].map(block).to_vec())
}

fn found(layout: &SectionLayout, options: &OrderOptions) -> Vec<(String, Reason)> {
    let findings = layout_findings(layout, options, &Budget::unlimited()).expect("no limit");
    let errors =
        order_sections(layout, options, &Budget { iterations: Some(10), ..Budget::unlimited() }, &mut Silent);
    assert_eq!(errors.err().unwrap_or_default(), findings);
    for Finding { message, .. } in &findings {
        assert!(message.chars().next().is_some_and(|first| !first.is_uppercase()), "{message}");
    }
    findings.into_iter().map(|finding| (finding.field, finding.reason)).collect()
}

fn fields(layout: &SectionLayout) -> Vec<(String, Reason)> {
    found(layout, &OrderOptions::default())
}

fn named(expected: &[(&str, Reason)]) -> Vec<(String, Reason)> {
    expected.iter().map(|&(field, reason)| (field.to_owned(), reason)).collect()
}

#[test]
fn a_sound_question_has_none() {
    assert_eq!(fields(&layout()), []);
}

#[test]
fn everything_wrong_with_sections_is_said_at_once() {
    assert_eq!(fields(&oracle::layout(vec![])), named(&[("sections", Reason::MissingField)]));
    let mut layout = layout();
    layout.strip_height_mm = Some(1.0);
    layout.sections[0].parts.clear();
    layout.sections[1].quantity = 0;
    layout.sections[1].poses = vec![Pose::AsIs, Pose::AsIs];
    layout.sections[2].id = "b".into();
    layout.sections[2].poses.clear();
    layout.sections[2].parts[0].id = String::new();
    layout.sections[2].parts[0].pole.y = f64::NAN;
    assert_eq!(
        fields(&layout),
        named(&[
            ("sections[0].parts", Reason::MissingField),
            ("sections[1].quantity", Reason::OutOfRange),
            ("sections[1].allowed_poses[1]", Reason::DuplicateId),
            ("sections[1]", Reason::OutOfRange),
            ("sections[2].id", Reason::DuplicateId),
            ("sections[2].allowed_poses", Reason::MissingField),
            ("sections[2].parts[0].id", Reason::MissingField),
            ("sections[2].parts[0].pole.y_mm", Reason::NotFinite),
        ])
    );
}

#[test]
fn strips_and_gaps_have_ranges() {
    let with = |gap_mm: f64, height: f64| {
        let layout = SectionLayout { gap_mm, strip_height_mm: Some(height), ..layout() };
        fields(&layout).into_iter().find(|(field, _)| !field.starts_with("sections"))
    };
    assert_eq!(with(-1.0, 100.0), Some(("gap_mm".into(), Reason::OutOfRange)));
    assert_eq!(with(1e-9, 100.0), Some(("gap_mm".into(), Reason::OutOfRange)));
    assert_eq!(with(f64::NAN, 100.0), Some(("gap_mm".into(), Reason::NotFinite)));
    assert_eq!(with(0.0, f64::INFINITY), Some(("strip_height_mm".into(), Reason::NotFinite)));
    assert_eq!(with(0.0, -5.0), Some(("strip_height_mm".into(), Reason::OutOfRange)));
}

#[test]
fn coordinates_and_copies_have_limits() {
    let mut far = layout();
    far.sections[1].parts[0].pole.x = 2e6;
    assert_eq!(fields(&far), named(&[("sections[1]", Reason::CoordinateTooLarge)]));
    let mut many = layout();
    many.sections[0].quantity = LARGEST_COPIES as u32;
    assert_eq!(fields(&many), named(&[("sections", Reason::TooMany)]));
    let thousands = (0..100_000).map(|i| Section { id: format!("{}", i % 99_000), ..block("x") }).collect();
    let findings = fields(&oracle::layout(thousands));
    assert_eq!(findings.len(), 101);
    assert_eq!(findings[0], ("sections[99000].id".into(), Reason::DuplicateId));
}

#[test]
fn ends_and_precedences_contradict_each_other() {
    let unknown = SectionLayout {
        first: Some(7),
        last: Some(3),
        precedences: vec![(0, 9)],
        forbidden_joins: vec![(4, 0)],
        ..layout()
    };
    assert_eq!(
        fields(&unknown),
        named(&[
            ("first_section_id", Reason::OutOfRange),
            ("last_section_id", Reason::OutOfRange),
            ("precedences[0].after_section_id", Reason::OutOfRange),
            ("forbidden_joins[0].left_section_id", Reason::OutOfRange),
        ])
    );
    let both = SectionLayout { first: Some(1), last: Some(1), ..layout() };
    assert_eq!(fields(&both), named(&[("last_section_id", Reason::PrecedenceContradiction)]));
    let circle = SectionLayout { precedences: vec![(0, 1), (1, 2), (2, 0)], ..layout() };
    assert_eq!(fields(&circle), named(&[("precedences", Reason::PrecedenceContradiction)]));
    let against = SectionLayout { first: Some(1), precedences: vec![(2, 1)], ..layout() };
    assert_eq!(fields(&against), named(&[("precedences[0]", Reason::PrecedenceContradiction)]));
}

#[test]
fn options_are_looked_at_too() {
    let options = OrderOptions { gap_limit: Some(-0.5), ..OrderOptions::default() };
    assert_eq!(found(&layout(), &options), named(&[("options.gap_limit", Reason::OutOfRange)]));
    let options = OrderOptions { algorithm: Algorithm::AntColony, ..OrderOptions::default() };
    let ordered = SectionLayout { precedences: vec![(0, 1)], ..layout() };
    assert_eq!(found(&ordered, &options), named(&[("precedences", Reason::NotApplicable)]));
    let options = OrderOptions { algorithm: Algorithm::GivenOrder, ..OrderOptions::default() };
    assert_eq!(found(&layout(), &options), named(&[("initial_order", Reason::MissingField)]));
    let of = |order: &[(usize, u32, Pose)]| {
        let order = order.iter();
        let placed = order.map(|&(section, copy, pose)| PlacedSection { section, copy, pose, x_mm: 0.0 });
        let options = OrderOptions { initial_order: Some(placed.collect()), ..OrderOptions::default() };
        let rules = SectionLayout {
            first: Some(0),
            last: Some(2),
            precedences: vec![(0, 1)],
            forbidden_joins: vec![(2, 1)],
            ..layout()
        };
        found(&rules, &options)
    };
    assert_eq!(of(&[(0, 0, Pose::AsIs), (1, 0, Pose::AsIs), (2, 0, Pose::AsIs)]), []);
    assert_eq!(of(&[(0, 0, Pose::AsIs)]), named(&[("initial_order", Reason::MissingField)]));
    assert_eq!(
        of(&[(0, 1, Pose::AsIs), (1, 0, Pose::MirrorX), (1, 0, Pose::AsIs), (5, 0, Pose::AsIs)]),
        named(&[
            ("initial_order[0].copy", Reason::OutOfRange),
            ("initial_order[1].pose", Reason::OutOfRange),
            ("initial_order[2]", Reason::DuplicateId),
            ("initial_order[3].section_id", Reason::OutOfRange),
        ])
    );
    let backwards = of(&[(2, 0, Pose::AsIs), (1, 0, Pose::AsIs), (0, 0, Pose::AsIs)]);
    assert_eq!(backwards, vec![("initial_order".to_owned(), Reason::PrecedenceContradiction); 4]);
}

/// A section of two parts, the second moved by `by`.
fn pair(first: &[f64], second: &[f64], bulges: &[f64], by: Vector) -> SectionLayout {
    let mut section = block("pair");
    section.parts.push(section.parts[0].clone());
    section.parts[1].id = "other".into();
    for (part, xy) in section.parts.iter_mut().zip([first, second]) {
        part.pole = Point::origin();
        part.shape = Polygon::from_ring(Ring::from_xy(xy, bulges).expect("a ring"));
    }
    section.parts[1].pole = Point::from(by);
    oracle::layout(vec![section])
}

#[test]
fn parts_that_overlap_inside_their_section_are_found() {
    let square = [0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.0, 10.0];
    let cross = [4.0, -5.0, 6.0, -5.0, 6.0, 15.0, 4.0, 15.0];
    let circle = [0.0, 0.0, 10.0, 0.0];
    let refused = |layout: &SectionLayout| {
        let allowed = OrderOptions { inner_overlap: InnerOverlap::Allowed, ..OrderOptions::default() };
        assert_eq!(found(layout, &allowed), []);
        let findings = fields(layout);
        assert!(findings.is_empty() || findings == named(&[("sections[0].parts[1]", Reason::PartsOverlap)]));
        !findings.is_empty()
    };
    let squares = |x: f64, y: f64| refused(&pair(&square, &square, &[], Vector::new(x, y)));
    assert!(squares(0.0, 0.0) && squares(9.9, 9.9) && squares(-9.999, 0.0) && squares(1e-3, 3.0));
    assert!(
        !squares(10.0, 0.0) && !squares(10.0, 10.0) && !squares(0.0, -10.0) && !squares(10.0 - 1e-7, 0.0)
    );
    assert!(refused(&pair(&square, &cross, &[], Vector::zeros())));
    assert!(!refused(&pair(&square, &cross, &[], Vector::new(6.0, 0.0))));
    let circles = |x: f64, y: f64| refused(&pair(&circle, &circle, &[1.0, 1.0], Vector::new(x, y)));
    assert!(circles(9.99, 0.0) && circles(7.0, 7.0) && circles(0.0, 0.0));
    assert!(!circles(10.0, 0.0) && !circles(7.1, 7.1) && !circles(0.0, 10.0));
}

#[test]
fn a_part_may_lie_in_the_hole_of_another() {
    let mut layout = pair(
        &[0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.0, 10.0],
        &[3.0, 3.0, 6.0, 3.0, 6.0, 6.0],
        &[],
        Vector::zeros(),
    );
    assert_eq!(fields(&layout).len(), 1);
    let outer = layout.sections[0].parts[0].shape.outer().clone();
    let hole = Ring::from_xy(&[2.0, 2.0, 8.0, 2.0, 8.0, 8.0, 2.0, 8.0], &[]).unwrap();
    layout.sections[0].parts[0].shape = Polygon::new(outer, vec![hole]).unwrap();
    assert_eq!(fields(&layout), []);
}

#[test]
fn a_cancel_during_validation_ends_it() {
    let cancel = CancelToken::new();
    cancel.cancel();
    let budget = Budget { cancel, ..Budget::unlimited() };
    let options = OrderOptions::default();
    assert_eq!(layout_findings(&layout(), &options, &budget), Err(Interrupt::Cancelled));
    let answer = order_sections(&layout(), &options, &budget, &mut Silent).unwrap();
    assert_eq!((answer.plan, answer.ending), (None, Ending::Interrupted(Interrupt::Cancelled)));
}
