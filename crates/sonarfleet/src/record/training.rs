//! What a training writes down, as its curve is drawn from it.

use serde::{Deserialize, Serialize};

/// Trainings of one policy on one problem that differ by their seeds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrainingRecord {
    /// What was trained on what, in words.
    pub name: String,
    /// Version of the program that trained.
    pub version: String,
    /// Required algebraic connectivity, τ.
    pub connectivity_threshold: f64,
    /// One per seed.
    pub runs: Vec<TrainingRun>,
}

/// One training.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrainingRun {
    /// Seed of all its randomness.
    pub seed: u64,
    /// One per update, in order.
    pub points: Vec<TrainingPoint>,
}

/// A training after one update: means over the episodes that it learnt from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrainingPoint {
    /// Episodes so far.
    pub episodes: f64,
    /// Wall-clock seconds so far.
    pub seconds: f64,
    /// Reward R of an episode.
    pub reward: f64,
    /// `J_d` of the layouts.
    pub detection_utility: f64,
    /// λ₂ of the layouts.
    pub algebraic_connectivity: f64,
    /// The connectivity multiplier λₖ.
    pub multiplier: f64,
    /// How far the update moved the policy: the mean of (r − 1) − ln r.
    pub approx_kl: f64,
    /// Entropy of the policy, nats.
    pub entropy: f64,
}

impl TrainingRecord {
    /// The median over the seeds, number by number and update by update, as far as
    /// every run goes. What is not finite does not count.
    pub fn median(&self) -> Vec<TrainingPoint> {
        let updates = self.runs.iter().map(|run| run.points.len()).min().unwrap_or(0);
        (0..updates)
            .map(|update| {
                let of = |number: fn(&TrainingPoint) -> f64| {
                    median(self.runs.iter().map(|run| number(&run.points[update])).collect())
                };
                TrainingPoint {
                    episodes: of(|point| point.episodes),
                    seconds: of(|point| point.seconds),
                    reward: of(|point| point.reward),
                    detection_utility: of(|point| point.detection_utility),
                    algebraic_connectivity: of(|point| point.algebraic_connectivity),
                    multiplier: of(|point| point.multiplier),
                    approx_kl: of(|point| point.approx_kl),
                    entropy: of(|point| point.entropy),
                }
            })
            .collect()
    }
}

/// The middle value, or the mean of the middle two; NaN of nothing. What is not finite
/// does not count.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        count => f64::midpoint(values[(count - 1) / 2], values[count / 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_that_of_every_number_by_itself() {
        let point = |reward, entropy| TrainingPoint {
            episodes: 100.0,
            seconds: 1.0,
            reward,
            detection_utility: f64::NAN,
            algebraic_connectivity: 0.5,
            multiplier: 0.1,
            approx_kl: 0.01,
            entropy,
        };
        let run = |points| TrainingRun { seed: 0, points };
        let record = TrainingRecord {
            name: String::new(),
            version: String::new(),
            connectivity_threshold: 0.95,
            runs: vec![
                run(vec![point(3.0, 1.0), point(4.0, f64::NAN)]),
                run(vec![point(1.0, 3.0), point(8.0, 5.0)]),
                run(vec![point(2.0, 2.0), point(9.0, 6.0), point(0.0, 0.0)]),
            ],
        };
        let median = record.median();
        let found: Vec<f64> = median.iter().flat_map(|p| [p.reward, p.entropy]).collect();
        assert_eq!(found, [2.0, 2.0, 8.0, 5.5]);
        assert!(median[0].detection_utility.is_nan());
    }

    #[test]
    fn no_runs_have_no_median() {
        assert!(median(Vec::new()).is_nan());
    }
}
