//! Actor and critic on top of a trunk.

use super::actor_critic::Output;
use super::linear::Linear;
use super::vector::{add_scaled, wide};
use sonarfleet::random::Stream;

/// Two linear layers on the trunk's features: logits, then the value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Heads {
    pub(super) actor: Linear,
    pub(super) critic: Linear,
}

impl Heads {
    pub(super) const fn new(features: usize, actions: usize) -> Self {
        Self {
            actor: Linear { inputs: features, outputs: actions },
            critic: Linear { inputs: features, outputs: 1 },
        }
    }

    pub(super) const fn weight_count(&self) -> usize {
        self.actor.weight_count() + self.critic.weight_count()
    }

    pub(super) fn initialise(&self, weights: &mut [f32], random: &mut Stream) {
        let (actor, critic) = weights.split_at_mut(self.actor.weight_count());
        self.actor.initialise(actor, 0.01, random);
        self.critic.initialise(critic, 1.0, random);
    }

    pub(super) fn forward(&self, weights: &[f32], features: &[f32], output: &mut Output) {
        let (actor, critic) = weights.split_at(self.actor.weight_count());
        output.resize(features.len() / self.actor.inputs, self.actor.outputs);
        self.actor.forward(actor, features, &mut output.logits);
        self.critic.forward(critic, features, &mut output.values);
    }

    /// Gradients in the weights and in the features.
    pub(super) fn backward(
        &self,
        weights: &[f32],
        features: &[f32],
        output_gradient: &Output,
        gradient: &mut [f32],
        features_gradient: &mut [f32],
    ) {
        let Output { logits, values } = output_gradient;
        let (actor, critic) = gradient.split_at_mut(self.actor.weight_count());
        self.actor.backward_weights(features, logits, actor);
        self.critic.backward_weights(features, values, critic);
        let (actor, critic) = weights.split_at(self.actor.weight_count());
        self.actor.backward_input(actor, logits, features_gradient);
        let critic = &critic[..self.critic.inputs];
        wide(|| {
            for (row, &slope) in features_gradient.chunks_exact_mut(critic.len()).zip(values) {
                add_scaled(row, slope, critic);
            }
        });
    }
}
