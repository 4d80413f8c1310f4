use crate::grid::CellId;
use sonarfleet_acoustics::AcousticsError;

/// Why a table could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum TransmissionLossError {
    /// A setting is outside its range.
    #[error("{setting} must be positive: found {found}")]
    NotPositive {
        /// Which setting.
        setting: &'static str,
        /// Its value.
        found: f64,
    },
    /// The environment of a slice is not one.
    #[error("a slice from cell {}: {reason}", source_cell.0)]
    Slice {
        /// The source.
        source_cell: CellId,
        /// Why.
        #[source]
        reason: AcousticsError,
    },
}
