use super::quality::{Numerics, Quality};
use super::row::RowComputer;
use crate::grid::{CellId, SurveillanceGrid};
use crate::sonar::section::Waters;
use rayon::prelude::*;
use sonarfleet_acoustics::AcousticsError;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Losses are not given beyond this, dB: nothing is heard there.
pub const LARGEST_LOSS_DB: f32 = 200.0;

/// Transmission loss from every cell to every cell at the fleet's depth.
#[derive(Debug, Clone, PartialEq)]
pub struct TransmissionLossTable {
    /// Number of cells.
    pub cell_count: usize,
    /// [source cell, target cell], dB re 1 m; at most [`LARGEST_LOSS_DB`].
    ///
    /// A source is a point in the middle of its cell; intensity is averaged over
    /// the target cell. On the diagonal it is the intensity half a cell away.
    pub loss_db: Vec<f32>,
}

impl TransmissionLossTable {
    /// Loss from one cell to another, dB.
    pub fn loss_db(&self, source: CellId, target: CellId) -> f32 {
        self.loss_db[source.0 * self.cell_count + target.0]
    }

    /// Losses from one cell to all, dB.
    pub fn row(&self, source: CellId) -> &[f32] {
        &self.loss_db[source.0 * self.cell_count..(source.0 + 1) * self.cell_count]
    }
}

/// What a table is computed for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LossTableSettings {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Depth of sources and receivers, metres.
    pub fleet_depth_m: f64,
    /// Largest distance over which sound is followed, metres; infinite for the
    /// whole region.
    pub maximum_range_m: f64,
    /// How much work goes into it.
    pub quality: Quality,
}

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

impl LossTableSettings {
    pub(super) fn check(&self) -> Result<(), TransmissionLossError> {
        for (setting, found) in [
            ("the frequency", self.frequency_hz),
            ("the fleet's depth", self.fleet_depth_m),
            ("the largest range", self.maximum_range_m),
        ] {
            if found.is_nan() || found <= 0.0 {
                return Err(TransmissionLossError::NotPositive { setting, found });
            }
        }
        Ok(())
    }
}

/// Computes the table of a region's waters. `progress` is told how many sources
/// of how many are done, from any thread. The result does not depend on the
/// number of threads.
///
/// # Errors
/// If a setting is not positive.
pub fn compute_transmission_loss(
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<TransmissionLossTable, TransmissionLossError> {
    let sources: Vec<CellId> = grid.cells().collect();
    let loss_db = transmission_loss_from(waters, grid, settings, &sources, progress)?;
    Ok(TransmissionLossTable { cell_count: grid.cell_count(), loss_db })
}

/// As [`compute_transmission_loss`], but only the rows of some sources, in their
/// order: [source, target], dB.
///
/// # Errors
/// If a setting is not positive.
pub fn transmission_loss_from(
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
    sources: &[CellId],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<f32>, TransmissionLossError> {
    settings.check()?;
    let numerics = settings.quality.numerics();
    Ok(compute_rows(waters, grid, settings, &numerics, sources, progress)?.concat())
}

/// The rows of some sources, in their order.
pub(super) fn compute_rows(
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
    numerics: &Numerics,
    sources: &[CellId],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Vec<f32>>, TransmissionLossError> {
    let slice_error =
        |source_cell| move |reason| TransmissionLossError::Slice { source_cell, reason };
    let computer = RowComputer::new(waters, grid, settings, numerics)
        .map_err(slice_error(CellId(0)))?;
    let done = AtomicUsize::new(0);
    sources
        .par_iter()
        .map(|&source| {
            let row = computer.row(source).map_err(slice_error(source))?;
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, sources.len());
            Ok(row)
        })
        .collect()
}
