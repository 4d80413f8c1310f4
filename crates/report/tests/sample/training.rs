//! Made-up trainings that rise and settle as real ones do.

use sonarfleet::record::{TrainingPoint, TrainingRecord, TrainingRun};

const EPISODES_PER_UPDATE: f64 = 102.0;
const THRESHOLD: f64 = 0.95;

/// Trainings of so many seeds, with so many updates each.
pub(crate) fn training(seeds: u64, updates: usize) -> TrainingRecord {
    TrainingRecord {
        name: "Sequential PPO on a sample".into(),
        version: "0.1.0".into(),
        connectivity_threshold: THRESHOLD,
        runs: (1..=seeds).map(|seed| run(seed, updates)).collect(),
    }
}

fn run(seed: u64, updates: usize) -> TrainingRun {
    let mut multiplier = 0.1;
    let point = |update: usize| {
        let episodes = EPISODES_PER_UPDATE * (update + 1) as f64;
        let noise = |k: u64| noise(seed * 1000 + k, update);
        let pace = 2500.0 + 500.0 * self::noise(seed, 0);
        let progress = 1.0 - (-episodes / pace).exp();
        let utility = 22.0 + 13.0 * progress + 0.8 * noise(1);
        let late = 1.0 / (1.0 + (-(episodes - 1.8 * pace) / 700.0).exp());
        let connectivity = (0.97 * late + 0.06 * noise(2)).max(0.0);
        let violation = (THRESHOLD - connectivity).max(0.0);
        multiplier += 0.5 * violation;
        TrainingPoint {
            episodes,
            seconds: 2.1 * (update + 1) as f64,
            reward: utility - multiplier * violation,
            detection_utility: utility,
            algebraic_connectivity: connectivity,
            multiplier,
            approx_kl: 0.012 * (-episodes / 9000.0).exp() * (1.0 + 0.6 * noise(3)),
            entropy: 6.4 - 4.6 * progress + 0.1 * noise(4),
        }
    };
    TrainingRun { seed, points: (0..updates).map(point).collect() }
}

/// Something between −1 and 1 that looks like chance.
fn noise(stream: u64, step: usize) -> f64 {
    let turns = (12.9898 * stream as f64 + 78.233 * step as f64).sin() * 43_758.545;
    2.0 * (turns - turns.floor()) - 1.0
}
