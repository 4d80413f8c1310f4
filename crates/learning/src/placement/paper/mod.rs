//! The paper's placement policies: a fully connected network on the occupancy vector,
//! trained on one problem under a Lagrange multiplier for connectivity (section 3).

mod environment;
mod export;
mod policy;
mod settings;
mod solver;
mod trainer;

pub use environment::{EpisodeState, Layout};
pub use policy::PaperPolicy;
pub use settings::PaperSettings;
pub use solver::{Observer, PaperPpo, Process};
pub use trainer::{PlacementTrainer, PlacementTrainerState, PlacementUpdate};
