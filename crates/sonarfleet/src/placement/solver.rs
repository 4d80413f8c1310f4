//! What every placement method takes and gives.

use super::{Evaluation, PlacementProblem, bound};
use crate::grid::CellId;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// How long a method may search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Budget {
    /// So many proposals, each a layout or a change of one that is evaluated:
    /// reproducible to the bit.
    Evaluations(u64),
    /// So many seconds of wall-clock time: **not** reproducible.
    Seconds(f64),
}

impl Budget {
    /// An equal share for each of several searches that run side by side on the threads
    /// there are.
    pub(super) fn shared(self, searches: usize) -> Self {
        let searches = searches.max(1);
        match self {
            Self::Evaluations(limit) => Self::Evaluations(limit / searches as u64),
            Self::Seconds(limit) => {
                let at_once = rayon::current_num_threads().min(searches);
                Self::Seconds(limit * at_once as f64 / searches as f64)
            }
        }
    }
}

/// A method that places the fleet.
pub trait Solver: Send + Sync {
    /// Its name, as on the command line.
    fn name(&self) -> &'static str;

    /// The best layout it finds: feasible before infeasible, then by `J_d`. A
    /// method that constructs one layout takes what that costs, whatever the
    /// budget. The same seed gives the same bits with any number of threads
    /// unless the budget is in seconds.
    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement;
}

/// A method that suggests several layouts quickly, for another to improve.
pub trait Proposer: Send + Sync {
    /// Its name, in records.
    fn name(&self) -> &'static str;

    /// Layouts, the most promising first, feasible or not; none where it cannot
    /// serve the problem. The same seed gives the same bits with any number of threads.
    fn propose(&self, problem: &PlacementProblem, seed: u64) -> Vec<Vec<CellId>>;
}

/// What a method found.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement {
    /// Name of the method.
    pub method: &'static str,
    /// The vehicles' cells, ascending.
    pub cells: Vec<CellId>,
    /// Full evaluation of them.
    pub evaluation: Evaluation,
    /// No feasible layout has a higher `J_d` than this.
    pub upper_bound: f64,
    /// Proposals evaluated.
    pub evaluations: u64,
    /// Best feasible `J_d` against proposals evaluated; empty while nothing
    /// feasible was found.
    pub history: Vec<(u64, f64)>,
    /// What each part of a method of several parts reached, in the order of their work.
    pub contributions: Vec<Contribution>,
}

/// What one part of a method reached.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Contribution {
    /// Name of the part.
    pub by: String,
    /// Layouts it gave or worked on.
    pub layouts: u64,
    /// Full evaluation of the best of them.
    pub best: Evaluation,
}

impl Placement {
    /// What a method found: the full evaluation of its layout beside the bound.
    /// `history` is cut to what lies below that evaluation, with which it ends.
    pub fn new(
        method: &'static str,
        problem: &PlacementProblem,
        mut cells: Vec<CellId>,
        evaluations: u64,
        mut history: Vec<(u64, f64)>,
    ) -> Self {
        cells.sort_unstable();
        let evaluation = problem.evaluate(&cells);
        // The curve ends with the full evaluation.
        if evaluation.feasible {
            history.retain(|&(_, utility)| utility < evaluation.detection_utility);
            history.push((evaluations, evaluation.detection_utility));
        }
        let upper_bound = bound::upper_bound(problem);
        let contributions = Vec::new();
        Self { method, cells, evaluation, upper_bound, evaluations, history, contributions }
    }
}

/// How much of a budget is used up.
#[derive(Debug, Clone, Copy)]
pub struct Meter {
    budget: Budget,
    start: Instant,
}

impl Meter {
    /// Starts the clock.
    pub fn new(budget: Budget) -> Self {
        Self { budget, start: Instant::now() }
    }

    /// What is left of the budget after so many evaluations.
    pub(super) fn left(&self, evaluations: u64) -> Budget {
        match self.budget {
            Budget::Evaluations(limit) => Budget::Evaluations(limit.saturating_sub(evaluations)),
            Budget::Seconds(limit) => {
                Budget::Seconds((limit - self.start.elapsed().as_secs_f64()).max(0.0))
            }
        }
    }

    /// The used share of the budget after so many evaluations: 1 or more at its end.
    pub fn used(&self, evaluations: u64) -> f64 {
        match self.budget {
            Budget::Evaluations(limit) => evaluations as f64 / limit.max(1) as f64,
            Budget::Seconds(limit) => self.start.elapsed().as_secs_f64() / limit.max(1e-9),
        }
    }

    /// How many of `wanted` further evaluations the budget allows, one at least before
    /// there was any; by the clock, all or none.
    pub(super) fn affordable(&self, evaluations: u64, wanted: usize) -> usize {
        match self.budget {
            Budget::Evaluations(limit) => {
                wanted.min(limit.max(1).saturating_sub(evaluations) as usize)
            }
            Budget::Seconds(_) if evaluations == 0 || self.used(evaluations) < 1.0 => wanted,
            Budget::Seconds(_) => 0,
        }
    }
}
