//! What can be wrong with a placement problem.

use crate::grid::CellId;
use crate::npz::NpzError;
use crate::sonar::SonarError;
use std::path::PathBuf;

/// A placement problem that cannot be set up, or a layout that is none of its.
#[derive(Debug, thiserror::Error)]
pub enum PlacementError {
    /// A level, model or prior is wrong.
    #[error(transparent)]
    Sonar(#[from] SonarError),
    /// The instance file cannot be read.
    #[error(transparent)]
    File(#[from] NpzError),
    /// The instance's parameters are not the JSON object expected.
    #[error("{}: array `params` is not the JSON object expected: {source}", path.display())]
    Parameters {
        /// The file.
        path: PathBuf,
        /// What is wrong, with line and column.
        source: serde_json::Error,
    },
    /// An array does not fit the grid.
    #[error(
        "`{name}` has {found} values, expected {expected} for a grid of {columns} × {rows} cells"
    )]
    WrongSize {
        /// Name of the array.
        name: &'static str,
        /// Number of values found.
        found: usize,
        /// Number of values expected.
        expected: usize,
        /// Columns of the grid.
        columns: usize,
        /// Rows of the grid.
        rows: usize,
    },
    /// A transmission loss is NaN or −∞ (+∞ means that nothing arrives).
    #[error("`{name}`: the loss from cell {from} to cell {to} is {found} dB", from = from.0, to = to.0)]
    BadLoss {
        /// Name of the table.
        name: &'static str,
        /// Cell of the row.
        from: CellId,
        /// Cell of the column.
        to: CellId,
        /// The value found.
        found: f32,
    },
    /// The connectivity threshold τ is negative or not finite.
    #[error("`connectivity_threshold` is {found}, expected a finite number of at least 0")]
    BadThreshold {
        /// The value found.
        found: f64,
    },
    /// There is nothing to place.
    #[error("the fleet has no vehicles to place")]
    NoVehicles,
    /// There are fewer cells than vehicles.
    #[error("{vehicles} vehicles cannot be placed on {deployable} deployable cells, one each")]
    TooFewCells {
        /// Vehicles to place.
        vehicles: usize,
        /// Cells where a vehicle may be placed and no fixed sensor is.
        deployable: usize,
    },
    /// A fixed sensor is outside the grid, or two share a cell.
    #[error("fixed sensor {index} in cell {cell}: {reason}", cell = cell.0)]
    BadFixedSensor {
        /// Index of the sensor.
        index: usize,
        /// Its cell.
        cell: CellId,
        /// What is wrong.
        reason: &'static str,
    },
}
