//! Long short-term memory (Hochreiter & Schmidhuber 1997,
//! doi:10.1162/neco.1997.9.8.1735) over sequences in which episodes start anew.

use super::linear::Linear;
use super::matrix::{Factor, Matrix, MatrixMut, multiply, multiply_add};
use super::orthogonal::orthogonal;
use super::vector::{sigmoid, tanh, wide};
use rayon::prelude::*;
use sonarfleet::random::Stream;

/// A layer with forget gates:
///
/// (i, f, g, o) = x·W + h·U + b, c ← σ(f)·c + σ(i)·tanh(g), h ← σ(o)·tanh(c).
///
/// Weights, in order: W [input, gate], b `[gate]`, U [unit, gate]; the gates' units in
/// the order i, f, g, o. The state is h, then c.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lstm {
    /// Values in x.
    pub inputs: usize,
    /// Values in h.
    pub units: usize,
}

/// What the layer sees.
#[derive(Debug, Clone, Copy)]
pub(super) struct LstmInputs<'a> {
    /// Steps of each sequence.
    pub(super) steps: usize,
    /// [sequence, step, input]
    pub(super) x: &'a [f32],
    /// Whether an episode starts at a step, so that the state is 0 before it,
    /// [sequence, step].
    pub(super) starts: &'a [bool],
    /// State before the first step, [sequence, state].
    pub(super) states: &'a [f32],
}

/// What a forward pass leaves, [sequence, step, …].
#[derive(Debug, Clone, Default)]
pub(super) struct LstmActivations {
    /// Gates after their non-linearities; after the backward pass, the gradients
    /// before them.
    gates: Vec<f32>,
    /// h and c before each step, zeros where an episode starts.
    hidden_before: Vec<f32>,
    cell_before: Vec<f32>,
    cell_tanh: Vec<f32>,
    /// h after each step.
    pub(super) hidden: Vec<f32>,
    /// State after the last step, [sequence, state].
    pub(super) last: Vec<f32>,
}

/// Tasks that the sequences of a batch are divided among, whatever the number of
/// threads.
const TASKS: usize = 4;

impl Lstm {
    /// Number of weights.
    pub const fn weight_count(&self) -> usize {
        self.input().weight_count() + self.units * 4 * self.units
    }

    /// W and b.
    pub const fn input(&self) -> Linear {
        Linear { inputs: self.inputs, outputs: 4 * self.units }
    }

    /// Orthogonal W and U, and biases 0.
    pub fn initialise(&self, weights: &mut [f32], random: &mut Stream) {
        let (input, recurrent) = weights.split_at_mut(self.input().weight_count());
        self.input().initialise(input, 1.0, random);
        orthogonal(recurrent, 4 * self.units, 1.0, random);
    }

    /// h after each step.
    pub(super) fn forward(
        &self,
        weights: &[f32],
        inputs: &LstmInputs<'_>,
        activations: &mut LstmActivations,
    ) {
        let LstmInputs { steps, x, starts, states } = *inputs;
        let units = self.units;
        let rows = starts.len();
        let per_task = (rows / steps).div_ceil(TASKS);
        let (input, recurrent) = weights.split_at(self.input().weight_count());
        let LstmActivations { gates, hidden_before, cell_before, cell_tanh, hidden, last } =
            activations;
        gates.resize(rows * 4 * units, 0.0);
        for values in [&mut *hidden_before, cell_before, cell_tanh, hidden] {
            values.resize(rows * units, 0.0);
        }
        last.clear();
        last.extend_from_slice(states);
        self.input().forward(input, x, gates);
        let recurrent = Factor::new(Matrix::new(recurrent, 4 * units), per_task);

        let chunk = per_task * steps;
        gates
            .par_chunks_mut(chunk * 4 * units)
            .zip(hidden_before.par_chunks_mut(chunk * units))
            .zip(cell_before.par_chunks_mut(chunk * units))
            .zip(cell_tanh.par_chunks_mut(chunk * units))
            .zip(hidden.par_chunks_mut(chunk * units))
            .zip(last.par_chunks_mut(per_task * 2 * units))
            .zip(starts.par_chunks(chunk))
            .for_each(|((((((gates, h_before), c_before), c_tanh), hidden), state), starts)| {
                for step in 0..steps {
                    for (row, state) in
                        (step..).step_by(steps).zip(state.chunks_exact_mut(2 * units))
                    {
                        if starts[row] {
                            state.fill(0.0);
                        }
                        let row = row * units..(row + 1) * units;
                        h_before[row.clone()].copy_from_slice(&state[..units]);
                        c_before[row].copy_from_slice(&state[units..]);
                    }
                    multiply_add(
                        &mut MatrixMut::at_step(gates, step, steps, 4 * units),
                        &Matrix::at_step(h_before, step, steps, units),
                        &recurrent,
                    );
                    for (row, state) in
                        (step..).step_by(steps).zip(state.chunks_exact_mut(2 * units))
                    {
                        let (h, c) = state.split_at_mut(units);
                        let gates = &mut gates[row * 4 * units..(row + 1) * 4 * units];
                        let row = row * units..(row + 1) * units;
                        wide(|| cell(gates, c, &mut c_tanh[row.clone()], h));
                        hidden[row].copy_from_slice(h);
                    }
                }
            });
    }

    /// The gradients in the weights and in x, from that in h after each step: back
    /// through time to the start of each sequence, and not beyond the start of an
    /// episode.
    pub(super) fn backward(
        &self,
        weights: &[f32],
        inputs: &LstmInputs<'_>,
        activations: &mut LstmActivations,
        hidden_gradient: &[f32],
        gradient: &mut [f32],
        x_gradient: &mut [f32],
    ) {
        let LstmInputs { steps, x, starts, .. } = *inputs;
        let units = self.units;
        let per_task = (starts.len() / steps).div_ceil(TASKS);
        let (input, recurrent) = weights.split_at(self.input().weight_count());
        let recurrent = Matrix::new(recurrent, 4 * units).transposed();
        let recurrent = Factor::new(recurrent, per_task);
        let chunk = per_task * steps;
        activations
            .gates
            .par_chunks_mut(chunk * 4 * units)
            .zip(activations.cell_before.par_chunks(chunk * units))
            .zip(activations.cell_tanh.par_chunks(chunk * units))
            .zip(hidden_gradient.par_chunks(chunk * units))
            .zip(starts.par_chunks(chunk))
            .for_each(|((((gates, c_before), c_tanh), hidden_gradient), starts)| {
                let sequences = starts.len() / steps;
                // What comes back from the next step: gradients in h and in c.
                let mut h_later = vec![0.0; sequences * units];
                let mut c_later = vec![0.0; sequences * units];
                for step in (0..steps).rev() {
                    let later = h_later.chunks_exact(units).zip(c_later.chunks_exact_mut(units));
                    for (row, (h_later, c_later)) in (step..).step_by(steps).zip(later) {
                        let gates = &mut gates[row * 4 * units..(row + 1) * 4 * units];
                        let row = row * units..(row + 1) * units;
                        let slopes = &hidden_gradient[row.clone()];
                        let (c_before, c_tanh) = (&c_before[row.clone()], &c_tanh[row]);
                        wide(|| cell_backward(gates, c_before, c_tanh, slopes, h_later, c_later));
                    }
                    multiply(
                        &mut MatrixMut::new(&mut h_later, units),
                        &Matrix::at_step(gates, step, steps, 4 * units),
                        &recurrent,
                    );
                    let later =
                        h_later.chunks_exact_mut(units).zip(c_later.chunks_exact_mut(units));
                    for (row, (h_later, c_later)) in (step..).step_by(steps).zip(later) {
                        if starts[row] {
                            h_later.fill(0.0);
                            c_later.fill(0.0);
                        }
                    }
                }
            });
        let gates = &activations.gates;
        let (input_gradient, recurrent_gradient) =
            gradient.split_at_mut(self.input().weight_count());
        self.input().backward_weights(x, gates, input_gradient);
        self.input().backward_input(input, gates, x_gradient);
        let hidden = Linear { inputs: units, outputs: 4 * units };
        hidden.backward_matrix(&activations.hidden_before, gates, recurrent_gradient);
    }
}

/// One step of one sequence: sums of the gates become the gates, c and h move on.
#[expect(clippy::inline_always, reason = "to be compiled for wide vectors")]
#[inline(always)]
fn cell(gates: &mut [f32], c: &mut [f32], c_tanh: &mut [f32], h: &mut [f32]) {
    let units = c.len();
    let (i, rest) = gates.split_at_mut(units);
    let (f, rest) = rest.split_at_mut(units);
    let (g, o) = rest.split_at_mut(units);
    for k in 0..units {
        i[k] = sigmoid(i[k]);
        f[k] = sigmoid(f[k]);
        g[k] = tanh(g[k]);
        o[k] = sigmoid(o[k]);
        c[k] = f[k] * c[k] + i[k] * g[k];
        c_tanh[k] = tanh(c[k]);
        h[k] = o[k] * c_tanh[k];
    }
}

/// The way back: gates become the gradients in their sums, `c_later` moves to the step
/// before.
#[expect(clippy::inline_always, reason = "to be compiled for wide vectors")]
#[inline(always)]
fn cell_backward(
    gates: &mut [f32],
    c_before: &[f32],
    c_tanh: &[f32],
    hidden_gradient: &[f32],
    h_later: &[f32],
    c_later: &mut [f32],
) {
    let units = c_before.len();
    let (i, rest) = gates.split_at_mut(units);
    let (f, rest) = rest.split_at_mut(units);
    let (g, o) = rest.split_at_mut(units);
    for k in 0..units {
        let dh = hidden_gradient[k] + h_later[k];
        let dc = c_later[k] + dh * o[k] * (1.0 - c_tanh[k] * c_tanh[k]);
        let (di, df, dg) = (dc * g[k], dc * c_before[k], dc * i[k]);
        let d_o = dh * c_tanh[k];
        c_later[k] = dc * f[k];
        i[k] = di * i[k] * (1.0 - i[k]);
        f[k] = df * f[k] * (1.0 - f[k]);
        g[k] = dg * (1.0 - g[k] * g[k]);
        o[k] = d_o * o[k] * (1.0 - o[k]);
    }
}
