//! How the policy is trained: imitation of annealed layouts, then proximal policy
//! optimisation, both over problems that are drawn ever anew.

use super::episode::Workspace;
use super::imitation;
use super::landscape::Landscape;
use super::network::{Network, WEIGHTS};
use super::reinforcement::{Group, group};
use super::update::{Lesson, LossSettings, LossSummary, gradient};
use crate::network::{Adam, clip_gradient};
use rand::Rng;
use rand::seq::SliceRandom;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sonarfleet::grid::CellId;
use sonarfleet::placement::annealing::Annealing;
use sonarfleet::placement::{Budget, PlacementProblem, Solver};
use sonarfleet::random::{Stream, stream};
use std::num::NonZeroUsize;

/// Gives the practice problem of an index: always the same for the same index.
pub type Practice<'a> = dyn Fn(u64) -> PlacementProblem + Sync + 'a;

/// Sizes and rates of the training.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TrainingSettings {
    /// Seed of all randomness.
    pub seed: u64,
    /// Problems that annealing solves for imitation.
    pub taught: usize,
    /// Proposals that annealing may evaluate on each.
    pub teacher_evaluations: u64,
    /// Stage 1: updates, each on so many episodes.
    pub imitation_updates: usize,
    /// Episodes of an update of stage 1.
    pub imitation_episodes: usize,
    /// Learning rate of stage 1 at its start and end.
    pub imitation_learning_rate: [f32; 2],
    /// Stage 2: updates.
    pub updates: usize,
    /// Problems of an update of stage 2.
    pub groups: usize,
    /// Rollouts of each of them.
    pub rollouts: usize,
    /// Passes over the rollouts of an update.
    pub update_epochs: usize,
    /// Parts of a pass.
    pub minibatches: usize,
    /// ε of Eq. (12).
    pub clip_coef: f32,
    /// Weight of the entropy at the start of stage 2; it falls to 0.
    pub entropy_coef: f32,
    /// Largest norm of a gradient.
    pub max_grad_norm: f32,
    /// Learning rate of stage 2 at its start and end; exponential in between.
    pub learning_rate: [f32; 2],
    /// τ′ in multiples of a problem's τ: drawn uniformly for each problem.
    pub aims: [f64; 2],
}

impl Default for TrainingSettings {
    fn default() -> Self {
        Self {
            seed: 1,
            taught: 160,
            teacher_evaluations: 500_000,
            imitation_updates: 400,
            imitation_episodes: 16,
            imitation_learning_rate: [2e-3, 2e-4],
            updates: 1100,
            groups: 4,
            rollouts: 32,
            update_epochs: 2,
            minibatches: 4,
            clip_coef: 0.2,
            entropy_coef: 0.002,
            max_grad_norm: 1.0,
            learning_rate: [3e-3, 2e-4],
            aims: [0.85, 1.1],
        }
    }
}

impl TrainingSettings {
    /// For one problem from scratch: layouts of its own annealing, imitation, and what
    /// is left of about four minutes for improvement.
    pub fn one_problem(seed: u64) -> Self {
        Self {
            seed,
            taught: 24,
            imitation_updates: 120,
            updates: 300,
            aims: [0.95, 1.1],
            ..Self::default()
        }
    }

    /// For one problem from scratch without anything to imitate: reward alone.
    pub fn one_problem_untaught(seed: u64) -> Self {
        Self { taught: 0, imitation_updates: 0, updates: 400, ..Self::one_problem(seed) }
    }

    /// For fine-tuning on one problem: no imitation, half a minute.
    pub fn fine_tuning(seed: u64) -> Self {
        Self {
            seed,
            taught: 0,
            imitation_updates: 0,
            updates: 60,
            groups: 2,
            learning_rate: [5e-4, 1e-4],
            entropy_coef: 0.0,
            aims: [0.95, 1.15],
            ..Self::default()
        }
    }
}

/// Where a training stands: all that a checkpoint needs. Randomness is derived from
/// the seed and the counters, so that a training that goes on from a checkpoint ends
/// with the bits of one never stopped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Training {
    /// Sizes and rates.
    pub settings: TrainingSettings,
    /// The network's weights.
    pub weights: Vec<f32>,
    adam: Adam,
    /// Layouts to imitate, one per taught problem; empty where none is feasible.
    layouts: Vec<Vec<CellId>>,
    /// Updates of stage 1 done.
    imitated: usize,
    /// Updates of stage 2 done.
    improved: usize,
}

/// What a step of the training did.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "stage", rename_all = "kebab-case")]
pub enum Progress {
    /// Annealing solved some problems.
    Taught {
        /// Problems solved so far.
        done: usize,
        /// Problems to be solved.
        of: usize,
    },
    /// An update of stage 1.
    Imitated {
        /// Updates done.
        done: usize,
        /// Updates to be done.
        of: usize,
        /// Cross entropy with the target distribution.
        loss: f64,
        /// Entropy of the policy.
        entropy: f64,
    },
    /// An update of stage 2.
    Improved {
        /// Updates done.
        done: usize,
        /// Updates to be done.
        of: usize,
        /// Mean reward.
        reward: f64,
        /// Mean `J_d`.
        detection_utility: f64,
        /// Mean share of the expected targets that is detected.
        detected: f64,
        /// Mean λ₂ in multiples of τ.
        connectivity: f64,
        /// Share of the rollouts with λ₂ ≥ τ.
        feasible: f64,
        /// Entropy of the policy.
        entropy: f64,
        /// Divergence from the policy before the update.
        approx_kl: f64,
        /// Share of the steps that were clipped.
        clip_fraction: f64,
    },
}

/// Adam's ε: far below the gradients, which are small where advantages cancel.
const EPSILON: f32 = 1e-8;

/// Divergence from the policy of the rollouts at which a minibatch is left out.
const LARGEST_KL: f64 = 0.1;

/// Problems that annealing solves between two reports.
const TAUGHT_AT_ONCE: usize = 8;

/// Stage 1 repeats its problems from here; those of stage 2 lie beyond.
const FIRST_IMPROVED: u64 = 1 << 32;

impl Training {
    /// A training that has not begun.
    pub fn new(settings: TrainingSettings) -> Self {
        let network = Network::random(&mut stream(settings.seed, "placement/policy/weights", 0));
        Self {
            settings,
            weights: network.weights,
            adam: Adam::new(WEIGHTS, EPSILON),
            layouts: Vec::new(),
            imitated: 0,
            improved: 0,
        }
    }

    /// A training that goes on from a network and skips stage 1.
    pub fn improving(network: Network, settings: TrainingSettings) -> Self {
        Self {
            weights: network.weights,
            adam: Adam::new(WEIGHTS, EPSILON),
            layouts: vec![Vec::new(); settings.taught],
            imitated: settings.imitation_updates,
            improved: 0,
            settings,
        }
    }

    /// Updates of both stages done.
    pub const fn updates_done(&self) -> u64 {
        (self.imitated + self.improved) as u64
    }

    /// Layouts built so far.
    pub const fn episodes(&self) -> u64 {
        let Self { settings, imitated, improved, .. } = self;
        let rollouts = settings.groups * settings.rollouts;
        (*imitated * settings.imitation_episodes + *improved * rollouts) as u64
    }

    /// The policy's network as it is now.
    pub fn network(&self) -> Network {
        Network { weights: self.weights.clone() }
    }

    /// Does the next step; none where nothing is left to do.
    pub fn step(&mut self, practice: &Practice<'_>, school: &mut School) -> Option<Progress> {
        if self.layouts.len() < self.settings.taught {
            Some(self.teach(practice))
        } else if self.imitated < self.settings.imitation_updates {
            Some(self.imitate(practice, school))
        } else if self.improved < self.settings.updates {
            Some(self.improve(practice))
        } else {
            None
        }
    }

    fn teach(&mut self, practice: &Practice<'_>) -> Progress {
        let from = self.layouts.len();
        let to = (from + TAUGHT_AT_ONCE).min(self.settings.taught);
        let budget = Budget::Evaluations(self.settings.teacher_evaluations);
        let teacher = Annealing { chains: const { NonZeroUsize::new(1).unwrap() } };
        let solved: Vec<Vec<CellId>> = (from..to)
            .into_par_iter()
            .map(|index| {
                let problem = practice(index as u64);
                // Another seed each time: practice may be one problem for all indices.
                let seed = self.settings.seed.wrapping_add(index as u64);
                let placement = teacher.solve(&problem, budget, seed);
                if placement.evaluation.feasible { placement.cells } else { Vec::new() }
            })
            .collect();
        self.layouts.extend(solved);
        Progress::Taught { done: self.layouts.len(), of: self.settings.taught }
    }

    fn imitate(&mut self, practice: &Practice<'_>, school: &mut School) -> Progress {
        let of = self.settings.imitation_updates;
        let solved: Vec<usize> =
            (0..self.layouts.len()).filter(|&index| !self.layouts[index].is_empty()).collect();
        if solved.is_empty() {
            self.imitated = of;
            return Progress::Imitated { done: of, of, loss: 0.0, entropy: 0.0 };
        }
        let Self { settings, layouts, .. } = &*self;
        let done = self.imitated as f64 / of as f64;
        let mut random = stream(settings.seed, "placement/policy/imitation", self.imitated as u64);
        let chosen: Vec<(usize, Stream)> = (0..settings.imitation_episodes)
            .map(|episode| {
                let index = solved[random.random_range(0..solved.len())];
                let place = (self.imitated * settings.imitation_episodes + episode) as u64;
                (index, stream(settings.seed, "placement/policy/imitated", place))
            })
            .collect();
        school.fetch(practice, chosen.iter().map(|(index, _)| *index));
        let network = self.network();
        // At first any order, then more and more the policy's own.
        let own_order = (2.0 * done).min(0.9);
        let lessons: Vec<Lesson> = chosen
            .into_par_iter()
            .map_init(Workspace::default, |workspace, (index, mut random)| {
                let landscape = Landscape::new(school.problem(index));
                let layout = &layouts[index];
                imitation::lessons(&network, &landscape, layout, own_order, &mut random, workspace)
            })
            .flatten()
            .collect();
        let all: Vec<&Lesson> = lessons.iter().collect();
        let [from, to] = settings.imitation_learning_rate;
        let learning_rate = from * (to / from).powf(done as f32);
        let loss = LossSettings { clip_coef: 0.0, entropy_coef: 0.0 };
        let summary = self.descend(&all, loss, learning_rate);
        self.imitated += 1;
        if self.imitated == of {
            self.adam = Adam::new(WEIGHTS, EPSILON);
        }
        Progress::Imitated { done: self.imitated, of, loss: summary.loss, entropy: summary.entropy }
    }

    fn improve(&mut self, practice: &Practice<'_>) -> Progress {
        let settings = self.settings.clone();
        let update = self.improved as u64;
        let mut random = stream(settings.seed, "placement/policy/improvement", update);
        let [low, high] = settings.aims;
        let network = self.network();
        let tasks: Vec<(u64, f64)> = (0..settings.groups as u64)
            .map(|k| (update * settings.groups as u64 + k, random.random_range(low..high)))
            .collect();
        let problems: Vec<PlacementProblem> =
            tasks.par_iter().map(|&(index, _)| practice(FIRST_IMPROVED + index)).collect();
        let groups: Vec<Rollouts> = tasks
            .iter()
            .zip(&problems)
            .map(|(&(index, aim), problem)| {
                let landscape = Landscape::new(problem);
                let threshold = problem.connectivity_threshold();
                let expected_targets = problem.prior().total();
                let place = (settings.seed, index);
                let rollouts = settings.rollouts;
                let group = group(&network, &landscape, aim * threshold, rollouts, place);
                Rollouts { threshold, expected_targets, group }
            })
            .collect();
        let mut lessons: Vec<&Lesson> =
            groups.iter().flat_map(|rollouts| &rollouts.group.lessons).collect();
        let left = 1.0 - update as f32 / settings.updates as f32;
        let [from, to] = settings.learning_rate;
        let learning_rate = from * (to / from).powf(1.0 - left);
        let loss = LossSettings {
            clip_coef: settings.clip_coef,
            entropy_coef: settings.entropy_coef * left,
        };
        let mut summaries = Vec::new();
        for _ in 0..settings.update_epochs {
            lessons.shuffle(&mut random);
            let size = lessons.len().div_ceil(settings.minibatches);
            for minibatch in lessons.chunks(size) {
                summaries.push(self.descend(minibatch, loss, learning_rate));
            }
        }
        self.improved += 1;
        self.report(&groups, &summaries)
    }

    fn report(&self, groups: &[Rollouts], summaries: &[LossSummary]) -> Progress {
        let count: usize = groups.iter().map(|rollouts| rollouts.group.rewards.len()).sum();
        let share = 1.0 / count as f64;
        let (mut reward, mut connectivity, mut feasible) = (0.0, 0.0, 0.0);
        let (mut detection_utility, mut detected) = (0.0, 0.0);
        for Rollouts { threshold, expected_targets, group } in groups {
            reward += share * group.rewards.iter().sum::<f64>();
            for evaluation in &group.evaluations {
                connectivity += share * evaluation.algebraic_connectivity / threshold;
                feasible += share * f64::from(u8::from(evaluation.feasible));
                detection_utility += share * evaluation.detection_utility;
                detected += share * evaluation.detection_utility / expected_targets;
            }
        }
        let mean = |value: fn(&LossSummary) -> f64| {
            summaries.iter().map(value).sum::<f64>() / summaries.len() as f64
        };
        Progress::Improved {
            done: self.improved,
            of: self.settings.updates,
            reward,
            detection_utility,
            detected,
            connectivity,
            feasible,
            entropy: mean(|summary| summary.entropy),
            approx_kl: mean(|summary| summary.approx_kl),
            clip_fraction: mean(|summary| summary.clip_fraction),
        }
    }

    /// One step against the gradient of the mean loss; none where the policy has come
    /// so far from the one that built the layouts that they say little about it.
    fn descend(
        &mut self,
        lessons: &[&Lesson],
        loss: LossSettings,
        learning_rate: f32,
    ) -> LossSummary {
        let (mut slopes, summary) = gradient(&self.network(), lessons, loss);
        if summary.approx_kl > LARGEST_KL {
            return summary;
        }
        clip_gradient(&mut slopes, self.settings.max_grad_norm);
        self.adam.step(&mut self.weights, &slopes, learning_rate);
        summary
    }
}

/// The rollouts of one problem, and what they are measured by.
struct Rollouts {
    threshold: f64,
    expected_targets: f64,
    group: Group,
}

/// The taught problems that stage 1 goes back to, kept so that they are not made anew
/// every time. Not part of a checkpoint.
#[derive(Debug, Default)]
pub struct School {
    problems: Vec<Option<PlacementProblem>>,
}

impl School {
    fn fetch(&mut self, practice: &Practice<'_>, indices: impl Iterator<Item = usize>) {
        let mut missing: Vec<usize> =
            indices.filter(|&i| self.problems.get(i).is_none_or(Option::is_none)).collect();
        missing.sort_unstable();
        missing.dedup();
        let made: Vec<(usize, PlacementProblem)> =
            missing.into_par_iter().map(|index| (index, practice(index as u64))).collect();
        for (index, problem) in made {
            if self.problems.len() <= index {
                self.problems.resize_with(index + 1, || None);
            }
            self.problems[index] = Some(problem);
        }
    }

    fn problem(&self, index: usize) -> &PlacementProblem {
        self.problems[index].as_ref().expect("fetched before")
    }
}
