//! Integration tests of the ocean crate: files in, files out.

mod damage;
mod dialects;
mod errors;
mod properties;
mod round_trip;

use std::path::PathBuf;

/// A file of the committed dialects.
fn dialect(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/dialects").join(file)
}
