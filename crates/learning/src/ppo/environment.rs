//! What is learned from.

use serde::Serialize;
use serde::de::DeserializeOwned;
use sonarfleet::random::Stream;

/// Rules of an environment with numbered actions. The state of an episode is apart, so
/// that many episodes share the rules and a checkpoint holds them all.
pub trait Environment: Sync {
    /// State of an episode.
    type State: Clone + Send + Serialize + DeserializeOwned;
    /// What is told about an episode when it ends.
    type Outcome: Send;

    /// Values in an observation.
    fn observation_len(&self) -> usize;

    /// Number of actions.
    fn actions(&self) -> usize;

    /// Start of an episode; episodes are numbered from 0 over all environments.
    fn reset(&self, episode: u64, random: &mut Stream) -> Self::State;

    /// Writes what the policy sees.
    fn observation(&self, state: &Self::State, observation: &mut [f32]);

    /// Writes which actions are allowed; at least one is.
    fn action_mask(&self, state: &Self::State, mask: &mut [bool]);

    /// Takes an allowed action.
    fn step(
        &self,
        state: &mut Self::State,
        action: usize,
        random: &mut Stream,
    ) -> Transition<Self::Outcome>;
}

/// What a step brings.
#[derive(Debug, Clone, PartialEq)]
pub struct Transition<O> {
    /// Reward.
    pub reward: f32,
    /// Whether the episode goes on.
    pub progress: Progress<O>,
}

/// Whether an episode goes on.
#[derive(Debug, Clone, PartialEq)]
pub enum Progress<O> {
    /// It goes on.
    Continues,
    /// It has reached its end, after which there is nothing to expect.
    Terminated(O),
    /// It is cut off, at a time limit for example: the return goes on as estimated.
    Truncated(O),
}

/// An episode that ended during a rollout.
#[derive(Debug, Clone, PartialEq)]
pub struct Episode<O> {
    /// Sum of its rewards.
    pub total_reward: f64,
    /// Its steps.
    pub length: u64,
    /// What the environment tells about it.
    pub outcome: O,
}
