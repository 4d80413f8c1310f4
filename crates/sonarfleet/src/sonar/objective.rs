//! What a layout is worth: Eqs. (5), (6), (10) and (11) of the paper.

/// Network detection probability `P_net` of one cell from the probabilities with
/// which each sonar detects a target there, independently of one another.
pub fn network_detection_probability(detection: impl IntoIterator<Item = f64>) -> f64 {
    1.0 - detection.into_iter().map(|p| 1.0 - p).product::<f64>() // Eq. (5)
}

/// Detection utility `J_d`: the expected number of targets that are detected.
///
/// # Panics
/// Unless there is one probability per cell of the prior.
pub fn detection_utility(prior: &[f64], network_detection: &[f64]) -> f64 {
    assert_eq!(prior.len(), network_detection.len(), "one probability per cell");
    prior.iter().zip(network_detection).map(|(p_t, p_net)| p_t * p_net).sum() // Eq. (6)
}

/// Reward R: the detection utility less what connectivity falls short of its
/// threshold τ, weighted by the multiplier λₖ.
pub fn penalised_reward(
    detection_utility: f64,
    algebraic_connectivity: f64,
    connectivity_threshold: f64,
    connectivity_multiplier: f64,
) -> f64 {
    let violation = (connectivity_threshold - algebraic_connectivity).max(0.0);
    detection_utility - connectivity_multiplier * violation // Eq. (10)
}

/// The next multiplier λₖ₊₁ by dual ascent with step η, from the signed slack of
/// λ₂ (of one layout, or the mean over a batch).
pub fn updated_connectivity_multiplier(
    connectivity_multiplier: f64,
    step: f64,
    algebraic_connectivity: f64,
    connectivity_threshold: f64,
) -> f64 {
    let slack = connectivity_threshold - algebraic_connectivity;
    (connectivity_multiplier + step * slack).max(0.0) // Eq. (11)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn detections_combine_as_independent_events() {
        assert!((network_detection_probability([0.5, 0.5]) - 0.75).abs() < 1e-15);
        assert!(network_detection_probability([]).abs() < 1e-15);
        assert!((network_detection_probability([0.2, 1.0]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn utility_is_the_expected_number_of_detections() {
        assert!((detection_utility(&[0.5, 2.0], &[1.0, 0.25]) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn only_violations_cost() {
        assert!((penalised_reward(30.0, 1.2, 0.95, 30.0) - 30.0).abs() < 1e-15);
        assert!((penalised_reward(30.0, 0.85, 0.95, 30.0) - 27.0).abs() < 1e-12);
    }

    #[test]
    fn the_multiplier_rises_with_violation_and_never_turns_negative() {
        assert!((updated_connectivity_multiplier(5.0, 0.5, 0.75, 0.95) - 5.1).abs() < 1e-12);
        assert!(updated_connectivity_multiplier(0.1, 0.5, 2.0, 0.95).abs() < 1e-15);
    }
}
