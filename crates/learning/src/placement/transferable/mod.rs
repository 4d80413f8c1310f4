//! One policy for any prior, ocean, fleet and grid: it sees candidates described by
//! features that do not depend on the grid, and needs no training on the problem.

mod construction;
mod decoding;
mod episode;
mod imitation;
mod landscape;
mod network;
mod observation;
mod policy;
mod reinforcement;
mod revision;
mod spectrum;
mod training;
mod update;
mod weights;

pub use decoding::{Decoding, Sample};
pub use network::{HIDDEN, Network, WEIGHTS};
pub use observation::{CANDIDATES, FEATURES};
pub use policy::TransferablePolicy;
pub use training::{Practice, Progress, School, Training, TrainingSettings};
pub use weights::KIND;
