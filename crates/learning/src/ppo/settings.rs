//! Settings, by the names of CleanRL.

use serde::{Deserialize, Serialize};

/// Settings of proximal policy optimisation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PpoSettings {
    /// Environments that run side by side.
    pub num_envs: usize,
    /// Steps of each environment in a rollout; a multiple of `sequence_length`.
    pub num_steps: usize,
    /// Steps that stay together in a minibatch, for networks with memory; else 1.
    pub sequence_length: usize,
    /// Steps in a minibatch; at least one sequence.
    pub minibatch_size: usize,
    /// Times that each rollout is gone through.
    pub update_epochs: usize,
    /// Adam's step at the start.
    pub learning_rate: f32,
    /// Adam's step at the end, to which it falls linearly.
    pub final_learning_rate: f32,
    /// What keeps Adam's division finite.
    pub adam_epsilon: f32,
    /// Discount γ.
    pub gamma: f32,
    /// Decay λ of generalised advantage estimation.
    pub gae_lambda: f32,
    /// Clip range ε of the ratio.
    pub clip_coef: f32,
    /// Whether the value's change is clipped too, to the same range.
    pub clip_vloss: bool,
    /// Whether advantages are standardised in each minibatch.
    pub norm_adv: bool,
    /// Weight of the entropy at the start.
    pub ent_coef: f32,
    /// Weight of the entropy at the end, to which it changes linearly.
    pub final_ent_coef: f32,
    /// Weight of half the mean squared error of the value.
    pub vf_coef: f32,
    /// Largest Euclidean norm of a gradient.
    pub max_grad_norm: f32,
    /// Approximate KL divergence of an epoch's last minibatch above which the rollout's
    /// further epochs are left out; none: never.
    pub target_kl: Option<f32>,
}

impl PpoSettings {
    /// Table 1 of the paper for placement: rollouts of 4096 steps, 10 epochs of
    /// minibatches of 512, γ 0.99. What the table leaves open is as in CleanRL; the
    /// rollout is divided among 16 environments.
    pub const fn paper_placement() -> Self {
        Self {
            num_envs: 16,              // ours
            num_steps: 256,            // 16 · 256 = 4096, Table 1
            sequence_length: 1,        // no memory
            minibatch_size: 512,       // Table 1
            update_epochs: 10,         // Table 1
            learning_rate: 3e-4,       // Table 1
            final_learning_rate: 3e-4, // no schedule is given
            adam_epsilon: 1e-5,        // CleanRL
            gamma: 0.99,               // Table 1 (1 in the text)
            gae_lambda: 0.95,          // Table 1
            clip_coef: 0.2,            // Table 1
            clip_vloss: false,         // Algorithm 1: a plain squared error
            norm_adv: true,            // CleanRL
            ent_coef: 0.01,            // Table 1
            final_ent_coef: 0.01,      // no schedule is given
            vf_coef: 0.5,              // Table 1
            max_grad_norm: 0.5,        // CleanRL
            target_kl: None,           // none is given
        }
    }

    /// Table 1 of the paper for navigation: rollouts of 256 steps in sequences of 256,
    /// 10 epochs of minibatches of 512, γ 0.995. A minibatch of 512 takes two
    /// sequences, so eight environments fill four minibatches.
    pub const fn paper_navigation() -> Self {
        Self {
            num_envs: 8,          // ours: 256 steps of one would not fill a minibatch
            num_steps: 256,       // Table 1
            sequence_length: 256, // Table 1
            gamma: 0.995,         // Table 1
            ..Self::paper_placement()
        }
    }

    /// Steps in a rollout.
    pub const fn rollout_size(&self) -> usize {
        self.num_envs * self.num_steps
    }

    /// Learning rate and weight of the entropy when a share of the training is done.
    pub(super) fn scheduled(&self, progress: f64) -> (f32, f32) {
        let at = |start: f32, end: f32| start + (end - start) * progress.clamp(0.0, 1.0) as f32;
        (at(self.learning_rate, self.final_learning_rate), at(self.ent_coef, self.final_ent_coef))
    }

    /// Checks what the trainer relies on.
    ///
    /// # Errors
    /// Where a count is 0, sequences do not divide a rollout, or a minibatch holds none.
    pub fn check(&self) -> Result<(), BadSettings> {
        for (name, found) in [
            ("num_envs", self.num_envs),
            ("num_steps", self.num_steps),
            ("sequence_length", self.sequence_length),
            ("update_epochs", self.update_epochs),
        ] {
            if found == 0 {
                return Err(BadSettings { name, found, expected: "at least 1" });
            }
        }
        if !self.num_steps.is_multiple_of(self.sequence_length) {
            let (name, found) = ("sequence_length", self.sequence_length);
            return Err(BadSettings { name, found, expected: "a divisor of `num_steps`" });
        }
        if self.minibatch_size < self.sequence_length {
            let (name, found) = ("minibatch_size", self.minibatch_size);
            return Err(BadSettings { name, found, expected: "at least `sequence_length`" });
        }
        Ok(())
    }
}

/// A setting that makes no sense.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{name}` is {found}, expected {expected}")]
pub struct BadSettings {
    /// The setting.
    pub name: &'static str,
    /// Its value.
    pub found: usize,
    /// What it should be.
    pub expected: &'static str,
}
