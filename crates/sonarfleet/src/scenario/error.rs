//! What can be wrong with a scenario.

use std::path::PathBuf;
use thiserror::Error;

/// Why a scenario cannot be used. `origin` is its path, or "embedded scenario".
#[derive(Debug, Error)]
pub enum ScenarioError {
    /// The file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Not TOML, an unknown key, or a value of the wrong type.
    #[error("{origin}: {message}")]
    Parse {
        /// The scenario.
        origin: String,
        /// The parser's message, with line, caret and the valid keys.
        message: String,
    },
    /// A number outside its range, often one in a wrong unit.
    #[error("{origin}: `{key}` is {found}, expected {expected}")]
    Value {
        /// The scenario.
        origin: String,
        /// Full key, e.g. `fleet.speed_m_s`.
        key: &'static str,
        /// What was found.
        found: String,
        /// What was expected, with its unit.
        expected: String,
    },
    /// A file named in the scenario does not hold what it should.
    #[error("{origin}: `{key}` names {}: {reason}", path.display())]
    File {
        /// The scenario.
        origin: String,
        /// Full key.
        key: &'static str,
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
}
