//! Placement as a Markov decision process, for whoever learns it: [`SequentialMdp`]
//! builds a layout vehicle by vehicle, [`ExchangeMdp`] improves a complete one.
//!
//! Both are plain rules on a state that belongs to the caller, as in Gymnasium:
//! `reset`, `observation`, `action_mask`, `step`. An action is the number of a cell.

mod exchange;
mod reward;
mod sequential;

pub use exchange::{ExchangeMdp, ExchangeState};
pub use reward::TerminalReward;
pub use sequential::{LinkMask, SequentialMdp, SequentialState};

use super::{Evaluation, PlacementProblem};
use crate::grid::CellId;
use crate::random::Stream;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

/// A placement problem as a Markov decision process whose actions are cells.
pub trait PlacementMdp: Sync {
    /// State of an episode.
    type State: Clone + Debug + Send + Serialize + DeserializeOwned;

    /// The problem.
    fn problem(&self) -> &PlacementProblem;

    /// Decisions in an episode.
    fn decisions(&self) -> usize;

    /// Start of an episode.
    fn reset(&self, random: &mut Stream) -> Self::State;

    /// Writes what the policy sees, one value per cell.
    fn observation(&self, state: &Self::State, observation: &mut [f32]);

    /// Writes which actions are allowed, one per cell; at least one is.
    fn action_mask(&self, state: &Self::State, mask: &mut [bool]);

    /// Takes an action.
    ///
    /// # Panics
    /// Where the action is not allowed or the episode has ended.
    fn step(&self, state: &mut Self::State, action: CellId) -> Step;

    /// The vehicles' cells, in the order of their placing.
    fn layout<'s>(&self, state: &'s Self::State) -> &'s [CellId];
}

/// What a step brings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Reward, in expected detections.
    pub reward: f64,
    /// What the layout achieves, where the episode ends with this step.
    pub end: Option<Evaluation>,
}

/// Which cells may be deployed to.
fn deployable(problem: &PlacementProblem) -> Vec<bool> {
    let mut mask = vec![false; problem.grid().cell_count()];
    for cell in problem.deployable() {
        mask[cell.0] = true;
    }
    mask
}
