//! Exact joins against distances of all pairs of edges.

mod oracle;

use oracle::{Borders, distance, section, standing, stopped};
use traverse_geometry::{Part, Point, Polygon, Pose, Ring, Section};
use traverse_layout_sequencing::{EffectModel, join, joins, published_effect};
use traverse_solve::{Budget, Seed};

fn one_part(id: &str, xy: &[f64]) -> Section {
    let part = Part {
        id: id.into(),
        shape: Polygon::from_ring(Ring::from_xy(xy, &[]).expect("a ring")),
        pole: Point::origin(),
        rotation_rad: 0.0,
        mirrored: false,
    };
    Section { id: id.into(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
}

#[test]
fn joins_touch_and_come_no_nearer_on_the_way() {
    let mut found = 0;
    for (seed, borders) in [(1, Borders::Straight), (2, Borders::Round), (3, Borders::Steps)] {
        let mut chance = Seed(seed).stream();
        for case in 0..80 {
            let (left, right) = (section("l", borders, &mut chance), section("r", borders, &mut chance));
            let pose = Pose::ALL[case % 4];
            for gap in [0.0, 0.5, 3.0] {
                let joined = join((&left, pose), (&right, Pose::AsIs), gap);
                let stands = standing(&left, pose, 0.0);
                let slides = |x: f64| standing(&right, Pose::AsIs, x);
                let from = left.bounds().size().x + gap + 1.0;
                let until = -right.bounds().size().x - gap;
                let stopped = stopped(&stands, slides, from, until, gap);
                let name = format!("{borders:?} case {case} gap {gap}: {joined:?} {stopped:?}");
                let Some(offset) = joined.offset_mm else {
                    assert_eq!(stopped, None, "{name}");
                    continue;
                };
                found += 1;
                let near = distance(&stands, &slides(offset)) - gap;
                assert!(near.abs() < 1e-7, "{name} apart by {near}");
                // The way there is free, but where it grazes: there the room is used up, too.
                if let Some(stopped) = stopped {
                    assert!(stopped > offset - 1e-6, "{name}");
                    if stopped > offset + 1e-5 {
                        let there = distance(&stands, &slides(stopped)) - gap;
                        assert!(there > -1e-9, "{name}");
                        let beyond = distance(&stands, &slides(stopped - 1e-3)) - gap;
                        assert!(beyond > -1e-7, "{name}: in the way at {stopped}, {beyond}");
                    }
                }
                let [on_left, on_right] = joined.witness.unwrap();
                assert!(((on_left - on_right).norm() - gap).abs() < 1e-7, "{name}");
                let border = |rings: &[Ring], p: Point| {
                    rings.iter().map(|ring| ring.distance_to_point(p)).fold(f64::INFINITY, f64::min)
                };
                assert!(
                    border(&stands, on_left) < 1e-7 && border(&slides(offset), on_right) < 1e-7,
                    "{name}"
                );
            }
        }
    }
    assert!(found > 600, "{found}");
}

#[test]
fn the_worked_numbers_of_the_published_model() {
    // The left section's right edge runs (0, 0) – (10, 10); the right one's left chain (0, 0), (2, 6), (9, 10).
    let left = one_part("left", &[0.0, 0.0, 10.0, 10.0, 0.0, 10.0]);
    let right = one_part("right", &[0.0, 0.0, 9.0, 0.0, 9.0, 10.0, 2.0, 6.0]);
    assert_eq!(published_effect((&left, Pose::AsIs), (&right, Pose::AsIs)), 9.0);
    let exact = join((&left, Pose::AsIs), (&right, Pose::AsIs), 0.0);
    assert_eq!((exact.effect_mm, exact.offset_mm), (6.0, Some(4.0)));
    assert_eq!(exact.witness, Some([Point::new(6.0, 6.0); 2]));
}

#[test]
fn equal_heights_touch_and_others_pass() {
    let block = |id: &str, low: f64, high: f64| one_part(id, &[0.0, low, 5.0, low, 5.0, high, 0.0, high]);
    let lower = block("lower", 0.0, 10.0);
    let at = |low: f64, gap: f64| join((&lower, Pose::AsIs), (&block("b", low, 20.0), Pose::AsIs), gap);
    assert_eq!(at(10.0, 0.0).offset_mm, Some(5.0));
    assert_eq!(at(10.5, 0.0).offset_mm, None);
    assert_eq!(at(10.5, 0.0).effect_mm, 5.0);
    assert_eq!(at(13.0, 5.0).offset_mm, Some(9.0));
    assert_eq!(at(13.0, 5.0).effect_mm, 1.0);
    assert_eq!(at(15.0, 5.0).offset_mm, Some(5.0));
    assert_eq!(at(15.5, 5.0).effect_mm, 10.0);
}

#[test]
fn antennas_count() {
    let antenna = one_part("a", &[0.0, 0.0, 4.0, 0.0, 4.0, 5.0, 9.0, 5.0, 4.0, 5.0, 4.0, 10.0, 0.0, 10.0]);
    let block = one_part("b", &[0.0, 0.0, 3.0, 0.0, 3.0, 10.0, 0.0, 10.0]);
    for gap in [0.0, 1.0] {
        assert_eq!(join((&antenna, Pose::AsIs), (&block, Pose::AsIs), gap).offset_mm, Some(9.0 + gap));
        assert_eq!(join((&antenna, Pose::MirrorX), (&block, Pose::AsIs), gap).offset_mm, Some(9.0 + gap));
        assert_eq!(join((&block, Pose::AsIs), (&antenna, Pose::HalfTurn), gap).offset_mm, Some(3.0 + gap));
    }
}

#[test]
fn the_matrix_holds_every_join_whatever_the_threads() {
    let mut chance = Seed(4).stream();
    let mut sections: Vec<Section> =
        (0..6).map(|i| section(&i.to_string(), Borders::Round, &mut chance)).collect();
    sections[2].poses = Pose::ALL.to_vec();
    sections.push(Section { id: "again".into(), ..sections[2].clone() });
    let layout = traverse_geometry::SectionLayout { gap_mm: 0.25, ..oracle::layout(sections) };
    for model in [EffectModel::Exact, EffectModel::Published] {
        let matrix = joins(&layout, model, 1, &Budget::unlimited()).unwrap();
        assert_eq!(joins(&layout, model, 2, &Budget::unlimited()), Ok(matrix.clone()));
        assert_eq!(matrix.items.len(), 13);
        for (i, left) in matrix.items.iter().enumerate() {
            for (j, right) in matrix.items.iter().enumerate() {
                let of =
                    |item: &traverse_layout_sequencing::JoinItem| (&layout.sections[item.section], item.pose);
                let alone = match model {
                    EffectModel::Exact => join(of(left), of(right), layout.gap_mm).effect_mm,
                    EffectModel::Published => published_effect(of(left), of(right)),
                };
                assert_eq!(matrix.effects_mm[i * 13 + j], alone);
            }
        }
    }
}

#[test]
fn a_cancelled_matrix_is_none() {
    let mut chance = Seed(4).stream();
    let sections = (0..3).map(|i| section(&i.to_string(), Borders::Steps, &mut chance)).collect();
    let budget = Budget::unlimited();
    budget.cancel.cancel();
    let cancelled = joins(&oracle::layout(sections), EffectModel::Exact, 2, &budget);
    assert_eq!(cancelled, Err(traverse_solve::Interrupt::Cancelled));
}
