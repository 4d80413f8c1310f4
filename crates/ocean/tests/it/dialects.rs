//! Every dialect gives the values that xarray reads from it.

use crate::dialect;
use sonarfleet_ocean::io::{ForecastRequest, inspect, read_bathymetry, read_forecast};
use sonarfleet_ocean::potential_temperature::{potential_c, pressure_dbar};
use sonarfleet_ocean::{Forecast, OceanState, Quantity, Region};
use std::path::PathBuf;

/// Values are `f32` here and `f32` or `f64` there.
const RELATIVE: f64 = 3e-7;

const EVERYTHING: ForecastRequest = ForecastRequest { required: &[], region: None, span: None };

/// A row of `expected.csv`.
struct Expected {
    variable: String,
    time: String,
    depth_m: f64,
    latitude_deg: f64,
    longitude_deg: f64,
    value: f64,
}

fn expected(file: &str) -> Vec<Expected> {
    let text = std::fs::read_to_string(dialect("expected.csv")).unwrap();
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let rows: Vec<Expected> = rows
        .filter(|row| row[0] == file)
        .map(|row| Expected {
            variable: row[1].to_owned(),
            time: row[2].to_owned(),
            depth_m: row[3].parse().unwrap(),
            latitude_deg: row[4].parse().unwrap(),
            longitude_deg: row[5].parse().unwrap(),
            value: row[6].trim().parse().unwrap(),
        })
        .collect();
    assert!(!rows.is_empty(), "no expectations for {file}");
    rows
}

fn quantity(variable: &str) -> Quantity {
    match variable {
        "thetao" | "water_temp" => Quantity::Temperature,
        "so" | "salinity" => Quantity::Salinity,
        "uo" | "water_u" => Quantity::CurrentEast,
        "vo" | "water_v" => Quantity::CurrentNorth,
        other => panic!("unexpected variable {other}"),
    }
}

fn nearest(axis: &[f64], value: f64) -> usize {
    let found = axis.iter().position(|node| (node - value).abs() < 1e-5 * (1.0 + value.abs()));
    found.unwrap_or_else(|| panic!("{value} not on {axis:?}"))
}

fn node_value(state: &OceanState, quantity: Quantity, row: &Expected) -> f64 {
    let grid = &state.grid;
    let first = grid.longitude_deg[0];
    let longitude = first + (row.longitude_deg - first + 1e-4).rem_euclid(360.0) - 1e-4;
    let node = grid.index(
        nearest(&grid.depth_m, row.depth_m),
        nearest(&grid.latitude_deg, row.latitude_deg),
        nearest(&grid.longitude_deg, longitude),
    );
    f64::from(state.values(quantity)[node])
}

fn check(file: &str, forecast: &Forecast) {
    let mut worst: f64 = 0.0;
    for row in expected(file) {
        let state = forecast.states.iter().find(|state| state.time.to_string() == row.time);
        let state = state.unwrap_or_else(|| panic!("{file}: no state at {}", row.time));
        let mut found = node_value(state, quantity(&row.variable), &row);
        if row.variable == "thetao" && !found.is_nan() {
            let row_pressure = pressure_dbar(row.depth_m, row.latitude_deg);
            let salinity = if state.salinity_psu.is_empty() {
                34.7
            } else {
                node_value(state, Quantity::Salinity, &row)
            };
            found = potential_c(found, salinity, row_pressure);
        }
        assert_eq!(found.is_nan(), row.value.is_nan(), "{file} {} {}", row.variable, row.value);
        if !found.is_nan() {
            let scale = row.value.abs().max(0.1);
            worst = worst.max((found - row.value).abs() / scale);
        }
    }
    println!("{file}: largest relative difference from xarray {worst:.1e}");
    assert!(worst <= RELATIVE, "{file}: {worst}");
}

#[test]
fn single_files_of_all_dialects_give_what_xarray_gives() {
    for file in [
        "cmems_t.nc",
        "cmems_s.nc",
        "cmems_uv.nc",
        "seconds_nan_fill.nc",
        "int16.nc",
        "netcdf3.nc",
        "elevation_axis.nc",
        "descending_transposed.nc",
        "currents_only_days.nc",
        "superblock_v0.nc",
        "hycom.nc",
        "scalar_time.nc",
    ] {
        let forecast = read_forecast(&[dialect(file)], &EVERYTHING)
            .unwrap_or_else(|error| panic!("{file}: {error:?}"));
        check(file, &forecast);
    }
}

#[test]
fn separate_files_are_merged_in_any_order() {
    let files: Vec<PathBuf> = ["cmems_uv.nc", "cmems_t.nc", "cmems_s.nc"].map(dialect).to_vec();
    let request = ForecastRequest { required: &Quantity::ALL, ..EVERYTHING };
    let merged = read_forecast(&files, &request).unwrap();
    assert_eq!(merged.states.len(), 2);
    let together = read_forecast(&[dialect("seconds_nan_fill.nc")], &request).unwrap();
    let bits = |values: &[f32]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    for (a, b) in merged.states.iter().zip(&together.states) {
        assert_eq!(a.time, b.time);
        for quantity in Quantity::ALL {
            assert_eq!(bits(a.values(quantity)), bits(b.values(quantity)), "{quantity}");
        }
    }
}

#[test]
fn only_what_is_needed_is_required() {
    let currents = ForecastRequest { required: &Quantity::CURRENTS, ..EVERYTHING };
    let forecast = read_forecast(&[dialect("currents_only_days.nc")], &currents).unwrap();
    let state = &forecast.states[0];
    assert!(state.temperature_c.is_empty());
    assert!(state.current(118.1, 21.6, 50.0).is_some());
    assert!(state.column(118.1, 21.6).unwrap().temperature_c.iter().all(|t| t.is_nan()));
}

#[test]
fn potential_temperature_becomes_temperature_in_situ() {
    let forecast = read_forecast(&[dialect("seconds_nan_fill.nc")], &EVERYTHING).unwrap();
    let state = &forecast.states[0];
    let hycom = read_forecast(&[dialect("hycom.nc")], &EVERYTHING).unwrap();
    let node = state.grid.index(2, 1, 1);
    let warming = state.temperature_c[node] - hycom.states[0].temperature_c[node];
    // HYCOM's file holds the same numbers, as temperature in situ: 7 °C at 1062 m.
    assert!((0.09..0.12).contains(&warming), "{warming}");
}

#[test]
fn longitudes_across_greenwich_are_one_piece() {
    let region = Region { west_deg: -0.1, east_deg: 0.05, south_deg: 21.55, north_deg: 21.6 };
    let request = ForecastRequest { region: Some(region), ..EVERYTHING };
    let forecast = read_forecast(&[dialect("hycom.nc")], &request).unwrap();
    let state = &forecast.states[0];
    assert!(state.grid.covers(region));
    let [east, _] = state.current(-0.04, 21.55, 0.494_025).unwrap();
    let [west, _] = state.current(359.92, 21.55, 0.494_025).unwrap();
    assert!(east > west);
}

#[test]
fn bathymetry_of_all_dialects_is_the_same_sea() {
    for file in [
        "bathymetry_gebco.nc",
        "bathymetry_etopo2022.nc",
        "bathymetry_etopo2.nc",
        "bathymetry_etopo5.nc",
        "bathymetry_deptho.nc",
    ] {
        let sea = read_bathymetry(&dialect(file), None)
            .unwrap_or_else(|error| panic!("{file}: {error:?}"));
        for row in expected(file) {
            let found = sea.depth_m(row.longitude_deg, row.latitude_deg).unwrap();
            let sign = if row.variable == "deptho" { 1.0 } else { -1.0 };
            let value = if row.value.is_nan() { 0.0 } else { sign * row.value };
            // Coordinates are printed to 10⁻⁷ degrees, over a slope of 5 m per 0.001°.
            assert!((found - value).abs() < 2e-3, "{file}: {found} {value}");
        }
        assert!((sea.depth_m(118.05, 21.55).unwrap() - 2230.0).abs() < 0.05);
        assert_eq!(sea.depth_m(119.0, 21.6), None);
    }
    let region = Region { west_deg: 118.15, east_deg: 118.16, south_deg: 21.6, north_deg: 21.61 };
    let part = read_bathymetry(&dialect("bathymetry_gebco.nc"), Some(region)).unwrap();
    assert!(part.span().east_deg <= 118.5 + 1e-9);
}

#[test]
fn inspection_tells_what_a_file_holds() {
    let found = inspect(&dialect("int16.nc")).unwrap();
    assert_eq!(found.format, "NetCDF-4");
    assert_eq!(found.variables.len(), 4);
    let temperature = found.variables.iter().find(|v| v.name == "thetao").unwrap();
    assert_eq!(temperature.role.as_deref(), Some("potential temperature"));
    assert_eq!(temperature.shape, [2, 3, 3, 4]);
    assert!(temperature.encoding.starts_with("i16, _FillValue -32767, scale_factor"));
    assert!((temperature.missing_fraction - 8.0 / 72.0).abs() < 1e-12);
    assert!(temperature.minimum > 6.0 && temperature.maximum < 29.0);
    let (start, end) = found.time_span.unwrap();
    assert_eq!(start.to_string(), "2025-10-09T00:00:00Z");
    assert_eq!(end.to_string(), "2025-10-09T06:00:00Z");
    assert_eq!(found.time_step_h, Some(6.0));
    let text = found.to_string();
    for expected in ["longitude", "every 0.0833", "2025-10-09", "potential temperature"] {
        assert!(text.contains(expected), "{expected} not in\n{text}");
    }
    let map = inspect(&dialect("bathymetry_gebco.nc")).unwrap();
    assert_eq!(map.format, "NetCDF-3 classic");
    assert_eq!(map.variables[0].role.as_deref(), Some("bathymetry (height, positive up)"));
}
