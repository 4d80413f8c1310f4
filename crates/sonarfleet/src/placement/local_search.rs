//! Improvement by exchanges until none improves.

use super::coverage::Coverage;
use super::network::Network;
use super::solver::Meter;
use super::{Budget, Placement, PlacementProblem, Solver, compact, greedy};
use crate::grid::CellId;

/// Connected greedy (or the best disc where that is infeasible), then for one
/// vehicle after the other the best exchange that keeps λ₂ ≥ τ, until no exchange
/// of any vehicle improves or the budget is spent. Deterministic.
#[derive(Debug, Clone, Copy, Default)]
pub struct LocalSearch;

/// Improvements of `J_d` below this are rounding.
const LEAST_IMPROVEMENT: f64 = 1e-5;

impl Solver for LocalSearch {
    fn name(&self) -> &'static str {
        "local-search"
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, _seed: u64) -> Placement {
        let meter = Meter::new(budget);
        let (mut layout, mut evaluations, mut history) = greedy::connected(problem);
        let mut network = Network::new(problem, &layout);
        if network.is_none() {
            evaluations += problem.deployable().len() as u64;
            layout = compact::best_disc(problem);
            network = Network::new(problem, &layout);
        }
        let Some(mut network) = network else {
            return Placement::new(self.name(), problem, layout, evaluations, history);
        };

        let mut coverage = Coverage::new(problem, &layout);
        let mut unchanged = 0;
        let mut slot = 0;
        while unchanged < problem.vehicles() && meter.used(evaluations) < 1.0 {
            evaluations += (problem.deployable().len() - problem.vehicles()) as u64;
            if let Some(utility) = improve(problem, &mut coverage, &mut network, slot) {
                history.push((evaluations, utility));
                unchanged = 0;
            } else {
                unchanged += 1;
            }
            slot = (slot + 1) % problem.vehicles();
        }
        let cells = coverage.layout().to_vec();
        Placement::new(self.name(), problem, cells, evaluations, history)
    }
}

/// Moves the vehicle in `slot` to the best cell that is better than its own and
/// keeps the network; the new utility where there is one.
fn improve(
    problem: &PlacementProblem,
    coverage: &mut Coverage,
    network: &mut Network,
    slot: usize,
) -> Option<f64> {
    let old = coverage.remove(slot);
    let least = coverage.utility_with(old) + LEAST_IMPROVEMENT;
    let threshold = network.threshold();
    let mut better: Vec<(f64, CellId)> = problem
        .deployable()
        .iter()
        .filter(|cell| **cell != old && !coverage.layout().contains(cell))
        .map(|&cell| (coverage.utility_with(cell), cell))
        .filter(|&(utility, _)| utility > least)
        .collect();
    better.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let found = better.into_iter().find(|&(_, cell)| network.try_exchange(slot, cell, threshold));
    coverage.insert(slot, found.map_or(old, |(_, cell)| cell));
    found.map(|(utility, _)| utility)
}
