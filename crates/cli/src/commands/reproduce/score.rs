//! What layouts are worth, and how that is said.

use serde::Serialize;
use sonarfleet::grid::CellId;
use sonarfleet::placement::{Evaluation, PlacementProblem, SCORING_MULTIPLIER};
use sonarfleet::record::{ScoreRecord, median};

/// What a layout is worth.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Score {
    /// R under the multiplier by which methods are compared.
    pub(super) reward: f64,
    #[serde(flatten)]
    pub(super) evaluation: Evaluation,
}

impl Score {
    pub(super) fn of(problem: &PlacementProblem, layout: &[CellId]) -> Self {
        let evaluation = problem.evaluate(layout);
        let reward = evaluation.reward(problem.connectivity_threshold(), SCORING_MULTIPLIER);
        Self { reward, evaluation }
    }

    pub(super) fn record(&self, name: &str) -> ScoreRecord {
        ScoreRecord {
            name: name.into(),
            reward: self.reward,
            detection_utility: self.evaluation.detection_utility,
            algebraic_connectivity: self.evaluation.algebraic_connectivity,
        }
    }
}

/// The median R.
pub(super) fn reward(scores: &[Score]) -> f64 {
    median(scores.iter().map(|score| score.reward).collect())
}

/// The median `J_d`.
pub(super) fn utility(scores: &[Score]) -> f64 {
    median(scores.iter().map(|score| score.evaluation.detection_utility).collect())
}

/// "R 35.98 (`J_d` 36.10, λ₂ 0.946; 2 of 3 feasible)", each number the median by itself.
pub(super) fn text(scores: &[Score]) -> String {
    let feasible = scores.iter().filter(|score| score.evaluation.feasible).count();
    let connectivity = scores.iter().map(|score| score.evaluation.algebraic_connectivity).collect();
    format!(
        "R {} (J_d {:.2}, λ₂ {:.3}; {feasible} of {} feasible)",
        number(reward(scores), 2),
        utility(scores),
        median(connectivity),
        scores.len(),
    )
}

/// A number with a true minus sign; a dash where there is none.
pub(super) fn number(value: f64, decimals: usize) -> String {
    if value.is_finite() { format!("{value:.decimals$}").replace('-', "−") } else { "–".into() }
}

/// How much more one number is than another, which is positive: "+16.0 %".
pub(super) fn more(than: f64, value: f64, decimals: usize) -> String {
    if than > 0.0 {
        let percent = format!("{:+.decimals$} %", 100.0 * (value / than - 1.0));
        percent.replace('-', "−")
    } else {
        "–".into()
    }
}

/// Index of the run with the median R, the lower of the middle two.
pub(super) fn median_run(scores: &[Score]) -> usize {
    let mut order: Vec<usize> = (0..scores.len()).collect();
    order.sort_by(|&a, &b| scores[a].reward.total_cmp(&scores[b].reward));
    order[(order.len() - 1) / 2]
}
