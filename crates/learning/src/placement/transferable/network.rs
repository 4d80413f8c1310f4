//! The policy's network: the same small perceptron for every candidate, which sees
//! the mean over all of them before its second layer.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for wide vectors"
)]
#![expect(clippy::large_stack_arrays, reason = "a few tens of kilobytes on their way into a box")]

use super::observation::{CANDIDATES, FEATURES};
use pulp::{Arch, Simd, WithSimd};
use rand::Rng;
use sonarfleet::random::Stream;

/// Units of each hidden layer.
pub const HIDDEN: usize = 48;

/// Rows of a matrix that are multiplied at a time; divides [`HIDDEN`].
const BLOCK: usize = 8;

/// Parts in which sums over candidates are taken; divides [`CANDIDATES`].
const PARTS: usize = 16;

type Rows<const N: usize> = [[f32; CANDIDATES]; N];

/// Where each matrix lies in the flat weights.
mod place {
    use super::{FEATURES, HIDDEN};
    pub(super) const FIRST: usize = 0;
    pub(super) const FIRST_BIAS: usize = FIRST + HIDDEN * FEATURES;
    pub(super) const SECOND: usize = FIRST_BIAS + HIDDEN;
    pub(super) const CONTEXT: usize = SECOND + HIDDEN * HIDDEN;
    pub(super) const SECOND_BIAS: usize = CONTEXT + HIDDEN * HIDDEN;
    pub(super) const OUTPUT: usize = SECOND_BIAS + HIDDEN;
    pub(super) const END: usize = OUTPUT + HIDDEN;
}

/// Number of weights.
pub const WEIGHTS: usize = place::END;

/// h₁ = relu(W₁f + b₁), h₂ = relu(W₂h₁ + Wₓ·mean(h₁) + b₂), logit = w₃·h₂, per
/// candidate; the mean is over the candidates.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    /// W₁ [hidden, feature], b₁, W₂ [hidden, hidden], Wₓ [hidden, hidden], b₂, w₃.
    pub weights: Vec<f32>,
}

/// What a forward pass leaves for the backward pass.
#[derive(Debug, Clone)]
pub(super) struct Activations {
    first: Box<Rows<HIDDEN>>,
    second: Box<Rows<HIDDEN>>,
    mean: [f32; HIDDEN],
    /// One per candidate.
    pub(super) logits: [f32; CANDIDATES],
    scratch: Box<Scratch>,
}

#[derive(Debug, Clone)]
struct Scratch {
    slope: Rows<HIDDEN>,
    first_slope: Rows<HIDDEN>,
    turned: [[f32; HIDDEN]; CANDIDATES],
}

impl Default for Activations {
    fn default() -> Self {
        let rows = || Box::new([[0.0; CANDIDATES]; HIDDEN]);
        Self {
            first: rows(),
            second: rows(),
            mean: [0.0; HIDDEN],
            logits: [0.0; CANDIDATES],
            scratch: Box::new(Scratch {
                slope: [[0.0; CANDIDATES]; HIDDEN],
                first_slope: [[0.0; CANDIDATES]; HIDDEN],
                turned: [[0.0; HIDDEN]; CANDIDATES],
            }),
        }
    }
}

impl Network {
    /// Random weights of the scale of He et al. (2015, doi:10.1109/ICCV.2015.123), and
    /// an output near 0, so that all candidates are nearly as likely.
    pub fn random(random: &mut Stream) -> Self {
        let mut weights = vec![0.0; WEIGHTS];
        let mut fill = |from: usize, count: usize, scale: f32| {
            for weight in &mut weights[from..from + count] {
                *weight = scale * gaussian(random);
            }
        };
        let scale = |inputs: usize| (2.0 / inputs as f32).sqrt();
        fill(place::FIRST, HIDDEN * FEATURES, scale(FEATURES));
        fill(place::SECOND, HIDDEN * HIDDEN, scale(HIDDEN));
        fill(place::CONTEXT, HIDDEN * HIDDEN, scale(HIDDEN));
        fill(place::OUTPUT, HIDDEN, 0.01);
        Self { weights }
    }

    /// W₁, b₁, W₂, Wₓ, b₂, w₃.
    pub(super) fn parts(&self) -> [&[f32]; 6] {
        let part = |from: usize, to: usize| &self.weights[from..to];
        [
            part(place::FIRST, place::FIRST_BIAS),
            part(place::FIRST_BIAS, place::SECOND),
            part(place::SECOND, place::CONTEXT),
            part(place::CONTEXT, place::SECOND_BIAS),
            part(place::SECOND_BIAS, place::OUTPUT),
            part(place::OUTPUT, place::END),
        ]
    }

    /// Logits of the first `count` candidates.
    pub(super) fn forward(&self, features: &Rows<FEATURES>, count: usize, to: &mut Activations) {
        Arch::new().dispatch(Forward { weights: &self.weights, features, count, to });
    }

    /// Adds to `gradient` what follows from the slopes of the loss along the logits,
    /// after a forward pass on the same features. Slopes beyond `count` are 0.
    pub(super) fn backward(
        &self,
        features: &Rows<FEATURES>,
        count: usize,
        from: &mut Activations,
        slopes: &[f32; CANDIDATES],
        gradient: &mut [f32],
    ) {
        let weights = &self.weights;
        Arch::new().dispatch(Backward { weights, features, count, from, slopes, gradient });
    }
}

struct Forward<'a> {
    weights: &'a [f32],
    features: &'a Rows<FEATURES>,
    count: usize,
    to: &'a mut Activations,
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        forward(simd, self.weights, self.features, self.count, self.to);
    }
}

struct Backward<'a> {
    weights: &'a [f32],
    features: &'a Rows<FEATURES>,
    count: usize,
    from: &'a mut Activations,
    slopes: &'a [f32; CANDIDATES],
    gradient: &'a mut [f32],
}

impl WithSimd for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { weights, features, count, from, slopes, gradient } = self;
        backward(simd, weights, features, count, from, slopes, gradient);
    }
}

/// A standard normal number (Box & Muller 1958).
fn gaussian(random: &mut Stream) -> f32 {
    let radius: f64 = (-2.0 * (1.0 - random.random::<f64>()).ln()).sqrt();
    let angle: f64 = std::f64::consts::TAU * random.random::<f64>();
    (radius * angle.cos()) as f32
}

#[inline(always)]
fn forward<S: Simd>(
    simd: S,
    weights: &[f32],
    features: &Rows<FEATURES>,
    count: usize,
    to: &mut Activations,
) {
    let matrix = &weights[place::FIRST..place::FIRST_BIAS];
    let bias = &weights[place::FIRST_BIAS..place::SECOND];
    multiply(simd, matrix, bias, features, &mut to.first);
    let share = 1.0 / count.max(1) as f32;
    for (mean, row) in to.mean.iter_mut().zip(to.first.iter()) {
        *mean = share * row[..count].iter().sum::<f32>();
    }
    let mut bias = [0.0; HIDDEN];
    let own = &weights[place::SECOND_BIAS..place::OUTPUT];
    let context = weights[place::CONTEXT..place::SECOND_BIAS].chunks_exact(HIDDEN);
    for ((bias, own), row) in bias.iter_mut().zip(own).zip(context) {
        *bias = own + row.iter().zip(&to.mean).map(|(w, mean)| w * mean).sum::<f32>();
    }
    let matrix = &weights[place::SECOND..place::CONTEXT];
    multiply(simd, matrix, &bias, &to.first, &mut to.second);
    to.logits = [0.0; CANDIDATES];
    for (&weight, row) in weights[place::OUTPUT..].iter().zip(to.second.iter()) {
        for (logit, &value) in to.logits.iter_mut().zip(row) {
            *logit = weight.mul_add(value, *logit);
        }
    }
}

/// relu(W·x + b) for all candidates: sums of [`BLOCK`] rows stay in registers.
#[inline(always)]
fn multiply<S: Simd, const IN: usize>(
    simd: S,
    matrix: &[f32],
    bias: &[f32],
    input: &Rows<IN>,
    output: &mut Rows<HIDDEN>,
) {
    let zero = simd.splat_f32s(0.0);
    for (block, output) in output.chunks_exact_mut(BLOCK).enumerate() {
        let matrix = &matrix[block * BLOCK * IN..(block + 1) * BLOCK * IN];
        let bias = &bias[block * BLOCK..(block + 1) * BLOCK];
        for lane in 0..CANDIDATES / S::F32_LANES {
            let mut sums = [zero; BLOCK];
            for row in 0..BLOCK {
                sums[row] = simd.splat_f32s(bias[row]);
            }
            for (i, input) in input.iter().enumerate() {
                let value = S::as_simd_f32s(input).0[lane];
                for row in 0..BLOCK {
                    let weight = simd.splat_f32s(matrix[row * IN + i]);
                    sums[row] = simd.mul_add_f32s(weight, value, sums[row]);
                }
            }
            for row in 0..BLOCK {
                S::as_mut_simd_f32s(&mut output[row]).0[lane] = simd.max_f32s(sums[row], zero);
            }
        }
    }
}

#[inline(always)]
fn backward<S: Simd>(
    simd: S,
    weights: &[f32],
    features: &Rows<FEATURES>,
    count: usize,
    from: &mut Activations,
    slopes: &[f32; CANDIDATES],
    gradient: &mut [f32],
) {
    let Activations { first, second, mean, scratch, .. } = from;
    let Scratch { slope, first_slope, turned } = &mut **scratch;
    let output = &weights[place::OUTPUT..];
    for (unit, (slope, second)) in slope.iter_mut().zip(second.iter()).enumerate() {
        let mut sum = [0.0_f32; PARTS];
        for (slopes, second) in slopes.chunks_exact(PARTS).zip(second.chunks_exact(PARTS)) {
            for ((sum, &slope), &value) in sum.iter_mut().zip(slopes).zip(second) {
                *sum = slope.mul_add(value, *sum);
            }
        }
        gradient[place::OUTPUT + unit] += sum.iter().sum::<f32>();
        for ((slope, &value), &downstream) in slope.iter_mut().zip(second).zip(slopes) {
            *slope = if value > 0.0 { output[unit] * downstream } else { 0.0 };
        }
    }
    let mut sums = [0.0_f32; HIDDEN];
    for (sum, slope) in sums.iter_mut().zip(slope.iter()) {
        *sum = slope.iter().sum();
    }
    // The context is shared: its slope is the sum over the candidates.
    let mut mean_slope = [0.0_f32; HIDDEN];
    for (unit, &sum) in sums.iter().enumerate() {
        gradient[place::SECOND_BIAS + unit] += sum;
        let row = place::CONTEXT + unit * HIDDEN;
        for (gradient, &mean) in gradient[row..row + HIDDEN].iter_mut().zip(mean.iter()) {
            *gradient = sum.mul_add(mean, *gradient);
        }
        for (mean, &weight) in mean_slope.iter_mut().zip(&weights[row..row + HIDDEN]) {
            *mean = sum.mul_add(weight, *mean);
        }
    }
    turn(first, turned);
    outer::<S, HIDDEN>(simd, slope, turned, &mut gradient[place::SECOND..place::CONTEXT]);

    let share = 1.0 / count.max(1) as f32;
    for (row, mean) in first_slope.iter_mut().zip(&mean_slope) {
        row[..count].fill(share * mean);
        row[count..].fill(0.0);
    }
    back(simd, &weights[place::SECOND..place::CONTEXT], slope, first_slope);
    for (slope, first) in first_slope.iter_mut().zip(first.iter()) {
        for (slope, &value) in slope.iter_mut().zip(first) {
            *slope = if value > 0.0 { *slope } else { 0.0 };
        }
    }
    for (unit, slope) in first_slope.iter().enumerate() {
        gradient[place::FIRST_BIAS + unit] += slope.iter().sum::<f32>();
    }
    turn(features, turned);
    outer::<S, FEATURES>(simd, first_slope, turned, &mut gradient[place::FIRST..place::FIRST_BIAS]);
}

/// Candidate by candidate instead of row by row.
#[inline(always)]
fn turn<const N: usize>(rows: &Rows<N>, turned: &mut [[f32; HIDDEN]; CANDIDATES]) {
    const { assert!(N <= HIDDEN) };
    for (i, row) in rows.iter().enumerate() {
        for (turned, &value) in turned.iter_mut().zip(row) {
            turned[i] = value;
        }
    }
}

/// Adds Σ over the candidates of slope ⊗ input to a gradient [hidden, N].
#[inline(always)]
fn outer<S: Simd, const N: usize>(
    simd: S,
    slopes: &Rows<HIDDEN>,
    inputs: &[[f32; HIDDEN]; CANDIDATES],
    gradient: &mut [f32],
) {
    const ROWS: usize = 8;
    for (block, slopes) in slopes.chunks_exact(ROWS).enumerate() {
        for part in 0..N.div_ceil(S::F32_LANES) {
            let mut sums = [simd.splat_f32s(0.0); ROWS];
            for (candidate, input) in inputs.iter().enumerate() {
                let value = S::as_simd_f32s(input).0[part];
                for row in 0..ROWS {
                    let slope = simd.splat_f32s(slopes[row][candidate]);
                    sums[row] = simd.mul_add_f32s(slope, value, sums[row]);
                }
            }
            for (row, sum) in sums.into_iter().enumerate() {
                let mut values = [0.0; HIDDEN];
                S::as_mut_simd_f32s(&mut values).0[0] = sum;
                let from = part * S::F32_LANES;
                let width = S::F32_LANES.min(N.saturating_sub(from));
                let at = (block * ROWS + row) * N + from;
                for (gradient, value) in gradient[at..at + width].iter_mut().zip(values) {
                    *gradient += value;
                }
            }
        }
    }
}

/// Adds W₂ᵀ · slope.
#[inline(always)]
fn back<S: Simd>(simd: S, matrix: &[f32], slopes: &Rows<HIDDEN>, to: &mut Rows<HIDDEN>) {
    for (block, to) in to.chunks_exact_mut(BLOCK).enumerate() {
        for lane in 0..CANDIDATES / S::F32_LANES {
            let mut sums = [simd.splat_f32s(0.0); BLOCK];
            for row in 0..BLOCK {
                sums[row] = S::as_simd_f32s(&to[row]).0[lane];
            }
            for (unit, slopes) in slopes.iter().enumerate() {
                let slope = S::as_simd_f32s(slopes).0[lane];
                let weights = &matrix[unit * HIDDEN + block * BLOCK..][..BLOCK];
                for row in 0..BLOCK {
                    let weight = simd.splat_f32s(weights[row]);
                    sums[row] = simd.mul_add_f32s(weight, slope, sums[row]);
                }
            }
            for row in 0..BLOCK {
                S::as_mut_simd_f32s(&mut to[row]).0[lane] = sums[row];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sonarfleet::random::stream;

    /// Single precision in sums of some thousand terms against central differences.
    const TOLERANCE: f64 = 2e-2;

    fn features(random: &mut Stream, count: usize) -> Box<Rows<FEATURES>> {
        let mut features = Box::new([[0.0; CANDIDATES]; FEATURES]);
        for row in features.iter_mut() {
            for value in &mut row[..count] {
                *value = random.random_range(-1.0..1.0);
            }
        }
        features
    }

    /// The network written down naively, in double precision.
    fn naive(weights: &[f64], features: &Rows<FEATURES>, count: usize) -> Vec<f64> {
        let relu = |x: f64| x.max(0.0);
        let first: Vec<Vec<f64>> = (0..count)
            .map(|c| {
                let unit = |j: usize| {
                    let row = &weights[place::FIRST + j * FEATURES..];
                    let sum: f64 = (0..FEATURES).map(|i| row[i] * f64::from(features[i][c])).sum();
                    relu(sum + weights[place::FIRST_BIAS + j])
                };
                (0..HIDDEN).map(unit).collect()
            })
            .collect();
        let mean: Vec<f64> =
            (0..HIDDEN).map(|j| first.iter().map(|h| h[j]).sum::<f64>() / count as f64).collect();
        first
            .iter()
            .map(|h| {
                let unit = |j: usize| {
                    let row = |from: usize, x: &[f64]| -> f64 {
                        (0..HIDDEN).map(|i| weights[from + j * HIDDEN + i] * x[i]).sum()
                    };
                    let sum = row(place::SECOND, h) + row(place::CONTEXT, &mean);
                    relu(sum + weights[place::SECOND_BIAS + j])
                };
                (0..HIDDEN).map(|j| weights[place::OUTPUT + j] * unit(j)).sum()
            })
            .collect()
    }

    #[test]
    fn logits_and_gradients_are_those_of_the_formula() {
        for count in [128, 77, 1] {
            let mut random = stream(3, "test/network", count as u64);
            let mut network = Network::random(&mut random);
            for weight in &mut network.weights {
                *weight += random.random_range(-0.05..0.05);
            }
            let features = features(&mut random, count);
            let mut activations = Activations::default();
            network.forward(&features, count, &mut activations);
            let exact: Vec<f64> = network.weights.iter().map(|&w| f64::from(w)).collect();
            for (logit, expected) in activations.logits.iter().zip(naive(&exact, &features, count))
            {
                assert!((f64::from(*logit) - expected).abs() < 1e-4);
            }

            let mut slopes = [0.0; CANDIDATES];
            for slope in &mut slopes[..count] {
                *slope = random.random_range(-1.0..1.0);
            }
            let mut gradient = vec![0.0; WEIGHTS];
            network.backward(&features, count, &mut activations, &slopes, &mut gradient);
            let loss = |weights: &[f64]| -> f64 {
                let logits = naive(weights, &features, count);
                logits.iter().zip(&slopes).map(|(l, &s)| l * f64::from(s)).sum()
            };
            for at in (0..WEIGHTS).step_by(37) {
                const STEP: f64 = 1e-6;
                let mut moved = exact.clone();
                moved[at] += STEP;
                let above = loss(&moved);
                moved[at] -= 2.0 * STEP;
                let expected = (above - loss(&moved)) / (2.0 * STEP);
                let found = f64::from(gradient[at]);
                let scale = expected.abs().max(0.05);
                assert!((found - expected).abs() < TOLERANCE * scale, "{at}: {found} {expected}");
            }
        }
    }
}
