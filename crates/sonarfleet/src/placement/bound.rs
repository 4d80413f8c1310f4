//! An upper bound on what any layout can achieve.

use super::PlacementProblem;
use super::coverage::{Coverage, scalar_product, sum};
use crate::grid::CellId;
use rayon::prelude::*;

/// Cells that are worth another thread's while.
const CELLS_PER_TASK: usize = 128;

/// An upper bound on `J_d` of every layout of the problem's size, feasible or not:
/// it does not know about connectivity.
///
/// A target is detected with a probability of at most 1 and at most Σ `P_d` over
/// the layout. Weighing the second by u and the first by `P_T` − u, 0 ≤ u ≤ `P_T`,
/// no layout exceeds
///
/// D(u) = Σ (`P_T` − u) + the G largest of Σ u · `P_d` over the deployable cells,
///
/// for any u: the Lagrangian dual of the linear relaxation of maximal coverage
/// (Fisher 2004, doi:10.1287/mnsc.1040.0263). With u = `P_T` × what a set of cells
/// misses it is the submodular bound of Leskovec et al. (2007,
/// doi:10.1145/1281192.1281239); the best of these over the prefixes of the greedy
/// layout is where projected subgradient steps start.
pub fn upper_bound(problem: &PlacementProblem) -> f64 {
    const STEPS: usize = 300;
    const PATIENCE: usize = 8;

    let (mut weights, reached) = best_prefix(problem);
    let limits = problem.initial_residual();
    let (mut best_value, mut best_weights) = (f64::INFINITY, weights.clone());
    let (mut scale, mut stalled) = (1.0, 0);
    for _ in 0..STEPS {
        let chosen = most_weight(problem, &weights);
        let covered: f64 = chosen.iter().map(|(weight, _)| f64::from(*weight)).sum();
        let value = problem.utility_of_residual(sum(&weights)) + covered;
        if value < best_value {
            (best_value, stalled) = (value, 0);
            best_weights.copy_from_slice(&weights);
        } else {
            stalled += 1;
            if stalled == PATIENCE {
                (scale, stalled) = (0.5 * scale, 0);
                weights.copy_from_slice(&best_weights);
                continue;
            }
        }
        // The subgradient: Σ P_d over the chosen cells − 1.
        let mut slope = vec![chosen.len() as f32 - 1.0; weights.len()];
        for (_, cell) in &chosen {
            for (slope, miss) in slope.iter_mut().zip(problem.miss(*cell)) {
                *slope -= miss;
            }
        }
        // Targets of no weight only fill up the rows.
        for (slope, limit) in slope.iter_mut().zip(limits) {
            *slope = if *limit > 0.0 { *slope } else { 0.0 };
        }
        let length_squared = f64::from(scalar_product(&slope, &slope));
        let step = (scale * (value - reached).max(0.0) / length_squared.max(1e-30)) as f32;
        for ((weight, slope), limit) in weights.iter_mut().zip(&slope).zip(limits) {
            *weight = (*weight - step * slope).clamp(0.0, *limit);
        }
    }
    exact_value(problem, &best_weights)
}

/// Residual of the prefix of the greedy layout that gives the least bound, and
/// `J_d` of the whole greedy layout.
fn best_prefix(problem: &PlacementProblem) -> (Vec<f32>, f64) {
    let mut coverage = Coverage::new(problem, &[]);
    let (mut least, mut best) = (f64::INFINITY, problem.initial_residual().to_vec());
    for slot in 0..problem.vehicles() {
        let chosen = most_weight(problem, coverage.residual());
        let gains: f64 = chosen.iter().map(|(gain, _)| f64::from(*gain)).sum();
        if coverage.utility() + gains < least {
            least = coverage.utility() + gains;
            best.copy_from_slice(coverage.residual());
        }
        coverage.insert(slot, chosen[0].1);
    }
    (best, coverage.utility())
}

/// The G deployable cells with the largest Σ weight · `P_d`, largest first.
fn most_weight(problem: &PlacementProblem, weights: &[f32]) -> Vec<(f32, CellId)> {
    let total = sum(weights);
    let mut cells: Vec<(f32, CellId)> = problem
        .deployable()
        .par_iter()
        .with_min_len(CELLS_PER_TASK)
        .map(|&cell| (total - scalar_product(weights, problem.miss(cell)), cell))
        .collect();
    let largest_first =
        |a: &(f32, CellId), b: &(f32, CellId)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
    let vehicles = problem.vehicles();
    if vehicles < cells.len() {
        cells.select_nth_unstable_by(vehicles, largest_first);
        cells.truncate(vehicles);
    }
    cells.sort_unstable_by(largest_first);
    cells
}

/// D(u) in double precision, over all targets; those that the search leaves out
/// count as detected.
fn exact_value(problem: &PlacementProblem, weights: &[f32]) -> f64 {
    let prior = problem.prior().values();
    let mut left = prior.to_vec();
    for &cell in problem.fixed_sensors() {
        for (left, p_d) in left.iter_mut().zip(problem.detection(cell)) {
            *left *= 1.0 - p_d;
        }
    }
    let mut all_weights = vec![0.0; prior.len()];
    for (&target, &weight) in problem.targets().iter().zip(weights) {
        all_weights[target.0] = f64::from(weight).min(left[target.0]);
    }
    let weighed = |cell: &CellId| -> f64 {
        all_weights.iter().zip(problem.detection(*cell)).map(|(weight, p_d)| weight * p_d).sum()
    };
    let mut covered: Vec<f64> = problem.deployable().iter().map(weighed).collect();
    covered.sort_unstable_by(|a, b| b.total_cmp(a));
    covered.truncate(problem.vehicles());
    let total = problem.prior().total();
    // D(0) = Σ P_T holds too.
    total + (covered.iter().sum::<f64>() - all_weights.iter().sum::<f64>()).min(0.0)
}
