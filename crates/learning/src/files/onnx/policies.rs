//! The networks of the policies.

use super::encode::Notes;
use super::graph::{Dimension, Graph, Value};
use super::layers::{Activation, Linear, Lstm};

const BATCH: Dimension = Dimension::Any("batch");

/// The paper's placement policy: hidden layers that actor and critic share.
///
/// In: `occupancy` and `mask` [batch, cells], 1 where a vehicle is and where one may
/// be put. Out: `logits` [batch, cells], −10⁶ where the mask is 0, and `value` `[batch]`.
#[derive(Debug, Clone, Copy)]
pub struct ActorCritic<'a> {
    /// The hidden layers, in order.
    pub hidden: &'a [Linear<'a>],
    /// What bends them.
    pub activation: Activation,
    /// From the last hidden layer to the logits, one per cell.
    pub actor: Linear<'a>,
    /// From the last hidden layer to the value.
    pub critic: Linear<'a>,
}

impl ActorCritic<'_> {
    /// The bytes of an ONNX file.
    ///
    /// # Panics
    /// Where slices, sizes and layers do not fit each other.
    pub fn to_onnx(&self, notes: &Notes) -> Vec<u8> {
        let mut graph = Graph::new("actor_critic");
        let inputs = self.hidden.first().unwrap_or(&self.actor).inputs;
        let occupancy = graph.input("occupancy", &[BATCH, Dimension::Fixed(inputs)]);
        let mask = graph.input("mask", &[BATCH, Dimension::Fixed(self.actor.outputs)]);
        let x = hidden_layers(&mut graph, occupancy, self.hidden, self.activation);
        let logits = graph.linear(x, &self.actor);
        let logits = graph.masked(logits, mask);
        graph.output(logits, "logits");
        value_head(&mut graph, x, &self.critic);
        graph.encode(notes)
    }
}

/// The paper's pilot: hidden layers, a long short-term memory, actor and critic. The
/// file makes one step; whoever runs it keeps the state, zeros at an episode's start.
///
/// In: `observation` [batch, observations], `hidden` and `cell` [batch, state]. Out:
/// `logits` [batch, headings], `value` `[batch]`, `hidden_out` and `cell_out`.
#[derive(Debug, Clone, Copy)]
pub struct RecurrentPilot<'a> {
    /// The layers before the memory, in order.
    pub hidden: &'a [Linear<'a>],
    /// What bends them.
    pub activation: Activation,
    /// The memory.
    pub lstm: Lstm<'a>,
    /// From the memory to the logits.
    pub actor: Linear<'a>,
    /// From the memory to the value.
    pub critic: Linear<'a>,
}

impl RecurrentPilot<'_> {
    /// The bytes of an ONNX file.
    ///
    /// # Panics
    /// Where slices, sizes and layers do not fit each other.
    pub fn to_onnx(&self, notes: &Notes) -> Vec<u8> {
        let mut graph = Graph::new("recurrent_pilot");
        let inputs = self.hidden.first().map_or(self.lstm.inputs, |layer| layer.inputs);
        let observation = graph.input("observation", &[BATCH, Dimension::Fixed(inputs)]);
        let state = [BATCH, Dimension::Fixed(self.lstm.hidden)];
        let hidden = graph.input("hidden", &state);
        let cell = graph.input("cell", &state);
        let x = hidden_layers(&mut graph, observation, self.hidden, self.activation);
        let (hidden, cell) = graph.lstm(x, hidden, cell, &self.lstm);
        let logits = graph.linear(hidden, &self.actor);
        graph.output(logits, "logits");
        value_head(&mut graph, hidden, &self.critic);
        graph.output(hidden, "hidden_out");
        graph.output(cell, "cell_out");
        graph.encode(notes)
    }
}

/// The transferable placement policy, which scores candidates:
/// h₁ = relu(W₁f + b₁), h₂ = relu(W₂h₁ + `W_c`·mean h₁ + b₂), logit = w₃·h₂ + b₃, with
/// the mean over the candidates.
///
/// In: `features` [batch, candidates, features]. Out: `logits` [batch, candidates].
#[derive(Debug, Clone, Copy)]
pub struct PlacementNetwork<'a> {
    /// W₁, b₁.
    pub first: Linear<'a>,
    /// W₂, b₂.
    pub second: Linear<'a>,
    /// `W_c`, without a bias.
    pub context: Linear<'a>,
    /// w₃, b₃: one output.
    pub last: Linear<'a>,
}

impl PlacementNetwork<'_> {
    /// The bytes of an ONNX file.
    ///
    /// # Panics
    /// Where slices, sizes and layers do not fit each other.
    pub fn to_onnx(&self, notes: &Notes) -> Vec<u8> {
        let mut graph = Graph::new("placement_network");
        let shape = [BATCH, Dimension::Any("candidates"), Dimension::Fixed(self.first.inputs)];
        let features = graph.input("features", &shape);
        let first = graph.linear(features, &self.first);
        let first = graph.activation(first, Activation::Relu);
        let mean = graph.mean(first, 1);
        let context = graph.linear(mean, &self.context);
        let second = graph.linear(first, &self.second);
        let second = graph.add(second, context);
        let second = graph.activation(second, Activation::Relu);
        let logits = graph.linear(second, &self.last);
        let logits = graph.squeeze(logits, 2);
        graph.output(logits, "logits");
        graph.encode(notes)
    }
}

fn hidden_layers(
    graph: &mut Graph,
    input: Value,
    layers: &[Linear],
    activation: Activation,
) -> Value {
    layers.iter().fold(input, |x, layer| {
        let x = graph.linear(x, layer);
        graph.activation(x, activation)
    })
}

fn value_head(graph: &mut Graph, x: Value, critic: &Linear) {
    let value = graph.linear(x, critic);
    let value = graph.squeeze(value, 1);
    graph.output(value, "value");
}
