//! What the methods share that improve a population of layouts: where it starts,
//! how its members are scored, and which layout is kept.

use super::random::random_layout;
use super::{Evaluation, PlacementProblem, SCORING_MULTIPLIER, compact, greedy};
use crate::grid::CellId;
use crate::random::stream;
use rand::Rng;

/// The layouts with which a population starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// Uniformly random ones, as the paper's.
    Random,
    /// Connected greedy, the best disc, and discs around random cells.
    Feasible,
}

impl Start {
    /// The first `count` layouts. With the same seed a larger population starts with
    /// the layouts of a smaller one, and more. What the simple methods try before they
    /// settle on theirs is not counted as evaluations of the population.
    pub fn layouts(self, problem: &PlacementProblem, count: usize, seed: u64) -> Vec<Vec<CellId>> {
        let simple = match self {
            Self::Random => Vec::new(),
            Self::Feasible => vec![greedy::connected(problem).0, compact::best_disc(problem)],
        };
        let by_chance = |k: usize| {
            let mut random = stream(seed, "placement/start", k as u64);
            match self {
                Self::Random => random_layout(problem, &mut random),
                Self::Feasible => {
                    let cells = problem.deployable();
                    compact::disc(problem, cells[random.random_range(0..cells.len())])
                }
            }
        };
        let further = (simple.len()..count).map(by_chance);
        simple.iter().take(count).cloned().chain(further).collect()
    }
}

/// A layout's evaluation and score.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judgement {
    evaluation: Evaluation,
    /// R under [`SCORING_MULTIPLIER`].
    pub(super) score: f64,
}

impl Judgement {
    pub(super) fn of(problem: &PlacementProblem, layout: &[CellId]) -> Self {
        let evaluation = problem.evaluate(layout);
        let score = evaluation.reward(problem.connectivity_threshold(), SCORING_MULTIPLIER);
        Self { evaluation, score }
    }
}

/// The best layout that a population has seen: feasible before infeasible, then by R,
/// which is `J_d` among feasible ones.
#[derive(Debug, Default)]
pub(super) struct Best {
    pub(super) cells: Vec<CellId>,
    judgement: Option<Judgement>,
    /// Best feasible `J_d` against layouts evaluated.
    pub(super) history: Vec<(u64, f64)>,
}

impl Best {
    /// Keeps a layout, the `number`-th that was evaluated, if it is better.
    pub(super) fn offer(&mut self, number: u64, cells: &[CellId], judgement: Judgement) {
        let rank = |judgement: Judgement| (judgement.evaluation.feasible, judgement.score);
        if self.judgement.is_some_and(|present| rank(judgement) <= rank(present)) {
            return;
        }
        self.judgement = Some(judgement);
        cells.clone_into(&mut self.cells);
        if judgement.evaluation.feasible {
            self.history.push((number, judgement.evaluation.detection_utility));
        }
    }
}
