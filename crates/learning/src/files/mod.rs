//! The files that training writes: checkpoints, shipped weights, networks as ONNX,
//! and what training was like (`metrics.jsonl`, TensorBoard).

pub mod checkpoint;
mod error;
mod half;
pub mod metrics;
pub mod onnx;
mod protobuf;
pub mod tensorboard;
pub mod weights;

pub use error::FileError;
pub use metrics::TrainingLog;
pub use weights::{Precision, Weights};

use std::path::Path;

/// Writes a file that is either whole or not there; the folders above it are made.
///
/// # Errors
/// [`FileError::Io`] where the file or a folder cannot be written.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(FileError::io(folder))?;
    }
    sonarfleet::replace_file(path, contents).map_err(FileError::io(path))
}
