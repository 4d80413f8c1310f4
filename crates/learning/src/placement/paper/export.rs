//! The paper's policies for other programs.

use super::policy::PaperPolicy;
use crate::files::onnx::{self, Activation, ActorCritic, Notes};
use crate::network::Linear;

/// A layer as ONNX wants it: [output, input].
struct Turned {
    layer: Linear,
    weights: Vec<f32>,
    bias: Vec<f32>,
}

impl Turned {
    fn new(layer: Linear, weights: &[f32]) -> Self {
        let Linear { inputs, outputs } = layer;
        let (matrix, bias) = weights.split_at(inputs * outputs);
        let turned = (0..outputs).flat_map(|o| (0..inputs).map(move |i| matrix[i * outputs + o]));
        Self { layer, weights: turned.collect(), bias: bias.to_vec() }
    }

    fn linear(&self) -> onnx::Linear<'_> {
        onnx::Linear {
            inputs: self.layer.inputs,
            outputs: self.layer.outputs,
            weights: &self.weights,
            bias: Some(&self.bias),
        }
    }
}

impl PaperPolicy {
    /// The network as ONNX: `occupancy` and `mask` [batch, cells] → `logits`
    /// [batch, cells] and `value` `[batch]`.
    pub fn to_onnx(&self) -> Vec<u8> {
        let mut rest = &self.weights[..];
        let mut turn = |layer: Linear| {
            let (own, next) = rest.split_at(layer.weight_count());
            rest = next;
            Turned::new(layer, own)
        };
        let hidden: Vec<Turned> = self.network.layers().map(&mut turn).collect();
        let [actor, critic] = self.network.heads().map(&mut turn);
        let hidden: Vec<onnx::Linear> = hidden.iter().map(Turned::linear).collect();
        ActorCritic {
            hidden: &hidden,
            activation: Activation::Relu,
            actor: actor.linear(),
            critic: critic.linear(),
        }
        .to_onnx(&Notes {
            description: "Scores the cells of one placement problem for the next vehicle",
            properties: &[],
        })
    }
}
