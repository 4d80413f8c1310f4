//! Checkpoints: what a killed run needs to continue and end bit-identical.

use super::{EpochRecord, RecordError};
use crate::grid::Position;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// State of a run between two epochs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Fingerprint of scenario, seed, inputs and program version.
    pub fingerprint: String,
    /// Where the vehicles are.
    pub fleet: Vec<Position>,
    /// The epochs that are done.
    pub epochs: Vec<EpochRecord>,
}

impl Checkpoint {
    const FILE: &str = "checkpoint.bin";

    /// Writes the checkpoint into a run directory, atomically.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn save(&self, directory: &Path) -> Result<(), RecordError> {
        let path = directory.join(Self::FILE);
        let bytes = postcard::to_stdvec(self).map_err(|error| RecordError::Checkpoint {
            path: path.clone(),
            reason: error.to_string(),
        })?;
        crate::replace_file(&path, &bytes).map_err(RecordError::io(path))
    }

    /// Whether a run directory holds a checkpoint.
    pub fn exists(directory: &Path) -> bool {
        directory.join(Self::FILE).exists()
    }

    /// Reads the checkpoint of an unfinished run; none if it had not finished an epoch.
    ///
    /// # Errors
    /// If the file cannot be read, or belongs to a run with another fingerprint.
    pub fn load(directory: &Path, fingerprint: &str) -> Result<Option<Self>, RecordError> {
        let path = directory.join(Self::FILE);
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(RecordError::Io { path, source }),
        };
        let checkpoint: Self = postcard::from_bytes(&bytes).map_err(|error| {
            RecordError::Checkpoint { path: path.clone(), reason: error.to_string() }
        })?;
        if checkpoint.fingerprint == fingerprint {
            Ok(Some(checkpoint))
        } else {
            let expected = fingerprint.to_owned();
            Err(RecordError::OtherRun { path, found: checkpoint.fingerprint, expected })
        }
    }

    /// Removes the checkpoint of a finished run.
    ///
    /// # Errors
    /// If the file is there and cannot be removed.
    pub fn remove(directory: &Path) -> Result<(), RecordError> {
        let path = directory.join(Self::FILE);
        match std::fs::remove_file(&path) {
            Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
                Err(RecordError::Io { path, source })
            }
            _ => Ok(()),
        }
    }
}
