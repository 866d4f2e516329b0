//! Certificates prove what they say, and corrupted ones nothing more.

use rand::RngExt;
use traverse_solve::{Budget, Seed, Silent};
use traverse_tours::{
    Certificate, CertificateFault, CostMatrix, SolveOptions, TourSpecification, solve, verify_certificate,
};

fn solved(seed: u64) -> (TourSpecification, Certificate, i64, i64) {
    let mut chance = Seed(seed).stream();
    let size = 12 + chance.random_range(0..30);
    let entries = (0..size * size).map(|_| chance.random_range(0..500)).collect();
    let specification = TourSpecification::path(CostMatrix::new(size, entries).expect("small costs"));
    let answer = solve(&specification, &SolveOptions::default(), &Budget::unlimited(), &mut Silent);
    let answer = answer.expect("no findings");
    let cost = answer.tour.expect("there is a tour").cost;
    (specification, answer.certificate, answer.certified_bound, cost)
}

#[test]
fn a_corrupted_certificate_is_refused_or_proves_no_more_than_the_optimum() {
    let mut refused = 0;
    for seed in 0..40 {
        let (specification, certificate, bound, cost) = solved(seed);
        assert_eq!(verify_certificate(&specification, &certificate), Ok(bound));
        let mut chance = Seed(seed).stream();
        for _ in 0..50 {
            let mut corrupted = certificate.clone();
            let raise = chance.random_range(1..=1000) * corrupted.parts;
            let node = chance.random_range(0..corrupted.row.len());
            match chance.random_range(0..4) {
                0 => corrupted.row[node] += raise,
                1 => corrupted.column[node] += raise,
                2 => match corrupted.sets.first_mut() {
                    Some(set) => set.1 += raise,
                    None => corrupted.sets.push((vec![node], raise)),
                },
                _ => corrupted.parts = 1,
            }
            match verify_certificate(&specification, &corrupted) {
                Ok(proven) => assert!(proven <= cost, "{proven} > {cost}"),
                Err(_) => refused += 1,
            }
        }
    }
    assert!(refused > 1500, "{refused}");
}

#[test]
fn malformed_certificates_are_refused() {
    let (specification, certificate, ..) = solved(1);
    let with = |change: &dyn Fn(&mut Certificate)| {
        let mut changed = certificate.clone();
        change(&mut changed);
        verify_certificate(&specification, &changed)
    };
    let nodes = certificate.row.len();
    assert!(matches!(with(&|c| c.row.truncate(1)), Err(CertificateFault::Size { duals: 1, .. })));
    assert!(matches!(with(&|c| c.parts = 0), Err(CertificateFault::Parts { parts: 0 })));
    for set in [vec![], vec![nodes], vec![0, 0], (0..nodes).collect()] {
        assert!(matches!(with(&|c| c.sets = vec![(set.clone(), 1)]), Err(CertificateFault::Set { set: 0 })));
    }
    assert!(matches!(with(&|c| c.sets = vec![(vec![0], -1)]), Err(CertificateFault::Set { set: 0 })));
    assert!(matches!(with(&|c| c.row[0] = i64::MAX), Err(CertificateFault::Arc { from: 0, .. })));
}
