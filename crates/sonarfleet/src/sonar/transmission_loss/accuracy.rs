use super::error::TransmissionLossError;
use super::settings::LossTableSettings;
use super::table::{TransmissionLossTable, compute_rows};
use crate::grid::{CellId, SurveillanceGrid};
use crate::sonar::section::Waters;

/// Losses above this are left out of comparisons, dB: what is fainter is neither
/// detected nor understood.
const COMPARED_LOSS_DB: f32 = 90.0;

/// How far a table is from one of 720 bearings and dense beams, over a sample of
/// its sources.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorEstimate {
    /// Sources that were recomputed.
    pub sources: usize,
    /// Losses that were compared: those under 90 dB.
    pub compared: usize,
    /// Median absolute difference, dB.
    pub median_db: f64,
    /// 90th percentile of the absolute difference, dB.
    pub p90_db: f64,
    /// 99th percentile of the absolute difference, dB.
    pub p99_db: f64,
}

impl ErrorEstimate {
    /// Compares rows with those of [`Quality::Fine`](super::Quality::Fine) of the same sources. Without a
    /// source or a loss to compare, the differences are NaN.
    pub fn between(rows: &[impl AsRef<[f32]>], fine: &[impl AsRef<[f32]>]) -> Self {
        let mut differences: Vec<f64> = rows
            .iter()
            .zip(fine)
            .flat_map(|(row, fine)| row.as_ref().iter().zip(fine.as_ref()))
            .filter(|(_, fine)| **fine < COMPARED_LOSS_DB)
            .map(|(loss, fine)| f64::from((loss - fine).abs()))
            .collect();
        differences.sort_by(f64::total_cmp);
        let quantile = |q: f64| match differences.len() {
            0 => f64::NAN,
            count => differences[((count - 1) as f64 * q).round() as usize],
        };
        Self {
            sources: rows.len(),
            compared: differences.len(),
            median_db: quantile(0.5),
            p90_db: quantile(0.9),
            p99_db: quantile(0.99),
        }
    }
}

/// Recomputes the rows of some sources with
/// [`Quality::Fine`](super::Quality::Fine) and compares.
///
/// # Errors
/// As of computing the table.
pub fn estimate_error(
    table: &TransmissionLossTable,
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
    sources: &[CellId],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<ErrorEstimate, TransmissionLossError> {
    let fine = compute_rows(waters, grid, &settings.fine(), sources, progress)?;
    let rows: Vec<&[f32]> = sources.iter().map(|&source| table.row(source)).collect();
    Ok(ErrorEstimate::between(&rows, &fine))
}
