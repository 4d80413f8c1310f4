//! What can go wrong in an assignment.

use crate::npz::NpzError;
use std::fmt;
use std::path::PathBuf;

/// Why there is no cost matrix or no assignment.
#[derive(Debug, thiserror::Error)]
pub enum AssignmentError {
    /// The matrix has no entry.
    #[error("the cost matrix is empty ({rows} × {columns})")]
    Empty {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
    },
    /// The number of values is not that of the matrix.
    #[error("a {rows} × {columns} cost matrix holds {} values, found {found}", rows * columns)]
    WrongLength {
        /// Number of rows.
        rows: usize,
        /// Number of columns.
        columns: usize,
        /// Number of values.
        found: usize,
    },
    /// An entry is no cost.
    #[error("cost in row {row}, column {column} (from 0) must be {expected}, found {found}")]
    InvalidCost {
        /// Row, from 0.
        row: usize,
        /// Column, from 0.
        column: usize,
        /// What a cost is.
        expected: &'static str,
        /// What stands there.
        found: f64,
    },
    /// The exponent of the power objective is out of range.
    #[error("the exponent of the costs must be finite and positive, found {found}")]
    InvalidPower {
        /// The exponent.
        found: f64,
    },
    /// Forbidden pairs leave no complete assignment.
    #[error("no complete assignment: {0}")]
    Infeasible(HallViolation),
    /// The file cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: std::io::Error,
    },
    /// A field of a CSV file is no number.
    #[error(
        "{}: row {row}, column {column} (from 0) must be a cost, or empty or `inf` where \
         forbidden; found `{found}`",
        path.display()
    )]
    CsvField {
        /// The file.
        path: PathBuf,
        /// Row of the matrix, from 0.
        row: usize,
        /// Column of the matrix, from 0.
        column: usize,
        /// What stands there.
        found: String,
    },
    /// A row of a CSV file is longer or shorter than the first.
    #[error("{}: row {row} (from 0) has {found} columns, the rows before have {expected}", path.display())]
    CsvRow {
        /// The file.
        path: PathBuf,
        /// Row of the matrix, from 0.
        row: usize,
        /// Columns of the rows before.
        expected: usize,
        /// Columns of this row.
        found: usize,
    },
    /// An archive of costs cannot be read.
    #[error(transparent)]
    Archive(#[from] NpzError),
    /// Neither `.npz` nor `.csv`.
    #[error("{}: costs are read from .npz (array `cost`) or .csv", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
}

/// Why no complete assignment exists: more rows than columns that they may take (or
/// the other way round), which Hall's theorem forbids.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct HallViolation {
    /// The side that cannot be served.
    pub rows: Vec<usize>,
    /// All that it may take; fewer.
    pub columns: Vec<usize>,
    /// Whether the sides are exchanged: `rows` are columns of the matrix.
    pub transposed: bool,
}

impl fmt::Display for HallViolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 8;
        let list = |indices: &[usize]| {
            let shown: Vec<String> = indices.iter().take(SHOWN).map(usize::to_string).collect();
            let more = if indices.len() > SHOWN { ", …" } else { "" };
            if shown.is_empty() { "none".to_owned() } else { shown.join(", ") + more }
        };
        let (side, other) = if self.transposed { ("columns", "rows") } else { ("rows", "columns") };
        write!(
            f,
            "{} {side} ({}) have only {} {other} allowed ({})",
            self.rows.len(),
            list(&self.rows),
            self.columns.len(),
            list(&self.columns)
        )
    }
}
