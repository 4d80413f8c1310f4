//! What can be wrong with a file of training.

use std::collections::BTreeMap;
use std::path::PathBuf;
use thiserror::Error;

/// Why a file of training cannot be written or read.
#[derive(Debug, Error)]
pub enum FileError {
    /// The file system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is something else altogether.
    #[error("{}: not {expected}: it begins with {found:?}", path.display())]
    NotSuchAFile {
        /// The file.
        path: PathBuf,
        /// Its first bytes, as text.
        found: String,
        /// What the file should hold.
        expected: &'static str,
    },
    /// The container has another layout.
    #[error("{}: layout {found}, expected layout {expected}", path.display())]
    OtherLayout {
        /// The file.
        path: PathBuf,
        /// Layout of the file.
        found: u32,
        /// The layout that this program writes.
        expected: u32,
    },
    /// The file ends too early.
    #[error("{}: ends after {found} bytes, expected {expected}", path.display())]
    Truncated {
        /// The file.
        path: PathBuf,
        /// Length of the file, bytes.
        found: u64,
        /// Length it should have (at least, where its header is cut), bytes.
        expected: u64,
    },
    /// The file is damaged, or something was appended to it.
    #[error("{}: damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The file holds the state of something else.
    #[error("{}: holds `{found}`, expected `{expected}`", path.display())]
    OtherKind {
        /// The file.
        path: PathBuf,
        /// What it holds.
        found: String,
        /// What was asked for.
        expected: String,
    },
    /// The weights are of a network of other sizes.
    #[error("{}: of a network with {}, expected {}", path.display(), listed(found), listed(expected))]
    OtherSizes {
        /// The file.
        path: PathBuf,
        /// Sizes by name, as found.
        found: BTreeMap<String, usize>,
        /// Sizes by name, as expected.
        expected: BTreeMap<String, usize>,
    },
    /// The file was written by another version of the program.
    #[error(
        "{}: written by version {found}, this is version {expected}; start anew", path.display()
    )]
    OtherVersion {
        /// The file.
        path: PathBuf,
        /// Version that wrote it.
        found: String,
        /// Version of this program.
        expected: String,
    },
    /// The state is not one that the container can hold.
    #[error("{}: cannot be written: {reason}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A line is not what training writes.
    #[error("{}:{line}: {reason}", path.display())]
    BadLine {
        /// The file.
        path: PathBuf,
        /// Number of the line, from 1.
        line: usize,
        /// What is wrong with it.
        reason: String,
    },
}

impl FileError {
    /// Names the file in a file-system error.
    pub(crate) fn io(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        |source| Self::Io { path, source }
    }
}

fn listed(sizes: &BTreeMap<String, usize>) -> String {
    let terms: Vec<String> = sizes.iter().map(|(name, size)| format!("{size} {name}")).collect();
    terms.join(", ")
}
