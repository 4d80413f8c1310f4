//! Reading bathymetry.

use super::NetcdfFile;
use super::coordinates::{AxisRole, axis};
use super::layout::{find_bathymetry, is_depth, searched_bathymetry_names};
use super::selection::{Selected, refuse_unknown_dimensions, select_region};
use super::source::{DataSource, read_decoded};
use crate::{Bathymetry, OceanError, Region};
use std::path::Path;

/// Reads the depth of the sea from a NetCDF file: GEBCO, ETOPO and SRTM15 (heights,
/// positive up), Copernicus Marine static files (`deptho`, positive down, missing on
/// land). With a region, only that part and a few nodes around it.
///
/// # Errors
/// What is wrong with the file, see [`OceanError`].
pub fn read_bathymetry(path: &Path, region: Option<Region>) -> Result<Bathymetry, OceanError> {
    bathymetry_from(&NetcdfFile::open(path)?, region)
}

/// As [`read_bathymetry`], from an open source.
///
/// # Errors
/// What is wrong with the source, see [`OceanError`].
pub fn bathymetry_from(
    source: &dyn DataSource,
    region: Option<Region>,
) -> Result<Bathymetry, OceanError> {
    let variable = find_bathymetry(source).ok_or_else(|| OceanError::MissingVariable {
        wanted: "bathymetry".to_owned(),
        names: searched_bathymetry_names(),
        files: vec![source.path().to_owned()],
    })?;
    let latitude = axis(source, variable, AxisRole::Latitude)?;
    let longitude = axis(source, variable, AxisRole::Longitude)?;
    let known = [latitude.dimension, longitude.dimension];
    refuse_unknown_dimensions(source, variable, &known)?;
    let (rows, columns) = select_region(source, latitude, longitude, region)?;
    let mut selection = vec![0..1; variable.dimensions.len()];
    for selected in [&rows, &columns] {
        if let Some(position) = selected.axis.dimension {
            selection[position] = selected.file_range();
        }
    }
    let values = read_decoded(source, variable, &selection)?;
    if values.iter().all(|value| value.is_nan()) {
        return Err(OceanError::OnlyMissingValues {
            path: source.path().to_owned(),
            variable: variable.name.clone(),
        });
    }
    let depth = |value: f64| match (is_depth(variable), value.is_nan()) {
        // Files of depths leave land out: there the sea is 0 m deep.
        (true, true) => 0.0,
        (true, false) => value as f32,
        (false, _) => -value as f32,
    };
    let (row_offsets, column_offsets) = (rows.offsets(&selection), columns.offsets(&selection));
    let mut values_m = Vec::with_capacity(row_offsets.len() * column_offsets.len());
    for row in &row_offsets {
        values_m.extend(column_offsets.iter().map(|column| depth(values[row + column])));
    }
    let Selected { coordinates: latitude_deg, .. } = rows;
    Ok(Bathymetry { longitude_deg: columns.coordinates, latitude_deg, values_m })
}
