//! A synthetic South China Sea: a pure function of position and time that has what the
//! real continental slope south-west of Taiwan has in autumn, so that everything can be
//! run and tested without downloading anything. It is not an observation of anything.
//!
//! - [`profile`]: the undisturbed water column.
//! - [`circulation`]: eddy, front and slope current in thermal-wind balance with the
//!   temperature, tides, inertial motion, and the heaving of the thermocline.
//! - [`seafloor`]: the continental slope with its canyon, spur and hills.
//!
//! Beside it stands [`ensemble`], a family of small oceans to practise on.

pub mod circulation;
pub mod ensemble;
pub mod profile;
pub mod seafloor;

use crate::potential_temperature::{in_situ_c, potential_c, pressure_dbar};
use crate::{Bathymetry, Forecast, OceanGrid, OceanState, Region};
use circulation::Circulation;
use jiff::{SignedDuration, Timestamp};
use std::sync::Arc;

/// What every file and figure of this ocean must say.
pub const TITLE: &str =
    "SYNTHETIC South China Sea slope (sonarfleet): not an observation or a forecast";

/// 2025-10-09 00:00 UTC, the start of the ten days and the origin of the ocean's time.
pub const START: Timestamp = Timestamp::constant(1_759_968_000, 0);

/// The region of the default scenario.
pub const REGION: Region =
    Region { west_deg: 118.1, east_deg: 118.4, south_deg: 21.60, north_deg: 21.88 };

/// Nodes per degree of the ocean grid, that of the Copernicus Marine global forecast.
const NODES_PER_DEGREE: f64 = 12.0;

/// Nodes per degree of the bathymetry grid, that of GEBCO (15 arc-seconds).
const BATHYMETRY_NODES_PER_DEGREE: f64 = 240.0;

/// Depths of the levels of the Copernicus Marine global forecast down to the deepest
/// point of the synthetic sea floor, metres.
const LEVELS_M: [f32; 43] = [
    0.494_025, 1.541_375, 2.645_669, 3.819_495, 5.078_224, 6.440_614, 7.929_56, 9.572_997, 11.405,
    13.467_14, 15.810_07, 18.495_56, 21.598_82, 25.211_41, 29.444_73, 34.434_15, 40.344_05,
    47.373_69, 55.764_29, 65.807_27, 77.853_85, 92.326_07, 109.729_3, 130.666, 155.850_7,
    186.125_6, 222.475_2, 266.040_3, 318.127_4, 380.213, 453.937_7, 541.088_9, 643.566_8,
    763.333_1, 902.339_3, 1_062.44, 1_245.291, 1_452.251, 1_684.284, 1_941.893, 2_225.078,
    2_533.336, 2_865.703,
];

/// The synthetic South China Sea over a region and a time span, on the nodes and at the
/// hours at which the Copernicus Marine global forecast would give it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SyntheticOcean {
    /// The region that must be covered.
    pub region: Region,
    /// How far the data reach beyond the region, degrees.
    pub margin_deg: f64,
    /// Time of the first state.
    pub start: Timestamp,
    /// Number of states.
    pub states: usize,
    /// Hours between states.
    pub interval_h: i64,
}

impl Default for SyntheticOcean {
    /// The default scenario's: 6-hourly states over ten days, with at least three
    /// nodes of 1/12° around [`REGION`].
    fn default() -> Self {
        Self { region: REGION, margin_deg: 0.34, start: START, states: 41, interval_h: 6 }
    }
}

impl SyntheticOcean {
    /// The ocean states.
    pub fn forecast(&self) -> Forecast {
        let area = self.region.grown(self.margin_deg);
        let grid = Arc::new(OceanGrid {
            longitude_deg: single(nodes(area.west_deg, area.east_deg, NODES_PER_DEGREE, 0.0)),
            latitude_deg: single(nodes(area.south_deg, area.north_deg, NODES_PER_DEGREE, 0.0)),
            depth_m: LEVELS_M.iter().map(|&level| f64::from(level)).collect(),
        });
        let step = SignedDuration::from_hours(self.interval_h);
        let times = (0..self.states).map(|i| self.start + step * i as i32);
        Forecast { states: times.map(|time| state(&grid, time)).collect() }
    }

    /// The depth of the sea, whole metres as GEBCO gives it.
    pub fn bathymetry(&self) -> Bathymetry {
        let area = self.region.grown(self.margin_deg);
        let longitude_deg = nodes(area.west_deg, area.east_deg, BATHYMETRY_NODES_PER_DEGREE, 0.5);
        let latitude_deg = nodes(area.south_deg, area.north_deg, BATHYMETRY_NODES_PER_DEGREE, 0.5);
        let mut values_m = Vec::with_capacity(longitude_deg.len() * latitude_deg.len());
        for &latitude in &latitude_deg {
            for &longitude in &longitude_deg {
                values_m.push(seafloor::depth_m(longitude, latitude).round() as f32);
            }
        }
        Bathymetry { longitude_deg, latitude_deg, values_m }
    }
}

/// Metres east and north of the middle of [`REGION`] on a tangent plane: the
/// coordinates in which the ocean is defined.
fn plane_m(longitude_deg: f64, latitude_deg: f64) -> (f64, f64) {
    plane_about_m(REGION, longitude_deg, latitude_deg)
}

/// Metres east and north of the middle of a region on a tangent plane.
fn plane_about_m(region: Region, longitude_deg: f64, latitude_deg: f64) -> (f64, f64) {
    const METRES_PER_DEGREE: f64 = 111_195.0;
    let (longitude, latitude) = region.centre_deg();
    let parallel = METRES_PER_DEGREE * latitude.to_radians().cos();
    ((longitude_deg - longitude) * parallel, (latitude_deg - latitude) * METRES_PER_DEGREE)
}

/// Nodes at `(i + offset) / per_degree` from the last one not above `from` to the first
/// one not below `to`.
fn nodes(from: f64, to: f64, per_degree: f64, offset: f64) -> Vec<f64> {
    let first = (from * per_degree - offset).floor() as i64;
    let last = (to * per_degree - offset).ceil() as i64;
    (first..=last).map(|i| (i as f64 + offset) / per_degree).collect()
}

/// Coordinates as ocean files hold them, in single precision.
fn single(nodes: Vec<f64>) -> Vec<f64> {
    nodes.into_iter().map(|node| f64::from(node as f32)).collect()
}

/// The ocean on the nodes of a grid at a time. Temperatures are rounded so that a file
/// that holds potential temperature as `f32` gives back the same bits.
fn state(grid: &Arc<OceanGrid>, time: Timestamp) -> OceanState {
    let seconds = time.duration_since(START).as_secs_f64();
    let count = grid.node_count();
    let mut state = OceanState {
        grid: grid.clone(),
        time,
        temperature_c: vec![f32::NAN; count],
        salinity_psu: vec![f32::NAN; count],
        current_east_m_s: vec![f32::NAN; count],
        current_north_m_s: vec![f32::NAN; count],
    };
    for (row, &latitude) in grid.latitude_deg.iter().enumerate() {
        for (column, &longitude) in grid.longitude_deg.iter().enumerate() {
            let (x, y) = plane_m(longitude, latitude);
            let bottom_m = seafloor::depth_m(longitude, latitude);
            let circulation = Circulation::at(x, y, seconds);
            for (level, &depth) in grid.depth_m.iter().enumerate() {
                if depth > bottom_m {
                    break;
                }
                let node = grid.index(level, row, column);
                let water = circulation.water(depth);
                let salinity = water.salinity_psu as f32;
                let pressure = pressure_dbar(depth, latitude);
                let potential =
                    potential_c(water.temperature_c, f64::from(salinity), pressure) as f32;
                let in_situ = in_situ_c(f64::from(potential), f64::from(salinity), pressure);
                state.temperature_c[node] = in_situ as f32;
                state.salinity_psu[node] = salinity;
                state.current_east_m_s[node] = water.current_east_m_s as f32;
                state.current_north_m_s[node] = water.current_north_m_s as f32;
            }
        }
    }
    state
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::LocalFrame;

    #[test]
    fn the_default_covers_the_region_with_three_nodes_around() {
        let forecast = SyntheticOcean::default().forecast();
        let grid = &forecast.states[0].grid;
        let around = |axis: &[f64], from: f64, to: f64| {
            let below = axis.iter().filter(|&&node| node < from).count();
            let above = axis.iter().filter(|&&node| node > to).count();
            assert!(below >= 4 && above >= 4, "{below} {above}");
        };
        around(&grid.longitude_deg, REGION.west_deg, REGION.east_deg);
        around(&grid.latitude_deg, REGION.south_deg, REGION.north_deg);
        assert_eq!(forecast.states.len(), 41);
        let (start, end) = forecast.span().unwrap();
        assert_eq!(start.to_string(), "2025-10-09T00:00:00Z");
        assert_eq!(end.to_string(), "2025-10-19T00:00:00Z");
    }

    /// The currents the default scenario promises: 0.05–0.35 m/s at 200 m all over the
    /// region, and at every hour of the ten days.
    #[test]
    fn currents_at_200_m_are_strong_but_not_too_strong() {
        let forecast = SyntheticOcean::default().forecast();
        let frame = LocalFrame::new(REGION);
        let (mut slowest, mut fastest, mut sum, mut count) = (f64::MAX, 0.0_f64, 0.0, 0);
        for hour in (0..=240).step_by(3) {
            let state = forecast.at(START + SignedDuration::from_hours(hour)).unwrap();
            for i in 0..=10 {
                for j in 0..=10 {
                    let east = frame.width_m() * f64::from(i) / 10.0;
                    let north = frame.height_m() * f64::from(j) / 10.0;
                    let (longitude, latitude) = frame.to_geographic(east, north);
                    let [u, v] = state.current(longitude, latitude, 200.0).unwrap();
                    slowest = slowest.min(u.hypot(v));
                    fastest = fastest.max(u.hypot(v));
                    sum += u.hypot(v);
                    count += 1;
                }
            }
        }
        let mean = sum / f64::from(count);
        println!("speed at 200 m: {slowest:.3} to {fastest:.3}, mean {mean:.3} m/s");
        assert!(slowest >= 0.05 && fastest <= 0.35, "{slowest} {fastest}");
    }

    #[test]
    fn the_sea_floor_falls_to_two_kilometres_and_hides_the_deep_levels() {
        let ocean = SyntheticOcean { states: 1, ..SyntheticOcean::default() };
        let sea = ocean.bathymetry();
        let (mut shallowest, mut deepest) = (f64::MAX, 0.0_f64);
        for i in 0..=30 {
            for j in 0..=28 {
                let longitude = 118.1 + f64::from(i) * 0.01;
                let latitude = 21.60 + f64::from(j) * 0.01;
                let depth = sea.depth_m(longitude, latitude).unwrap();
                shallowest = shallowest.min(depth);
                deepest = deepest.max(depth);
            }
        }
        println!("depth over the region: {shallowest:.0} to {deepest:.0} m");
        assert!((700.0..1000.0).contains(&shallowest) && (1850.0..2100.0).contains(&deepest));

        let state = &ocean.forecast().states[0];
        let grid = &state.grid;
        for (row, &latitude) in grid.latitude_deg.iter().enumerate() {
            for (column, &longitude) in grid.longitude_deg.iter().enumerate() {
                let bottom = seafloor::depth_m(longitude, latitude);
                assert!(bottom < 2865.0 && bottom > 100.0, "{bottom}");
                for (level, &depth) in grid.depth_m.iter().enumerate() {
                    let wet = !state.temperature_c[grid.index(level, row, column)].is_nan();
                    assert_eq!(wet, depth <= bottom);
                }
            }
        }
    }
}
