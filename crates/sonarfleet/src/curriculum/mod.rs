//! Practice problems for learning placement: oceans by chance with the transmission loss
//! that our own acoustics gives them, and placement problems drawn from their tables.

mod chance;
mod climate;
mod error;
mod store;
mod training_ocean;

pub use error::CurriculumError;
pub use store::{OceanStore, PracticeTable};
pub use training_ocean::{TrainingOcean, practice_numerics};
