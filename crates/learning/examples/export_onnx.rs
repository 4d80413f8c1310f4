//! Writes small random networks as ONNX files, each beside an `.npz` of inputs and of
//! the outputs that plain loops give: `export_onnx DIR`. `scripts/check_onnx.py`
//! compares them with what an ONNX runtime computes.

use rand::Rng;
use sonarfleet::npz::{self, NamedArray, Values};
use sonarfleet::random::{Stream, stream};
use sonarfleet_learning::files::onnx::{
    Activation, ActorCritic, Dimension, Graph, Linear, Lstm, Notes, PlacementNetwork,
    RecurrentPilot,
};
use sonarfleet_learning::files::write_whole;
use std::error::Error;
use std::path::{Path, PathBuf};

const SEED: u64 = 1;
const BATCH: usize = 7;

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args_os().nth(1).ok_or("usage: export_onnx DIR")?.into();
    actor_critic(&folder)?;
    recurrent_pilot(&folder)?;
    placement_network(&folder)?;
    own_graph(&folder)?;
    Ok(())
}

/// The paper's placement policy for 6 × 6 cells.
fn actor_critic(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut random = stream(SEED, "example/actor-critic", 0);
    let cells = 36;
    let [first, second] = [(cells, 16), (16, 12)].map(|(i, o)| Layer::new(&mut random, i, o));
    let [actor, critic] = [cells, 1].map(|outputs| Layer::new(&mut random, 12, outputs));
    let network = ActorCritic {
        hidden: &[first.linear(), second.linear()],
        activation: Activation::Relu,
        actor: actor.linear(),
        critic: critic.linear(),
    };
    let occupancy: Vec<f32> =
        (0..BATCH * cells).map(|_| f32::from(u8::from(random.random_bool(0.3)))).collect();
    let mask: Vec<f32> = occupancy.iter().map(|taken| 1.0 - taken).collect();
    let (mut logits, mut values) = (Vec::new(), Vec::new());
    for (x, mask) in occupancy.chunks(cells).zip(mask.chunks(cells)) {
        let hidden = relu(second.apply(&relu(first.apply(x))));
        let scores = actor.apply(&hidden);
        logits.extend(scores.iter().zip(mask).map(|(&x, &m)| if m > 0.5 { x } else { -1e6 }));
        values.extend(critic.apply(&hidden));
    }
    let notes = Notes { description: "random weights", properties: &[("seed", "1")] };
    let arrays: [Array; 4] = [
        ("occupancy", &[BATCH, cells], &occupancy),
        ("mask", &[BATCH, cells], &mask),
        ("logits", &[BATCH, cells], &logits),
        ("value", &[BATCH], &values),
    ];
    write(folder, "actor_critic", &network.to_onnx(&notes), &arrays)
}

/// The paper's pilot with a smaller memory, one step from a state that is not zero.
fn recurrent_pilot(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut random = stream(SEED, "example/recurrent-pilot", 0);
    let (observations, width, hidden, headings) = (8, 12, 10, 16);
    let encoder = Layer::new(&mut random, observations, width);
    let input = Layer::new(&mut random, width, 4 * hidden);
    let state = Layer::new(&mut random, hidden, 4 * hidden); // its bias is not used
    let [actor, critic] = [headings, 1].map(|outputs| Layer::new(&mut random, hidden, outputs));
    let network = RecurrentPilot {
        hidden: &[encoder.linear()],
        activation: Activation::Tanh,
        lstm: Lstm {
            inputs: width,
            hidden,
            input_weights: &input.weights,
            hidden_weights: &state.weights,
            bias: &input.bias,
        },
        actor: actor.linear(),
        critic: critic.linear(),
    };
    let observation = numbers(&mut random, BATCH * observations);
    let [h, c] = [(); 2].map(|()| numbers(&mut random, BATCH * hidden));
    let (mut logits, mut values, mut h_out, mut c_out) = (vec![], vec![], vec![], vec![]);
    for row in 0..BATCH {
        let [h, c] = [&h, &c].map(|state| &state[row * hidden..(row + 1) * hidden]);
        let x = encoder.apply(&observation[row * observations..(row + 1) * observations]);
        let x: Vec<f32> = x.into_iter().map(f32::tanh).collect();
        let from_input = input.apply(&x);
        let gate = |number: usize, unit: usize| {
            let at = number * hidden + unit;
            let weights = &state.weights[at * hidden..(at + 1) * hidden];
            from_input[at] + weights.iter().zip(h).map(|(w, h)| w * h).sum::<f32>()
        };
        let sigmoid = |x: f32| 1.0 / (1.0 + (-x).exp());
        let mut new_h = Vec::new();
        for (unit, old) in c.iter().enumerate() {
            let candidate = gate(2, unit).tanh();
            let cell = sigmoid(gate(1, unit)) * old + sigmoid(gate(0, unit)) * candidate;
            new_h.push(sigmoid(gate(3, unit)) * cell.tanh());
            c_out.push(cell);
        }
        logits.extend(actor.apply(&new_h));
        values.extend(critic.apply(&new_h));
        h_out.extend(new_h);
    }
    let arrays: [Array; 7] = [
        ("observation", &[BATCH, observations], &observation),
        ("hidden", &[BATCH, hidden], &h),
        ("cell", &[BATCH, hidden], &c),
        ("logits", &[BATCH, headings], &logits),
        ("value", &[BATCH], &values),
        ("hidden_out", &[BATCH, hidden], &h_out),
        ("cell_out", &[BATCH, hidden], &c_out),
    ];
    write(folder, "recurrent_pilot", &network.to_onnx(&Notes::default()), &arrays)
}

/// The transferable placement policy with 20 candidates.
fn placement_network(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut random = stream(SEED, "example/placement-network", 0);
    let (candidates, inputs, first_width, second_width) = (20, 32, 24, 18);
    let first = Layer::new(&mut random, inputs, first_width);
    let second = Layer::new(&mut random, first_width, second_width);
    let context = Layer::new(&mut random, first_width, second_width);
    let last = Layer::new(&mut random, second_width, 1);
    let network = PlacementNetwork {
        first: first.linear(),
        second: second.linear(),
        context: Linear { bias: None, ..context.linear() },
        last: last.linear(),
    };
    let features = numbers(&mut random, BATCH * candidates * inputs);
    let mut logits = Vec::new();
    for set in features.chunks(candidates * inputs) {
        let h1: Vec<Vec<f32>> = set.chunks(inputs).map(|f| relu(first.apply(f))).collect();
        let mean: Vec<f32> = (0..first_width)
            .map(|unit| h1.iter().map(|h| h[unit]).sum::<f32>() / candidates as f32)
            .collect();
        let around = context.product(&mean);
        for h in &h1 {
            let h2 = second.apply(h).iter().zip(&around).map(|(x, y)| x + y).collect();
            logits.extend(last.apply(&relu(h2)));
        }
    }
    let arrays: [Array; 2] = [
        ("features", &[BATCH, candidates, inputs], &features),
        ("logits", &[BATCH, candidates], &logits),
    ];
    write(folder, "placement_network", &network.to_onnx(&Notes::default()), &arrays)
}

/// What a user may build: probabilities from a layer's output beside its input.
fn own_graph(folder: &Path) -> Result<(), Box<dyn Error>> {
    let mut random = stream(SEED, "example/own-graph", 0);
    let (inputs, outputs) = (3, 2);
    let layer = Layer::new(&mut random, inputs, outputs);
    let mut graph = Graph::new("own_graph");
    let x = graph.input("x", &[Dimension::Any("batch"), Dimension::Fixed(inputs)]);
    let y = graph.linear(x, &layer.linear());
    let both = graph.concat(&[x, y]);
    let probabilities = graph.softmax(both);
    graph.output(probabilities, "probabilities");
    let x = numbers(&mut random, BATCH * inputs);
    let mut probabilities = Vec::new();
    for x in x.chunks(inputs) {
        let weights: Vec<f32> = x.iter().copied().chain(layer.apply(x)).map(f32::exp).collect();
        let total: f32 = weights.iter().sum();
        probabilities.extend(weights.iter().map(|weight| weight / total));
    }
    let arrays: [Array; 2] = [
        ("x", &[BATCH, inputs], &x),
        ("probabilities", &[BATCH, inputs + outputs], &probabilities),
    ];
    write(folder, "own_graph", &graph.encode(&Notes::default()), &arrays)
}

/// A layer that owns its weights.
struct Layer {
    inputs: usize,
    outputs: usize,
    weights: Vec<f32>,
    bias: Vec<f32>,
}

impl Layer {
    fn new(random: &mut Stream, inputs: usize, outputs: usize) -> Self {
        let scale = (inputs as f32).sqrt().recip();
        let weights = numbers(random, inputs * outputs).iter().map(|x| x * scale).collect();
        Self { inputs, outputs, weights, bias: numbers(random, outputs) }
    }

    fn linear(&self) -> Linear<'_> {
        let Self { inputs, outputs, .. } = *self;
        Linear { inputs, outputs, weights: &self.weights, bias: Some(&self.bias) }
    }

    fn product(&self, x: &[f32]) -> Vec<f32> {
        let rows = self.weights.chunks(self.inputs);
        rows.map(|row| row.iter().zip(x).map(|(w, x)| w * x).sum()).collect()
    }

    fn apply(&self, x: &[f32]) -> Vec<f32> {
        self.product(x).iter().zip(&self.bias).map(|(y, b)| y + b).collect()
    }
}

fn relu(x: Vec<f32>) -> Vec<f32> {
    x.into_iter().map(|x| x.max(0.0)).collect()
}

fn numbers(random: &mut Stream, count: usize) -> Vec<f32> {
    (0..count).map(|_| random.random_range(-1.0..1.0)).collect()
}

/// Name, shape and values.
type Array<'a> = (&'a str, &'a [usize], &'a [f32]);

fn write(
    folder: &Path,
    name: &str,
    network: &[u8],
    arrays: &[Array],
) -> Result<(), Box<dyn Error>> {
    write_whole(&folder.join(name).with_extension("onnx"), network)?;
    let arrays: Vec<NamedArray> = arrays
        .iter()
        .map(|&(key, shape, values)| NamedArray { key, shape, values: Values::F32(values) })
        .collect();
    npz::write(folder.join(name).with_extension("npz"), &arrays)?;
    println!("{name}: {} bytes", network.len());
    Ok(())
}
