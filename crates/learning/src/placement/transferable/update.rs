//! Gradients of a loss over many observations.

use super::episode::Distribution;
use super::network::{Activations, Network, WEIGHTS};
use super::observation::{CANDIDATES, FEATURES, Observation};
use rayon::prelude::*;

/// An observation that is learned from, and what is to be learned.
#[derive(Debug, Clone)]
pub(super) struct Lesson {
    features: Box<[[f32; CANDIDATES]; FEATURES]>,
    count: usize,
    aim: Aim,
}

/// What is to be learned at an observation.
#[derive(Debug, Clone)]
pub(super) enum Aim {
    /// A distribution over candidates: cross entropy.
    Imitate(Vec<(usize, f32)>),
    /// The clipped surrogate of Eq. (12).
    Improve { candidate: usize, log_probability: f32, advantage: f32 },
}

impl Lesson {
    pub(super) fn new(observation: &Observation, aim: Aim) -> Self {
        let count = observation.cells.len();
        Self { features: observation.features.clone(), count, aim }
    }

    /// Sets the advantage of an [`Aim::Improve`].
    pub(super) fn credit(&mut self, earned: f32) {
        if let Aim::Improve { advantage, .. } = &mut self.aim {
            *advantage = earned;
        }
    }
}

/// Coefficients of the loss.
#[derive(Debug, Clone, Copy)]
pub(super) struct LossSettings {
    pub(super) clip_coef: f32,
    pub(super) entropy_coef: f32,
}

/// Means over a batch.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct LossSummary {
    pub(super) loss: f64,
    pub(super) entropy: f64,
    pub(super) approx_kl: f64,
    pub(super) clip_fraction: f64,
}

/// Lessons whose gradients are summed by one thread: fixed, so that the bits do not
/// depend on the number of threads.
const CHUNK: usize = 32;

/// Gradient of the mean loss over some lessons.
pub(super) fn gradient(
    network: &Network,
    lessons: &[&Lesson],
    settings: LossSettings,
) -> (Vec<f32>, LossSummary) {
    let share = 1.0 / lessons.len().max(1) as f32;
    let parts: Vec<(Vec<f32>, LossSummary)> = lessons
        .par_chunks(CHUNK)
        .map_init(Activations::default, |activations, lessons| {
            let mut gradient = vec![0.0; WEIGHTS];
            let mut summary = LossSummary::default();
            for lesson in lessons {
                network.forward(&lesson.features, lesson.count, activations);
                let choices = Distribution::new(&activations.logits[..lesson.count], 1.0);
                let mut slopes = slopes(lesson, &choices, settings, &mut summary);
                slopes.iter_mut().for_each(|slope| *slope *= share);
                let (features, count) = (&lesson.features, lesson.count);
                network.backward(features, count, activations, &slopes, &mut gradient);
            }
            (gradient, summary)
        })
        .collect();
    let mut total = vec![0.0; WEIGHTS];
    let mut summary = LossSummary::default();
    for (part, further) in parts {
        for (total, part) in total.iter_mut().zip(part) {
            *total += part;
        }
        summary.loss += further.loss * f64::from(share);
        summary.entropy += further.entropy * f64::from(share);
        summary.approx_kl += further.approx_kl * f64::from(share);
        summary.clip_fraction += further.clip_fraction * f64::from(share);
    }
    (total, summary)
}

/// Slopes of one lesson's loss along the logits.
fn slopes(
    lesson: &Lesson,
    choices: &Distribution,
    settings: LossSettings,
    summary: &mut LossSummary,
) -> [f32; CANDIDATES] {
    let mut slopes = [0.0; CANDIDATES];
    let entropy = choices.entropy();
    summary.entropy += f64::from(entropy);
    match &lesson.aim {
        Aim::Imitate(target) => {
            let mass: f32 = target.iter().map(|(_, share)| share).sum();
            for (slope, probability) in slopes.iter_mut().zip(&choices.probabilities) {
                *slope = mass * probability;
            }
            for &(candidate, share) in target {
                slopes[candidate] -= share;
                summary.loss -= f64::from(share * choices.logarithms[candidate]);
            }
        }
        &Aim::Improve { candidate, log_probability, advantage } => {
            let log_ratio = choices.logarithms[candidate] - log_probability;
            let ratio = log_ratio.exp();
            let SurrogateSlope { loss, along_log } =
                clipped_surrogate(ratio, advantage, settings.clip_coef);
            summary.loss += f64::from(loss);
            summary.approx_kl += f64::from(ratio - 1.0 - log_ratio);
            summary.clip_fraction += f64::from(u8::from((ratio - 1.0).abs() > settings.clip_coef));
            for (slope, probability) in slopes.iter_mut().zip(&choices.probabilities) {
                *slope = -along_log * probability;
            }
            slopes[candidate] += along_log;
        }
    }
    if settings.entropy_coef > 0.0 {
        // ∂H/∂logit = −p (ln p + H); the entropy is to grow.
        let terms = choices.probabilities.iter().zip(&choices.logarithms);
        for (slope, (probability, logarithm)) in slopes.iter_mut().zip(terms) {
            *slope += settings.entropy_coef * probability * (logarithm + entropy);
        }
    }
    slopes
}

struct SurrogateSlope {
    loss: f32,
    /// Slope along the logarithm of the probability.
    along_log: f32,
}

/// −min(rA, clip(r, 1 − ε, 1 + ε)A), the negative of Eq. (12)'s term.
fn clipped_surrogate(ratio: f32, advantage: f32, clip_coef: f32) -> SurrogateSlope {
    let clipped = ratio.clamp(1.0 - clip_coef, 1.0 + clip_coef);
    let (free, held) = (ratio * advantage, clipped * advantage);
    if free <= held {
        SurrogateSlope { loss: -free, along_log: -free }
    } else {
        SurrogateSlope { loss: -held, along_log: 0.0 }
    }
}
