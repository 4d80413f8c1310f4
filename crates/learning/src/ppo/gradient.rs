//! The gradient of a minibatch, in shards side by side.

use super::loss::{Losses, Targets, loss};
use super::rollout::{Rollout, Scale};
use super::settings::PpoSettings;
use crate::network::{ActorCritic, Output};
use rayon::prelude::*;

/// Rows of a shard, whatever the number of threads. Its task goes from the observations
/// to the gradient without waiting for another; a shard costs room for a gradient, and
/// a pass over it to add it to the others.
const ROWS_PER_SHARD: usize = 256;

/// Weights whose gradients one task adds up, whatever the number of threads.
const WEIGHTS_PER_TASK: usize = 16_384;

/// What the gradients of a rollout's minibatches share.
pub(super) struct Learner<'a, N> {
    pub(super) network: &'a N,
    pub(super) weights: &'a [f32],
    pub(super) settings: &'a PpoSettings,
    pub(super) ent_coef: f32,
    pub(super) rollout: Rollout<'a>,
}

/// Room that the gradients of minibatches are computed in.
pub(super) struct Shards<N: ActorCritic>(Vec<Shard<N>>);

struct Shard<N: ActorCritic> {
    targets: Targets,
    activations: N::Activations,
    output: Output,
    gradient: Vec<f32>,
}

impl<N: ActorCritic> Default for Shards<N> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<N: ActorCritic> Shard<N> {
    fn new(weights: usize) -> Self {
        Self {
            targets: Targets::default(),
            activations: N::Activations::default(),
            output: Output::default(),
            gradient: vec![0.0; weights],
        }
    }
}

impl<N: ActorCritic> Learner<'_, N> {
    /// Mean losses of a minibatch of sequences and the gradient in the weights.
    pub(super) fn gradient<'s>(
        &self,
        sequences: &[usize],
        shards: &'s mut Shards<N>,
    ) -> (Losses, &'s [f32]) {
        let per_shard = (ROWS_PER_SHARD / self.rollout.steps).max(1);
        let parts: Vec<&[usize]> = sequences.chunks(per_shard).collect();
        shards.0.resize_with(parts.len(), || Shard::new(self.weights.len()));
        let scale = if self.settings.norm_adv {
            self.rollout.advantage_scale(sequences)
        } else {
            Scale::PLAIN
        };
        let share = 1.0 / (sequences.len() * self.rollout.steps) as f32;
        let losses: Vec<Losses> = (shards.0.par_iter_mut(), parts)
            .into_par_iter()
            .map(|(shard, sequences)| self.part(sequences, scale, share, shard))
            .collect();
        (Losses::sum(&losses), sum_of_gradients(&mut shards.0))
    }

    /// What some sequences add to them.
    fn part(
        &self,
        sequences: &[usize],
        scale: Scale,
        share: f32,
        Shard { targets, activations, output, gradient }: &mut Shard<N>,
    ) -> Losses {
        let Self { network, weights, settings, ent_coef, rollout } = self;
        let batch = rollout.batch(*network, sequences);
        rollout.fill_targets(sequences, scale, targets);
        network.forward(weights, &batch, activations, output);
        let losses = loss(settings, *ent_coef, share, targets, output);
        network.backward(weights, &batch, activations, output, gradient);
        losses
    }
}

/// Adds all gradients to the first.
fn sum_of_gradients<N: ActorCritic>(shards: &mut [Shard<N>]) -> &[f32] {
    let Some((first, rest)) = shards.split_first_mut() else { return &[] };
    let rest: Vec<&[f32]> = rest.iter().map(|shard| &shard.gradient[..]).collect();
    if !rest.is_empty() {
        first.gradient.par_chunks_mut(WEIGHTS_PER_TASK).enumerate().for_each(|(task, sum)| {
            for gradient in &rest {
                let part = &gradient[task * WEIGHTS_PER_TASK..];
                for (sum, slope) in sum.iter_mut().zip(part) {
                    *sum += slope;
                }
            }
        });
    }
    &first.gradient
}
