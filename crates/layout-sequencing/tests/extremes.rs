//! Sections as large as coordinates permit, thousands of times larger than others, and questions that no order answers:
//! no sum overflows, and nothing is proven that does not hold.

mod oracle;

use rand::{Rng, RngExt};
use traverse_checker::check_sections;
use traverse_geometry::{
    CONTACT_TOLERANCE_MM, COORDINATE_LIMIT_MM, Part, PlacedSection, Point, Polygon, Pose, Ring, Section,
    SectionLayout, SlideRule,
};
use traverse_layout_sequencing::{
    Ending, LayoutAnswer, OrderOptions, layout_length_mm, order_sections, place,
};
use traverse_solve::{Budget, Observer, Seed};

/// The largest that coordinates permit a section to be, about its origin.
const LARGEST_MM: f64 = 2.0 * COORDINATE_LIMIT_MM;

/// A wedge that leans, of a width.
fn wedge(id: usize, width: f64, chance: &mut impl Rng) -> Section {
    let lean = |chance: &mut dyn Rng| width * chance.random_range(0.0..0.4);
    let xy = [
        lean(chance) - width / 2.0,
        0.0,
        width / 2.0 - lean(chance),
        0.0,
        width / 2.0,
        10.0,
        -width / 2.0,
        10.0,
    ];
    let part = Part {
        id: "part".into(),
        shape: Polygon::from_ring(Ring::from_xy(&xy, &[]).expect("convex")),
        pole: Point::origin(),
        rotation_rad: 0.0,
        mirrored: false,
    };
    Section { id: id.to_string(), parts: vec![part], quantity: 1, poses: Pose::ALL[..2].to_vec() }
}

/// Up to five sections of a few sizes, in two poses.
fn layout_of_extremes(chance: &mut impl Rng) -> SectionLayout {
    let count = chance.random_range(2..=5);
    let widths = [LARGEST_MM, LARGEST_MM / 3.0, 1.0, 1e-2];
    let widths: Vec<f64> = (0..count).map(|_| widths[chance.random_range(0..4)]).collect();
    let mut layout =
        oracle::layout(widths.iter().enumerate().map(|(id, &width)| wedge(id, width, chance)).collect());
    layout.slide_rule = [SlideRule::KeepOrder, SlideRule::Free][chance.random_range(0..2)];
    for left in 0..count {
        for right in 0..count {
            if chance.random_bool(0.35) {
                layout.forbidden_joins.push((left, right));
            }
        }
    }
    layout
}

/// Hears bounds and lengths; a bound is no longer than all sections in a row.
struct Hears {
    most_mm: f64,
}

impl Observer for Hears {
    fn better_cost(&mut self, cost: f64) {
        assert!(cost.is_finite() && cost >= 0.0 && cost <= self.most_mm, "{cost}");
    }

    fn better_bound(&mut self, bound: f64) {
        assert!(bound.is_finite() && bound <= self.most_mm, "{bound}");
    }
}

fn ordered(layout: &SectionLayout) -> LayoutAnswer {
    let copies = |section: &Section| section.bounds().size().x * f64::from(section.quantity);
    let most_mm = layout.sections.iter().map(copies).sum::<f64>() * (1.0 + 1e-6) + 1.0;
    let budget = Budget { iterations: Some(20_000), ..Budget::unlimited() };
    order_sections(layout, &OrderOptions::default(), &budget, &mut Hears { most_mm }).expect("no findings")
}

/// The shortest of all orders and poses that are allowed.
fn shortest(layout: &SectionLayout, placed: &mut Vec<PlacedSection>) -> Option<f64> {
    if placed.len() == layout.sections.len() {
        return Some(layout_length_mm(layout, &place(layout, placed)));
    }
    let mut best: Option<f64> = None;
    for section in 0..layout.sections.len() {
        let used = placed.iter().any(|other| other.section == section);
        let barred =
            placed.last().is_some_and(|last| layout.forbidden_joins.contains(&(last.section, section)));
        if used || barred {
            continue;
        }
        for &pose in &layout.sections[section].poses {
            placed.push(PlacedSection { section, copy: 0, pose, x_mm: 0.0 });
            best = [best, shortest(layout, placed)].into_iter().flatten().reduce(f64::min);
            placed.pop();
        }
    }
    best
}

#[test]
fn the_shortest_order_of_extremes_is_found_or_that_there_is_none() {
    let mut chance = Seed(31).stream();
    let mut none = 0;
    for case in 0..150 {
        let layout = layout_of_extremes(&mut chance);
        let answer = ordered(&layout);
        let best = shortest(&layout, &mut vec![]);
        none += usize::from(best.is_none());
        let Some(best) = best else {
            assert_eq!((answer.ending, answer.plan), (Ending::ProvenInfeasible, None), "{case}");
            assert_eq!((answer.lower_bound_mm, answer.certified_lower_bound_mm), (0.0, 0.0), "{case}");
            continue;
        };
        let plan = answer.plan.expect("there is an order");
        // The unit is coarser where sections are long: one for each section may be missing.
        let unit = if best > 1e5 { 1e-4 } else { 1e-5 };
        assert_eq!(answer.ending, Ending::ProvenOptimal, "{case}");
        assert!((plan.length_mm - best).abs() <= 8.0 * unit, "{case}: {} {best}", plan.length_mm);
        assert!(answer.lower_bound_mm <= best + 8.0 * unit, "{case}");
        assert!(answer.certified_lower_bound_mm <= best + 8.0 * unit, "{case}");
        assert!(check_sections(&layout, &plan.order, CONTACT_TOLERANCE_MM).is_sound(), "{case}");
    }
    assert!(none > 3, "{none}");
}

#[test]
fn questions_without_an_order_are_answered_so_with_many_copies_and_poses() {
    // Nothing may stand beside anything of the other half.
    let mut chance = Seed(32).stream();
    for (count, quantity) in [(6, 1), (12, 3), (30, 1)] {
        for width in [10.0, LARGEST_MM] {
            let sections = (0..count).map(|id| wedge(id, width, &mut chance));
            let mut layout = oracle::layout(sections.collect());
            layout.sections.iter_mut().for_each(|section| section.quantity = quantity);
            for left in 0..count {
                let other_half = (0..count).filter(|right| right % 2 != left % 2);
                layout.forbidden_joins.extend(other_half.map(|right| (left, right)));
            }
            let answer = ordered(&layout);
            // That there is none may take longer to prove; that something is proven of it would be wrong.
            assert!(answer.plan.is_none() && answer.ending != Ending::ProvenOptimal, "{count} {width}");
            assert!(count > 6 || answer.ending == Ending::ProvenInfeasible, "{width}: {:?}", answer.ending);
            assert!(answer.ending != Ending::ProvenInfeasible || answer.lower_bound_mm == 0.0);
        }
    }
}

#[test]
fn thousands_of_the_largest_are_bounded() {
    let mut chance = Seed(33).stream();
    for quantity in [150, 1_000] {
        let mut layout = oracle::layout((0..4).map(|id| wedge(id, LARGEST_MM, &mut chance)).collect());
        layout.sections.iter_mut().for_each(|section| section.quantity = quantity);
        let budget = Budget { iterations: Some(200), ..Budget::unlimited() };
        let mut hears = Hears { most_mm: LARGEST_MM * 4.0 * f64::from(quantity) + 1.0 };
        let answer =
            order_sections(&layout, &OrderOptions::default(), &budget, &mut hears).expect("no findings");
        let plan = answer.plan.expect("nothing is forbidden");
        assert!(answer.lower_bound_mm > 0.0 && answer.lower_bound_mm <= plan.length_mm);
        assert!(answer.certified_lower_bound_mm <= answer.lower_bound_mm);
    }
}
