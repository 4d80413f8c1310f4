//! Playing many episodes at once.

use super::advantage::generalised_advantages;
use super::environment::{Environment, Episode, Progress};
use super::loss::Targets;
use super::settings::PpoSettings;
use crate::network::{ActorCritic, Batch, Categorical, Output, Sequence};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use sonarfleet::random::{Stream, stream};

/// An environment with its own random numbers, between two steps.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Player<S> {
    state: S,
    /// The network's memory.
    memory: Vec<f32>,
    random: Stream,
    /// Number of the episode over all environments.
    episode: u64,
    total_reward: f64,
    /// Steps taken in the episode.
    length: u64,
}

impl<S> Player<S> {
    /// The environment number `index`, at the start of its first episode.
    pub(super) fn new<E>(environment: &E, memory: usize, seed: u64, index: u64) -> Self
    where
        E: Environment<State = S>,
    {
        let mut random = stream(seed, "ppo/environment", index);
        let state = environment.reset(index, &mut random);
        let memory = vec![0.0; memory];
        Self { state, memory, random, episode: index, total_reward: 0.0, length: 0 }
    }
}

/// What one environment went through in a rollout, [step] and so on.
#[derive(Debug, Clone, Default)]
pub(super) struct Trajectory {
    /// [step, observation]
    pub(super) observations: Vec<f32>,
    /// [step, action]
    pub(super) masks: Vec<bool>,
    pub(super) actions: Vec<usize>,
    pub(super) log_probabilities: Vec<f32>,
    pub(super) values: Vec<f32>,
    pub(super) rewards: Vec<f32>,
    /// Estimated return after the step: 0 where the episode terminated.
    pub(super) next_values: Vec<f32>,
    /// Whether the episode ended with the step.
    pub(super) ended: Vec<bool>,
    /// Whether the episode started with the step.
    pub(super) starts: Vec<bool>,
    /// Memory before each sequence, [sequence, state].
    pub(super) memories: Vec<f32>,
    pub(super) advantages: Vec<f32>,
    pub(super) returns: Vec<f32>,
}

/// Environments that one task plays, whatever the number of threads.
const ENVIRONMENTS_PER_TASK: usize = 8;

/// Plays `num_steps` steps of every environment; gives the episodes that ended, by
/// step and environment.
pub(super) fn play<E: Environment, N: ActorCritic>(
    environment: &E,
    network: &N,
    weights: &[f32],
    settings: &PpoSettings,
    players: &mut [Player<E::State>],
    trajectories: &mut [Trajectory],
) -> Vec<Episode<E::Outcome>> {
    let stride = players.len() as u64;
    let mut episodes: Vec<(usize, usize, Episode<E::Outcome>)> = players
        .par_chunks_mut(ENVIRONMENTS_PER_TASK)
        .zip(trajectories.par_chunks_mut(ENVIRONMENTS_PER_TASK))
        .enumerate()
        .flat_map_iter(|(task, (players, trajectories))| {
            let table = Table { environment, network, weights, settings, stride };
            let mut episodes = table.play(players, trajectories);
            for (_, player, _) in &mut episodes {
                *player += task * ENVIRONMENTS_PER_TASK;
            }
            episodes
        })
        .collect();
    episodes.sort_by_key(|&(step, player, _)| (step, player));
    episodes.into_iter().map(|(_, _, episode)| episode).collect()
}

/// What the players of one task share.
struct Table<'a, E, N> {
    environment: &'a E,
    network: &'a N,
    weights: &'a [f32],
    settings: &'a PpoSettings,
    /// Environments in all.
    stride: u64,
}

/// Room for the network's inputs and outputs.
struct Scene<A> {
    /// [player, observation]
    observations: Vec<f32>,
    /// [player, state]
    memories: Vec<f32>,
    activations: A,
    output: Output,
}

impl<E: Environment, N: ActorCritic> Table<'_, E, N> {
    /// Gives each episode that ended with its step and its player.
    fn play(
        &self,
        players: &mut [Player<E::State>],
        trajectories: &mut [Trajectory],
    ) -> Vec<(usize, usize, Episode<E::Outcome>)> {
        let mut scene = Scene {
            observations: Vec::new(),
            memories: Vec::new(),
            activations: N::Activations::default(),
            output: Output::default(),
        };
        let mut categorical = Categorical::default();
        let mut episodes = Vec::new();
        for trajectory in trajectories.iter_mut() {
            trajectory.clear();
        }
        for step in 0..self.settings.num_steps {
            self.look(players, &mut scene);
            for (index, (player, trajectory)) in
                players.iter_mut().zip(trajectories.iter_mut()).enumerate()
            {
                if step % self.settings.sequence_length == 0 {
                    trajectory.memories.extend_from_slice(&player.memory);
                }
                self.act(index, player, trajectory, &mut categorical, &scene);
                let episode = self.advance(player, trajectory);
                episodes.extend(episode.map(|episode| (step, index, episode)));
            }
        }
        self.look(players, &mut scene);
        for (trajectory, &value) in trajectories.iter_mut().zip(&scene.output.values) {
            trajectory.continue_with(value);
            trajectory.estimate(self.settings);
        }
        episodes
    }

    /// Shows the network where the players are.
    fn look(&self, players: &[Player<E::State>], scene: &mut Scene<N::Activations>) {
        let (length, memory) = (self.network.observation_len(), self.network.state_len());
        scene.observations.resize(players.len() * length, 0.0);
        scene.memories.clear();
        for (player, observation) in players.iter().zip(scene.observations.chunks_exact_mut(length))
        {
            self.environment.observation(&player.state, observation);
            scene.memories.extend_from_slice(&player.memory);
        }
        debug_assert_eq!(scene.memories.len(), players.len() * memory);
        self.network.step(
            self.weights,
            &scene.observations,
            &mut scene.memories,
            &mut scene.activations,
            &mut scene.output,
        );
    }

    /// Draws an action and takes note of it.
    fn act(
        &self,
        index: usize,
        player: &mut Player<E::State>,
        trajectory: &mut Trajectory,
        categorical: &mut Categorical,
        scene: &Scene<N::Activations>,
    ) {
        let part = |length: usize| index * length..(index + 1) * length;
        trajectory.continue_with(scene.output.values[index]);
        let first = trajectory.masks.len();
        trajectory.masks.resize(first + self.network.actions(), false);
        let mask = &mut trajectory.masks[first..];
        self.environment.action_mask(&player.state, mask);
        categorical.fill(&scene.output.logits[part(self.network.actions())], mask);
        let action = categorical.sample(&mut player.random);
        trajectory.actions.push(action);
        trajectory.log_probabilities.push(categorical.log_probability(action));
        trajectory.values.push(scene.output.values[index]);
        trajectory.starts.push(player.length == 0);
        let observation = &scene.observations[part(self.network.observation_len())];
        trajectory.observations.extend_from_slice(observation);
        player.memory.copy_from_slice(&scene.memories[part(self.network.state_len())]);
    }

    /// Takes the last action noted; gives the episode if it ends.
    fn advance(
        &self,
        player: &mut Player<E::State>,
        trajectory: &mut Trajectory,
    ) -> Option<Episode<E::Outcome>> {
        let action = *trajectory.actions.last()?;
        let transition = self.environment.step(&mut player.state, action, &mut player.random);
        trajectory.rewards.push(transition.reward);
        player.total_reward += f64::from(transition.reward);
        player.length += 1;
        let (outcome, next_value) = match transition.progress {
            Progress::Continues => {
                trajectory.ended.push(false);
                return None;
            }
            Progress::Terminated(outcome) => (outcome, 0.0),
            Progress::Truncated(outcome) => (outcome, self.value(player)),
        };
        trajectory.ended.push(true);
        trajectory.next_values.push(next_value);
        let episode = Episode { total_reward: player.total_reward, length: player.length, outcome };
        player.episode += self.stride;
        player.state = self.environment.reset(player.episode, &mut player.random);
        player.memory.fill(0.0);
        (player.total_reward, player.length) = (0.0, 0);
        Some(episode)
    }

    /// Estimated return from where one player is.
    fn value(&self, player: &Player<E::State>) -> f32 {
        let mut observation = vec![0.0; self.network.observation_len()];
        self.environment.observation(&player.state, &mut observation);
        let mut output = Output::default();
        self.network.step(
            self.weights,
            &observation,
            &mut player.memory.clone(),
            &mut N::Activations::default(),
            &mut output,
        );
        output.values[0]
    }
}

impl Trajectory {
    /// Keeps what was allocated.
    fn clear(&mut self) {
        self.observations.clear();
        self.masks.clear();
        self.actions.clear();
        for values in [
            &mut self.log_probabilities,
            &mut self.values,
            &mut self.rewards,
            &mut self.next_values,
            &mut self.memories,
        ] {
            values.clear();
        }
        self.ended.clear();
        self.starts.clear();
    }

    /// The estimated return after the last step, unless its episode ended.
    fn continue_with(&mut self, value: f32) {
        if self.ended.last() == Some(&false) {
            self.next_values.push(value);
        }
    }

    fn estimate(&mut self, settings: &PpoSettings) {
        self.advantages.resize(self.rewards.len(), 0.0);
        generalised_advantages(
            &self.rewards,
            &self.values,
            &self.next_values,
            &self.ended,
            settings.gamma,
            settings.gae_lambda,
            &mut self.advantages,
        );
        self.returns.clear();
        self.returns.extend(self.advantages.iter().zip(&self.values).map(|(a, v)| a + v));
    }

    /// The steps and their number, of a sequence's observations, starts and memory.
    fn sequence<N: ActorCritic>(&self, network: &N, index: usize, steps: usize) -> Sequence<'_> {
        let part = |length: usize| index * length..(index + 1) * length;
        Sequence {
            observations: &self.observations[part(steps * network.observation_len())],
            starts: &self.starts[part(steps)],
            state: &self.memories[part(network.state_len())],
        }
    }

    /// Values and returns of all steps.
    pub(super) fn estimates(&self) -> impl Iterator<Item = (f32, f32)> {
        self.values.iter().copied().zip(self.returns.iter().copied())
    }
}

/// A rollout of several environments, whose sequences are numbered over all of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rollout<'a> {
    pub(super) trajectories: &'a [Trajectory],
    /// Steps of a sequence.
    pub(super) steps: usize,
    /// Sequences of a trajectory.
    pub(super) per_trajectory: usize,
}

impl<'a> Rollout<'a> {
    /// The trajectory of a sequence, and the sequence's number in it.
    const fn find(&self, sequence: usize) -> (&'a Trajectory, usize) {
        (&self.trajectories[sequence / self.per_trajectory], sequence % self.per_trajectory)
    }

    /// What the network sees in some sequences.
    pub(super) fn batch<N: ActorCritic>(&self, network: &N, sequences: &[usize]) -> Batch<'a> {
        let sequences = sequences.iter().map(|&sequence| {
            let (trajectory, index) = self.find(sequence);
            trajectory.sequence(network, index, self.steps)
        });
        Batch { steps: self.steps, sequences: sequences.collect() }
    }

    /// What the loss of some sequences is computed from, with advantages on a scale.
    pub(super) fn fill_targets(&self, sequences: &[usize], scale: Scale, targets: &mut Targets) {
        targets.clear();
        for &sequence in sequences {
            let (trajectory, index) = self.find(sequence);
            let actions = trajectory.masks.len() / trajectory.actions.len();
            let rows = index * self.steps..(index + 1) * self.steps;
            let allowed = &trajectory.masks[rows.start * actions..rows.end * actions];
            targets.mask.extend_from_slice(allowed);
            targets.actions.extend_from_slice(&trajectory.actions[rows.clone()]);
            let log_probabilities = &trajectory.log_probabilities[rows.clone()];
            targets.log_probabilities.extend_from_slice(log_probabilities);
            let advantages = trajectory.advantages[rows.clone()].iter();
            targets.advantages.extend(advantages.map(|&advantage| scale.apply(advantage)));
            targets.returns.extend_from_slice(&trajectory.returns[rows.clone()]);
            targets.values.extend_from_slice(&trajectory.values[rows]);
        }
    }

    /// The scale on which the advantages of some sequences have mean 0 and standard
    /// deviation 1.
    pub(super) fn advantage_scale(&self, sequences: &[usize]) -> Scale {
        let advantages = || {
            sequences.iter().flat_map(|&sequence| {
                let (trajectory, index) = self.find(sequence);
                let rows = index * self.steps..(index + 1) * self.steps;
                trajectory.advantages[rows].iter().map(|&advantage| f64::from(advantage))
            })
        };
        let count = (sequences.len() * self.steps) as f64;
        let mean = advantages().sum::<f64>() / count;
        let squares: f64 = advantages().map(|advantage| (advantage - mean).powi(2)).sum();
        Scale { origin: mean, unit: (squares / (count - 1.0).max(1.0)).sqrt() + 1e-8 }
    }
}

/// A linear scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scale {
    origin: f64,
    unit: f64,
}

impl Scale {
    /// The scale on which everything is what it is.
    pub(super) const PLAIN: Self = Self { origin: 0.0, unit: 1.0 };

    fn apply(self, value: f32) -> f32 {
        ((f64::from(value) - self.origin) / self.unit) as f32
    }
}
