//! Simulated annealing with exchanges.

use super::chain::{Chain, Cooling};
use super::solver::Meter;
use super::{Budget, Placement, PlacementProblem, Solver, compact, greedy};
use crate::grid::CellId;
use crate::random::stream;
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Simulated annealing (Kirkpatrick, Gelatt & Vecchi 1983,
/// doi:10.1126/science.220.4598.671): a vehicle moves to a free cell, mostly near
/// itself or near another vehicle. Layouts whose λ₂ is below τ pay for it, the more the
/// longer the search stays there, so that it swings about the threshold while the
/// temperature falls geometrically.
///
/// Starts from connected greedy or, where that is infeasible, from the best disc;
/// where no disc is feasible either, exchanges that raise λ₂ come first. A proposal
/// costs about a microsecond; several chains share the budget.
#[derive(Debug, Clone, Copy)]
pub struct Annealing {
    /// Independent chains; an evaluation budget is divided among them, and they
    /// run on as many threads as there are. The result depends on their number,
    /// not on that of the threads.
    pub chains: NonZeroUsize,
}

impl Default for Annealing {
    fn default() -> Self {
        Self { chains: const { NonZeroUsize::new(4).unwrap() } }
    }
}

const COOLING: Cooling = Cooling { from: 0.1, to: 0.007 };

impl Solver for Annealing {
    fn name(&self) -> &'static str {
        "annealing"
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement {
        let meter = Meter::new(budget);
        let (start, spent) = start(problem);
        let starts = vec![start; self.chains.get()];
        let left = meter.left(spent);
        let chains = anneal(problem, &starts, left, COOLING, (seed, "placement/annealing"));
        let (best, evaluations, history) = join(problem, &chains, spent);
        Placement::new(self.name(), problem, best, evaluations, history)
    }
}

/// A layout to start from, feasible where a simple one is, and its evaluations.
pub(super) fn start(problem: &PlacementProblem) -> (Vec<CellId>, u64) {
    let (greedy, evaluations, _) = greedy::connected(problem);
    if problem.evaluate(&greedy).feasible {
        return (greedy, evaluations);
    }
    let disc = compact::best_disc(problem);
    let better = problem.evaluate(&disc).compare(&problem.evaluate(&greedy)).is_gt();
    (if better { disc } else { greedy }, evaluations + problem.deployable().len() as u64)
}

/// A chain from each start, with equal shares of a budget.
pub(super) fn anneal<'p>(
    problem: &'p PlacementProblem,
    starts: &[Vec<CellId>],
    budget: Budget,
    cooling: Cooling,
    (seed, purpose): (u64, &str),
) -> Vec<Chain<'p>> {
    let share = budget.shared(starts.len());
    starts
        .par_iter()
        .enumerate()
        .map(|(index, start)| {
            let mut chain = Chain::new(problem, start, stream(seed, purpose, index as u64));
            chain.run(share, cooling);
            chain
        })
        .collect()
}

/// The best layout of several chains, the evaluations of all of them with those
/// before, and the best so far against these: chains are taken to be equally far.
pub(super) fn join(
    problem: &PlacementProblem,
    chains: &[Chain],
    spent: u64,
) -> (Vec<CellId>, u64, Vec<(u64, f64)>) {
    let count = chains.len() as u64;
    let points = chains.iter().flat_map(|chain| chain.history.iter());
    let mut points: Vec<(u64, f64)> =
        points.map(|&(proposals, utility)| (spent + proposals * count, utility)).collect();
    points.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    let mut highest = f64::NEG_INFINITY;
    points.retain(|&(_, utility)| {
        let better = utility > highest;
        highest = highest.max(utility);
        better
    });
    let (_, best) = chains
        .iter()
        .map(|chain| (problem.evaluate(&chain.best), &chain.best))
        .reduce(|a, b| if b.0.compare(&a.0).is_gt() { b } else { a })
        .expect("there is at least one chain");
    let evaluations = spent + chains.iter().map(|chain| chain.proposals).sum::<u64>();
    (best.clone(), evaluations, points)
}
