//! Stage 2: proximal policy optimisation without a critic: the rollouts of one problem
//! are each other's baseline.

use super::episode::{Drawing, Workspace, build};
use super::landscape::Landscape;
use super::network::Network;
use super::update::{Aim, Lesson};
use rayon::prelude::*;
use sonarfleet::placement::Evaluation;
use sonarfleet::random::stream;

/// `J_d` of all that can be detected is worth this much.
const UTILITY_WEIGHT: f64 = 40.0;

/// And λ₂ that lacks all of τ′ costs this much.
const CONNECTIVITY_WEIGHT: f64 = 28.5;

/// Rollouts of one problem.
pub(super) struct Group {
    pub(super) lessons: Vec<Lesson>,
    pub(super) rewards: Vec<f64>,
    pub(super) evaluations: Vec<Evaluation>,
}

/// What a layout earns that was built for τ′: 40·`J_d`/Σ`P_T` − 28.5·max(0, 1 − λ₂/τ′).
pub(super) fn reward(evaluation: &Evaluation, expected_targets: f64, threshold: f64) -> f64 {
    let lacking = (1.0 - evaluation.algebraic_connectivity / threshold).max(0.0);
    let detected = evaluation.detection_utility / expected_targets;
    UTILITY_WEIGHT * detected - CONNECTIVITY_WEIGHT * lacking
}

/// Rollouts of one problem for one τ′, each step with its rollout's standardised
/// reward as its advantage.
pub(super) fn group(
    network: &Network,
    landscape: &Landscape,
    threshold: f64,
    rollouts: usize,
    (seed, index): (u64, u64),
) -> Group {
    let expected_targets = landscape.problem.prior().total();
    let drawing = Drawing { threshold, temperature: 1.0 };
    let episodes: Vec<(Vec<Lesson>, Evaluation)> = (0..rollouts)
        .into_par_iter()
        .map_init(Workspace::default, |workspace, rollout| {
            let place = index * rollouts as u64 + rollout as u64;
            let mut random = stream(seed, "placement/policy/rollout", place);
            let mut lessons = Vec::with_capacity(landscape.problem.vehicles());
            let layout = build(
                network,
                landscape,
                &[],
                drawing,
                &mut random,
                workspace,
                |observation, candidate, log_probability| {
                    let aim = Aim::Improve { candidate, log_probability, advantage: 0.0 };
                    lessons.push(Lesson::new(observation, aim));
                },
            );
            (lessons, landscape.problem.evaluate(&layout))
        })
        .collect();
    let rewards: Vec<f64> = episodes
        .iter()
        .map(|(_, evaluation)| reward(evaluation, expected_targets, threshold))
        .collect();
    let advantages = standardised(&rewards);
    let mut lessons = Vec::new();
    let mut evaluations = Vec::with_capacity(rollouts);
    for ((steps, evaluation), advantage) in episodes.into_iter().zip(advantages) {
        evaluations.push(evaluation);
        lessons.extend(steps.into_iter().map(|mut lesson| {
            lesson.credit(advantage);
            lesson
        }));
    }
    Group { lessons, rewards, evaluations }
}

fn standardised(values: &[f64]) -> Vec<f32> {
    const LEAST_DEVIATION: f64 = 1e-3;
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n;
    let deviation = variance.sqrt().max(LEAST_DEVIATION);
    values.iter().map(|value| ((value - mean) / deviation) as f32).collect()
}
