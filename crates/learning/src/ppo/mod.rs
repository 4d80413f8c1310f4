//! Proximal policy optimisation with action masks, for networks with and without
//! memory. Settings and logs have the names that CleanRL gave them.

mod advantage;
mod environment;
mod loss;
mod rollout;
mod settings;
mod trainer;

pub use advantage::generalised_advantages;
pub use environment::{Environment, Episode, Progress, Transition};
pub use loss::Losses;
pub use settings::{BadSettings, PpoSettings};
pub use trainer::{Trainer, TrainerState, Update};
