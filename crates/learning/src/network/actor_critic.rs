//! What the optimiser asks of a network.

use sonarfleet::random::Stream;

/// A policy over numbered actions and an estimate of the return, on one flat slice of
/// weights that belongs to the caller.
///
/// The same inputs give the same bits on any number of threads.
pub trait ActorCritic: Send + Sync {
    /// What a forward pass leaves for the backward pass.
    type Activations: Default + Send;

    /// Values in an observation.
    fn observation_len(&self) -> usize;

    /// Number of actions.
    fn actions(&self) -> usize;

    /// Values that are carried from step to step; 0 without memory.
    fn state_len(&self) -> usize;

    /// Number of weights.
    fn weight_count(&self) -> usize;

    /// Weights to start from: orthogonal, of gain √2 in hidden layers, 0.01 before
    /// the logits and 1 before the value; biases 0.
    fn initialise(&self, random: &mut Stream) -> Vec<f32>;

    /// One step of several episodes: observations [episode, observation]; `states`
    /// [episode, state] are read and replaced.
    fn step(
        &self,
        weights: &[f32],
        observations: &[f32],
        states: &mut [f32],
        activations: &mut Self::Activations,
        output: &mut Output,
    );

    /// The outputs for a batch of sequences.
    fn forward(
        &self,
        weights: &[f32],
        batch: &Batch<'_>,
        activations: &mut Self::Activations,
        output: &mut Output,
    );

    /// The gradient in the weights, after [`Self::forward`] on the same batch, from
    /// that in the outputs.
    fn backward(
        &self,
        weights: &[f32],
        batch: &Batch<'_>,
        activations: &mut Self::Activations,
        output_gradient: &Output,
        gradient: &mut [f32],
    );
}

/// Sequences of steps, all of one length.
#[derive(Debug, Clone, Default)]
pub struct Batch<'a> {
    /// Steps of a sequence; 1 for a network without memory.
    pub steps: usize,
    /// The sequences, whose steps are the rows of the batch, in order.
    pub sequences: Vec<Sequence<'a>>,
}

/// Steps of one environment that follow one another.
#[derive(Debug, Clone, Copy)]
pub struct Sequence<'a> {
    /// [step, observation]
    pub observations: &'a [f32],
    /// Whether an episode starts at a step, so that the state is 0 before it.
    pub starts: &'a [bool],
    /// State before the first step.
    pub state: &'a [f32],
}

impl Batch<'_> {
    /// Number of rows.
    pub const fn len(&self) -> usize {
        self.sequences.len() * self.steps
    }

    /// Whether it has no rows.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Outputs of a network for a batch, or the gradient in them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Output {
    /// Unnormalised log-probabilities, [row, action], before masking.
    pub logits: Vec<f32>,
    /// Estimated returns, `[row]`.
    pub values: Vec<f32>,
}

impl Output {
    pub(super) fn resize(&mut self, rows: usize, actions: usize) {
        self.logits.resize(rows * actions, 0.0);
        self.values.resize(rows, 0.0);
    }
}
