//! Upper bounds on what any layout can achieve.

use super::PlacementProblem;
use crate::grid::CellId;

/// An upper bound on `J_d` of every layout of the problem's size, feasible or not.
///
/// `J_d` is monotone and submodular, so for every set A of cells no layout exceeds
/// `J_d`(A) plus the G largest gains over A (Leskovec et al. 2007,
/// doi:10.1145/1281192.1281239, section 4). The bound is the least of these over
/// the prefixes of the greedy layout and the given layout. It does not know about
/// connectivity.
pub fn upper_bound(problem: &PlacementProblem, layout: &[CellId]) -> f64 {
    let mut residual = residual(problem, &[]);
    let mut least = f64::INFINITY;
    for _ in 0..=problem.vehicles() {
        let gains = gains(problem, &residual);
        least = least.min(bound_over(problem, &residual, &gains));
        let best = (0..gains.len()).max_by(|&a, &b| gains[a].total_cmp(&gains[b]));
        // There is one: the problem has at least as many deployable cells as vehicles, and at least one.
        if let Some(best) = best {
            multiply(&mut residual, problem.detection(problem.deployable()[best]));
        }
    }
    let residual = self::residual(problem, layout);
    least.min(bound_over(problem, &residual, &gains(problem, &residual)))
}

/// Prior times what the fixed sensors and a layout miss.
fn residual(problem: &PlacementProblem, layout: &[CellId]) -> Vec<f64> {
    let mut residual = problem.prior().values().to_vec();
    for &cell in problem.fixed_sensors().iter().chain(layout) {
        multiply(&mut residual, problem.detection(cell));
    }
    residual
}

fn multiply(residual: &mut [f64], detection: &[f64]) {
    for (residual, p_d) in residual.iter_mut().zip(detection) {
        *residual *= 1.0 - p_d;
    }
}

/// Gain of each deployable cell.
fn gains(problem: &PlacementProblem, residual: &[f64]) -> Vec<f64> {
    let gain = |cell: &CellId| {
        residual.iter().zip(problem.detection(*cell)).map(|(left, p_d)| left * p_d).sum()
    };
    problem.deployable().iter().map(gain).collect()
}

fn bound_over(problem: &PlacementProblem, residual: &[f64], gains: &[f64]) -> f64 {
    let reached = problem.prior().total() - residual.iter().sum::<f64>();
    let mut gains = gains.to_vec();
    gains.sort_unstable_by(|a, b| b.total_cmp(a));
    let further: f64 = gains.iter().take(problem.vehicles()).sum();
    // Not more than there is.
    (reached + further).min(problem.prior().total())
}
