//! Reading ocean states.

use super::coordinates::{AxisRole, axis, find_coordinate};
use super::layout::{find_quantity, is_potential, searched_names, to_our_units};
use super::selection::{Selected, refuse_unknown_dimensions, select_region};
use super::source::{DataSource, VariableInfo, read_decoded};
use super::{NetcdfFile, time};
use crate::axis::TOLERANCE;
use crate::potential_temperature::{in_situ_c, pressure_dbar};
use crate::{Forecast, OceanError, OceanGrid, OceanState, Quantity, Region};
use jiff::Timestamp;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Salinity assumed for the conversion of potential temperature where a file has none:
/// 1 more or less changes the result by 3 mK at 2000 m.
pub(crate) const ASSUMED_SALINITY: f64 = 34.7;

/// What to read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForecastRequest<'a> {
    /// What must be there; other quantities are read where they are.
    pub required: &'a [Quantity],
    /// The region that must be covered; `None` reads all there is.
    pub region: Option<Region>,
    /// The time span that must be covered; `None` reads all times.
    pub span: Option<(Timestamp, Timestamp)>,
}

/// Reads ocean states from NetCDF files, in any order: quantities may be spread over
/// files, and so may times. The states are those at the times that all quantities have.
///
/// # Errors
/// What is wrong with which file, see [`OceanError`].
pub fn read_forecast(files: &[PathBuf], request: &ForecastRequest) -> Result<Forecast, OceanError> {
    let open = |path: &PathBuf| NetcdfFile::open(path);
    let files = files.iter().map(open).collect::<Result<Vec<_>, _>>()?;
    let sources: Vec<&dyn DataSource> = files.iter().map(|file| file as &dyn DataSource).collect();
    forecast_from(&sources, request)
}

/// As [`read_forecast`], from open sources.
///
/// # Errors
/// What is wrong with which source, see [`OceanError`].
pub fn forecast_from(
    sources: &[&dyn DataSource],
    request: &ForecastRequest,
) -> Result<Forecast, OceanError> {
    let files = || sources.iter().map(|source| source.path().to_owned()).collect::<Vec<_>>();
    let mut series = Vec::new();
    for quantity in Quantity::ALL {
        let found = Series::collect(sources, quantity, request.region)?;
        if found.parts.is_empty() {
            if request.required.contains(&quantity) {
                return Err(OceanError::MissingVariable {
                    wanted: quantity.to_string(),
                    names: searched_names(quantity),
                    files: files(),
                });
            }
            continue;
        }
        series.push(found);
    }
    let Some(first) = series.first() else {
        return Err(OceanError::MissingVariable {
            wanted: "ocean variable".to_owned(),
            names: Quantity::ALL.into_iter().flat_map(searched_names).collect(),
            files: files(),
        });
    };
    let grid = Arc::new(first.parts[0].grid());
    for part in series.iter().flat_map(|series| &series.parts) {
        part.check_same_grid(&grid, first.parts[0].source.path())?;
    }
    let times = common_times(&series, &files())?;
    let times = select_times(&times, request.span)?;
    let mut states = Vec::with_capacity(times.len());
    for &time in times {
        states.push(read_state(&series, &grid, time)?);
    }
    let forecast = Forecast { states };
    for series in &series {
        let mut values = forecast.states.iter().flat_map(|state| state.values(series.quantity));
        if values.all(|value| value.is_nan()) {
            let part = &series.parts[0];
            return Err(OceanError::OnlyMissingValues {
                path: part.source.path().to_owned(),
                variable: part.variable.name.clone(),
            });
        }
    }
    Ok(forecast)
}

/// A quantity over time, spread over files.
struct Series<'a> {
    quantity: Quantity,
    parts: Vec<Part<'a>>,
    /// For each time, the part that has it and the index in the file.
    steps: BTreeMap<Timestamp, (usize, usize)>,
}

/// A quantity in one file.
struct Part<'a> {
    source: &'a dyn DataSource,
    variable: &'a VariableInfo,
    time_dimension: Option<usize>,
    depth: Selected,
    latitude: Selected,
    longitude: Selected,
}

impl<'a> Series<'a> {
    fn collect(
        sources: &[&'a dyn DataSource],
        quantity: Quantity,
        region: Option<Region>,
    ) -> Result<Self, OceanError> {
        let mut series = Self { quantity, parts: Vec::new(), steps: BTreeMap::new() };
        for &source in sources {
            let Some(variable) = find_quantity(source, quantity) else { continue };
            let (times, time_dimension) = times_of(source, variable)?;
            for (index, time) in times.into_iter().enumerate() {
                series.steps.entry(time).or_insert((series.parts.len(), index));
            }
            series.parts.push(Part::new(source, variable, time_dimension, region)?);
        }
        Ok(series)
    }
}

fn times_of(
    source: &dyn DataSource,
    variable: &VariableInfo,
) -> Result<(Vec<Timestamp>, Option<usize>), OceanError> {
    let Some((coordinate, dimension)) = find_coordinate(source, variable, AxisRole::Time) else {
        return Err(OceanError::NoTimeSteps { files: vec![source.path().to_owned()] });
    };
    let values = read_decoded(source, coordinate, &coordinate.everything())?;
    if values.is_empty() {
        return Err(OceanError::NoTimeSteps { files: vec![source.path().to_owned()] });
    }
    Ok((time::decode(source, coordinate, &values)?, dimension))
}

impl<'a> Part<'a> {
    fn new(
        source: &'a dyn DataSource,
        variable: &'a VariableInfo,
        time_dimension: Option<usize>,
        region: Option<Region>,
    ) -> Result<Self, OceanError> {
        let depth = axis(source, variable, AxisRole::Depth)?;
        let latitude = axis(source, variable, AxisRole::Latitude)?;
        let longitude = axis(source, variable, AxisRole::Longitude)?;
        let known = [time_dimension, depth.dimension, latitude.dimension, longitude.dimension];
        refuse_unknown_dimensions(source, variable, &known)?;
        let (latitude, longitude) = select_region(source, latitude, longitude, region)?;
        let depth = Selected::all(depth);
        Ok(Self { source, variable, time_dimension, depth, latitude, longitude })
    }

    fn grid(&self) -> OceanGrid {
        OceanGrid {
            longitude_deg: self.longitude.coordinates.clone(),
            latitude_deg: self.latitude.coordinates.clone(),
            depth_m: self.depth.coordinates.clone(),
        }
    }

    fn check_same_grid(&self, grid: &OceanGrid, other: &Path) -> Result<(), OceanError> {
        let axes = [
            (&self.depth, &grid.depth_m),
            (&self.latitude, &grid.latitude_deg),
            (&self.longitude, &grid.longitude_deg),
        ];
        for (ours, theirs) in axes {
            let close = |(a, b): (&f64, &f64)| (a - b).abs() <= TOLERANCE * (1.0 + 0.01 * a.abs());
            let same = ours.coordinates.len() == theirs.len()
                && ours.coordinates.iter().zip(theirs).all(close);
            if !same {
                return Err(OceanError::GridMismatch {
                    path: self.source.path().to_owned(),
                    variable: self.variable.name.clone(),
                    axis: ours.axis.role.to_string(),
                    other: other.to_owned(),
                });
            }
        }
        Ok(())
    }

    /// Values at a time step, decoded, as [depth, latitude, longitude].
    fn read(&self, step: usize) -> Result<Vec<f64>, OceanError> {
        let axes = [&self.depth, &self.latitude, &self.longitude];
        let mut selection = vec![0..1; self.variable.dimensions.len()];
        if let Some(position) = self.time_dimension {
            selection[position] = step..step + 1;
        }
        for selected in axes {
            if let Some(position) = selected.axis.dimension {
                selection[position] = selected.file_range();
            }
        }
        let values = read_decoded(self.source, self.variable, &selection)?;
        let offsets = axes.map(|selected| selected.offsets(&selection));
        let mut ordered = Vec::with_capacity(offsets.iter().map(Vec::len).product());
        for level in &offsets[0] {
            for row in &offsets[1] {
                ordered.extend(offsets[2].iter().map(|column| values[level + row + column]));
            }
        }
        Ok(ordered)
    }
}

/// Times that all quantities have.
fn common_times(series: &[Series], files: &[PathBuf]) -> Result<Vec<Timestamp>, OceanError> {
    let mut times: Vec<Timestamp> = series[0].steps.keys().copied().collect();
    for other in &series[1..] {
        times.retain(|time| other.steps.contains_key(time));
        if times.is_empty() {
            return Err(OceanError::NoCommonTimes {
                first: series[0].quantity,
                second: other.quantity,
                files: files.to_vec(),
            });
        }
    }
    Ok(times)
}

/// The times from the last not after the span's start to the first not before its end.
fn select_times(
    times: &[Timestamp],
    span: Option<(Timestamp, Timestamp)>,
) -> Result<&[Timestamp], OceanError> {
    let Some((from, to)) = span else { return Ok(times) };
    let (start, end) = (times[0], times[times.len() - 1]);
    for asked in [from, to] {
        if asked < start || asked > end {
            return Err(OceanError::TimeOutsideData { asked, start, end });
        }
    }
    let first = times.partition_point(|&time| time <= from) - 1;
    let last = times.partition_point(|&time| time < to);
    Ok(&times[first..=last.max(first)])
}

fn read_state(
    series: &[Series],
    grid: &Arc<OceanGrid>,
    time: Timestamp,
) -> Result<OceanState, OceanError> {
    let mut state = OceanState {
        grid: grid.clone(),
        time,
        temperature_c: Vec::new(),
        salinity_psu: Vec::new(),
        current_east_m_s: Vec::new(),
        current_north_m_s: Vec::new(),
    };
    let mut potential = false;
    for series in series {
        let (part, step) = series.steps[&time];
        let part = &series.parts[part];
        let (factor, offset) =
            to_our_units(series.quantity, part.variable.text("units").unwrap_or(""));
        let values: Vec<f32> =
            part.read(step)?.iter().map(|value| (value * factor + offset) as f32).collect();
        match series.quantity {
            Quantity::Temperature => {
                state.temperature_c = values;
                potential = is_potential(part.variable);
            }
            Quantity::Salinity => state.salinity_psu = values,
            Quantity::CurrentEast => state.current_east_m_s = values,
            Quantity::CurrentNorth => state.current_north_m_s = values,
        }
    }
    if potential {
        to_in_situ(&mut state);
    }
    Ok(state)
}

/// Turns the potential temperature that models give into temperature in situ.
fn to_in_situ(state: &mut OceanState) {
    let grid = state.grid.clone();
    for (level, &depth) in grid.depth_m.iter().enumerate() {
        for (row, &latitude) in grid.latitude_deg.iter().enumerate() {
            let pressure = pressure_dbar(depth, latitude);
            for column in 0..grid.longitude_deg.len() {
                let node = grid.index(level, row, column);
                let salinity = state.salinity_psu.get(node).copied().filter(|s| !s.is_nan());
                let salinity = salinity.map_or(ASSUMED_SALINITY, f64::from);
                let temperature = &mut state.temperature_c[node];
                *temperature = in_situ_c(f64::from(*temperature), salinity, pressure) as f32;
            }
        }
    }
}
