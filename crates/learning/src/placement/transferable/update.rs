//! Gradients of a loss over many observations.

use super::episode::Distribution;
use super::network::{Activations, Network, WEIGHTS};
use super::observation::{CANDIDATES, FEATURES, Observation};
use crate::ppo::clipped_surrogate;
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
                for slope in &mut slopes {
                    *slope *= share;
                }
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
            let surrogate = clipped_surrogate(ratio, advantage, settings.clip_coef);
            summary.loss -= f64::from(surrogate.value);
            summary.approx_kl += f64::from(ratio - 1.0 - log_ratio);
            summary.clip_fraction += f64::from(u8::from((ratio - 1.0).abs() > settings.clip_coef));
            for (slope, probability) in slopes.iter_mut().zip(&choices.probabilities) {
                *slope = surrogate.slope * probability;
            }
            slopes[candidate] -= surrogate.slope;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::placement::transferable::episode::Distribution;
    use rand::Rng;
    use sonarfleet::random::stream;

    /// Single precision against central differences of the loss in it.
    const TOLERANCE: f32 = 5e-3;

    /// The loss of a lesson as it is written, from its logits.
    fn loss(logits: &[f32], aim: &Aim, settings: LossSettings) -> f32 {
        let choices = Distribution::new(logits, 1.0);
        let own = match aim {
            Aim::Imitate(target) => {
                -target.iter().map(|&(c, share)| share * choices.logarithms[c]).sum::<f32>()
            }
            &Aim::Improve { candidate, log_probability, advantage } => {
                let ratio = (choices.logarithms[candidate] - log_probability).exp();
                let clip = settings.clip_coef;
                -(ratio * advantage).min(ratio.clamp(1.0 - clip, 1.0 + clip) * advantage)
            }
        };
        own - settings.entropy_coef * choices.entropy()
    }

    #[test]
    fn slopes_are_those_of_the_loss() {
        let mut random = stream(5, "test/slopes", 0);
        let settings = LossSettings { clip_coef: 0.2, entropy_coef: 0.05 };
        let observation = Observation { cells: (0..40).collect(), ..Observation::default() };
        for case in 0..40 {
            let mut logits: Vec<f32> = (0..40).map(|_| random.random_range(-2.0..2.0)).collect();
            let choices = Distribution::new(&logits, 1.0);
            let candidate = random.random_range(0..40);
            // Ratios inside and outside of the clip range, away from its corners.
            let ratio: f32 = [0.5, 0.95, 1.05, 1.6][case % 4];
            let log_probability = choices.logarithms[candidate] - ratio.ln();
            let advantage = random.random_range(-2.0..2.0);
            let aim = if case < 20 {
                Aim::Improve { candidate, log_probability, advantage }
            } else {
                Aim::Imitate(vec![(candidate, 0.7), ((candidate + 1) % 40, 0.3)])
            };
            let lesson = Lesson::new(&observation, aim.clone());
            let found = slopes(&lesson, &choices, settings, &mut LossSummary::default());
            for at in 0..40 {
                const STEP: f32 = 1e-2;
                let middle = logits[at];
                logits[at] = middle + STEP;
                let above = loss(&logits, &aim, settings);
                logits[at] = middle - STEP;
                let below = loss(&logits, &aim, settings);
                logits[at] = middle;
                let expected = (above - below) / (2.0 * STEP);
                assert!((found[at] - expected).abs() < TOLERANCE, "{case}, {at}: {expected}");
            }
        }
    }
}
