//! What a layout achieves.

use crate::sonar::objective::penalised_reward;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// Multiplier λₖ of the reward R by which methods that may end infeasible are compared.
pub const SCORING_MULTIPLIER: f64 = 30.0;

/// Detection utility and connectivity of a layout, from a full evaluation.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// `J_d`, Equation (6): expected number of targets detected.
    pub detection_utility: f64,
    /// λ₂ of the communication graph of vehicles and fixed sensors; ∞ for a lone vehicle.
    pub algebraic_connectivity: f64,
    /// Whether λ₂ ≥ τ.
    pub feasible: bool,
}

impl Evaluation {
    /// Reward R of Equation (10) under a multiplier λₖ.
    pub fn reward(&self, connectivity_threshold: f64, connectivity_multiplier: f64) -> f64 {
        penalised_reward(
            self.detection_utility,
            self.algebraic_connectivity,
            connectivity_threshold,
            connectivity_multiplier,
        )
    }

    /// Which of two layouts is better (the greater): feasible before infeasible;
    /// among feasible ones the higher utility, among infeasible ones the higher λ₂,
    /// and the higher utility where that is equal.
    pub fn compare(&self, other: &Self) -> Ordering {
        let utility = self.detection_utility.total_cmp(&other.detection_utility);
        self.feasible.cmp(&other.feasible).then_with(|| {
            if self.feasible {
                utility
            } else {
                self.algebraic_connectivity.total_cmp(&other.algebraic_connectivity).then(utility)
            }
        })
    }
}
