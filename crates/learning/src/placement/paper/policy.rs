//! What was learnt.

use crate::network::{ActorCritic, Categorical, Mlp, MlpActivations, Output};
use serde::{Deserialize, Serialize};
use sonarfleet::grid::CellId;
use sonarfleet::placement::mdp::PlacementMdp;
use sonarfleet::random::{Stream, stream};

/// A policy of the paper: a network and its weights.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PaperPolicy {
    /// The network.
    pub network: Mlp,
    /// Its weights.
    pub weights: Vec<f32>,
}

impl PaperPolicy {
    /// The layout after so many decisions, each the most probable action, in the order
    /// of placing. With fewer decisions than an episode has, a policy for 50 vehicles
    /// places 40, for example. `seed` is for processes that start at random.
    ///
    /// # Panics
    /// Where the network does not fit the grid or an episode has fewer decisions.
    pub fn decode<M: PlacementMdp>(&self, mdp: &M, decisions: usize, seed: u64) -> Vec<CellId> {
        let mut random = stream(seed, "placement/decode", 0);
        self.play(mdp, decisions, &mut random, |categorical, _| categorical.mode())
    }

    /// The layout after so many decisions drawn at random; `index` numbers the draws.
    ///
    /// # Panics
    /// Where the network does not fit the grid or an episode has fewer decisions.
    pub fn sample<M: PlacementMdp>(
        &self,
        mdp: &M,
        decisions: usize,
        seed: u64,
        index: u64,
    ) -> Vec<CellId> {
        let mut random = stream(seed, "placement/sample", index);
        self.play(mdp, decisions, &mut random, Categorical::sample)
    }

    fn play<M: PlacementMdp>(
        &self,
        mdp: &M,
        decisions: usize,
        random: &mut Stream,
        choose: impl Fn(&Categorical, &mut Stream) -> usize,
    ) -> Vec<CellId> {
        let mut observation = vec![0.0; self.network.inputs];
        let mut mask = vec![false; self.network.actions];
        let (mut activations, mut output) = (MlpActivations::default(), Output::default());
        let mut categorical = Categorical::default();
        let mut state = mdp.reset(random);
        for _ in 0..decisions {
            mdp.observation(&state, &mut observation);
            mdp.action_mask(&state, &mut mask);
            self.network.step(&self.weights, &observation, &mut [], &mut activations, &mut output);
            categorical.fill(&output.logits, &mask);
            mdp.step(&mut state, CellId(choose(&categorical, random)));
        }
        mdp.layout(&state).to_vec()
    }
}
