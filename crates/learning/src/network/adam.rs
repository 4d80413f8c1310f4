//! Gradient descent.

use super::vector::wide;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Adam (Kingma & Ba 2015, arXiv:1412.6980) on a flat slice of weights.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Adam {
    /// Decay of the mean gradient, β₁.
    pub beta1: f32,
    /// Decay of the mean squared gradient, β₂.
    pub beta2: f32,
    /// What keeps the division finite, ε.
    pub epsilon: f32,
    steps: u64,
    mean: Vec<f32>,
    square: Vec<f32>,
}

impl Adam {
    /// An optimiser for so many weights that has seen no gradient yet, with β₁ 0.9,
    /// β₂ 0.999.
    pub fn new(weights: usize, epsilon: f32) -> Self {
        Self {
            beta1: 0.9,
            beta2: 0.999,
            epsilon,
            steps: 0,
            mean: vec![0.0; weights],
            square: vec![0.0; weights],
        }
    }

    /// One step against the gradient.
    ///
    /// # Panics
    /// Where the slices are not as long as the optimiser was made for.
    pub fn step(&mut self, weights: &mut [f32], gradient: &[f32], learning_rate: f32) {
        self.step_scaled(weights, gradient, 1.0, learning_rate);
    }

    /// One step against the gradient, scaled so that its Euclidean norm is at most
    /// `largest`; gives the norm it has. The same as [`clip_gradient`] and
    /// [`Self::step`], with one pass over the gradient less.
    ///
    /// # Panics
    /// Where the slices are not as long as the optimiser was made for.
    pub fn step_clipped(
        &mut self,
        weights: &mut [f32],
        gradient: &[f32],
        largest: f32,
        learning_rate: f32,
    ) -> f32 {
        let norm = norm(gradient);
        let scale = if norm > largest { largest / norm } else { 1.0 };
        self.step_scaled(weights, gradient, scale, learning_rate);
        norm
    }

    fn step_scaled(
        &mut self,
        weights: &mut [f32],
        gradient: &[f32],
        scale: f32,
        learning_rate: f32,
    ) {
        assert_eq!(weights.len(), self.mean.len(), "one moment per weight");
        assert_eq!(gradient.len(), self.mean.len(), "one gradient per weight");
        self.steps += 1;
        let correction = |beta: f32| 1.0 - f64::from(beta).powf(self.steps as f64);
        let rate = (f64::from(learning_rate) / correction(self.beta1)) as f32;
        let square_factor = (1.0 / correction(self.beta2)) as f32;
        let (beta1, beta2, epsilon) = (self.beta1, self.beta2, self.epsilon);
        weights
            .par_chunks_mut(CHUNK)
            .zip(gradient.par_chunks(CHUNK))
            .zip(self.mean.par_chunks_mut(CHUNK).zip(self.square.par_chunks_mut(CHUNK)))
            .for_each(|((weights, gradient), (mean, square))| {
                let moments = mean.iter_mut().zip(square.iter_mut());
                wide(|| {
                    for ((weight, &slope), (mean, square)) in
                        weights.iter_mut().zip(gradient).zip(moments)
                    {
                        let slope = scale * slope;
                        *mean = beta1 * *mean + (1.0 - beta1) * slope;
                        *square = beta2 * *square + (1.0 - beta2) * slope * slope;
                        *weight -= rate * *mean / ((*square * square_factor).sqrt() + epsilon);
                    }
                });
            });
    }
}

/// Weights that one task takes, whatever the number of threads.
const CHUNK: usize = 16_384;

/// Scales a gradient so that its Euclidean norm is at most `largest`; gives the norm
/// it had.
pub fn clip_gradient(gradient: &mut [f32], largest: f32) -> f32 {
    let norm = norm(gradient);
    if norm > largest {
        let scale = largest / norm;
        for slope in gradient {
            *slope *= scale;
        }
    }
    norm
}

fn norm(gradient: &[f32]) -> f32 {
    let squares: Vec<f64> = gradient.par_chunks(CHUNK).map(|part| wide(|| squares(part))).collect();
    squares.iter().sum::<f64>().sqrt() as f32
}

/// Sum of squares, in parallel lanes.
#[inline]
fn squares(values: &[f32]) -> f64 {
    const LANES: usize = 16;
    let mut sums = [0.0; LANES];
    for chunk in values.chunks(LANES) {
        for (sum, &value) in sums.iter_mut().zip(chunk) {
            *sum += f64::from(value) * f64::from(value);
        }
    }
    sums.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three steps on the slopes 1, −2, 0.5 computed by hand from the paper's
    /// Algorithm 1.
    #[test]
    fn steps_are_those_of_the_algorithm() {
        let mut adam = Adam::new(1, 1e-8);
        let mut weight = [1.0];
        let (mut mean, mut square, mut expected) = (0.0_f64, 0.0_f64, 1.0_f64);
        for (step, slope) in [1.0_f64, -2.0, 0.5].into_iter().enumerate() {
            adam.step(&mut weight, &[slope as f32], 0.1);
            mean = 0.9 * mean + 0.1 * slope;
            square = 0.999 * square + 0.001 * slope * slope;
            let count = step as i32 + 1;
            let (m, v) =
                (mean / (1.0 - 0.9_f64.powi(count)), square / (1.0 - 0.999_f64.powi(count)));
            expected -= 0.1 * m / (v.sqrt() + 1e-8);
            assert!((f64::from(weight[0]) - expected).abs() < 1e-5, "{weight:?} {expected}");
        }
    }

    #[test]
    fn only_long_gradients_are_clipped() {
        let mut gradient = [3.0, 4.0];
        assert!((clip_gradient(&mut gradient, 10.0) - 5.0).abs() < 1e-6);
        assert_eq!(gradient.map(f32::to_bits), [3.0_f32, 4.0].map(f32::to_bits));
        clip_gradient(&mut gradient, 1.0);
        assert!((gradient[0] - 0.6).abs() < 1e-6 && (gradient[1] - 0.8).abs() < 1e-6);
    }

    #[test]
    fn a_clipped_step_is_a_step_on_the_clipped_gradient() {
        let gradient: Vec<f32> = (0..100).map(|k| (k as f32).sin()).collect();
        for largest in [0.5, 100.0] {
            let (mut one, mut other) = (Adam::new(100, 1e-5), Adam::new(100, 1e-5));
            let (mut a, mut b) = (vec![0.0; 100], vec![0.0; 100]);
            for _ in 0..3 {
                let norm = one.step_clipped(&mut a, &gradient, largest, 0.1);
                let mut clipped = gradient.clone();
                assert!((clip_gradient(&mut clipped, largest) - norm).abs() < 1e-6);
                other.step(&mut b, &clipped, 0.1);
            }
            assert!(a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-6));
        }
    }
}
