//! The simplex method against an independent solver.

use super::dual_method::Ending;
use super::simplex::Simplex;
use crate::work::Work;
use microlp::{ComparisonOp, OptimizationDirection, Problem};
use rand::RngExt;
use traverse_solve::{Budget, Seed};

/// Values agree with an independent solver, however rows and bounds come and go.
#[test]
fn random_programs_have_the_cost_that_microlp_finds() {
    let budget = Budget::unlimited();
    let work = Work::new(&budget);
    let mut chance = Seed(3).stream();
    let (mut optimal, mut infeasible) = (0, 0);
    for _ in 0..300 {
        let (rows, columns) = (chance.random_range(1..4), chance.random_range(3..9));
        let right: Vec<f64> = (0..rows).map(|_| f64::from(chance.random_range(0..4))).collect();
        let mut simplex = Simplex::new(&right);
        let mut costs = vec![];
        let mut matrix: Vec<(Vec<f64>, bool, f64)> = right.iter().map(|&b| (vec![], true, b)).collect();
        let mut bounds = vec![];
        let mut numbers = vec![];
        for _ in 0..columns {
            let cost = f64::from(chance.random_range(-5..10));
            let upper = f64::from(chance.random_range(1..4));
            let entries: Vec<f64> = (0..rows).map(|_| f64::from(chance.random_range(0..2))).collect();
            let sparse = entries.iter().copied().enumerate().filter(|&(_, value)| value != 0.0).collect();
            let duals = simplex.duals();
            numbers.push(simplex.add_column(cost, upper, sparse, &duals));
            costs.push(cost);
            bounds.push((0.0, upper));
            for (row, value) in entries.into_iter().enumerate() {
                matrix[row].0.push(value);
            }
        }
        simplex.refresh_values();
        for step in 0..4 {
            let ending = simplex.solve(1000, &work).expect("no limit");
            let mut problem = Problem::new(OptimizationDirection::Minimize);
            let variables: Vec<_> =
                costs.iter().zip(&bounds).map(|(&cost, &bound)| problem.add_var(cost, bound)).collect();
            for (entries, equal, right) in &matrix {
                let terms: Vec<_> = variables.iter().copied().zip(entries.iter().copied()).collect();
                let sense = if *equal { ComparisonOp::Eq } else { ComparisonOp::Ge };
                problem.add_constraint(&terms, sense, *right);
            }
            match problem.solve() {
                Ok(outcome) => {
                    assert_eq!(ending, Ending::Optimal);
                    let expected = outcome.solution().expect("no limit").objective();
                    assert!((simplex.objective() - expected).abs() < 1e-6);
                    optimal += 1;
                }
                Err(_) => {
                    assert!(matches!(ending, Ending::Infeasible(_)), "{ending:?}");
                    infeasible += 1;
                    break;
                }
            }
            if step == 1 {
                let loose: Vec<bool> =
                    (0..simplex.rows()).map(|row| row >= rows && simplex.is_loose(row)).collect();
                let mut at = 0;
                matrix.retain(|_| {
                    at += 1;
                    !loose[at - 1]
                });
                simplex.remove_loose_rows(&loose);
            }
            if step == 2 {
                let column = chance.random_range(0..columns);
                bounds[column] = (1.0, 1.0);
                simplex.set_bounds(numbers[column], 1.0, 1.0);
                simplex.refresh_values();
                continue;
            }
            let entries: Vec<f64> = (0..columns).map(|_| f64::from(chance.random_range(0..2))).collect();
            let right = f64::from(chance.random_range(0..3));
            let sparse: Vec<(usize, f64)> =
                numbers.iter().copied().zip(entries.iter().copied()).filter(|&(_, v)| v != 0.0).collect();
            simplex.add_row(&sparse, right);
            matrix.push((entries, false, right));
        }
    }
    assert!(optimal > 300 && infeasible > 30, "{optimal} {infeasible}");
}
