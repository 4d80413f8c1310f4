//! The clipped surrogate, with its gradient.
#![expect(
    clippy::inline_always,
    reason = "only what is inlined into the dispatched function is compiled for wide vectors"
)]

use super::settings::PpoSettings;
use super::surrogate::clipped_surrogate;
use crate::network::vector::{self, dot, exp, largest, wide};
use crate::network::{Output, apply_mask};
use rayon::prelude::*;

/// What the loss of a minibatch is computed from, [row].
#[derive(Debug, Clone, Default)]
pub(super) struct Targets {
    /// Allowed actions, [row, action].
    pub(super) mask: Vec<bool>,
    pub(super) actions: Vec<usize>,
    /// Log-probabilities of the actions when they were taken.
    pub(super) log_probabilities: Vec<f32>,
    pub(super) advantages: Vec<f32>,
    pub(super) returns: Vec<f32>,
    /// Values as they were estimated then.
    pub(super) values: Vec<f32>,
}

impl Targets {
    /// Keeps what was allocated.
    pub(super) fn clear(&mut self) {
        self.mask.clear();
        self.actions.clear();
        for values in
            [&mut self.log_probabilities, &mut self.advantages, &mut self.returns, &mut self.values]
        {
            values.clear();
        }
    }
}

/// Means over a minibatch.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Losses {
    /// −L of Equation (12).
    pub policy_loss: f64,
    /// Half the mean squared error of the value.
    pub value_loss: f64,
    /// Entropy of the policy, in nats.
    pub entropy: f64,
    /// (r − 1) − ln r, an estimate of the KL divergence from the old policy.
    pub approx_kl: f64,
    /// Share of rows whose ratio is outside the clip range.
    pub clip_fraction: f64,
    /// Euclidean norm of the gradient before it was clipped.
    pub gradient_norm: f64,
}

impl Losses {
    /// The mean of several.
    pub(super) fn mean(all: &[Self]) -> Self {
        Self::sum(all).scaled(1.0 / all.len().max(1) as f64)
    }

    /// The sum of several.
    pub(super) fn sum<'a>(all: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut sum = Self::default();
        for one in all {
            sum.policy_loss += one.policy_loss;
            sum.value_loss += one.value_loss;
            sum.entropy += one.entropy;
            sum.approx_kl += one.approx_kl;
            sum.clip_fraction += one.clip_fraction;
            sum.gradient_norm += one.gradient_norm;
        }
        sum
    }

    fn scaled(self, factor: f64) -> Self {
        Self {
            policy_loss: self.policy_loss * factor,
            value_loss: self.value_loss * factor,
            entropy: self.entropy * factor,
            approx_kl: self.approx_kl * factor,
            clip_fraction: self.clip_fraction * factor,
            gradient_norm: self.gradient_norm * factor,
        }
    }
}

/// Rows that one task takes, whatever the number of threads.
const ROWS_PER_TASK: usize = 64;

/// Turns a network's outputs into the gradient of
/// `policy_loss` − `ent_coef` · `entropy` + `vf_coef` · `value_loss`
/// in them, and gives what these rows add to the means of its parts. `share` is that of
/// one row in the minibatch.
pub(super) fn loss(
    settings: &PpoSettings,
    ent_coef: f32,
    share: f32,
    targets: &Targets,
    output: &mut Output,
) -> Losses {
    let actions = output.logits.len() / output.values.len();
    let parts: Vec<Losses> = output
        .logits
        .par_chunks_mut(ROWS_PER_TASK * actions)
        .zip(output.values.par_chunks_mut(ROWS_PER_TASK))
        .zip(targets.mask.par_chunks(ROWS_PER_TASK * actions))
        .enumerate()
        .map(|(task, ((logits, values), mask))| {
            let mut sum = Losses::default();
            let mut powers = vec![0.0; actions];
            let masked = logits.chunks_exact_mut(actions).zip(mask.chunks_exact(actions));
            for (((logits, mask), value), row) in masked.zip(values).zip(task * ROWS_PER_TASK..) {
                let action = Action {
                    index: targets.actions[row],
                    log_probability: targets.log_probabilities[row],
                    advantage: targets.advantages[row],
                };
                let clip_coef = settings.clip_coef;
                wide(|| {
                    apply_mask(logits, mask);
                    policy([clip_coef, ent_coef, share], &action, logits, &mut powers, &mut sum);
                });
                let old = settings.clip_vloss.then_some(targets.values[row]);
                let (half_square, slope) =
                    value_error(*value, targets.returns[row], old, clip_coef);
                sum.value_loss += f64::from(half_square);
                *value = settings.vf_coef * slope * share;
            }
            sum
        })
        .collect();
    Losses::sum(&parts).scaled(f64::from(share))
}

struct Action {
    index: usize,
    log_probability: f32,
    advantage: f32,
}

/// One row of Equation (12) and of the entropy; logits become the gradient in them,
/// times `share`. `powers` is room for their exponentials.
#[inline(always)]
fn policy(
    [clip_coef, ent_coef, share]: [f32; 3],
    action: &Action,
    logits: &mut [f32],
    powers: &mut [f32],
    sum: &mut Losses,
) {
    let most = largest(logits);
    for (power, logit) in powers.iter_mut().zip(logits.iter_mut()) {
        *logit -= most;
        *power = exp(*logit);
    }
    let total = vector::sum(powers);
    let log_total = total.ln();
    // H = −Σ p ln p, with ln p = z − ln Σ; a masked z times 0 is 0.
    let entropy = log_total - dot(powers, logits) / total;
    let log_ratio = logits[action.index] - log_total - action.log_probability;
    let ratio = log_ratio.exp();
    let surrogate = clipped_surrogate(ratio, action.advantage, clip_coef);
    let slope = -surrogate.slope * share;

    // ∂(−ln p(a))/∂z = p − 1(a); ∂(−H)/∂z = p (ln p + H).
    let entropy_slope = ent_coef * share;
    let offset = entropy_slope * (entropy - log_total) - slope;
    let normalise = 1.0 / total;
    for (logit, power) in logits.iter_mut().zip(powers.iter()) {
        *logit = power * normalise * (entropy_slope * *logit + offset);
    }
    logits[action.index] += slope;

    sum.policy_loss -= f64::from(surrogate.value);
    sum.entropy += f64::from(entropy);
    sum.approx_kl += f64::from(ratio) - 1.0 - f64::from(log_ratio);
    sum.clip_fraction += f64::from(u8::from((ratio - 1.0).abs() > clip_coef));
}

/// Half the squared error of a value and its slope; with an old value, of the worse of
/// the value and the value clipped to the old one's neighbourhood.
fn value_error(value: f32, target: f32, old: Option<f32>, clip_coef: f32) -> (f32, f32) {
    let error = value - target;
    let plain = (0.5 * error * error, error);
    let Some(old) = old else { return plain };
    let near = old + (value - old).clamp(-clip_coef, clip_coef);
    let bounded = 0.5 * (near - target) * (near - target);
    let inside = (value - old).abs() <= clip_coef;
    if bounded > plain.0 && !inside { (bounded, 0.0) } else { plain }
}
