//! Costs from many points to many in one question, beside as many single moves in a prepared scene.

use crate::scattered::{moves, scattered};
use crate::timing::timed;
use traverse_geometry::{Point, RapidRules};
use traverse_planner::{Algorithm, Answer, DistanceQuery, PreparedScene, RapidMove, plan_distances};
use traverse_solve::{Budget, Silent};

/// Points on either side.
const POINTS: usize = 100;

/// Rounds in turns; the least of them counts.
const ROUNDS: usize = 3;

/// Prints a row for each size and clearance. *Single*: the scene is prepared and every pair asked for; *again*: every
/// pair once more, when all that is seen from where is known.
pub(crate) fn table() {
    println!("\ndistances, {POINTS} × {POINTS} points: ms, least of {ROUNDS}; µs per pair");
    println!(
        "{:>6} {:>9} {:>10} {:>9} {:>10} {:>7} {:>10} {:>7}",
        "N", "clearance", "traverse", "per pair", "single", "ratio", "again", "ratio"
    );
    for n in [100, 900] {
        for clearance_mm in [0.0, 1.5] {
            row(n, clearance_mm);
        }
    }
}

fn row(n: usize, clearance_mm: f64) {
    let scene = scattered(n, clearance_mm);
    let (from, to): (Vec<Point>, Vec<Point>) =
        moves(&scene, POINTS).into_iter().map(|query| (query.start, query.target)).unzip();
    let question = DistanceQuery { from, to, algorithm: Algorithm::Exact, rules: RapidRules::default() };
    let mut least = [f64::INFINITY; 3];
    for _ in 0..ROUNDS {
        let (together, costs) = timed(|| plan_distances(&scene, &question, &Budget::unlimited()).unwrap());
        let ours = scene.clone();
        let (single, (mut kept, one_by_one)) = timed(|| {
            let mut kept = PreparedScene::new(ours, &Budget::unlimited()).unwrap();
            let costs = each(&mut kept, &question);
            (kept, costs)
        });
        let (again, _) = timed(|| each(&mut kept, &question));
        for (a, b) in costs.iter().zip(&one_by_one) {
            assert!((a - b).abs() <= 1e-9 * a.max(1.0), "{a} is not {b}");
        }
        for (least, time) in least.iter_mut().zip([together, single, again]) {
            *least = least.min(time);
        }
    }
    let [together, single, again] = least;
    println!(
        "{n:>6} {clearance_mm:>9} {:>10.2} {:>9.2} {:>10.1} {:>7} {:>10.1} {:>7}",
        together / 1e3,
        together / (POINTS * POINTS) as f64,
        single / 1e3,
        format!("1/{:.1}", single / together),
        again / 1e3,
        format!("1/{:.1}", again / together),
    );
}

/// The cost of every pair, one after the other.
fn each(kept: &mut PreparedScene, question: &DistanceQuery) -> Vec<f64> {
    let pairs =
        question.from.iter().flat_map(|&start| question.to.iter().map(move |&target| (start, target)));
    let queries = pairs.map(|(start, target)| RapidMove {
        start,
        target,
        algorithm: Algorithm::Exact,
        rules: RapidRules::default(),
    });
    queries
        .map(|query| match kept.plan(&query, &Budget::unlimited(), &mut Silent) {
            Ok((Answer::Plan(plan), _)) => plan.cost,
            other => panic!("no plan: {other:?}"),
        })
        .collect()
}
