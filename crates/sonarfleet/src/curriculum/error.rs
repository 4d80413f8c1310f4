//! Why there is nothing to practise on.

use crate::npz::NpzError;
use crate::sonar::SonarError;
use crate::sonar::section::WatersError;
use crate::sonar::transmission_loss::TransmissionLossError;
use std::path::PathBuf;

/// An ocean that cannot be computed or kept, or oceans without a problem in them.
#[derive(Debug, thiserror::Error)]
pub enum CurriculumError {
    /// The waters cannot be cut out of the ocean.
    #[error(transparent)]
    Waters(#[from] WatersError),
    /// The table cannot be computed.
    #[error(transparent)]
    Loss(#[from] TransmissionLossError),
    /// The directory of the store cannot be made.
    #[error("{}: {source}", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A table cannot be written.
    #[error(transparent)]
    File(#[from] NpzError),
    /// A drawn level or prior makes no sense; none is expected.
    #[error(transparent)]
    Sonar(#[from] SonarError),
    /// No draw gave a problem that a compact fleet can solve.
    #[error("problem {index} of seed {seed}: none of {attempts} draws has a connected disc")]
    NoProblem {
        /// The seed.
        seed: u64,
        /// Index of the problem.
        index: u64,
        /// How many draws were made.
        attempts: usize,
    },
}
