//! Step 1: the environment of an epoch.

use super::{MissionError, Theatre};
use crate::grid::CellId;
use crate::placement::{PlacementInput, PlacementProblem};
use crate::record::LossTableMetrics;
use crate::scenario::Scenario;
use crate::sonar::loss_file::{LossDescription, read_table};
use crate::sonar::section::Waters;
use crate::sonar::transmission_loss::{
    LossTableSettings, TransmissionLossTable, compute_rows, compute_transmission_loss,
    estimate_error,
};
use sonarfleet_acoustics::environment::Boundary;
use sonarfleet_ocean::OceanState;

/// What an epoch's decisions are made on.
#[derive(Debug)]
pub struct Environment {
    /// The ocean at the epoch's snapshot.
    pub state: OceanState,
    /// Transmission loss between all cells.
    pub loss: TransmissionLossTable,
    /// How the table was made.
    pub loss_metrics: LossTableMetrics,
    /// The placement problem that follows.
    pub problem: PlacementProblem,
}

/// What reports progress: done of total.
type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

impl Environment {
    /// The environment of an epoch: its ocean state, its own transmission-loss table
    /// (from a file if the scenario names one), its prior.
    ///
    /// # Errors
    /// If the ocean does not hold what is needed, a file does not fit, or no
    /// placement problem follows.
    pub fn at(
        scenario: &Scenario,
        theatre: &Theatre,
        epoch: usize,
        progress: Progress<'_>,
    ) -> Result<Self, MissionError> {
        let plan = &scenario.epochs[epoch];
        let state = theatre.forecast.at(scenario.instant(plan.snapshot_h))?;
        let (loss, loss_metrics) = if let Some(path) = &plan.loss_file {
            (read_table(path, &scenario.grid)?, LossTableMetrics::from_file())
        } else {
            let acoustics = Acoustics::of(scenario, theatre, &state)?;
            (acoustics.table(scenario, progress)?, acoustics.metrics(scenario))
        };
        let problem = PlacementProblem::new(&input(scenario, theatre, epoch, &loss))?;
        Ok(Self { state, loss, loss_metrics, problem })
    }

    /// Recomputes the rows of a sample of sources, evenly over the region, at `fine`
    /// settings and notes how far the table is from them.
    ///
    /// # Errors
    /// As of computing the table.
    pub(super) fn estimate_loss_error(
        &mut self,
        scenario: &Scenario,
        theatre: &Theatre,
        progress: Progress<'_>,
    ) -> Result<(), MissionError> {
        let acoustics = Acoustics::of(scenario, theatre, &self.state)?;
        let wanted = scenario.file.transmission_loss.error_sample;
        let candidates: Vec<CellId> =
            scenario.grid.cells().filter(|cell| theatre.deployable[cell.0]).collect();
        let count = wanted.min(candidates.len());
        let sample: Vec<CellId> =
            (0..count).map(|k| candidates[(2 * k + 1) * candidates.len() / (2 * count)]).collect();
        let Acoustics { waters, settings } = &acoustics;
        let error =
            estimate_error(&self.loss, waters, &scenario.grid, settings, &sample, progress)?;
        self.loss_metrics.sampled_sources = error.sources;
        self.loss_metrics.median_error_db = error.median_db;
        self.loss_metrics.p90_error_db = error.p90_db;
        Ok(())
    }
}

/// The placement problem of an epoch, given its transmission loss.
pub fn input(
    scenario: &Scenario,
    theatre: &Theatre,
    epoch: usize,
    loss: &TransmissionLossTable,
) -> PlacementInput {
    PlacementInput {
        grid: scenario.grid,
        prior: scenario.epochs[epoch].prior.clone(),
        detection_loss_db: loss.loss_db.clone(),
        communication_loss_db: None,
        sonar: scenario.sonar.clone(),
        modem: scenario.modem.clone(),
        vehicles: scenario.fleet.len(),
        connectivity_threshold: scenario.connectivity_threshold,
        deployable: Some(theatre.deployable.clone()),
        fixed_sensors: scenario.fixed_sensors.clone(),
    }
}

/// What sound meets at one time, and how it is followed.
#[derive(Debug)]
pub struct Acoustics {
    /// Sound speed, sea floor and seabed.
    pub waters: Waters,
    /// Frequency, depth, range, quality.
    pub settings: LossTableSettings,
}

impl Acoustics {
    /// The acoustics of a scenario in an ocean state.
    ///
    /// # Errors
    /// If the state or the bathymetry has nothing around the region.
    pub fn of(
        scenario: &Scenario,
        theatre: &Theatre,
        state: &OceanState,
    ) -> Result<Self, MissionError> {
        let waters = Waters::new(
            state,
            &theatre.bathymetry,
            &scenario.frame,
            scenario.sound_speed,
            Boundary::Fluid(scenario.seabed),
        )?;
        let settings = LossTableSettings {
            frequency_hz: scenario.frequency_hz,
            fleet_depth_m: scenario.fleet_depth_m,
            maximum_range_m: scenario.maximum_range_m.unwrap_or(f64::INFINITY),
            numerics: scenario.quality.numerics(),
        };
        Ok(Self { waters, settings })
    }

    /// The rows of some sources, [source, target], dB.
    ///
    /// # Errors
    /// As of computing them.
    pub fn rows(
        &self,
        scenario: &Scenario,
        sources: &[CellId],
        progress: Progress<'_>,
    ) -> Result<Vec<f32>, MissionError> {
        let rows = compute_rows(&self.waters, &scenario.grid, &self.settings, sources, progress)?;
        Ok(rows.concat())
    }

    /// The whole table.
    ///
    /// # Errors
    /// As of computing it.
    fn table(
        &self,
        scenario: &Scenario,
        progress: Progress<'_>,
    ) -> Result<TransmissionLossTable, MissionError> {
        Ok(compute_transmission_loss(&self.waters, &scenario.grid, &self.settings, progress)?)
    }

    /// How a table of these acoustics is described in records.
    fn metrics(&self, scenario: &Scenario) -> LossTableMetrics {
        let numerics = &self.settings.numerics;
        let diagonal_m = scenario.grid.width_m().hypot(scenario.grid.height_m());
        LossTableMetrics {
            beams: numerics.beam_count(),
            bearings: numerics.bearings,
            range_m: self.settings.maximum_range_m.min(diagonal_m),
            ..LossTableMetrics::from_file()
        }
    }

    /// How a table of these acoustics is described in files.
    pub fn description(&self, scenario: &Scenario, state: &OceanState) -> LossDescription {
        let numerics = &self.settings.numerics;
        LossDescription {
            columns: scenario.grid.columns,
            rows: scenario.grid.rows,
            frequency_hz: self.settings.frequency_hz,
            fleet_depth_m: self.settings.fleet_depth_m,
            time: state.time.to_string(),
            quality: scenario.quality.name().into(),
            beams: numerics.beam_count(),
            bearings: numerics.bearings,
        }
    }
}
