//! Gradient descent.

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
        assert_eq!(weights.len(), self.mean.len(), "one moment per weight");
        assert_eq!(gradient.len(), self.mean.len(), "one gradient per weight");
        self.steps += 1;
        let correction = |beta: f32| 1.0 - f64::from(beta).powf(self.steps as f64);
        let mean_correction = correction(self.beta1) as f32;
        let square_correction = correction(self.beta2) as f32;
        let moments = self.mean.iter_mut().zip(self.square.iter_mut());
        for ((weight, &slope), (mean, square)) in weights.iter_mut().zip(gradient).zip(moments) {
            *mean = self.beta1 * *mean + (1.0 - self.beta1) * slope;
            *square = self.beta2 * *square + (1.0 - self.beta2) * slope * slope;
            let spread = (*square / square_correction).sqrt() + self.epsilon;
            *weight -= learning_rate * (*mean / mean_correction) / spread;
        }
    }
}

/// Scales a gradient so that its Euclidean norm is at most `largest`; gives the norm
/// it had.
pub fn clip_gradient(gradient: &mut [f32], largest: f32) -> f32 {
    let squares: f64 = gradient.iter().map(|&slope| f64::from(slope) * f64::from(slope)).sum();
    let norm = squares.sqrt() as f32;
    if norm > largest {
        let scale = largest / norm;
        for slope in gradient {
            *slope *= scale;
        }
    }
    norm
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
        assert_eq!(gradient, [3.0, 4.0]);
        clip_gradient(&mut gradient, 1.0);
        assert!((gradient[0] - 0.6).abs() < 1e-6 && (gradient[1] - 0.8).abs() < 1e-6);
    }
}
