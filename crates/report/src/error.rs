//! What can go wrong when a record is drawn.

use std::path::PathBuf;

/// Why figures or the report could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// An array of the record has not the length that its shape asks for.
    #[error("the record's `{field}`{at} has {found} values; its shape asks for {expected}",
        at = epoch.map(|k| format!(" of epoch {k}")).unwrap_or_default())]
    Shape {
        /// Name of the field in the record.
        field: &'static str,
        /// Epoch the field belongs to, if it belongs to one.
        epoch: Option<usize>,
        /// Number of values its shape asks for.
        expected: usize,
        /// Number of values it has.
        found: usize,
    },
    /// A cell of the record lies outside its grid.
    #[error("the record's `{field}`{at} names cell {found}; the grid has {count} cells",
        at = epoch.map(|k| format!(" of epoch {k}")).unwrap_or_default())]
    Cell {
        /// Name of the field in the record.
        field: &'static str,
        /// Epoch the field belongs to, if it belongs to one.
        epoch: Option<usize>,
        /// Number of cells of the grid.
        count: usize,
        /// The cell named.
        found: usize,
    },
    /// The grid has no cells, or cells without an extent.
    #[error(
        "the record's grid of {columns} × {rows} cells of {cell_width_m} m × {cell_height_m} m \
         has no area to draw"
    )]
    Grid {
        /// Columns of the grid.
        columns: usize,
        /// Rows of the grid.
        rows: usize,
        /// Width of a cell, metres.
        cell_width_m: f64,
        /// Height of a cell, metres.
        cell_height_m: f64,
    },
    /// A picture could not be rasterised or encoded.
    #[error("cannot draw {}: {reason}", path.display())]
    Draw {
        /// The picture's file.
        path: PathBuf,
        /// What the drawing backend said.
        reason: String,
    },
    /// The record could not be put into the report.
    #[error("cannot put the record into {}: {source}", path.display())]
    Encode {
        /// The report's file.
        path: PathBuf,
        /// What the encoder said.
        source: serde_json::Error,
    },
    /// A file or directory could not be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file or directory.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
}

/// A result whose error says why a record could not be drawn.
pub(crate) type Result<T> = std::result::Result<T, ReportError>;

/// Writes a whole file or none.
pub(crate) fn written(path: &std::path::Path, contents: &[u8]) -> Result<()> {
    sonarfleet::replace_file(path, contents)
        .map_err(|source| ReportError::Write { path: path.to_owned(), source })
}
