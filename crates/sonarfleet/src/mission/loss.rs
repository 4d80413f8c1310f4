//! The transmission-loss tables of an epoch.

use super::acoustics::{Acoustics, Progress};
use super::{MissionError, Theatre};
use crate::grid::CellId;
use crate::record::LossTableMetrics;
use crate::scenario::{LossUse, Scenario};
use crate::sonar::loss_file::read_table;
use crate::sonar::transmission_loss::{ErrorEstimate, LossCache, TransmissionLossTable};
use sonarfleet_ocean::OceanState;

/// A table of an epoch, and how it was made.
#[derive(Debug)]
pub struct EpochLoss {
    /// The table.
    pub table: TransmissionLossTable,
    /// How it was made.
    pub metrics: LossTableMetrics,
    /// Rows of the sample of sources on which the error is estimated, in one direction.
    sampled: Vec<Vec<f32>>,
}

/// What is needed to make a table.
pub(super) struct LossTask<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) theatre: &'a Theatre,
    pub(super) state: &'a OceanState,
    pub(super) purpose: LossUse,
    pub(super) cache: Option<&'a LossCache>,
}

impl LossTask<'_> {
    /// The table of an epoch: from a file if the scenario names one, as it is; else
    /// computed.
    pub(super) fn table(
        &self,
        epoch: usize,
        progress: Progress<'_>,
    ) -> Result<EpochLoss, MissionError> {
        let Self { scenario, .. } = self;
        let file = scenario.epochs[epoch].file_of(self.purpose);
        let (table, metrics) = if let Some(path) = file {
            let frequency_hz = scenario.loss_frequency_hz(self.purpose);
            (read_table(path, &scenario.grid)?, LossTableMetrics::from_file(frequency_hz))
        } else {
            let acoustics = self.acoustics()?;
            let sources: Vec<CellId> = scenario.grid.cells().collect();
            let rows = acoustics.rows(scenario, &sources, self.cache, progress)?.rows;
            let table = TransmissionLossTable { cell_count: sources.len(), loss_db: rows.concat() };
            (table, acoustics.metrics(scenario))
        };
        let sampled = self.sample().into_iter().map(|cell| table.row(cell).to_vec()).collect();
        let table = if metrics.both_directions { scenario.directions.of(table) } else { table };
        Ok(EpochLoss { table, metrics, sampled })
    }

    /// Recomputes the rows of the sample at `fine` settings and notes how far the
    /// table is from them. Of a table that is the mean of both directions, the rows are
    /// compared as they were computed, in one direction.
    pub(super) fn estimate_error(
        &self,
        loss: &mut EpochLoss,
        progress: Progress<'_>,
    ) -> Result<(), MissionError> {
        let mut acoustics = self.acoustics()?;
        acoustics.settings = acoustics.settings.fine();
        let fine = acoustics.rows(self.scenario, &self.sample(), self.cache, progress)?;
        let error = ErrorEstimate::between(&loss.sampled, &fine.rows);
        loss.metrics.sampled_sources = error.sources;
        loss.metrics.median_error_db = error.median_db;
        loss.metrics.p90_error_db = error.p90_db;
        Ok(())
    }

    fn acoustics(&self) -> Result<Acoustics, MissionError> {
        Acoustics::of(self.scenario, self.theatre, self.state, self.purpose)
    }

    /// Sources evenly over the cells where vehicles can be.
    fn sample(&self) -> Vec<CellId> {
        let wanted = self.scenario.file.transmission_loss.error_sample;
        let deployable = &self.theatre.deployable;
        let candidates: Vec<CellId> =
            self.scenario.grid.cells().filter(|cell| deployable[cell.0]).collect();
        let count = wanted.min(candidates.len());
        (0..count).map(|k| candidates[(2 * k + 1) * candidates.len() / (2 * count)]).collect()
    }
}
