//! Vehicles of a complete layout change their cells.

use super::{PlacementMdp, Step, TerminalReward, deployable};
use crate::grid::CellId;
use crate::placement::PlacementProblem;
use crate::placement::random::random_layout;
use crate::random::Stream;
use serde::{Deserialize, Serialize};

/// The paper's exchange process (section 5.2.2): swaps of an occupied with an
/// unoccupied cell, from a random layout.
///
/// A swap of one out of G vehicles to one out of N − G cells would be one of
/// 40 × 860 actions. It is taken in two decisions instead, each an action of the
/// sequential process' size: the cell to lift from, then the cell to drop in. So
/// π(swap) = π(lift) · π(drop | lift), which leaves nothing out, and both
/// formulations use the same network.
///
/// | | |
/// |---|---|
/// | State | a complete layout and the vehicle that is lifted, if any |
/// | Observation | occupancy vector, one value per cell: 1 where a vehicle is, −1 where it is being lifted from |
/// | Action | to lift: the cell of a vehicle; to drop: the cell it goes to |
/// | Mask | to lift: occupied cells; to drop: deployable cells that are not occupied (where there are none, the cell lifted from) |
/// | Reward | 0, and R of Equation (10) of the last layout |
/// | End | after a fixed number of swaps |
#[derive(Debug, Clone)]
pub struct ExchangeMdp<'p> {
    problem: &'p PlacementProblem,
    deployable: Vec<bool>,
    /// What an episode is worth.
    pub reward: TerminalReward,
    /// Swaps in an episode.
    pub swaps: usize,
}

/// State of an episode of [`ExchangeMdp`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExchangeState {
    layout: Vec<CellId>,
    /// Slot of the vehicle that is lifted.
    lifted: Option<usize>,
    swaps: usize,
}

impl<'p> ExchangeMdp<'p> {
    /// Swaps of an episode where nothing else is asked for.
    pub const SWAPS: usize = 40;

    /// The process on a problem, under a multiplier of 0.
    pub fn new(problem: &'p PlacementProblem) -> Self {
        Self {
            problem,
            deployable: deployable(problem),
            reward: TerminalReward::paper(0.0),
            swaps: Self::SWAPS,
        }
    }

    /// Whether every deployable cell is occupied.
    fn is_full(&self) -> bool {
        self.problem.deployable().len() == self.problem.vehicles()
    }
}

impl PlacementMdp for ExchangeMdp<'_> {
    type State = ExchangeState;

    fn problem(&self) -> &PlacementProblem {
        self.problem
    }

    fn decisions(&self) -> usize {
        2 * self.swaps
    }

    fn reset(&self, random: &mut Stream) -> ExchangeState {
        ExchangeState { layout: random_layout(self.problem, random), lifted: None, swaps: 0 }
    }

    fn observation(&self, state: &ExchangeState, observation: &mut [f32]) {
        observation.fill(0.0);
        for cell in &state.layout {
            observation[cell.0] = 1.0;
        }
        if let Some(slot) = state.lifted {
            observation[state.layout[slot].0] = -1.0;
        }
    }

    fn action_mask(&self, state: &ExchangeState, mask: &mut [bool]) {
        let lifting = state.lifted.is_none();
        if lifting {
            mask.fill(false);
        } else {
            mask.copy_from_slice(&self.deployable);
        }
        for cell in &state.layout {
            mask[cell.0] = lifting;
        }
        if let (Some(slot), true) = (state.lifted, self.is_full()) {
            mask[state.layout[slot].0] = true;
        }
    }

    fn step(&self, state: &mut ExchangeState, action: CellId) -> Step {
        assert!(state.swaps < self.swaps, "the episode has ended");
        let occupied = state.layout.iter().position(|&cell| cell == action);
        let Some(slot) = state.lifted else {
            assert!(occupied.is_some(), "there is no vehicle in cell {}", action.0);
            state.lifted = occupied;
            return Step { reward: 0.0, end: None };
        };
        let vacant = occupied.is_none() || (self.is_full() && occupied == Some(slot));
        let free = self.deployable[action.0] && vacant;
        assert!(free, "cell {} is not free", action.0);
        state.layout[slot] = action;
        state.lifted = None;
        state.swaps += 1;
        if state.swaps < self.swaps {
            return Step { reward: 0.0, end: None };
        }
        let evaluation = self.problem.evaluate(&state.layout);
        let reward = self.reward.of(&evaluation, self.problem.connectivity_threshold());
        Step { reward, end: Some(evaluation) }
    }

    fn layout<'s>(&self, state: &'s ExchangeState) -> &'s [CellId] {
        &state.layout
    }
}
