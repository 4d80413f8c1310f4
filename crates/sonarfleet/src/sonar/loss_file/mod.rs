//! Transmission-loss tables in files: whole ones and shards of them, `.nc` or `.npz`.

mod description;
mod error;
mod merge;
mod read;
mod rows;

pub use description::LossDescription;
pub use error::LossFileError;
pub use read::{read_rows, read_table};
pub use rows::LossRows;

use std::path::Path;

fn extension(path: &Path) -> &str {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default()
}
