//! Masked categorical distributions over actions.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for wide vectors"
)]

use super::vector::{dot, exp, largest, sum, wide};
use rand::Rng;
use sonarfleet::random::Stream;

/// Logit of an action that is not allowed: its probability is 0 in single precision.
pub const MASKED_LOGIT: f32 = -1e6;

/// A distribution over the allowed actions.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Categorical {
    /// Log-probabilities; of those that are not allowed, about [`MASKED_LOGIT`].
    log_probabilities: Vec<f32>,
    probabilities: Vec<f32>,
}

impl Categorical {
    /// Replaces the distribution by the softmax of the logits of allowed actions, of
    /// which there must be one at least.
    pub fn fill(&mut self, logits: &[f32], mask: &[bool]) {
        self.log_probabilities.clear();
        self.log_probabilities.extend_from_slice(logits);
        self.probabilities.resize(logits.len(), 0.0);
        wide(|| {
            let z = &mut self.log_probabilities[..];
            apply_mask(z, mask);
            let most = largest(z);
            for (probability, z) in self.probabilities.iter_mut().zip(z.iter_mut()) {
                *z -= most;
                *probability = exp(*z);
            }
            let total = sum(&self.probabilities);
            let (scale, log_total) = (1.0 / total, total.ln());
            for (probability, z) in self.probabilities.iter_mut().zip(z) {
                *probability *= scale;
                *z -= log_total;
            }
        });
    }

    /// Probabilities of all actions.
    pub fn probabilities(&self) -> &[f32] {
        &self.probabilities
    }

    /// Logarithm of an action's probability.
    pub fn log_probability(&self, action: usize) -> f32 {
        self.log_probabilities[action]
    }

    /// Entropy, in nats, of the allowed actions.
    pub fn entropy(&self) -> f32 {
        -wide(|| dot(&self.probabilities, &self.log_probabilities))
    }

    /// An action drawn at random; never one of probability 0.
    pub fn sample(&self, random: &mut Stream) -> usize {
        let mut left = random.random::<f32>() * wide(|| sum(&self.probabilities));
        let mut last = 0;
        for (action, &probability) in self.probabilities.iter().enumerate() {
            if probability > 0.0 {
                last = action;
                left -= probability;
                if left < 0.0 {
                    break;
                }
            }
        }
        last
    }

    /// The most probable action, the first of them.
    pub fn mode(&self) -> usize {
        let most = wide(|| largest(&self.probabilities));
        self.probabilities.iter().position(|&probability| probability >= most).unwrap_or(0)
    }
}

#[inline(always)]
pub(crate) fn apply_mask(logits: &mut [f32], mask: &[bool]) {
    for (logit, &allowed) in logits.iter_mut().zip(mask) {
        *logit = if allowed { *logit } else { MASKED_LOGIT };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sonarfleet::random::stream;

    fn example() -> (Categorical, Vec<bool>) {
        let logits: Vec<f32> = (0..50).map(|k| (k as f32 * 0.7).sin() * 3.0).collect();
        let mask: Vec<bool> = (0..50).map(|k| k % 3 != 0).collect();
        let mut categorical = Categorical::default();
        categorical.fill(&logits, &mask);
        (categorical, mask)
    }

    #[test]
    fn masked_actions_have_probability_0_and_the_others_sum_to_1() {
        let (categorical, mask) = example();
        for (&probability, &allowed) in categorical.probabilities().iter().zip(&mask) {
            assert_eq!(probability > 0.0, allowed);
        }
        let total: f32 = categorical.probabilities().iter().sum();
        assert!((total - 1.0).abs() < 1e-6);
    }

    #[test]
    fn entropy_and_log_probabilities_agree_with_the_probabilities() {
        let (categorical, mask) = example();
        let mut entropy = 0.0;
        for (action, &probability) in categorical.probabilities().iter().enumerate() {
            if mask[action] {
                assert!((categorical.log_probability(action) - probability.ln()).abs() < 1e-5);
                entropy -= f64::from(probability) * f64::from(probability).ln();
            }
        }
        assert!((f64::from(categorical.entropy()) - entropy).abs() < 1e-5);
    }

    /// Frequencies of 100,000 draws lie within five standard deviations.
    #[test]
    fn samples_follow_the_probabilities() {
        let (categorical, _) = example();
        let mut random = stream(3, "test/categorical", 0);
        let draws = 100_000;
        let mut counts = vec![0_u32; 50];
        for _ in 0..draws {
            counts[categorical.sample(&mut random)] += 1;
        }
        for (count, &p) in counts.into_iter().zip(categorical.probabilities()) {
            let (expected, p) = (f64::from(p) * f64::from(draws), f64::from(p));
            let deviation = (expected * (1.0 - p)).sqrt();
            assert!((f64::from(count) - expected).abs() <= 5.0 * deviation);
        }
    }

    #[test]
    fn the_mode_is_allowed_even_where_all_logits_are_tiny() {
        let mut categorical = Categorical::default();
        categorical.fill(&[5.0, -900.0, -901.0], &[false, true, true]);
        assert_eq!(categorical.mode(), 1);
        assert!(categorical.probabilities()[0].to_bits() == 0);
    }
}
