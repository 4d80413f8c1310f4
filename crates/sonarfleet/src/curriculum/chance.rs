//! Numbers by chance, drawn from a stream.

use crate::random::Stream;
use rand::Rng;
use std::f64::consts::{PI, TAU};

/// Uniform between two numbers.
pub(super) fn between(random: &mut Stream, low: f64, high: f64) -> f64 {
    low + (high - low) * random.random::<f64>()
}

/// Uniform in the logarithm between two positive numbers.
pub(super) fn log_between(random: &mut Stream, low: f64, high: f64) -> f64 {
    low * (high / low).powf(random.random())
}

/// Uniform in (−π, π].
pub(super) fn direction_rad(random: &mut Stream) -> f64 {
    PI - TAU * random.random::<f64>()
}

/// True with a probability.
pub(super) fn happens(random: &mut Stream, probability: f64) -> bool {
    random.random::<f64>() < probability
}

/// One of the values, each with its share of the weights.
pub(super) fn weighted<T: Copy>(random: &mut Stream, choices: &[(f64, T)]) -> T {
    let total: f64 = choices.iter().map(|(weight, _)| weight).sum();
    let mut left = total * random.random::<f64>();
    for &(weight, choice) in choices {
        left -= weight;
        if left < 0.0 {
            return choice;
        }
    }
    choices[choices.len() - 1].1
}

/// Standard normal (Box & Muller 1958, doi:10.1214/aoms/1177706645).
pub(super) fn normal(random: &mut Stream) -> f64 {
    // 1 − u lies in (0, 1].
    let radius = (-2.0 * (1.0 - random.random::<f64>()).ln()).sqrt();
    radius * (TAU * random.random::<f64>()).cos()
}

/// Gamma with mean 1 and a shape of at least 1 (Marsaglia & Tsang 2000,
/// doi:10.1145/358407.358414).
pub(super) fn gamma(random: &mut Stream, shape: f64) -> f64 {
    let d = shape - 1.0 / 3.0;
    let c = (9.0 * d).sqrt().recip();
    loop {
        let x = normal(random);
        let v = (1.0 + c * x).powi(3);
        let u = 1.0 - random.random::<f64>();
        if v > 0.0 && u.ln() < 0.5 * x * x + d * (1.0 - v + v.ln()) {
            return d * v / shape;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    /// Moments of 40 000 draws: four standard errors of the variance are below 0.06.
    #[test]
    fn gamma_has_its_moments() {
        const DRAWS: usize = 40_000;
        const TOLERANCE: f64 = 0.06;
        for (index, shape) in [1.5, 3.0, 6.0].into_iter().enumerate() {
            let mut random = stream(3, "test/gamma", index as u64);
            let values: Vec<f64> = (0..DRAWS).map(|_| gamma(&mut random, shape)).collect();
            let mean = values.iter().sum::<f64>() / DRAWS as f64;
            let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / DRAWS as f64;
            assert!((mean - 1.0).abs() < TOLERANCE, "shape {shape}: mean {mean}");
            assert!((variance * shape - 1.0).abs() < TOLERANCE, "shape {shape}: {variance}");
        }
    }

    #[test]
    fn choices_come_in_their_shares() {
        let mut random = stream(4, "test/weighted", 0);
        let choices = [(1.0, 'a'), (0.0, 'b'), (3.0, 'c')];
        let drawn: Vec<char> = (0..4000).map(|_| weighted(&mut random, &choices)).collect();
        let count = |letter| drawn.iter().filter(|&&c| c == letter).count();
        assert_eq!(count('b'), 0);
        assert!((900..1100).contains(&count('a')), "{}", count('a'));
    }
}
