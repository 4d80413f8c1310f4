//! What can be wrong with ocean input.

use jiff::Timestamp;
use std::path::PathBuf;

/// What can be wrong with ocean input.
#[derive(Debug, thiserror::Error)]
pub enum OceanError {
    /// There is no state at all.
    #[error("no time steps in {}", list(files))]
    NoTimeSteps {
        /// The files looked in.
        files: Vec<PathBuf>,
    },
    /// A time before the first or after the last state.
    #[error("no ocean state for {asked}: the data span {start} to {end}")]
    TimeOutsideData {
        /// The time asked for.
        asked: Timestamp,
        /// First time of the data.
        start: Timestamp,
        /// Last time of the data.
        end: Timestamp,
    },
}

fn list(files: &[PathBuf]) -> String {
    if files.is_empty() {
        return "the forecast".to_owned();
    }
    files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>().join(", ")
}
