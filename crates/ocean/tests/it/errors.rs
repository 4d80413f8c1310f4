//! Bad input says what was asked, what was found, and where.

use crate::dialect;
use jiff::{SignedDuration, Timestamp};
use sonarfleet_ocean::io::{
    Attribute, Dataset, ForecastRequest, Values, bathymetry_from, forecast_from, inspect,
    read_bathymetry, read_field, read_forecast,
};
use sonarfleet_ocean::{OceanError, Quantity, Region};
use std::path::{Path, PathBuf};

const EVERYTHING: ForecastRequest = ForecastRequest { required: &[], region: None, span: None };

fn read_one(path: PathBuf) -> OceanError {
    read_forecast(&[path], &EVERYTHING).unwrap_err()
}

/// A data set with one current over the given axes.
fn current(times: &[f64], units: &str, latitudes: &[f64], value: f32) -> Dataset {
    let mut data = Dataset::new("test");
    let units = [Attribute::text("units", units)];
    data.add_coordinate("time", Values::F64(times.to_vec()), &units);
    data.add_coordinate("depth", Values::F64(vec![0.5]), &[]);
    data.add_coordinate("latitude", Values::F64(latitudes.to_vec()), &[]);
    data.add_coordinate("longitude", Values::F64(vec![10.0, 11.0]), &[]);
    let count = times.len() * latitudes.len() * 2;
    let dimensions = ["time", "depth", "latitude", "longitude"];
    data.add_variable("uo", &dimensions, Values::F32(vec![value; count]), &[]);
    data
}

const HOURS: &str = "hours since 1950-01-01";

fn from_memory(data: &Dataset) -> OceanError {
    forecast_from(&[data], &EVERYTHING).unwrap_err()
}

#[test]
fn missing_and_foreign_files() {
    let error = read_one(PathBuf::from("no/such/file.nc"));
    assert!(matches!(error, OceanError::Unreadable { .. }), "{error:?}");
    assert_eq!(error.to_string(), "cannot read no/such/file.nc");

    let error = read_one(dialect("make.py"));
    assert!(matches!(error, OceanError::NotNetcdf { .. }), "{error:?}");
    assert!(error.to_string().contains("is not a NetCDF file: found a file that starts with"));

    let directory = tempfile::tempdir().unwrap();
    assert!(matches!(read_one(directory.path().to_owned()), OceanError::Unreadable { .. }));
    let empty = directory.path().join("empty.nc");
    std::fs::write(&empty, b"").unwrap();
    assert!(read_one(empty).to_string().contains("an empty file"));
}

#[test]
fn truncated_files() {
    let directory = tempfile::tempdir().unwrap();
    for file in ["netcdf3.nc", "seconds_nan_fill.nc", "int16.nc"] {
        let bytes = std::fs::read(dialect(file)).unwrap();
        let path = directory.path().join(file);
        std::fs::write(&path, &bytes[..bytes.len() * 2 / 3]).unwrap();
        let error = read_one(path);
        assert!(matches!(error, OceanError::Damaged { .. }), "{file}: {error:?}");
        assert!(error.to_string().contains("truncated"), "{error}");
    }
}

#[test]
fn missing_variables() {
    let request = ForecastRequest { required: &Quantity::SOUND, ..EVERYTHING };
    let files = [dialect("cmems_t.nc"), dialect("cmems_uv.nc")];
    let text = read_forecast(&files, &request).unwrap_err().to_string();
    assert!(text.starts_with("no salinity in "), "{text}");
    assert!(text.contains("cmems_t.nc") && text.contains("cmems_uv.nc") && text.contains("so, "));

    let error = read_one(dialect("bathymetry_gebco.nc"));
    assert!(matches!(error, OceanError::MissingVariable { .. }), "{error:?}");
    let error = read_bathymetry(&dialect("cmems_t.nc"), None).unwrap_err();
    assert!(error.to_string().starts_with("no bathymetry in "), "{error}");
    assert!(read_field(&dialect("cmems_t.nc"), "zos").unwrap_err().to_string().contains("zos"));
}

#[test]
fn regions_and_times_outside_the_data() {
    let region = Region { west_deg: 118.1, east_deg: 118.4, south_deg: 21.6, north_deg: 21.65 };
    let request = ForecastRequest { region: Some(region), ..EVERYTHING };
    let error = read_forecast(&[dialect("int16.nc")], &request).unwrap_err();
    let OceanError::RegionOutsideData { asked, span, .. } = &error else {
        panic!("{error:?}");
    };
    assert_eq!(*asked, region);
    assert!((span.east_deg - 118.25).abs() < 1e-4);
    assert!(error.to_string().contains("118.1 to 118.4° E"), "{error}");
    let error = read_bathymetry(
        &dialect("bathymetry_gebco.nc"),
        Some(Region { north_deg: 25.0, ..region }),
    );
    assert!(matches!(error, Err(OceanError::RegionOutsideData { .. })));

    let start: Timestamp = "2025-10-09T00:00:00Z".parse().unwrap();
    let span = Some((start, start + SignedDuration::from_hours(7)));
    let request = ForecastRequest { span, ..EVERYTHING };
    let error = read_forecast(&[dialect("int16.nc")], &request).unwrap_err();
    assert_eq!(
        error.to_string(),
        "no ocean state for 2025-10-09T07:00:00Z: the data span 2025-10-09T00:00:00Z to 2025-10-09T06:00:00Z"
    );
}

#[test]
fn times_that_are_none() {
    let error = from_memory(&current(&[], HOURS, &[0.0, 1.0], 0.1));
    assert!(matches!(error, OceanError::NoTimeSteps { .. }), "{error:?}");
    let error = from_memory(&current(&[1.0], "months since 1950-01-01", &[0.0, 1.0], 0.1));
    assert!(error.to_string().contains("\"months since 1950-01-01\""), "{error}");
    let error = from_memory(&current(&[f64::NAN], HOURS, &[0.0, 1.0], 0.1));
    assert!(matches!(error, OceanError::TimeUnits { .. }), "{error:?}");

    let mut other = Dataset::new("another day");
    let units = [Attribute::text("units", HOURS)];
    other.add_coordinate("time", Values::F64(vec![700_000.0]), &units);
    other.add_coordinate("depth", Values::F64(vec![0.5]), &[]);
    other.add_coordinate("latitude", Values::F64(vec![0.0, 1.0]), &[]);
    other.add_coordinate("longitude", Values::F64(vec![10.0, 11.0]), &[]);
    let dimensions = ["time", "depth", "latitude", "longitude"];
    other.add_variable("vo", &dimensions, Values::F32(vec![0.0; 4]), &[]);
    let east = current(&[1.0], HOURS, &[0.0, 1.0], 0.1);
    let error = forecast_from(&[&east, &other], &EVERYTHING).unwrap_err();
    assert!(error.to_string().contains("no time in common"), "{error}");
}

#[test]
fn axes_that_are_none() {
    let error = from_memory(&current(&[1.0], HOURS, &[0.0, 2.0, 1.0], 0.1));
    assert_eq!(
        error.to_string(),
        "data set in memory: coordinate latitude is not monotonic: 2 is followed by 1"
    );
    let error = from_memory(&current(&[1.0], HOURS, &[0.0, f64::NAN], 0.1));
    assert!(matches!(error, OceanError::AxisNotMonotonic { .. }), "{error:?}");
    let error = from_memory(&current(&[1.0], HOURS, &[], 0.1));
    assert!(matches!(error, OceanError::EmptyAxis { .. }), "{error:?}");

    let mut bare = Dataset::new("no coordinates");
    bare.add_dimension("j", 2);
    bare.add_dimension("i", 2);
    bare.add_variable("elevation", &["j", "i"], Values::F32(vec![-1.0; 4]), &[]);
    let error = bathymetry_from(&bare, None).unwrap_err();
    assert!(error.to_string().contains("no one-dimensional latitude coordinate"), "{error}");
}

#[test]
fn grids_that_differ() {
    let east = current(&[1.0], HOURS, &[0.0, 1.0], 0.1);
    let files = [dialect("cmems_t.nc"), dialect("hycom.nc")];
    let error = read_forecast(&files, &EVERYTHING).unwrap_err();
    assert!(matches!(error, OceanError::GridMismatch { .. }), "{error:?}");
    assert!(error.to_string().contains("hycom.nc"), "{error}");
    assert!(forecast_from(&[&east], &EVERYTHING).is_ok());
}

#[test]
fn currents_that_are_all_missing() {
    let error = from_memory(&current(&[1.0], HOURS, &[0.0, 1.0], f32::NAN));
    assert_eq!(
        error.to_string(),
        "data set in memory: variable uo holds only missing values in the region"
    );
}

#[test]
fn inspection_of_bad_files_fails_too() {
    assert!(inspect(Path::new("no/such/file.nc")).is_err());
    assert!(inspect(&dialect("make.py")).is_err());
}
