//! Whether exact layouts ever overlap: orders and poses of chance, both slide rules, with and without a gap, each held
//! against the checker; and whether they are tight, each section being moved left on its own.
//!
//! `cargo bench -p traverse-layout-sequencing --bench overlaps -- [--layouts COUNT] [--seed SEED] FILE…` with files in
//! the form that `read_part_set` takes, the layouts shared out to them. Without files ragged sections made by chance.

mod ragged;

use rand::RngExt;
use std::time::Instant;
use traverse_checker::{ViolationReason, check_sections};
use traverse_drawing::{BlockRules, build_blocks, read_part_set};
use traverse_geometry::{CONTACT_TOLERANCE_MM, PlacedSection, Pose, Section, SectionLayout, SlideRule};
use traverse_layout_sequencing::{Contact, contacts, place};
use traverse_solve::Seed;

/// Sections that orders of one set are drawn from, and how many stand in one layout.
const SECTIONS: usize = 24;
const IN_A_LAYOUT: std::ops::RangeInclusive<usize> = 2..=12;
/// Gaps that are drawn, millimetres.
const GAPS_MM: [f64; 5] = [0.0, 0.0, 0.5, 3.0, 12.0];
/// How far a section is moved left to see whether something holds it: edges that lean much see little of it.
const MOVED_MM: f64 = 10.0 * CONTACT_TOLERANCE_MM;
/// How far from the gap the points of a contact may be: places are rounded up to whole nanometres.
const CONTACT_OFF_MM: f64 = 3e-6;
/// What the checker is asked to see when a section is moved.
const SEEN_MM: f64 = 1e-9;

/// What was found in some layouts.
#[derive(Default)]
struct Found {
    layouts: usize,
    sections: usize,
    overlaps: usize,
    /// Held by the start of the strip, or by the slide rule.
    stopped: usize,
    /// Refused when it is moved left.
    pressed: usize,
    /// Touching at one height alone, along level edges or at corners: what is moved left slides past.
    level: usize,
    not_tight: usize,
}

impl Found {
    fn add(&mut self, other: &Self) {
        self.layouts += other.layouts;
        self.sections += other.sections;
        self.overlaps += other.overlaps;
        self.stopped += other.stopped;
        self.pressed += other.pressed;
        self.level += other.level;
        self.not_tight += other.not_tight;
    }

    fn print(&self, name: &str, seconds: f64) {
        println!(
            "| {name} | {} | {} | {} | {} | {} | {} | {} | {seconds:.1} |",
            self.layouts,
            self.sections,
            self.overlaps,
            self.not_tight,
            self.pressed,
            self.level,
            self.stopped
        );
    }

    /// One layout of chance, placed and checked.
    fn layout(&mut self, layout: &mut SectionLayout, chance: &mut rand_xoshiro::Xoshiro256PlusPlus) {
        layout.gap_mm = GAPS_MM[chance.random_range(0..GAPS_MM.len())];
        layout.slide_rule = [SlideRule::KeepOrder, SlideRule::Free][chance.random_range(0..2)];
        let mut left: Vec<usize> = (0..layout.sections.len()).collect();
        let order: Vec<PlacedSection> = (0..chance.random_range(IN_A_LAYOUT).min(left.len()))
            .map(|_| PlacedSection {
                section: left.swap_remove(chance.random_range(0..left.len())),
                copy: 0,
                pose: Pose::ALL[chance.random_range(0..Pose::ALL.len())],
                x_mm: 0.0,
            })
            .collect();
        let placed = place(layout, &order);
        self.layouts += 1;
        self.sections += placed.len();
        if is_refused(layout, &placed, CONTACT_TOLERANCE_MM) || placed.len() != order.len() {
            self.overlaps += 1;
            println!("refused: gap {} {:?} {placed:?}", layout.gap_mm, layout.slide_rule);
        }
        let touching = contacts(layout, &placed);
        for (index, section) in placed.iter().enumerate() {
            let stop = match layout.slide_rule {
                SlideRule::KeepOrder => index.checked_sub(1).map_or(0.0, |before| placed[before].x_mm),
                SlideRule::Free => 0.0,
            };
            if section.x_mm == stop {
                self.stopped += 1;
                continue;
            }
            let Some(contact) = touching.iter().find(|contact| contact.index == index) else {
                self.not_tight += 1;
                println!("held by nothing: {index} gap {} {:?} {placed:?}", layout.gap_mm, layout.slide_rule);
                continue;
            };
            if is_pressed(layout, &placed, contact) {
                self.pressed += 1;
            } else if is_touching(layout, contact) {
                self.level += 1;
            } else {
                self.not_tight += 1;
                println!("{contact:?} gap {} {:?} {placed:?}", layout.gap_mm, layout.slide_rule);
            }
        }
    }
}

/// Whether the checker says that sections overlap or come too near. Which copies are missing is not asked.
fn is_refused(layout: &SectionLayout, placed: &[PlacedSection], tolerance_mm: f64) -> bool {
    let near =
        |reason| matches!(reason, ViolationReason::SectionsOverlap | ViolationReason::SectionsTooClose);
    let check = check_sections(layout, placed, tolerance_mm);
    check.violations.iter().any(|violation| near(violation.reason))
}

/// Whether the checker refuses the two of a contact when the one that slid is moved left.
fn is_pressed(layout: &SectionLayout, placed: &[PlacedSection], contact: &Contact) -> bool {
    let slid = placed[contact.index];
    let moved = PlacedSection { x_mm: slid.x_mm - MOVED_MM, ..slid };
    is_refused(layout, &[placed[contact.against], moved], SEEN_MM)
}

/// Whether both points of a contact are a gap apart.
fn is_touching(layout: &SectionLayout, contact: &Contact) -> bool {
    ((contact.point - contact.against_point).norm() - layout.gap_mm).abs() <= CONTACT_OFF_MM
}

/// A name and sections of each set: those of the files, otherwise ragged ones.
fn sets(files: &[String]) -> Vec<(String, Vec<Section>)> {
    if files.is_empty() {
        let ragged = |vertices| (format!("ragged, {vertices} vertices"), ragged_sections(vertices));
        return [10, 40, 160].map(ragged).to_vec();
    }
    let mut sets = vec![];
    for file in files {
        let set = std::fs::read(file).ok().and_then(|bytes| read_part_set(&bytes).ok());
        let rules = BlockRules { count: Some(SECTIONS), poses: Pose::ALL.to_vec(), ..BlockRules::default() };
        match set.and_then(|set| build_blocks(&set, &rules).ok()) {
            Some(sections) => {
                let name = file.rsplit('/').next().unwrap_or(file);
                sets.push((name.trim_end_matches(".json").to_owned(), sections));
            }
            None => println!("{file}: no part set"),
        }
    }
    sets
}

fn ragged_sections(vertices: usize) -> Vec<Section> {
    let mut sections = ragged::layout(SECTIONS, vertices, 1).sections;
    sections.iter_mut().for_each(|section| section.poses = Pose::ALL.to_vec());
    sections
}

fn main() {
    let (mut layouts, mut seed, mut files) = (10_000, 0, vec![]);
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    while let Some(argument) = arguments.next() {
        let mut number = || arguments.next().and_then(|value| value.parse::<u64>().ok());
        match argument.as_str() {
            "--layouts" => layouts = number().map_or(layouts, |count| count as usize),
            "--seed" => seed = number().unwrap_or(seed),
            _ => files.push(argument),
        }
    }
    println!("| set | layouts | sections | overlaps | not tight | pressed | level | at a stop | seconds |");
    println!("|---|---|---|---|---|---|---|---|---|");
    let sets = sets(&files);
    let begin = Instant::now();
    let mut all = Found::default();
    for (number, (name, sections)) in sets.iter().enumerate() {
        let own = Instant::now();
        let mut chance = Seed(seed).part(number as u64).stream();
        let mut found = Found::default();
        let mut layout = SectionLayout::new(sections.clone());
        let share = layouts * (number + 1) / sets.len() - layouts * number / sets.len();
        (0..share).for_each(|_| found.layout(&mut layout, &mut chance));
        found.print(name, own.elapsed().as_secs_f64());
        all.add(&found);
    }
    all.print("all", begin.elapsed().as_secs_f64());
}
