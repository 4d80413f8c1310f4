//! The theatre of a run: the ocean over time, the sea floor, and the cells in it.

use super::MissionError;
use crate::grid::CellId;
use crate::navigation::CurrentField;
use crate::scenario::{OceanSource, Scenario};
use crate::sonar::section::BEHIND_M;
use sonarfleet_ocean::io::{ForecastRequest, read_bathymetry, read_forecast};
use sonarfleet_ocean::{Bathymetry, Forecast, OceanState, Quantity, Region};
use std::path::PathBuf;

/// Metres in a degree of latitude; of longitude, times the cosine of the latitude.
const METRES_PER_DEGREE: f64 = 111_000.0;

/// What stays the same over a run.
#[derive(Debug)]
pub struct Theatre {
    /// Ocean states over time.
    pub forecast: Forecast,
    /// The sea floor.
    pub bathymetry: Bathymetry,
    /// The current at the fleet's depth, hours since the run's start.
    pub currents: CurrentField,
    /// Longitude and latitude of the cells' centres, degrees, [row, column].
    pub cell_degrees: Vec<(f64, f64)>,
    /// Water depth at the cells' centres, metres, [row, column].
    pub cell_depth_m: Vec<f64>,
    /// Whether a vehicle may be placed in a cell, [row, column].
    pub deployable: Vec<bool>,
}

impl Theatre {
    /// Loads or generates the ocean of a scenario and looks where vehicles can be.
    ///
    /// # Errors
    /// If files are missing, damaged, or do not cover the region and the epochs, or
    /// no cell can hold a vehicle.
    pub fn of(scenario: &Scenario) -> Result<Self, MissionError> {
        let (forecast, bathymetry) = load(scenario)?;
        for epoch in &scenario.epochs {
            forecast.at(scenario.instant(epoch.snapshot_h))?;
        }
        let cell_degrees: Vec<(f64, f64)> = scenario
            .grid
            .cells()
            .map(|cell| {
                let centre = scenario.grid.centre(cell);
                scenario.frame.to_geographic(centre.east_m, centre.north_m)
            })
            .collect();
        let cell_depth_m = cell_degrees
            .iter()
            .map(|&(longitude_deg, latitude_deg)| {
                bathymetry.depth_m(longitude_deg, latitude_deg).ok_or_else(|| {
                    let (path, span) = (bathymetry_path(scenario), bathymetry.span().to_string());
                    MissionError::BathymetryTooSmall { path, longitude_deg, latitude_deg, span }
                })
            })
            .collect::<Result<Vec<f64>, _>>()?;
        let first = forecast.at(scenario.instant(scenario.epochs[0].snapshot_h))?;
        let deployable: Vec<bool> = scenario
            .grid
            .cells()
            .map(|CellId(n)| {
                let (longitude_deg, latitude_deg) = cell_degrees[n];
                cell_depth_m[n] > scenario.fleet_depth_m
                    && has_water(&first, longitude_deg, latitude_deg)
                    && !scenario.exclusions.contain(longitude_deg, latitude_deg)
            })
            .collect();
        if !deployable.contains(&true) {
            let cells = scenario.grid.cell_count();
            return Err(MissionError::NowhereToBe { cells, depth_m: scenario.fleet_depth_m });
        }
        let currents = CurrentField::from_forecast(
            &forecast,
            &scenario.frame,
            scenario.fleet_depth_m,
            scenario.domain,
            scenario.start,
        )?;
        let currents = currents.closed_where(|position| {
            let (longitude, latitude) =
                scenario.frame.to_geographic(position.east_m, position.north_m);
            let depth_m = bathymetry.depth_m(longitude, latitude);
            depth_m.is_some_and(|depth_m| depth_m <= scenario.fleet_depth_m)
        })?;
        Ok(Self { forecast, bathymetry, currents, cell_degrees, cell_depth_m, deployable })
    }

    /// Cells where no vehicle may be placed.
    pub fn blocked_cells(&self) -> Vec<CellId> {
        (0..self.deployable.len()).filter(|&n| !self.deployable[n]).map(CellId).collect()
    }
}

fn load(scenario: &Scenario) -> Result<(Forecast, Bathymetry), MissionError> {
    match &scenario.ocean {
        OceanSource::Synthetic(ocean) => Ok((ocean.forecast(), ocean.bathymetry())),
        OceanSource::Files { states, bathymetry } => {
            let area = needed(scenario);
            let request =
                ForecastRequest { required: &Quantity::ALL, region: Some(area), span: None };
            let forecast = read_forecast(states, &request)?;
            Ok((forecast, read_bathymetry(bathymetry, Some(area))?))
        }
    }
}

/// The region with what is needed around it: vehicles transit in the margin, and
/// slopes behind a source send sound back.
fn needed(scenario: &Scenario) -> Region {
    let margin_m = scenario.transit_margin_m().max(BEHIND_M);
    let (_, latitude_deg) = scenario.region().centre_deg();
    scenario.region().grown(margin_m / (METRES_PER_DEGREE * latitude_deg.to_radians().cos()))
}

fn bathymetry_path(scenario: &Scenario) -> PathBuf {
    match &scenario.ocean {
        OceanSource::Synthetic(_) => "synthetic bathymetry".into(),
        OceanSource::Files { bathymetry, .. } => bathymetry.clone(),
    }
}

/// Whether the ocean model has water at a point.
fn has_water(state: &OceanState, longitude_deg: f64, latitude_deg: f64) -> bool {
    state.column(longitude_deg, latitude_deg).is_some()
}
