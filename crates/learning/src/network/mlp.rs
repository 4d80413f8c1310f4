//! The placement network of the paper: fully connected, without memory.

use super::actor_critic::{ActorCritic, Batch, Output};
use super::heads::Heads;
use super::linear::{Linear, relu, relu_backward};
use super::sparse::SparseRows;
use serde::{Deserialize, Serialize};
use sonarfleet::random::Stream;
use std::f64::consts::SQRT_2;

/// Hidden layers of rectified linear units, shared by an actor and a critic; for
/// example 900 → 256 → 256 → (900, 1).
///
/// The first layer adds the columns of the observation's non-zero values only: it is
/// made for occupancy vectors. Weights, in order, each layer as in [`Linear`]: hidden
/// layers, actor, critic.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mlp {
    /// Values in an observation.
    pub inputs: usize,
    /// Units of the hidden layers; one layer at least.
    pub hidden: Vec<usize>,
    /// Number of actions.
    pub actions: usize,
}

/// What a forward pass of [`Mlp`] leaves.
#[derive(Debug, Default)]
pub struct MlpActivations {
    inputs: SparseRows,
    /// Outputs of each hidden layer, [row, unit].
    hidden: Vec<Vec<f32>>,
    /// Gradients in them.
    gradients: Vec<Vec<f32>>,
}

impl Mlp {
    /// The hidden layers.
    pub fn layers(&self) -> impl DoubleEndedIterator<Item = Linear> + ExactSizeIterator {
        (0..self.hidden.len()).map(|layer| Linear {
            inputs: if layer == 0 { self.inputs } else { self.hidden[layer - 1] },
            outputs: self.hidden[layer],
        })
    }

    /// The layer of the logits and that of the value.
    pub fn heads(&self) -> [Linear; 2] {
        let heads = self.output();
        [heads.actor, heads.critic]
    }

    fn output(&self) -> Heads {
        Heads::new(self.hidden.last().copied().unwrap_or(self.inputs), self.actions)
    }

    fn pass(
        &self,
        weights: &[f32],
        rows: usize,
        activations: &mut MlpActivations,
        output: &mut Output,
    ) {
        activations.hidden.resize_with(self.hidden.len(), Vec::new);
        let mut rest = weights;
        for (index, layer) in self.layers().enumerate() {
            let (own, next) = rest.split_at(layer.weight_count());
            rest = next;
            let (before, here) = activations.hidden.split_at_mut(index);
            let y = &mut here[0];
            y.resize(rows * layer.outputs, 0.0);
            match before.last() {
                None => layer.forward_sparse(own, &activations.inputs, y),
                Some(x) => layer.forward(own, x, y),
            }
            relu(y);
        }
        let features = activations.hidden.last().map_or(&[][..], Vec::as_slice);
        self.output().forward(rest, features, output);
    }
}

impl ActorCritic for Mlp {
    type Activations = MlpActivations;

    fn observation_len(&self) -> usize {
        self.inputs
    }

    fn actions(&self) -> usize {
        self.actions
    }

    fn state_len(&self) -> usize {
        0
    }

    fn weight_count(&self) -> usize {
        self.layers().map(|layer| layer.weight_count()).sum::<usize>()
            + self.output().weight_count()
    }

    fn initialise(&self, random: &mut Stream) -> Vec<f32> {
        let mut weights = vec![0.0; self.weight_count()];
        let mut rest = &mut weights[..];
        for layer in self.layers() {
            let (own, next) = rest.split_at_mut(layer.weight_count());
            rest = next;
            layer.initialise(own, SQRT_2, random);
        }
        self.output().initialise(rest, random);
        weights
    }

    fn step(
        &self,
        weights: &[f32],
        observations: &[f32],
        _states: &mut [f32],
        activations: &mut MlpActivations,
        output: &mut Output,
    ) {
        activations.inputs.fill(observations.chunks_exact(self.inputs));
        self.pass(weights, observations.len() / self.inputs, activations, output);
    }

    fn forward(
        &self,
        weights: &[f32],
        batch: &Batch<'_>,
        activations: &mut MlpActivations,
        output: &mut Output,
    ) {
        let sequences = batch.sequences.iter();
        activations
            .inputs
            .fill(sequences.flat_map(|sequence| sequence.observations.chunks_exact(self.inputs)));
        self.pass(weights, batch.len(), activations, output);
    }

    fn backward(
        &self,
        weights: &[f32],
        batch: &Batch<'_>,
        activations: &mut MlpActivations,
        output_gradient: &Output,
        gradient: &mut [f32],
    ) {
        let MlpActivations { inputs, hidden, gradients } = activations;
        gradients.resize_with(self.hidden.len(), Vec::new);
        for (gradient, units) in gradients.iter_mut().zip(&self.hidden) {
            gradient.resize(batch.len() * units, 0.0);
        }
        let (last, depth) = (self.hidden.len() - 1, weights.len());
        let mut start = depth - self.output().weight_count();
        self.output().backward(
            &weights[start..],
            &hidden[last],
            output_gradient,
            &mut gradient[start..],
            &mut gradients[last],
        );
        for (index, layer) in self.layers().enumerate().rev() {
            let end = start;
            start -= layer.weight_count();
            let (before, here) = gradients.split_at_mut(index);
            let here = &mut here[0];
            relu_backward(&hidden[index], here);
            match before.last_mut() {
                None => layer.backward_weights_sparse(inputs, here, &mut gradient[start..end]),
                Some(x_gradient) => {
                    layer.backward_weights(&hidden[index - 1], here, &mut gradient[start..end]);
                    layer.backward_input(&weights[start..end], here, x_gradient);
                }
            }
        }
    }
}
