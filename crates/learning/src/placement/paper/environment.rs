//! The placement processes as the optimiser plays them.

use crate::ppo::{Environment, Progress, Transition};
use serde::{Deserialize, Serialize};
use sonarfleet::grid::CellId;
use sonarfleet::placement::Evaluation;
use sonarfleet::placement::mdp::{PlacementMdp, TerminalReward};
use sonarfleet::random::Stream;

/// A placement process whose first episodes are rewarded without the constraint.
#[derive(Debug)]
pub(super) struct PlacementEnvironment<M> {
    pub(super) mdp: M,
    /// Reward after the warm-up, in expected detections.
    pub(super) reward: TerminalReward,
    /// Factor of the reward that the optimiser sees.
    pub(super) reward_scale: f64,
    /// Episodes at the start that are rewarded without a multiplier.
    pub(super) warm_up_episodes: u64,
}

/// State of an episode.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct EpisodeState<S> {
    placement: S,
    number: u64,
}

/// A layout that an episode ended with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Layout {
    /// In the order of placing.
    pub cells: Vec<CellId>,
    /// What it achieves.
    pub evaluation: Evaluation,
}

impl<M: PlacementMdp> Environment for PlacementEnvironment<M> {
    type State = EpisodeState<M::State>;
    type Outcome = Layout;

    fn observation_len(&self) -> usize {
        self.mdp.problem().grid().cell_count()
    }

    fn actions(&self) -> usize {
        self.mdp.problem().grid().cell_count()
    }

    fn reset(&self, episode: u64, random: &mut Stream) -> Self::State {
        EpisodeState { placement: self.mdp.reset(random), number: episode }
    }

    fn observation(&self, state: &Self::State, observation: &mut [f32]) {
        self.mdp.observation(&state.placement, observation);
    }

    fn action_mask(&self, state: &Self::State, mask: &mut [bool]) {
        self.mdp.action_mask(&state.placement, mask);
    }

    fn step(
        &self,
        state: &mut Self::State,
        action: usize,
        _random: &mut Stream,
    ) -> Transition<Layout> {
        let Some(evaluation) = self.mdp.step(&mut state.placement, CellId(action)).end else {
            return Transition { reward: 0.0, progress: Progress::Continues };
        };
        let mut reward = self.reward;
        if state.number < self.warm_up_episodes {
            reward.connectivity_multiplier = 0.0;
        }
        let threshold = self.mdp.problem().connectivity_threshold();
        let reward = (self.reward_scale * reward.of(&evaluation, threshold)) as f32;
        let cells = self.mdp.layout(&state.placement).to_vec();
        Transition { reward, progress: Progress::Terminated(Layout { cells, evaluation }) }
    }
}
