//! The navigation network of the paper: with memory.

use super::actor_critic::{ActorCritic, Batch, Output};
use super::heads::Heads;
use super::linear::{Linear, relu, relu_backward};
use super::lstm::{Lstm, LstmActivations, LstmInputs};
use serde::{Deserialize, Serialize};
use sonarfleet::random::Stream;
use std::f64::consts::SQRT_2;

/// A layer of rectified linear units, then an [`Lstm`], shared by an actor and a
/// critic; for example 8 → 128 → 256 → (16, 1).
///
/// Weights, in order: the layer as in [`Linear`], the memory as in [`Lstm`], actor,
/// critic as in [`Linear`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Recurrent {
    /// Values in an observation.
    pub inputs: usize,
    /// Units of the first layer.
    pub embedding: usize,
    /// Units of the memory.
    pub units: usize,
    /// Number of actions.
    pub actions: usize,
}

/// What a forward pass of [`Recurrent`] leaves.
#[derive(Debug, Default)]
pub struct RecurrentActivations {
    observations: Vec<f32>,
    starts: Vec<bool>,
    states: Vec<f32>,
    embedding: Vec<f32>,
    memory: LstmActivations,
    hidden_gradient: Vec<f32>,
    embedding_gradient: Vec<f32>,
}

impl Recurrent {
    /// The first layer.
    pub const fn embedding_layer(&self) -> Linear {
        Linear { inputs: self.inputs, outputs: self.embedding }
    }

    /// The memory.
    pub const fn memory(&self) -> Lstm {
        Lstm { inputs: self.embedding, units: self.units }
    }

    /// The layer of the logits and that of the value.
    pub const fn heads(&self) -> [Linear; 2] {
        let heads = self.output();
        [heads.actor, heads.critic]
    }

    const fn output(&self) -> Heads {
        Heads::new(self.units, self.actions)
    }

    /// Where the weights of the memory and of the heads start.
    const fn parts(&self) -> [usize; 2] {
        let embedding = self.embedding_layer().weight_count();
        [embedding, embedding + self.memory().weight_count()]
    }

    fn pass(
        &self,
        weights: &[f32],
        steps: usize,
        activations: &mut RecurrentActivations,
        output: &mut Output,
    ) {
        let [memory, heads] = self.parts();
        let RecurrentActivations { observations, starts, states, embedding, .. } = activations;
        embedding.resize(starts.len() * self.embedding, 0.0);
        self.embedding_layer().forward(&weights[..memory], observations, embedding);
        relu(embedding);
        let inputs = LstmInputs { steps, x: embedding, starts, states };
        let lstm = &mut activations.memory;
        self.memory().forward(&weights[memory..heads], &inputs, lstm);
        self.output().forward(&weights[heads..], &lstm.hidden, output);
    }
}

impl ActorCritic for Recurrent {
    type Activations = RecurrentActivations;

    fn observation_len(&self) -> usize {
        self.inputs
    }

    fn actions(&self) -> usize {
        self.actions
    }

    fn state_len(&self) -> usize {
        2 * self.units
    }

    fn weight_count(&self) -> usize {
        self.parts()[1] + self.output().weight_count()
    }

    fn initialise(&self, random: &mut Stream) -> Vec<f32> {
        let [memory, heads] = self.parts();
        let mut weights = vec![0.0; self.weight_count()];
        self.embedding_layer().initialise(&mut weights[..memory], SQRT_2, random);
        self.memory().initialise(&mut weights[memory..heads], random);
        self.output().initialise(&mut weights[heads..], random);
        weights
    }

    fn step(
        &self,
        weights: &[f32],
        observations: &[f32],
        states: &mut [f32],
        activations: &mut RecurrentActivations,
        output: &mut Output,
    ) {
        activations.observations.clear();
        activations.observations.extend_from_slice(observations);
        activations.starts.clear();
        activations.starts.resize(observations.len() / self.inputs, false);
        activations.states.clear();
        activations.states.extend_from_slice(states);
        self.pass(weights, 1, activations, output);
        states.copy_from_slice(&activations.memory.last);
    }

    fn forward(
        &self,
        weights: &[f32],
        batch: &Batch<'_>,
        activations: &mut RecurrentActivations,
        output: &mut Output,
    ) {
        activations.observations.clear();
        activations.starts.clear();
        activations.states.clear();
        for sequence in &batch.sequences {
            activations.observations.extend_from_slice(sequence.observations);
            activations.starts.extend_from_slice(sequence.starts);
            activations.states.extend_from_slice(sequence.state);
        }
        self.pass(weights, batch.steps, activations, output);
    }

    fn backward(
        &self,
        weights: &[f32],
        batch: &Batch<'_>,
        activations: &mut RecurrentActivations,
        output_gradient: &Output,
        gradient: &mut [f32],
    ) {
        let [memory, heads] = self.parts();
        let RecurrentActivations {
            observations,
            starts,
            states,
            embedding,
            memory: lstm,
            hidden_gradient,
            embedding_gradient,
        } = activations;
        hidden_gradient.resize(starts.len() * self.units, 0.0);
        embedding_gradient.resize(starts.len() * self.embedding, 0.0);
        self.output().backward(
            &weights[heads..],
            &lstm.hidden,
            output_gradient,
            &mut gradient[heads..],
            hidden_gradient,
        );
        self.memory().backward(
            &weights[memory..heads],
            &LstmInputs { steps: batch.steps, x: embedding, starts, states },
            lstm,
            hidden_gradient,
            &mut gradient[memory..heads],
            embedding_gradient,
        );
        relu_backward(embedding, embedding_gradient);
        self.embedding_layer().backward_weights(
            observations,
            embedding_gradient,
            &mut gradient[..memory],
        );
    }
}
