use crate::grid::CellId;
use crate::npz::NpzError;
use sonarfleet_ocean::OceanError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a table's file cannot be used.
#[derive(Debug, Error)]
pub enum LossFileError {
    /// Not a readable or writable NetCDF file.
    #[error(transparent)]
    NetCdf(#[from] OceanError),
    /// Not a readable or writable NumPy archive.
    #[error(transparent)]
    Npz(#[from] NpzError),
    /// Neither.
    #[error("{}: unknown format, expected a name that ends in .nc or .npz", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file does not hold a table, or not this one.
    #[error("{}: {what} is {found}, expected {expected}", path.display())]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// The quantity.
        what: &'static str,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// Parts that belong to different tables.
    #[error(
        "{} and {} are parts of different tables: {what} is {found} in the second, {expected} in \
         the first",
        first.display(),
        path.display()
    )]
    OtherTable {
        /// A part.
        first: PathBuf,
        /// The part that does not go with it.
        path: PathBuf,
        /// The first thing in which they differ.
        what: &'static str,
        /// What the second part says.
        found: String,
        /// What the first part says.
        expected: String,
    },
    /// Parts that overlap.
    #[error(
        "{} and {} overlap: both hold the row of source cell {}",
        first.display(),
        second.display(),
        cell.0
    )]
    Overlap {
        /// A part.
        first: PathBuf,
        /// A part with a row that the first has too (or twice).
        second: PathBuf,
        /// The first source that occurs twice.
        cell: CellId,
    },
    /// Parts that leave gaps.
    #[error(
        "the parts leave a gap: {missing} of {cells} rows are in none of them, the first is that \
         of source cell {}",
        cell.0
    )]
    Gap {
        /// Rows that are missing.
        missing: usize,
        /// Rows of the whole table.
        cells: usize,
        /// The first source without a row.
        cell: CellId,
    },
}
