//! What sound meets at one time, and how it is followed for one purpose.

use super::{MissionError, Theatre};
use crate::grid::CellId;
use crate::record::LossTableMetrics;
use crate::scenario::{LossUse, Scenario};
use crate::sonar::loss_file::LossDescription;
use crate::sonar::section::Waters;
use crate::sonar::transmission_loss::{
    Directions, LossCache, LossTableRows, LossTableSettings, rows_with_cache, table_fingerprint,
};
use sonarfleet_acoustics::environment::Boundary;
use sonarfleet_ocean::OceanState;

/// What reports progress: done of total.
pub(super) type Progress<'a> = &'a (dyn Fn(usize, usize) + Sync);

/// What sound meets at one time, and how it is followed.
#[derive(Debug)]
pub struct Acoustics {
    /// Sound speed, sea floor and seabed.
    pub waters: Waters,
    /// Frequency, depth, range, quality.
    pub settings: LossTableSettings,
}

impl Acoustics {
    /// The acoustics of a scenario in an ocean state for a purpose.
    ///
    /// # Errors
    /// If the state or the bathymetry has nothing around the region.
    pub fn of(
        scenario: &Scenario,
        theatre: &Theatre,
        state: &OceanState,
        purpose: LossUse,
    ) -> Result<Self, MissionError> {
        let waters = Waters::new(
            state,
            &theatre.bathymetry,
            &scenario.frame,
            scenario.sound_speed,
            Boundary::Fluid(scenario.seabed),
        )?;
        let settings = LossTableSettings {
            frequency_hz: scenario.loss_frequency_hz(purpose),
            fleet_depth_m: scenario.fleet_depth_m,
            maximum_range_m: scenario.maximum_range_m.unwrap_or(f64::INFINITY),
            numerics: scenario.quality.numerics(),
            model: scenario.loss_model.clone(),
        };
        Ok(Self { waters, settings })
    }

    /// The rows of some sources, from the cache where it has them.
    ///
    /// # Errors
    /// As of computing them.
    pub fn rows(
        &self,
        scenario: &Scenario,
        sources: &[CellId],
        cache: Option<&LossCache>,
        progress: Progress<'_>,
    ) -> Result<LossTableRows, MissionError> {
        let Self { waters, settings } = self;
        Ok(rows_with_cache(waters, &scenario.grid, settings, sources, cache, progress)?)
    }

    /// How a table of these acoustics is described in records.
    pub(super) fn metrics(&self, scenario: &Scenario) -> LossTableMetrics {
        let settings = &self.settings;
        let diagonal_m = scenario.grid.width_m().hypot(scenario.grid.height_m());
        LossTableMetrics {
            model: settings.model.name().to_owned(),
            both_directions: scenario.directions == Directions::Both,
            beams: settings.beam_count(),
            bearings: settings.numerics.bearings,
            range_m: settings.maximum_range_m.min(diagonal_m),
            ..LossTableMetrics::from_file(settings.frequency_hz)
        }
    }

    /// How a table of these acoustics is described in files.
    pub fn description(&self, scenario: &Scenario, state: &OceanState) -> LossDescription {
        let Self { waters, settings } = self;
        LossDescription {
            columns: scenario.grid.columns,
            rows: scenario.grid.rows,
            frequency_hz: settings.frequency_hz,
            fleet_depth_m: settings.fleet_depth_m,
            maximum_range_m: scenario.maximum_range_m,
            directions: scenario.directions,
            time: state.time.to_string(),
            model: settings.model.name().into(),
            quality: scenario.quality.name().into(),
            beams: settings.beam_count(),
            bearings: settings.numerics.bearings,
            fingerprint: table_fingerprint(waters, &scenario.grid, settings),
        }
    }
}
