//! Training on one problem.

use super::environment::{EpisodeState, Layout, PlacementEnvironment};
use super::policy::PaperPolicy;
use super::settings::PaperSettings;
use crate::network::Mlp;
use crate::ppo::{BadSettings, Losses, Trainer, TrainerState};
use serde::{Deserialize, Serialize};
use sonarfleet::grid::CellId;
use sonarfleet::placement::mdp::{ExchangeMdp, PlacementMdp, SequentialMdp, TerminalReward};
use sonarfleet::placement::{PlacementProblem, SCORING_MULTIPLIER};
use sonarfleet::sonar::objective::updated_connectivity_multiplier;

/// Trains a policy of the paper on one problem.
#[derive(Debug)]
pub struct PlacementTrainer<M: PlacementMdp> {
    settings: PaperSettings,
    ppo: Trainer<PlacementEnvironment<M>, Mlp>,
    multiplier: f64,
    sampled: Sampled,
}

/// All that training goes on from.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(bound = "S: Serialize + serde::de::DeserializeOwned")]
pub struct PlacementTrainerState<S> {
    ppo: TrainerState<EpisodeState<S>>,
    multiplier: f64,
    sampled: Sampled,
}

/// The best that episodes ended with.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Sampled {
    best: Option<Layout>,
    /// `J_d` of the best feasible layout against episodes.
    history: Vec<(u64, f64)>,
}

/// What an update of the policy did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlacementUpdate {
    /// Updates done.
    pub update: u64,
    /// Decisions taken.
    pub steps: u64,
    /// Episodes that ended: layouts evaluated.
    pub episodes: u64,
    /// Mean reward of the layouts of this rollout, under the multiplier of their time.
    pub mean_return: f64,
    /// Mean reward R of them under [`SCORING_MULTIPLIER`], by which methods are compared.
    pub score: f64,
    /// Mean `J_d` of them.
    pub detection_utility: f64,
    /// Mean λ₂ of them.
    pub algebraic_connectivity: f64,
    /// Share of them that is feasible.
    pub feasible: f64,
    /// Multiplier λₖ that they were rewarded under, but for the warm-up.
    pub multiplier: f64,
    /// Adam's step.
    pub learning_rate: f32,
    /// Mean over the minibatches: −L of Equation (12).
    pub policy_loss: f64,
    /// Mean over the minibatches: half the mean squared error of the value.
    pub value_loss: f64,
    /// Mean over the minibatches: entropy, in nats.
    pub entropy: f64,
    /// Mean over the minibatches: estimated KL divergence from the old policy.
    pub approx_kl: f64,
    /// Mean over the minibatches: share of ratios outside the clip range.
    pub clip_fraction: f64,
    /// Share of the returns' variance that the values explain.
    pub explained_variance: f64,
}

impl<'p> PlacementTrainer<SequentialMdp<'p>> {
    /// Sequential PPO at its start.
    ///
    /// # Errors
    /// Where the settings make no sense.
    pub fn sequential(
        problem: &'p PlacementProblem,
        settings: &PaperSettings,
        seed: u64,
    ) -> Result<Self, BadSettings> {
        Self::new(settings.sequential_mdp(problem), settings, seed)
    }
}

impl<'p> PlacementTrainer<ExchangeMdp<'p>> {
    /// Exchange PPO at its start.
    ///
    /// # Errors
    /// Where the settings make no sense.
    pub fn exchange(
        problem: &'p PlacementProblem,
        settings: &PaperSettings,
        seed: u64,
    ) -> Result<Self, BadSettings> {
        Self::new(ExchangeMdp::new(problem), settings, seed)
    }
}

impl<M: PlacementMdp> PlacementTrainer<M> {
    /// A trainer for a process, at its start.
    ///
    /// # Errors
    /// Where the settings make no sense.
    pub fn new(mdp: M, settings: &PaperSettings, seed: u64) -> Result<Self, BadSettings> {
        let network = settings.network(mdp.problem().grid().cell_count());
        let environment = environment(mdp, settings);
        let ppo = Trainer::new(environment, network, settings.ppo.clone(), seed)?;
        let multiplier = settings.initial_multiplier;
        Ok(Self { settings: settings.clone(), ppo, multiplier, sampled: Sampled::default() })
    }

    /// A trainer that starts from the weights of a policy, of an earlier epoch for
    /// example.
    ///
    /// # Errors
    /// Where the settings make no sense.
    ///
    /// # Panics
    /// Where the policy's network is another than the settings' or does not fit the grid.
    pub fn fine_tune(
        mdp: M,
        settings: &PaperSettings,
        policy: &PaperPolicy,
        seed: u64,
    ) -> Result<Self, BadSettings> {
        let environment = environment(mdp, settings);
        let (network, weights) = (policy.network.clone(), policy.weights.clone());
        let ppo = Trainer::with_weights(environment, network, settings.ppo.clone(), weights, seed)?;
        let multiplier = settings.initial_multiplier;
        Ok(Self { settings: settings.clone(), ppo, multiplier, sampled: Sampled::default() })
    }

    /// A trainer that goes on from a state, with the process and the settings that it
    /// was reached with.
    ///
    /// # Errors
    /// Where the settings make no sense.
    ///
    /// # Panics
    /// Where the state does not fit them.
    pub fn resume(
        mdp: M,
        settings: &PaperSettings,
        state: PlacementTrainerState<M::State>,
    ) -> Result<Self, BadSettings> {
        let network = settings.network(mdp.problem().grid().cell_count());
        let environment = environment(mdp, settings);
        let PlacementTrainerState { ppo, multiplier, sampled } = state;
        let ppo = Trainer::resume(environment, network, settings.ppo.clone(), ppo)?;
        Ok(Self { settings: settings.clone(), ppo, multiplier, sampled })
    }

    /// What training goes on from.
    pub fn state(&self) -> PlacementTrainerState<M::State> {
        let (ppo, sampled) = (self.ppo.state().clone(), self.sampled.clone());
        PlacementTrainerState { ppo, multiplier: self.multiplier, sampled }
    }

    /// Episodes that ended so far.
    pub const fn episodes(&self) -> u64 {
        self.ppo.state().episodes
    }

    /// The multiplier λₖ of the next rollout.
    pub const fn multiplier(&self) -> f64 {
        self.multiplier
    }

    /// The policy as it is.
    pub fn policy(&self) -> PaperPolicy {
        let (network, weights) = (self.ppo.network().clone(), self.ppo.state().weights.clone());
        PaperPolicy { network, weights }
    }

    /// The process.
    pub const fn mdp(&self) -> &M {
        &self.ppo.environment.mdp
    }

    /// The best layout that an episode ended with, in the order of placing.
    pub fn best_sampled(&self) -> Option<&[CellId]> {
        self.sampled.best.as_ref().map(|layout| &layout.cells[..])
    }

    /// Best feasible `J_d` that episodes ended with, against their number.
    pub fn history(&self) -> &[(u64, f64)] {
        &self.sampled.history
    }

    /// Plays a rollout, learns from it, and moves the multiplier. `progress` is the
    /// share of the training that is done, from 0 to 1.
    pub fn update(&mut self, progress: f64) -> PlacementUpdate {
        let start = self.settings.initial_detection_weight;
        self.ppo.environment.reward = TerminalReward {
            connectivity_multiplier: self.multiplier,
            detection_weight: (start + (1.0 - start) * 2.0 * progress).min(1.0),
            log_shortfall_weight: self.settings.log_shortfall_weight,
        };
        let before = self.episodes();
        let update = self.ppo.update(progress);
        for (episode, number) in update.episodes.iter().zip(before + 1..) {
            self.sampled.keep_best(&episode.outcome, number);
        }

        let layouts = || update.episodes.iter().map(|episode| &episode.outcome.evaluation);
        let count = update.episodes.len() as f64;
        let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / count;
        let connectivity = mean(&mut layouts().map(|layout| layout.algebraic_connectivity));
        let multiplier = self.multiplier;
        let threshold = self.mdp().problem().connectivity_threshold();
        if count > 0.0 {
            let step = self.settings.multiplier_step;
            self.multiplier =
                updated_connectivity_multiplier(multiplier, step, connectivity, threshold);
        }
        let Losses { policy_loss, value_loss, entropy, approx_kl, clip_fraction, .. } =
            update.losses();
        PlacementUpdate {
            update: update.update,
            steps: update.steps,
            episodes: self.episodes(),
            mean_return: update.mean_return() / self.settings.reward_scale,
            score: mean(&mut layouts().map(|layout| layout.reward(threshold, SCORING_MULTIPLIER))),
            detection_utility: mean(&mut layouts().map(|layout| layout.detection_utility)),
            algebraic_connectivity: connectivity,
            feasible: mean(&mut layouts().map(|layout| f64::from(u8::from(layout.feasible)))),
            multiplier,
            learning_rate: update.learning_rate,
            policy_loss,
            value_loss,
            entropy,
            approx_kl,
            clip_fraction,
            explained_variance: update.explained_variance,
        }
    }
}

impl Sampled {
    fn keep_best(&mut self, layout: &Layout, episode: u64) {
        let better = self
            .best
            .as_ref()
            .is_none_or(|best| layout.evaluation.compare(&best.evaluation).is_gt());
        if better {
            if layout.evaluation.feasible {
                self.history.push((episode, layout.evaluation.detection_utility));
            }
            self.best = Some(layout.clone());
        }
    }
}

fn environment<M>(mdp: M, settings: &PaperSettings) -> PlacementEnvironment<M> {
    PlacementEnvironment {
        mdp,
        reward: TerminalReward::paper(settings.initial_multiplier),
        reward_scale: settings.reward_scale,
        warm_up_episodes: settings.warm_up_episodes,
    }
}
