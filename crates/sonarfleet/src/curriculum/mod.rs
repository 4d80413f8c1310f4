//! Practice problems for learning placement: oceans by chance with the transmission loss
//! that our own acoustics gives them, and placement problems drawn from their tables.

mod chance;
mod climate;
mod error;
mod exclusions;
mod levels;
mod loss_curve;
mod priors;
mod problem;
mod store;
mod symmetry;
mod training_ocean;
mod variation;

pub use error::CurriculumError;
pub use loss_curve::LossCurve;
pub use problem::practice_problem;
pub use store::{OceanStore, PracticeTable};
pub use symmetry::Symmetry;
pub use training_ocean::{TrainingOcean, practice_numerics};
