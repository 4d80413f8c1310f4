//! What an episode is worth at its end.

use crate::placement::Evaluation;
use crate::sonar::objective::penalised_reward;
use serde::{Deserialize, Serialize};

/// Terminal reward of a placement episode: Equation (10) under a multiplier, which may
/// weigh `J_d` less and add a term that tells disconnected layouts apart.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TerminalReward {
    /// Multiplier λₖ of the shortfall of λ₂.
    pub connectivity_multiplier: f64,
    /// Weight of `J_d`; 1 in the paper.
    pub detection_weight: f64,
    /// Weight of ln(τ/λ₂)₊; 0 in the paper. Where λ₂ is nearly 0 the shortfall τ − λ₂
    /// is flat, and the logarithm is not.
    pub log_shortfall_weight: f64,
}

/// Smaller values of λ₂ are taken to be this one in the logarithm.
const LEAST_CONNECTIVITY: f64 = 1e-4;

impl TerminalReward {
    /// The paper's reward under a multiplier.
    pub const fn paper(connectivity_multiplier: f64) -> Self {
        Self { connectivity_multiplier, detection_weight: 1.0, log_shortfall_weight: 0.0 }
    }

    /// The reward for a layout, with the threshold τ.
    pub fn of(&self, evaluation: &Evaluation, connectivity_threshold: f64) -> f64 {
        let connectivity = evaluation.algebraic_connectivity;
        let shortfall = (connectivity_threshold / connectivity.max(LEAST_CONNECTIVITY)).ln();
        penalised_reward(
            self.detection_weight * evaluation.detection_utility,
            connectivity,
            connectivity_threshold,
            self.connectivity_multiplier,
        ) - self.log_shortfall_weight * shortfall.max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_logarithm_tells_poorly_connected_layouts_apart() {
        let at = |algebraic_connectivity| Evaluation {
            detection_utility: 30.0,
            algebraic_connectivity,
            feasible: false,
        };
        let reward = TerminalReward { log_shortfall_weight: 3.0, ..TerminalReward::paper(0.0) };
        let expected = 30.0 - 3.0 * 10.0_f64.ln();
        assert!((reward.of(&at(0.1), 1.0) - expected).abs() < 1e-12);
        assert!((reward.of(&at(2.0), 1.0) - 30.0).abs() < 1e-12);
        assert!(reward.of(&at(0.0), 1.0).is_finite());
        assert!((TerminalReward::paper(5.0).of(&at(0.5), 1.0) - 27.5).abs() < 1e-12);
    }
}
