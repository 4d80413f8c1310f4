//! One vehicle after the other.

use super::{PlacementMdp, Step, TerminalReward, deployable};
use crate::grid::CellId;
use crate::placement::PlacementProblem;
use crate::random::Stream;
use serde::{Deserialize, Serialize};

/// The paper's sequential process (section 3.2).
///
/// | | |
/// |---|---|
/// | State | the cells occupied so far, in order |
/// | Observation | occupancy vector z ∈ {0, 1}ᴺ, one value per cell |
/// | Action | the cell of the next vehicle |
/// | Mask | deployable cells that are not occupied (and see [`LinkMask`]) |
/// | Reward | 0, and R of Equation (10) with the last vehicle |
/// | End | when all G vehicles are placed |
#[derive(Debug, Clone)]
pub struct SequentialMdp<'p> {
    problem: &'p PlacementProblem,
    deployable: Vec<bool>,
    /// What an episode is worth.
    pub reward: TerminalReward,
    /// A narrower mask; none in the paper.
    pub link_mask: Option<LinkMask>,
}

/// Leaves out cells that hear too little of the stations placed so far: those whose
/// links to them add up to less than min(`degree`, `share` · k), k stations being
/// placed. Where that leaves nothing, the best linked cells stay.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct LinkMask {
    /// Sum of link weights that suffices.
    pub degree: f64,
    /// Share of all links that suffices while few stations are placed.
    pub share: f64,
}

/// State of an episode of [`SequentialMdp`].
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SequentialState {
    layout: Vec<CellId>,
    /// Links of every cell to the stations, [cell]; empty without a [`LinkMask`].
    degrees: Vec<f64>,
}

impl<'p> SequentialMdp<'p> {
    /// The paper's process on a problem, under a multiplier of 0.
    pub fn new(problem: &'p PlacementProblem) -> Self {
        Self {
            problem,
            deployable: deployable(problem),
            reward: TerminalReward::paper(0.0),
            link_mask: None,
        }
    }

    fn add_links(&self, degrees: &mut [f64], station: CellId) {
        for (degree, link) in degrees.iter_mut().zip(self.problem.links(station)) {
            *degree += link;
        }
    }

    fn apply_link_mask(&self, link_mask: LinkMask, state: &SequentialState, mask: &mut [bool]) {
        let stations = self.problem.fixed_sensors().len() + state.layout.len();
        let allowed = mask.iter().zip(&state.degrees).filter(|(allowed, _)| **allowed);
        let best = allowed.map(|(_, &degree)| degree).fold(0.0, f64::max);
        let least = link_mask.degree.min(link_mask.share * stations as f64).min(best);
        for (allowed, &degree) in mask.iter_mut().zip(&state.degrees) {
            *allowed &= degree >= least;
        }
    }
}

impl PlacementMdp for SequentialMdp<'_> {
    type State = SequentialState;

    fn problem(&self) -> &PlacementProblem {
        self.problem
    }

    fn decisions(&self) -> usize {
        self.problem.vehicles()
    }

    fn reset(&self, _random: &mut Stream) -> SequentialState {
        let mut state = SequentialState::default();
        if self.link_mask.is_some() {
            state.degrees.resize(self.deployable.len(), 0.0);
            for &sensor in self.problem.fixed_sensors() {
                self.add_links(&mut state.degrees, sensor);
            }
        }
        state
    }

    fn observation(&self, state: &SequentialState, observation: &mut [f32]) {
        observation.fill(0.0);
        for cell in &state.layout {
            observation[cell.0] = 1.0;
        }
    }

    fn action_mask(&self, state: &SequentialState, mask: &mut [bool]) {
        mask.copy_from_slice(&self.deployable);
        for cell in &state.layout {
            mask[cell.0] = false;
        }
        if let Some(link_mask) = self.link_mask {
            self.apply_link_mask(link_mask, state, mask);
        }
    }

    fn step(&self, state: &mut SequentialState, action: CellId) -> Step {
        assert!(state.layout.len() < self.decisions(), "the episode has ended");
        assert!(
            self.deployable[action.0] && !state.layout.contains(&action),
            "cell {} is not free",
            action.0
        );
        state.layout.push(action);
        if self.link_mask.is_some() {
            self.add_links(&mut state.degrees, action);
        }
        if state.layout.len() < self.decisions() {
            return Step { reward: 0.0, end: None };
        }
        let evaluation = self.problem.evaluate(&state.layout);
        let reward = self.reward.of(&evaluation, self.problem.connectivity_threshold());
        Step { reward, end: Some(evaluation) }
    }

    fn layout<'s>(&self, state: &'s SequentialState) -> &'s [CellId] {
        &state.layout
    }
}
