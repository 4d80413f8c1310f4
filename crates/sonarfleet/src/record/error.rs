//! What can go wrong when a run is written down.

use std::path::PathBuf;
use thiserror::Error;

/// Why a record cannot be written or read.
#[derive(Debug, Error)]
pub enum RecordError {
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The run directory is there already.
    #[error("{}: exists already; choose another output directory", path.display())]
    Exists {
        /// The directory.
        path: PathBuf,
    },
    /// A run that was stopped is in the way.
    #[error(
        "{}: an unfinished run is there; continue it with --resume, or remove it",
        path.display()
    )]
    Unfinished {
        /// The directory of the unfinished run.
        path: PathBuf,
    },
    /// There is nothing to resume.
    #[error("{}: no unfinished run to resume", path.display())]
    NothingToResume {
        /// Where the unfinished run would be.
        path: PathBuf,
    },
    /// The unfinished run belongs to something else.
    #[error(
        "{}: the unfinished run was started with other inputs ({found}) than this one ({expected})",
        path.display()
    )]
    OtherRun {
        /// The checkpoint.
        path: PathBuf,
        /// Fingerprint in the checkpoint.
        found: String,
        /// Fingerprint of the present scenario, seed, inputs and program version.
        expected: String,
    },
    /// The checkpoint cannot be understood.
    #[error("{}: not a checkpoint of this version: {reason}", path.display())]
    Checkpoint {
        /// The checkpoint.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A NetCDF file cannot be written.
    #[error(transparent)]
    NetCdf(#[from] sonarfleet_ocean::OceanError),
}

impl RecordError {
    /// Names the file in a file-system error.
    pub(crate) fn io(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        |source| Self::Io { path, source }
    }
}
