//! Layouts of chance in every pose: never overlapping, by the checker and by distances of all edges, and tight.

mod oracle;

use oracle::{Borders, distance, least_margin, section, standing};
use rand::RngExt;
use traverse_checker::check_sections;
use traverse_geometry::{CONTACT_TOLERANCE_MM, PlacedSection, Pose, SectionLayout, SlideRule};
use traverse_layout_sequencing::{contacts, layout_length_mm, place, place_as_published};
use traverse_solve::Seed;

/// Layouts of each kind of border.
const LAYOUTS: usize = 3_400;

fn layout_of_chance(
    borders: Borders,
    chance: &mut rand_xoshiro::Xoshiro256PlusPlus,
) -> (SectionLayout, Vec<PlacedSection>) {
    let count = chance.random_range(2..=5);
    let mut sections: Vec<_> = (0..count).map(|i| section(&i.to_string(), borders, chance)).collect();
    sections.iter_mut().for_each(|section| section.poses = Pose::ALL.to_vec());
    let mut layout = oracle::layout(sections);
    layout.gap_mm = [0.0, 0.0, 0.3, 2.0][chance.random_range(0..4)];
    layout.slide_rule = [SlideRule::KeepOrder, SlideRule::Free][chance.random_range(0..2)];
    let pose = |_| Pose::ALL[chance.random_range(0..4)];
    let poses: Vec<Pose> = (0..count).map(pose).collect();
    let order = poses.into_iter().enumerate();
    let placed = order.map(|(section, pose)| PlacedSection { section, copy: 0, pose, x_mm: 0.0 }).collect();
    (layout, placed)
}

#[test]
fn layouts_never_overlap_and_every_contact_is_tight() {
    let (mut tight, mut published) = (0, 0);
    for (seed, borders) in [(1, Borders::Straight), (2, Borders::Round), (3, Borders::Steps)] {
        let mut chance = Seed(seed).stream();
        for case in 0..LAYOUTS {
            let (layout, order) = layout_of_chance(borders, &mut chance);
            let name = format!("{borders:?} {case}");
            let placed = place(&layout, &order);
            let check = check_sections(&layout, &placed, CONTACT_TOLERANCE_MM);
            assert!(check.is_sound(), "{name}: {:?}", check.violations);
            assert!((check.length_mm - layout_length_mm(&layout, &placed)).abs() < 1e-6, "{name}");
            let touching = contacts(&layout, &placed);
            for contact in &touching {
                let apart = (contact.point - contact.against_point).norm();
                assert!((apart - layout.gap_mm).abs() < 3e-6, "{name}: {contact:?}");
            }
            for (index, section) in placed.iter().enumerate() {
                let stop = match layout.slide_rule {
                    SlideRule::KeepOrder => index.checked_sub(1).map_or(0.0, |before| placed[before].x_mm),
                    SlideRule::Free => 0.0,
                };
                let touches = touching.iter().any(|contact| contact.index == index);
                assert!(touches || section.x_mm == stop, "{name}: nothing holds section {index}");
            }
            if case % 20 == 0 {
                assert!(least_margin(&layout, &placed) > -CONTACT_TOLERANCE_MM, "{name}");
            }
            if case % 5 == 0 && borders == Borders::Straight {
                tight += tight_contacts(&layout, &placed, &touching, &name);
            }
            let wrong = check_sections(&layout, &place_as_published(&layout, &order), CONTACT_TOLERANCE_MM);
            published += usize::from(!wrong.is_sound());
        }
    }
    assert!(tight > 1_000, "{tight}");
    assert!(published > 100, "{published}");
}

/// Ten tolerances further left every contact is nearer than the gap, or one in the other.
fn tight_contacts(
    layout: &SectionLayout,
    placed: &[PlacedSection],
    touching: &[traverse_layout_sequencing::Contact],
    name: &str,
) -> usize {
    for contact in touching {
        let (own, other) = (placed[contact.index], placed[contact.against]);
        let at = |placed: PlacedSection, by: f64| {
            standing(&layout.sections[placed.section], placed.pose, placed.x_mm - by)
        };
        let near = distance(&at(other, 0.0), &at(own, 0.0)) - layout.gap_mm;
        let nearer = distance(&at(other, 0.0), &at(own, 10.0 * CONTACT_TOLERANCE_MM)) - layout.gap_mm;
        assert!(near > -CONTACT_TOLERANCE_MM && nearer < -1e-9, "{name}: {contact:?} {near} {nearer}");
    }
    touching.len()
}

#[test]
fn what_was_placed_before_the_neighbour_holds_off_too() {
    // A low block lies between two that reach up: the third meets the first.
    let block = |id: &str, width: f64, height: f64| {
        let xy = [0.0, 0.0, width, 0.0, width, height, 0.0, height];
        let shape = traverse_geometry::Ring::from_xy(&xy, &[]).unwrap();
        let part = traverse_geometry::Part {
            id: id.into(),
            shape: traverse_geometry::Polygon::from_ring(shape),
            pole: traverse_geometry::Point::origin(),
            rotation_rad: 0.0,
            mirrored: false,
        };
        traverse_geometry::Section { id: id.into(), parts: vec![part], quantity: 1, poses: vec![Pose::AsIs] }
    };
    let mut high = block("high", 4.0, 10.0);
    high.parts[0].shape = traverse_geometry::Polygon::from_ring(
        traverse_geometry::Ring::from_xy(
            &[0.0, 0.0, 4.0, 0.0, 4.0, 5.0, 30.0, 5.0, 30.0, 10.0, 0.0, 10.0],
            &[],
        )
        .unwrap(),
    );
    let layout = oracle::layout(vec![high, block("low", 10.0, 4.0), block("tall", 5.0, 10.0)]);
    let order: Vec<PlacedSection> =
        (0..3).map(|section| PlacedSection { section, copy: 0, pose: Pose::AsIs, x_mm: 0.0 }).collect();
    let places = |layout: &SectionLayout| -> Vec<f64> {
        place(layout, &order).iter().map(|placed| placed.x_mm).collect()
    };
    assert_eq!(places(&layout), [0.0, 4.0, 30.0]);
    let mut swapped = order.clone();
    swapped.swap(1, 2);
    // Kept in order the low block stays behind the tall one; free, it slides under the first.
    let keep = place(&layout, &swapped);
    assert_eq!((keep[1].x_mm, keep[2].x_mm), (30.0, 35.0));
    let free = SectionLayout { slide_rule: SlideRule::Free, ..layout };
    assert_eq!(place(&free, &swapped)[2].x_mm, 35.0);
}
