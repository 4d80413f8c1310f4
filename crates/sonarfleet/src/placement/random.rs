//! Layouts by chance.

use super::solver::Meter;
use super::{Budget, Evaluation, Placement, PlacementProblem, Solver};
use crate::grid::CellId;
use crate::random::{Stream, stream};
use rand::seq::SliceRandom;
use std::cmp::Ordering;

/// Uniformly random layouts, the best of as many as the budget allows (one at
/// least). With a budget of one evaluation it is the paper's random deployment.
#[derive(Debug, Clone, Copy, Default)]
pub struct RandomSearch;

impl Solver for RandomSearch {
    fn name(&self) -> &'static str {
        "random"
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement {
        let mut random = stream(seed, "placement/random", 0);
        let meter = Meter::new(budget);
        let mut best: Option<(Evaluation, Vec<CellId>)> = None;
        let mut evaluations = 0;
        let mut history = Vec::new();
        while best.is_none() || meter.used(evaluations) < 1.0 {
            let layout = random_layout(problem, &mut random);
            let evaluation = problem.evaluate(&layout);
            evaluations += 1;
            let better =
                best.as_ref().is_none_or(|(best, _)| evaluation.compare(best) == Ordering::Greater);
            if better {
                if evaluation.feasible {
                    history.push((evaluations, evaluation.detection_utility));
                }
                best = Some((evaluation, layout));
            }
        }
        let cells = best.map(|(_, layout)| layout).unwrap_or_default();
        Placement::new(self.name(), problem, cells, evaluations, history)
    }
}

/// A uniformly random layout.
pub(super) fn random_layout(problem: &PlacementProblem, random: &mut Stream) -> Vec<CellId> {
    let mut cells = problem.deployable().to_vec();
    let (chosen, _) = cells.partial_shuffle(random, problem.vehicles());
    chosen.to_vec()
}
