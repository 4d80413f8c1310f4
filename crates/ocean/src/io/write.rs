//! Writing ocean states and bathymetry in the layouts that the readers know best.

use super::attribute::{Attribute, AttributeValue};
use super::dataset::{Dataset, Values};
use crate::potential_temperature::{in_situ_c, potential_c, pressure_dbar};
use crate::{Bathymetry, Forecast, OceanError, OceanState, Quantity};
use std::path::{Path, PathBuf};

/// The fill value of Copernicus Marine files.
const FILL: f32 = 9.969_21e36;

/// Heights of GEBCO are whole metres; this one stands for no value.
const NO_HEIGHT: i16 = -32767;

/// Writes a forecast as three files in the layout that `copernicusmarine subset` gives:
/// `thetao.nc`, `so.nc` and `uo_vo.nc`, of which those that have no quantity are left
/// out. Temperatures become potential temperatures, each the `f32` whose conversion back
/// to temperature in situ comes nearest to the state's.
///
/// # Errors
/// [`OceanError::NoTimeSteps`] for an empty forecast, or what goes wrong in writing.
pub fn write_forecast(
    forecast: &Forecast,
    directory: &Path,
    title: &str,
) -> Result<Vec<PathBuf>, OceanError> {
    let files: [(&str, &[Quantity]); 3] = [
        ("thetao.nc", &[Quantity::Temperature]),
        ("so.nc", &[Quantity::Salinity]),
        ("uo_vo.nc", &Quantity::CURRENTS),
    ];
    forecast.span()?;
    let mut written = Vec::new();
    for (name, quantities) in files {
        let held = |quantity: &Quantity| !forecast.states[0].values(*quantity).is_empty();
        let quantities: Vec<Quantity> = quantities.iter().copied().filter(held).collect();
        if quantities.is_empty() {
            continue;
        }
        let mut data = layout(forecast, title);
        for quantity in quantities {
            add_quantity(&mut data, forecast, quantity);
        }
        let path = directory.join(name);
        data.write(&path)?;
        written.push(path);
    }
    Ok(written)
}

/// Writes bathymetry in the layout of GEBCO: `elevation(lat, lon)`, whole metres,
/// positive up.
///
/// # Errors
/// What goes wrong in writing.
pub fn write_bathymetry(
    bathymetry: &Bathymetry,
    path: &Path,
    title: &str,
) -> Result<(), OceanError> {
    let mut data = Dataset::new(title);
    let coordinates = [
        ("lat", "latitude", "degrees_north", "Y", &bathymetry.latitude_deg),
        ("lon", "longitude", "degrees_east", "X", &bathymetry.longitude_deg),
    ];
    for (name, standard_name, units, axis, values) in coordinates {
        let attributes = described(standard_name, standard_name, units, axis);
        data.add_coordinate(name, Values::F64(values.clone()), &attributes);
    }
    let height = |&depth: &f32| if depth.is_nan() { NO_HEIGHT } else { (-depth).round() as i16 };
    data.add_variable(
        "elevation",
        &["lat", "lon"],
        Values::I16(bathymetry.values_m.iter().map(height).collect()),
        &[
            Attribute {
                name: "_FillValue".to_owned(),
                value: AttributeValue::I16(vec![NO_HEIGHT]),
            },
            Attribute::text("standard_name", "height_above_mean_sea_level"),
            Attribute::text("long_name", "Elevation relative to sea level"),
            Attribute::text("units", "m"),
        ],
    );
    data.write(path)
}

/// The coordinates all files share.
fn layout(forecast: &Forecast, title: &str) -> Dataset {
    let grid = &forecast.states[0].grid;
    let mut data = Dataset::new(title);
    let seconds = forecast.states.iter().map(|state| state.time.as_second() as f64);
    let mut time = described("time", "Time", "seconds since 1970-01-01", "T");
    time.push(Attribute::text("calendar", "gregorian"));
    data.add_coordinate("time", Values::F64(seconds.collect()), &time);
    let mut depth = described("depth", "Depth", "m", "Z");
    depth.push(Attribute::text("positive", "down"));
    let single = |values: &[f64]| Values::F32(values.iter().map(|&value| value as f32).collect());
    data.add_coordinate("depth", single(&grid.depth_m), &depth);
    let latitude = described("latitude", "Latitude", "degrees_north", "Y");
    data.add_coordinate("latitude", single(&grid.latitude_deg), &latitude);
    let longitude = described("longitude", "Longitude", "degrees_east", "X");
    data.add_coordinate("longitude", single(&grid.longitude_deg), &longitude);
    data
}

fn described(standard_name: &str, long_name: &str, units: &str, axis: &str) -> Vec<Attribute> {
    vec![
        Attribute::text("standard_name", standard_name),
        Attribute::text("long_name", long_name),
        Attribute::text("units", units),
        Attribute::text("axis", axis),
    ]
}

fn add_quantity(data: &mut Dataset, forecast: &Forecast, quantity: Quantity) {
    let (name, standard_name, units) = match quantity {
        Quantity::Temperature => ("thetao", "sea_water_potential_temperature", "degrees_C"),
        Quantity::Salinity => ("so", "sea_water_salinity", "1e-3"),
        Quantity::CurrentEast => ("uo", "eastward_sea_water_velocity", "m s-1"),
        Quantity::CurrentNorth => ("vo", "northward_sea_water_velocity", "m s-1"),
    };
    let mut values = Vec::new();
    for state in &forecast.states {
        match quantity {
            Quantity::Temperature => values.extend(potential_temperatures(state)),
            _ => values.extend_from_slice(state.values(quantity)),
        }
    }
    for value in &mut values {
        if value.is_nan() {
            *value = FILL;
        }
    }
    let attributes = [
        Attribute { name: "_FillValue".to_owned(), value: AttributeValue::F32(vec![FILL]) },
        Attribute::text("standard_name", standard_name),
        Attribute::text("long_name", quantity.to_string()),
        Attribute::text("units", units),
    ];
    let dimensions = ["time", "depth", "latitude", "longitude"];
    data.add_variable(name, &dimensions, Values::F32(values), &attributes);
}

fn potential_temperatures(state: &OceanState) -> Vec<f32> {
    let grid = &state.grid;
    let mut values = Vec::with_capacity(grid.node_count());
    for (level, &depth) in grid.depth_m.iter().enumerate() {
        for (row, &latitude) in grid.latitude_deg.iter().enumerate() {
            let pressure = pressure_dbar(depth, latitude);
            for column in 0..grid.longitude_deg.len() {
                let node = grid.index(level, row, column);
                let salinity = state.salinity_psu.get(node).copied().filter(|s| !s.is_nan());
                let salinity = salinity.map_or(super::forecast::ASSUMED_SALINITY, f64::from);
                values.push(nearest_potential(state.temperature_c[node], salinity, pressure));
            }
        }
    }
    values
}

/// The `f32` potential temperature whose temperature in situ, as `f32`, is nearest.
fn nearest_potential(temperature_c: f32, salinity_psu: f64, pressure_dbar: f64) -> f32 {
    let best = potential_c(f64::from(temperature_c), salinity_psu, pressure_dbar) as f32;
    let miss = |potential: f32| {
        let back = in_situ_c(f64::from(potential), salinity_psu, pressure_dbar) as f32;
        (back - temperature_c).abs()
    };
    let candidates = [best, best.next_down(), best.next_up()];
    candidates.into_iter().min_by(|&a, &b| miss(a).total_cmp(&miss(b))).unwrap_or(best)
}
