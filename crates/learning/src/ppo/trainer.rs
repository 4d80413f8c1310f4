//! Proximal policy optimisation (Schulman et al. 2017, arXiv:1707.06347).

use super::environment::{Environment, Episode};
use super::gradient::{Learner, Shards};
use super::loss::Losses;
use super::rollout::{Player, Rollout, Trajectory, play};
use super::settings::{BadSettings, PpoSettings};
use crate::network::{ActorCritic, Adam};
use rand::seq::SliceRandom;
use serde::{Deserialize, Serialize};
use sonarfleet::random::{Stream, stream};

/// Learns a policy, update after update.
#[derive(Debug)]
pub struct Trainer<E: Environment, N: ActorCritic> {
    /// The environment's rules; they may change between updates.
    pub environment: E,
    network: N,
    settings: PpoSettings,
    state: TrainerState<E::State>,
    trajectories: Vec<Trajectory>,
}

/// All that training goes on from: a trainer made of it continues with the same bits.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(bound = "S: Serialize + serde::de::DeserializeOwned")]
pub struct TrainerState<S> {
    /// Weights of the network.
    pub weights: Vec<f32>,
    /// Updates done.
    pub updates: u64,
    /// Steps played.
    pub steps: u64,
    /// Episodes that ended.
    pub episodes: u64,
    adam: Adam,
    players: Vec<Player<S>>,
    /// Order of the minibatches.
    shuffling: Stream,
}

/// What an update did.
#[derive(Debug, Clone, PartialEq)]
pub struct Update<O> {
    /// Updates done, this one included.
    pub update: u64,
    /// Steps played, those of this update included.
    pub steps: u64,
    /// Adam's step.
    pub learning_rate: f32,
    /// Weight of the entropy.
    pub ent_coef: f32,
    /// Losses of every minibatch, in order.
    pub minibatches: Vec<Losses>,
    /// 1 − Var(return − value) / Var(return) over the rollout, before learning.
    pub explained_variance: f64,
    /// Episodes that ended during the rollout.
    pub episodes: Vec<Episode<O>>,
}

impl<O> Update<O> {
    /// Mean losses over all minibatches.
    pub fn losses(&self) -> Losses {
        Losses::mean(&self.minibatches)
    }

    /// Mean total reward of the episodes that ended; NaN where none did.
    pub fn mean_return(&self) -> f64 {
        let total: f64 = self.episodes.iter().map(|episode| episode.total_reward).sum();
        total / self.episodes.len() as f64
    }
}

impl<E: Environment, N: ActorCritic> Trainer<E, N> {
    /// A trainer at the start of everything.
    ///
    /// # Errors
    /// Where the settings make no sense.
    ///
    /// # Panics
    /// Where the network does not fit the environment.
    pub fn new(
        environment: E,
        network: N,
        settings: PpoSettings,
        seed: u64,
    ) -> Result<Self, BadSettings> {
        let weights = network.initialise(&mut stream(seed, "ppo/weights", 0));
        Self::with_weights(environment, network, settings, weights, seed)
    }

    /// A trainer that starts from weights, learnt elsewhere for example.
    ///
    /// # Errors
    /// Where the settings make no sense.
    ///
    /// # Panics
    /// Where the network does not fit the environment, or the weights the network.
    pub fn with_weights(
        environment: E,
        network: N,
        settings: PpoSettings,
        weights: Vec<f32>,
        seed: u64,
    ) -> Result<Self, BadSettings> {
        let players = (0..settings.num_envs as u64)
            .map(|index| Player::new(&environment, network.state_len(), seed, index))
            .collect();
        let state = TrainerState {
            updates: 0,
            steps: 0,
            episodes: 0,
            adam: Adam::new(weights.len(), settings.adam_epsilon),
            weights,
            players,
            shuffling: stream(seed, "ppo/minibatches", 0),
        };
        Self::resume(environment, network, settings, state)
    }

    /// A trainer that goes on from a state, with the environment, network and settings
    /// that it was reached with.
    ///
    /// # Errors
    /// Where the settings make no sense.
    ///
    /// # Panics
    /// Where the network does not fit the environment, or the state either or the
    /// settings.
    pub fn resume(
        environment: E,
        network: N,
        settings: PpoSettings,
        state: TrainerState<E::State>,
    ) -> Result<Self, BadSettings> {
        settings.check()?;
        assert_eq!(network.observation_len(), environment.observation_len(), "observations fit");
        assert_eq!(network.actions(), environment.actions(), "actions fit");
        assert_eq!(network.weight_count(), state.weights.len(), "weights fit");
        assert_eq!(settings.num_envs, state.players.len(), "environments fit");
        let trajectories = vec![Trajectory::default(); settings.num_envs];
        Ok(Self { environment, network, settings, state, trajectories })
    }

    /// The network.
    pub const fn network(&self) -> &N {
        &self.network
    }

    /// The settings.
    pub const fn settings(&self) -> &PpoSettings {
        &self.settings
    }

    /// What training goes on from.
    pub const fn state(&self) -> &TrainerState<E::State> {
        &self.state
    }

    /// Plays a rollout and learns from it. `progress`, the share of the training that is
    /// done, from 0 to 1, is what the schedules go by.
    pub fn update(&mut self, progress: f64) -> Update<E::Outcome> {
        // From inside the pool its tasks start without a change of thread.
        rayon::scope(|_| self.update_in_pool(progress))
    }

    fn update_in_pool(&mut self, progress: f64) -> Update<E::Outcome> {
        let settings = &self.settings;
        let (learning_rate, ent_coef) = settings.scheduled(progress);
        let episodes = play(
            &self.environment,
            &self.network,
            &self.state.weights,
            settings,
            &mut self.state.players,
            &mut self.trajectories,
        );
        let explained_variance = explained_variance(&self.trajectories);

        let mut sequences: Vec<usize> =
            (0..settings.rollout_size() / settings.sequence_length).collect();
        let per_minibatch = settings.minibatch_size / settings.sequence_length;
        let mut minibatches = Vec::new();
        let mut shards = Shards::default();
        for _ in 0..settings.update_epochs {
            sequences.shuffle(&mut self.state.shuffling);
            for sequences in sequences.chunks(per_minibatch) {
                minibatches.push(self.learn(sequences, learning_rate, ent_coef, &mut shards));
            }
            let kl = minibatches.last().map_or(0.0, |losses| losses.approx_kl);
            if self.settings.target_kl.is_some_and(|most| kl > f64::from(most)) {
                break;
            }
        }

        self.state.updates += 1;
        self.state.steps += self.settings.rollout_size() as u64;
        self.state.episodes += episodes.len() as u64;
        Update {
            update: self.state.updates,
            steps: self.state.steps,
            learning_rate,
            ent_coef,
            minibatches,
            explained_variance,
            episodes,
        }
    }

    /// One step of Adam on a minibatch of sequences.
    fn learn(
        &mut self,
        sequences: &[usize],
        learning_rate: f32,
        ent_coef: f32,
        shards: &mut Shards<N>,
    ) -> Losses {
        let (settings, state) = (&self.settings, &mut self.state);
        let learner = Learner {
            network: &self.network,
            weights: &state.weights,
            settings,
            ent_coef,
            rollout: Rollout {
                trajectories: &self.trajectories,
                steps: settings.sequence_length,
                per_trajectory: settings.num_steps / settings.sequence_length,
            },
        };
        let (mut losses, gradient) = learner.gradient(sequences, shards);
        let norm = state.adam.step_clipped(
            &mut state.weights,
            gradient,
            settings.max_grad_norm,
            learning_rate,
        );
        losses.gradient_norm = f64::from(norm);
        losses
    }
}

/// Share of the returns' variance that the values explain.
fn explained_variance(trajectories: &[Trajectory]) -> f64 {
    let estimates = || trajectories.iter().flat_map(Trajectory::estimates);
    let variance = |values: &mut dyn Iterator<Item = f64>| {
        let (mut count, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for value in values {
            (count, sum, squares) = (count + 1.0, sum + value, squares + value * value);
        }
        squares / count - (sum / count) * (sum / count)
    };
    let total = variance(&mut estimates().map(|(_, target)| f64::from(target)));
    let left = variance(&mut estimates().map(|(value, target)| f64::from(target - value)));
    1.0 - left / total
}
