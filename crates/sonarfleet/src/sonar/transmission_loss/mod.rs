//! Transmission loss from every cell to every cell: N×2D, many vertical slices
//! around each source.

mod accuracy;
mod cache;
mod chunk;
mod directions;
mod error;
mod model;
mod quality;
mod row;
mod settings;
mod table;

pub use accuracy::{ErrorEstimate, estimate_error};
pub(crate) use cache::TABLE_VERSION;
pub use cache::{LossCache, table_fingerprint};
pub use directions::Directions;
pub use error::TransmissionLossError;
pub use quality::{BeamClass, Numerics, Quality, UnknownQuality};
pub use settings::{LARGEST_LOSS_DB, LossTableSettings, TableModel};
pub use table::{
    LossTableRows, TransmissionLossTable, compute_rows, compute_transmission_loss, rows_with_cache,
};
