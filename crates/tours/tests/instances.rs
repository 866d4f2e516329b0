//! Instances from the literature: optima found, proven and certified, without being told.

use std::path::Path;
use traverse_solve::{Budget, Seed, Silent};
use traverse_tours::{Ending, SolveOptions, TourSpecification, read_tsplib, solve, verify_certificate};

fn read(file: &str) -> TourSpecification {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(file);
    let text = std::fs::read_to_string(&path).expect("the file is part of the crate");
    read_tsplib(&text).expect("a valid file")
}

fn check(file: &str, optimum: i64, options: &SolveOptions) {
    let specification = read(file);
    let answer = solve(&specification, options, &Budget::unlimited(), &mut Silent).expect("no findings");
    let tour = answer.tour.expect("there is a tour");
    assert_eq!(
        (tour.cost, answer.lower_bound, answer.ending),
        (optimum, optimum, Ending::ProvenOptimal),
        "{file}"
    );
    let proven = verify_certificate(&specification, &answer.certificate);
    assert_eq!(proven, Ok(answer.certified_bound), "{file}");
    assert!(answer.certified_bound <= optimum);
}

#[test]
fn asymmetric_tours_are_proven() {
    for (file, optimum) in [
        ("br17.atsp", 39),
        ("ftv33.atsp", 1286),
        ("ftv47.atsp", 1776),
        ("ft53.atsp", 6905),
        ("ry48p.atsp", 14422),
        ("p43.atsp", 5620),
        ("HardATSPLIB_11.atsp", 104),
        ("HardATSPLIB_19.atsp", 380),
        ("mao_rep3x7.atsp", 90630),
        ("swim_rep10x10.atsp", 240_372),
        ("shirts_50.atsp", 157_758),
    ] {
        check(file, optimum, &SolveOptions::default());
    }
}

#[test]
fn two_threads_prove_the_same() {
    for (file, optimum) in [("ry48p.atsp", 14422), ("kro124p.atsp", 36230), ("swim_rep10x10.atsp", 240_372)] {
        check(file, optimum, &SolveOptions { threads: 2, seed: Seed(5), ..SolveOptions::default() });
    }
}

#[test]
fn ordered_tours_reach_the_best_known() {
    for (file, optimum) in
        [("br17.12.sop", 55), ("ESC47.sop", 1288), ("prob.42.sop", 243), ("ft53.4.sop", 14425)]
    {
        let specification = read(file);
        let budget = Budget { iterations: Some(30_000), ..Budget::unlimited() };
        let answer =
            solve(&specification, &SolveOptions::default(), &budget, &mut Silent).expect("no findings");
        let tour = answer.tour.expect("there is a tour");
        assert_eq!(tour.cost, optimum, "{file}");
        assert!(answer.lower_bound <= optimum);
        for &(before, after) in &specification.precedence {
            let at = |node| tour.visits.iter().position(|&visit| visit == node);
            assert!(at(before) < at(after), "{file}: {before} before {after}");
        }
        let proven = verify_certificate(&specification, &answer.certificate);
        assert_eq!(proven, Ok(answer.certified_bound), "{file}");
    }
}
