//! Proximal policy optimisation with action masks, for networks with and without
//! memory. Settings and logs have the names that CleanRL gave them.

mod advantage;
mod environment;
mod gradient;
#[cfg(test)]
mod gradient_tests;
mod loss;
mod rollout;
mod settings;
mod surrogate;
mod trainer;

pub use advantage::generalised_advantages;
pub use environment::{Environment, Episode, Progress, Transition};
pub use loss::Losses;
pub use settings::{BadSettings, PpoSettings};
pub(crate) use surrogate::clipped_surrogate;
pub use trainer::{Trainer, TrainerState, Update};
