//! Where a run comes from: the resolved scenario, the seed, and the inputs' hashes.

use super::RecordError;
use crate::fingerprint::hexadecimal;
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::path::PathBuf;

/// What a run was made of.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: &'static str,
    /// Seed of all randomness.
    pub seed: u64,
    /// The resolved scenario, TOML.
    #[serde(skip)]
    pub scenario: String,
    /// Every input file.
    pub inputs: Vec<InputFile>,
    /// SHA-256 over version, scenario and inputs.
    pub fingerprint: String,
}

/// An input file and its hash.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InputFile {
    /// The file.
    pub path: PathBuf,
    /// SHA-256 of its contents, hexadecimal.
    pub sha256: String,
}

impl Provenance {
    /// Hashes a resolved scenario and the files it reads.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn new(scenario: String, seed: u64, files: Vec<PathBuf>) -> Result<Self, RecordError> {
        let version = env!("CARGO_PKG_VERSION");
        let mut all = Sha256::new();
        all.update(version);
        all.update(&scenario);
        let mut inputs = Vec::with_capacity(files.len());
        for path in files {
            let contents = std::fs::read(&path).map_err(RecordError::io(&path))?;
            let sha256 = hexadecimal(&Sha256::digest(contents));
            all.update(&sha256);
            inputs.push(InputFile { path, sha256 });
        }
        let fingerprint = hexadecimal(&all.finalize());
        Ok(Self { version, seed, scenario, inputs, fingerprint })
    }
}
