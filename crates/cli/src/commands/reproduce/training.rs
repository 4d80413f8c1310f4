//! Trainings of the paper's policies.

use super::score::Score;
use crate::args::Preset;
use anyhow::Result;
use sonarfleet::grid::CellId;
use sonarfleet::placement::PlacementProblem;
use sonarfleet::placement::mdp::PlacementMdp;
use sonarfleet::record::{TrainingPoint, median};
use sonarfleet_learning::placement::paper::{
    PaperPolicy, PaperSettings, PlacementTrainer, PlacementUpdate, Process,
};
use std::time::Instant;

/// Share of a training whose rollouts are its end.
const END_SHARE: f64 = 0.05;

/// What is trained how.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Course {
    pub(super) process: Process,
    pub(super) preset: Preset,
    pub(super) vehicles: usize,
}

/// A policy, and how it was learnt.
#[derive(Debug, Clone)]
pub(super) struct Trained {
    pub(super) seed: u64,
    pub(super) seconds: f64,
    /// One per update in which an episode ended; the reward is R under the multiplier by which methods are compared.
    pub(super) points: Vec<TrainingPoint>,
    pub(super) policy: PaperPolicy,
    /// The layout of the most probable actions, in their order.
    pub(super) decoded: Vec<CellId>,
    /// The better of it and the best layout that an episode ended with.
    pub(super) best: Vec<CellId>,
    /// What the better one is worth.
    pub(super) score: Score,
}

impl Course {
    /// "Sequential PPO" with our settings, "Sequential PPO, Table 1" with the paper's.
    pub(super) fn words(&self) -> String {
        let process = match self.process {
            Process::Sequential => "Sequential PPO",
            Process::Exchange => "Exchange PPO",
        };
        match self.preset {
            Preset::Ours => format!("{process}, our settings"),
            Preset::Paper => format!("{process}, Table 1"),
        }
    }

    pub(super) fn settings(&self) -> PaperSettings {
        match self.preset {
            Preset::Ours => PaperSettings::ours(),
            Preset::Paper => PaperSettings::paper(),
        }
    }

    /// Trains for so many seconds, one rollout at least.
    pub(super) fn train(
        &self,
        problem: &PlacementProblem,
        seconds: f64,
        seed: u64,
    ) -> Result<Trained> {
        let settings = self.settings();
        Ok(match self.process {
            Process::Sequential => {
                run(PlacementTrainer::sequential(problem, &settings, seed)?, seconds, seed)
            }
            Process::Exchange => {
                run(PlacementTrainer::exchange(problem, &settings, seed)?, seconds, seed)
            }
        })
    }
}

impl Trained {
    /// Median over the last rollouts of the mean R of their layouts.
    pub(super) fn final_reward(&self) -> f64 {
        let from = (1.0 - END_SHARE) * self.seconds;
        let last = self.points.last().map(|point| point.reward);
        let late = self.points.iter().filter(|point| point.seconds >= from);
        median(late.map(|point| point.reward).chain(last).collect())
    }
}

/// Their scores.
pub(super) fn scores(trained: &[Trained]) -> Vec<Score> {
    trained.iter().map(|trained| trained.score).collect()
}

fn run<M: PlacementMdp>(mut trainer: PlacementTrainer<M>, seconds: f64, seed: u64) -> Trained {
    let started = Instant::now();
    let mut points = Vec::new();
    let mut done = 0.0;
    while done < 1.0 {
        let update = trainer.update(done);
        let elapsed = started.elapsed().as_secs_f64();
        // A rollout shorter than an episode may see none end.
        if update.score.is_finite() {
            points.push(point(&update, elapsed));
        }
        done = elapsed / seconds;
    }
    let seconds = started.elapsed().as_secs_f64();
    let policy = trainer.policy();
    let mdp = trainer.mdp();
    let problem = mdp.problem();
    let decoded = policy.decode(mdp, mdp.decisions(), seed);
    let evaluation = problem.evaluate(&decoded);
    let sampled = trainer
        .best_sampled()
        .filter(|sampled| problem.evaluate(sampled).compare(&evaluation).is_ge());
    let best = sampled.unwrap_or(&decoded).to_vec();
    let score = Score::of(problem, &best);
    Trained { seed, seconds, points, policy, decoded, best, score }
}

fn point(update: &PlacementUpdate, seconds: f64) -> TrainingPoint {
    TrainingPoint {
        episodes: update.episodes as f64,
        seconds,
        reward: update.score,
        detection_utility: update.detection_utility,
        algebraic_connectivity: update.algebraic_connectivity,
        multiplier: update.multiplier,
        approx_kl: update.approx_kl,
        entropy: update.entropy,
    }
}
