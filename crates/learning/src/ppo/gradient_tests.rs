//! Gradients of the whole loss against central differences of the same loss written
//! out in double precision.

use super::gradient::{Learner, Shards};
use super::loss::{Losses, Targets, loss};
use super::rollout::{Rollout, Trajectory};
use super::settings::PpoSettings;
use crate::network::{ActorCritic, Batch, Mlp, Output, Recurrent, Sequence};
use rand::Rng;
use sonarfleet::random::{Stream, stream};

/// Step of the central differences: their own error is its square.
const STEP: f64 = 1e-5;

/// Single precision over a few dozen products, relative to the largest slope.
const ROUNDING: f64 = 2e-5;

const ENT_COEF: f32 = 0.05;

/// Sequences of random steps, some of which start episodes.
struct Data {
    steps: usize,
    observations: Vec<Vec<f32>>,
    starts: Vec<Vec<bool>>,
    states: Vec<Vec<f32>>,
    targets: Targets,
}

impl Data {
    fn new<N: ActorCritic>(network: &N, sequences: usize, steps: usize) -> Self {
        let mut random = stream(4, "test/gradient", 0);
        let random = &mut random;
        let rows = sequences * steps;
        let actions = network.actions();
        let mut mask: Vec<bool> = (0..rows * actions).map(|_| random.random_bool(0.7)).collect();
        let chosen: Vec<usize> = (0..rows).map(|_| random.random_range(0..actions)).collect();
        for (row, action) in chosen.iter().enumerate() {
            mask[row * actions + action] = true;
        }
        let values = |count: usize, random: &mut Stream| -> Vec<f32> {
            (0..count).map(|_| random.random_range(-1.0..1.0)).collect()
        };
        Self {
            steps,
            observations: (0..sequences)
                .map(|_| {
                    let mut values = values(steps * network.observation_len(), random);
                    values.iter_mut().step_by(3).for_each(|value| *value = 0.0);
                    values
                })
                .collect(),
            starts: (0..sequences)
                .map(|_| (0..steps).map(|_| random.random_bool(0.3)).collect())
                .collect(),
            states: (0..sequences).map(|_| values(network.state_len(), random)).collect(),
            targets: Targets {
                mask,
                actions: chosen,
                log_probabilities: (0..rows).map(|_| random.random_range(-2.5..-0.8)).collect(),
                advantages: values(rows, random),
                returns: values(rows, random),
                values: values(rows, random),
            },
        }
    }

    fn batch(&self) -> Batch<'_> {
        let sequences = self.observations.iter().zip(&self.starts).zip(&self.states);
        Batch {
            steps: self.steps,
            sequences: sequences
                .map(|((observations, starts), state)| Sequence { observations, starts, state })
                .collect(),
        }
    }
}

/// A minibatch of several shards, in another order than the rollout's, against a single
/// pass over the same rows.
#[test]
fn shards_add_up_to_the_minibatch() {
    let network = Mlp { inputs: 7, hidden: vec![6, 5], actions: 4 };
    let mut data = Data::new(&network, 700, 1);
    let settings = PpoSettings::paper_placement();
    let weights = network.initialise(&mut stream(5, "test/weights", 0));
    let trajectory = Trajectory {
        observations: data.observations.concat(),
        masks: data.targets.mask.clone(),
        actions: data.targets.actions.clone(),
        log_probabilities: data.targets.log_probabilities.clone(),
        values: data.targets.values.clone(),
        starts: data.starts.concat(),
        advantages: data.targets.advantages.clone(),
        returns: data.targets.returns.clone(),
        ..Trajectory::default()
    };
    let rollout = Rollout { trajectories: &[trajectory], steps: 1, per_trajectory: 700 };
    let (weights, settings) = (&weights[..], &settings);
    let learner = Learner { network: &network, weights, settings, ent_coef: ENT_COEF, rollout };
    let sequences: Vec<usize> = (0..700).map(|k| k * 387 % 700).collect();
    let mut shards = Shards::default();
    let (found, gradient) = learner.gradient(&sequences, &mut shards);

    let advantages = wide(&data.targets.advantages);
    let mean = advantages.iter().sum::<f64>() / 700.0;
    let variance = advantages.iter().map(|a| (a - mean).powi(2)).sum::<f64>() / 699.0;
    for (standardised, advantage) in data.targets.advantages.iter_mut().zip(&advantages) {
        *standardised = ((advantage - mean) / variance.sqrt()) as f32;
    }
    let batch = data.batch();
    let (mut activations, mut output) = Default::default();
    network.forward(weights, &batch, &mut activations, &mut output);
    let losses = loss(settings, ENT_COEF, 1.0 / 700.0, &data.targets, &mut output);
    let mut expected = vec![0.0; weights.len()];
    network.backward(weights, &batch, &mut activations, &output, &mut expected);
    assert!((found.policy_loss - losses.policy_loss).abs() < ROUNDING);
    assert!((found.value_loss - losses.value_loss).abs() < ROUNDING);
    let largest = expected.iter().fold(0.0_f32, |most, slope| most.max(slope.abs()));
    for (found, expected) in gradient.iter().zip(&expected) {
        let error = f64::from((found - expected).abs());
        assert!(error < ROUNDING * f64::from(largest), "{found}, in one pass {expected}");
    }
}

/// Checks every weight's slope; `reference` gives logits and value of every row.
fn check<N: ActorCritic>(
    network: &N,
    data: &Data,
    clip_vloss: bool,
    reference: impl Fn(&[f64], &Data) -> Vec<(Vec<f64>, f64)>,
) {
    let settings = PpoSettings { clip_vloss, ..PpoSettings::paper_placement() };
    let mut random = stream(5, "test/weights", 0);
    let weights: Vec<f32> =
        (0..network.weight_count()).map(|_| random.random_range(-0.7..0.7)).collect();
    let batch = data.batch();
    let (mut activations, mut output) = (N::Activations::default(), Output::default());
    network.forward(&weights, &batch, &mut activations, &mut output);
    let share = 1.0 / batch.len() as f32;
    let losses = loss(&settings, ENT_COEF, share, &data.targets, &mut output);
    let mut gradient = vec![f32::NAN; weights.len()];
    network.backward(&weights, &batch, &mut activations, &output, &mut gradient);

    let mut weights: Vec<f64> = weights.into_iter().map(f64::from).collect();
    let total = |weights: &[f64]| {
        let outputs = reference(weights, data);
        let losses = reference_losses(&settings, &data.targets, &outputs);
        (
            losses,
            losses.policy_loss - f64::from(ENT_COEF) * losses.entropy
                + f64::from(settings.vf_coef) * losses.value_loss,
        )
    };
    let (expected, _) = total(&weights);
    for (name, found, expected) in [
        ("policy loss", losses.policy_loss, expected.policy_loss),
        ("value loss", losses.value_loss, expected.value_loss),
        ("entropy", losses.entropy, expected.entropy),
        ("approx_kl", losses.approx_kl, expected.approx_kl),
        ("clip_fraction", losses.clip_fraction, expected.clip_fraction),
    ] {
        assert!((found - expected).abs() < ROUNDING, "{name}: {found}, reference {expected}");
    }
    assert!(expected.clip_fraction > 0.2 && expected.clip_fraction < 0.95, "both branches occur");

    let slopes: Vec<f64> = (0..weights.len())
        .map(|index| {
            let weight = weights[index];
            let mut at = |offset: f64| {
                weights[index] = weight + offset;
                total(&weights).1
            };
            let slope = (at(STEP) - at(-STEP)) / (2.0 * STEP);
            weights[index] = weight;
            slope
        })
        .collect();
    let largest = slopes.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
    for (index, (found, expected)) in gradient.iter().zip(&slopes).enumerate() {
        let error = (f64::from(*found) - expected).abs();
        assert!(error < ROUNDING * largest, "weight {index}: {found}, difference {expected}");
    }
}

/// Equation (12) and its companions as they are written.
fn reference_losses(
    settings: &PpoSettings,
    targets: &Targets,
    outputs: &[(Vec<f64>, f64)],
) -> Losses {
    let mut sum = Losses::default();
    let clip = f64::from(settings.clip_coef);
    for (row, (logits, value)) in outputs.iter().enumerate() {
        let mask = &targets.mask[row * logits.len()..(row + 1) * logits.len()];
        let allowed = || logits.iter().zip(mask).filter(|(_, allowed)| **allowed);
        let total: f64 = allowed().map(|(logit, _)| logit.exp()).sum();
        let log_probability = |logit: f64| logit - total.ln();
        sum.entropy -= allowed()
            .map(|(logit, _)| log_probability(*logit).exp() * log_probability(*logit))
            .sum::<f64>();
        let log_ratio = log_probability(logits[targets.actions[row]])
            - f64::from(targets.log_probabilities[row]);
        let (ratio, advantage) = (log_ratio.exp(), f64::from(targets.advantages[row]));
        sum.policy_loss -= (ratio * advantage).min(ratio.clamp(1.0 - clip, 1.0 + clip) * advantage);
        sum.approx_kl += ratio - 1.0 - log_ratio;
        sum.clip_fraction += f64::from(u8::from((ratio - 1.0).abs() > clip));
        let (target, old) = (f64::from(targets.returns[row]), f64::from(targets.values[row]));
        let square = |value: f64| 0.5 * (value - target).powi(2);
        sum.value_loss += if settings.clip_vloss {
            square(*value).max(square(old + (value - old).clamp(-clip, clip)))
        } else {
            square(*value)
        };
    }
    let rows = outputs.len() as f64;
    Losses {
        policy_loss: sum.policy_loss / rows,
        value_loss: sum.value_loss / rows,
        entropy: sum.entropy / rows,
        approx_kl: sum.approx_kl / rows,
        clip_fraction: sum.clip_fraction / rows,
        gradient_norm: 0.0,
    }
}

/// x·W + b; takes the layer's weights off the front.
fn dense(weights: &mut &[f64], x: &[f64], outputs: usize) -> Vec<f64> {
    let (w, rest) = weights.split_at(x.len() * outputs);
    let (bias, rest) = rest.split_at(outputs);
    *weights = rest;
    (0..outputs)
        .map(|k| bias[k] + x.iter().enumerate().map(|(i, x)| x * w[i * outputs + k]).sum::<f64>())
        .collect()
}

fn relu(values: Vec<f64>) -> Vec<f64> {
    values.into_iter().map(|value| value.max(0.0)).collect()
}

fn wide(values: &[f32]) -> Vec<f64> {
    values.iter().copied().map(f64::from).collect()
}

#[test]
fn gradients_of_the_feed_forward_network() {
    let network = Mlp { inputs: 7, hidden: vec![6, 5], actions: 4 };
    let data = Data::new(&network, 70, 1);
    let reference = |weights: &[f64], data: &Data| {
        data.observations
            .iter()
            .map(|observation| {
                let mut rest = weights;
                let h = relu(dense(&mut rest, &wide(observation), 6));
                let h = relu(dense(&mut rest, &h, 5));
                (dense(&mut rest, &h, 4), dense(&mut rest, &h, 1)[0])
            })
            .collect()
    };
    check(&network, &data, false, reference);
    check(&network, &data, true, reference);
}

#[test]
fn gradients_of_the_recurrent_network_with_resets_inside_sequences() {
    let network = Recurrent { inputs: 3, embedding: 4, units: 5, actions: 4 };
    let data = Data::new(&network, 6, 9);
    check(&network, &data, false, |weights, data| {
        let sigmoid = |x: f64| 1.0 / (1.0 + (-x).exp());
        let mut outputs = Vec::new();
        for ((observations, starts), state) in
            data.observations.iter().zip(&data.starts).zip(&data.states)
        {
            let (mut h, mut c) = (wide(&state[..5]), wide(&state[5..]));
            for (observation, &start) in observations.chunks_exact(3).zip(starts) {
                if start {
                    (h, c) = (vec![0.0; 5], vec![0.0; 5]);
                }
                let mut rest = weights;
                let x = relu(dense(&mut rest, &wide(observation), 4));
                let mut gates = dense(&mut rest, &x, 20);
                let (u, mut rest) = rest.split_at(5 * 20);
                for (k, gate) in gates.iter_mut().enumerate() {
                    *gate += h.iter().enumerate().map(|(j, h)| h * u[j * 20 + k]).sum::<f64>();
                }
                for k in 0..5 {
                    let [i, f, g, o] = [0, 5, 10, 15].map(|first| gates[first + k]);
                    c[k] = sigmoid(f) * c[k] + sigmoid(i) * g.tanh();
                    h[k] = sigmoid(o) * c[k].tanh();
                }
                outputs.push((dense(&mut rest, &h, 4), dense(&mut rest, &h, 1)[0]));
            }
        }
        outputs
    });
}

/// A state that is reset inside a sequence is that of two sequences, forward and
/// backward.
#[test]
fn a_reset_inside_a_sequence_separates_it_in_two() {
    let network = Recurrent { inputs: 3, embedding: 4, units: 5, actions: 4 };
    let weights = network.initialise(&mut stream(6, "test/weights", 0));
    let data = Data::new(&network, 1, 10);
    let (observations, state) = (&data.observations[0], &data.states[0]);
    let mut starts = [false; 10];
    starts[4] = true;
    let zeros = vec![0.0; network.state_len()];
    let run = |observations: &[f32], starts: &[bool], state: &[f32]| {
        let sequences = vec![Sequence { observations, starts, state }];
        let batch = Batch { steps: starts.len(), sequences };
        let (mut activations, mut output) = Default::default();
        network.forward(&weights, &batch, &mut activations, &mut output);
        let slopes = Output { logits: output.logits.clone(), values: output.values.clone() };
        let mut gradient = vec![0.0; weights.len()];
        network.backward(&weights, &batch, &mut activations, &slopes, &mut gradient);
        (output, gradient)
    };
    let (whole, gradient) = run(observations, &starts, state);
    let (first, first_gradient) = run(&observations[..12], &starts[..4], state);
    let (second, second_gradient) = run(&observations[12..], &[false; 6], &zeros);
    let same = |a: f32, b: f32| f64::from((a - b).abs()) < ROUNDING;
    let joined = first.logits.iter().chain(&second.logits);
    assert!(whole.logits.iter().zip(joined).all(|(a, b)| same(*a, *b)));
    let joined = first.values.iter().chain(&second.values);
    assert!(whole.values.iter().zip(joined).all(|(a, b)| same(*a, *b)));
    for ((whole, first), second) in gradient.iter().zip(&first_gradient).zip(&second_gradient) {
        assert!(same(*whole, first + second), "{whole}: {first} + {second}");
    }
    let (unreset, _) = run(observations, &[false; 10], state);
    assert!(!same(unreset.values[9], whole.values[9]), "the reset matters");
}
