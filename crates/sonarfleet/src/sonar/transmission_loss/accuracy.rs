use super::quality::Quality;
use super::table::{LossTableSettings, TransmissionLossError, TransmissionLossTable, compute_rows};
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

/// Recomputes the rows of some sources with [`Quality::Fine`] and compares.
/// Without a source or a loss to compare, the differences are NaN.
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
    let fine = LossTableSettings { numerics: Quality::Fine.numerics(), ..settings.clone() };
    let rows = compute_rows(waters, grid, &fine, sources, progress)?;
    let mut differences: Vec<f64> = sources
        .iter()
        .zip(&rows)
        .flat_map(|(&source, fine)| table.row(source).iter().zip(fine))
        .filter(|(_, fine)| **fine < COMPARED_LOSS_DB)
        .map(|(loss, fine)| f64::from((loss - fine).abs()))
        .collect();
    differences.sort_by(f64::total_cmp);
    let quantile = |q: f64| match differences.len() {
        0 => f64::NAN,
        count => differences[((count - 1) as f64 * q).round() as usize],
    };
    Ok(ErrorEstimate {
        sources: sources.len(),
        compared: differences.len(),
        median_db: quantile(0.5),
        p90_db: quantile(0.9),
        p99_db: quantile(0.99),
    })
}
