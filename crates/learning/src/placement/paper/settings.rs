//! Settings of the paper's placement policies, the paper's and ours.

use crate::network::Mlp;
use crate::ppo::PpoSettings;
use serde::{Deserialize, Serialize};
use sonarfleet::placement::PlacementProblem;
use sonarfleet::placement::mdp::{LinkMask, SequentialMdp};

/// Settings of the paper's placement policies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PaperSettings {
    /// The optimiser's.
    pub ppo: PpoSettings,
    /// Units of the hidden layers.
    pub hidden: Vec<usize>,
    /// Episodes at the start that are rewarded without the constraint.
    pub warm_up_episodes: u64,
    /// Multiplier λ₀ of the shortfall τ − λ₂ at the start.
    pub initial_multiplier: f64,
    /// Step η of the multiplier's dual ascent, Equation (11), once per rollout with the
    /// mean λ₂ of the layouts that it ended with.
    pub multiplier_step: f64,
    /// Weight of `J_d` in the reward at the start; it rises linearly to 1 over the
    /// first half of the training.
    pub initial_detection_weight: f64,
    /// Weight of ln(τ/λ₂)₊ in the reward.
    pub log_shortfall_weight: f64,
    /// A narrower mask for the sequential process.
    pub link_mask: Option<LinkMask>,
    /// Factor of the reward that the optimiser sees.
    pub reward_scale: f64,
}

impl PaperSettings {
    /// The paper's, literally: Table 1 and section 3.3. The reward has the size of
    /// `J_d`, about 36, so that at first the value's gradient fills the gradient norm.
    pub fn paper() -> Self {
        Self {
            ppo: PpoSettings::paper_placement(),
            hidden: vec![256, 256],
            warm_up_episodes: 50,          // half a rollout
            initial_multiplier: 5.0,       // λ₀
            multiplier_step: 0.5,          // η
            initial_detection_weight: 1.0, // Eq. (10)
            log_shortfall_weight: 0.0,     // Eq. (10)
            link_mask: None,               // occupied cells only
            reward_scale: 1.0,             // Eq. (10)
        }
    }

    /// Ours, for the same network: whole episodes in a rollout, advantages without
    /// bootstrapping (the reward comes at the end, where the value lags behind), more
    /// entropy at first and none at last; and what makes λ₂ learnable where most layouts
    /// are disconnected: a narrower mask, a logarithmic term, and `J_d` that comes in
    /// later.
    pub fn ours() -> Self {
        Self {
            ppo: PpoSettings {
                num_envs: 64,
                num_steps: 40,
                minibatch_size: 640,
                update_epochs: 4,
                learning_rate: 1e-3,
                final_learning_rate: 1e-4,
                gamma: 1.0,
                gae_lambda: 1.0,
                ent_coef: 0.03,
                final_ent_coef: 0.0,
                ..PpoSettings::paper_placement()
            },
            warm_up_episodes: 0,
            initial_multiplier: 30.0,
            multiplier_step: 0.5,
            initial_detection_weight: 0.2,
            log_shortfall_weight: 3.0,
            link_mask: Some(LinkMask { degree: 2.5, share: 0.8 }),
            reward_scale: 0.2,
            ..Self::paper()
        }
    }

    /// The sequential process under these settings.
    pub fn sequential_mdp<'p>(&self, problem: &'p PlacementProblem) -> SequentialMdp<'p> {
        let mut mdp = SequentialMdp::new(problem);
        mdp.link_mask = self.link_mask;
        mdp
    }

    /// The network for so many cells.
    pub fn network(&self, cells: usize) -> Mlp {
        Mlp { inputs: cells, hidden: self.hidden.clone(), actions: cells }
    }
}
