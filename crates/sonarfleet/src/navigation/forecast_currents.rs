//! The current field of an ocean forecast.

use super::{CurrentField, NavigationError, TransitDomain};
use crate::grid::{Position, evenly};
use jiff::Timestamp;
use rayon::prelude::*;
use sonarfleet_ocean::{Forecast, LocalFrame};

/// Greatest distance between resampled nodes, m: well below the 9 km of a 1/12°
/// forecast, so that resampling loses nothing that the forecast holds.
const GREATEST_SPACING_M: f64 = 2_000.0;

const SECONDS_PER_HOUR: f64 = 3600.0;

impl CurrentField {
    /// The current of a forecast at the vehicles' depth, resampled over a transit
    /// domain on nodes at most 2 km apart, at the forecast's times counted in hours
    /// since `run_start`. Impassable are land and what lies beyond the forecast's grid
    /// (for shoals see [`CurrentField::closed_where`]); beyond the forecast's first and
    /// last time its nearest state holds.
    ///
    /// # Errors
    /// As [`CurrentField::new`]: no state, implausible speeds, no water at this depth.
    pub fn from_forecast(
        forecast: &Forecast,
        frame: &LocalFrame,
        depth_m: f64,
        domain: TransitDomain,
        run_start: Timestamp,
    ) -> Result<Self, NavigationError> {
        let (south_west, north_east) = (domain.south_west(), domain.north_east());
        let east_m = evenly(south_west.east_m, north_east.east_m, GREATEST_SPACING_M);
        let north_m = evenly(south_west.north_m, north_east.north_m, GREATEST_SPACING_M);
        let time_h = forecast
            .states
            .iter()
            .map(|state| state.time.duration_since(run_start).as_secs_f64() / SECONDS_PER_HOUR)
            .collect();
        let places: Vec<(f64, f64)> = north_m
            .iter()
            .flat_map(|&north_m| east_m.iter().map(move |&east_m| Position { east_m, north_m }))
            .map(|node| frame.to_geographic(node.east_m, node.north_m))
            .collect();
        let layers: Vec<Vec<[f64; 2]>> = forecast
            .states
            .par_iter()
            .map(|state| {
                let current = |&(longitude_deg, latitude_deg): &(f64, f64)| {
                    state.current(longitude_deg, latitude_deg, depth_m).unwrap_or([f64::NAN; 2])
                };
                places.iter().map(current).collect()
            })
            .collect();
        let component = |part: usize| -> Vec<f64> {
            layers.iter().flatten().map(|velocity| velocity[part]).collect()
        };
        Self::new(east_m, north_m, time_h, &component(0), &component(1))
    }
}
