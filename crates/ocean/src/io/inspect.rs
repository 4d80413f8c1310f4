//! What a file holds, for people.

use super::attribute::Attribute;
use super::coordinates::{AxisRole, axis, find_coordinate, role_of};
use super::layout::role;
use super::source::{DataSource, VariableInfo, read_decoded};
use super::{NetcdfFile, time};
use crate::OceanError;
use jiff::Timestamp;
use serde::Serialize;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Values read at a time, so that global files fit into memory.
const LARGEST_BLOCK: usize = 1 << 23;

/// What a file holds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Inspection {
    /// The file.
    pub path: PathBuf,
    /// The file format.
    pub format: String,
    /// The file's title, if it has one.
    pub title: Option<String>,
    /// Names and lengths of the dimensions.
    pub dimensions: Vec<(String, usize)>,
    /// The axes of the variables that are understood.
    pub axes: Vec<AxisInspection>,
    /// First and last time, if there are times.
    pub time_span: Option<(Timestamp, Timestamp)>,
    /// Hours between the first two times.
    pub time_step_h: Option<f64>,
    /// The variables that are not coordinates.
    pub variables: Vec<VariableInspection>,
}

/// An axis, in our conventions: ascending, depths positive down.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AxisInspection {
    /// "depth", "latitude" or "longitude".
    pub role: String,
    /// The dimension's name in the file.
    pub name: String,
    /// Number of nodes.
    pub length: usize,
    /// Smallest coordinate.
    pub first: f64,
    /// Largest coordinate.
    pub last: f64,
    /// Smallest distance of two nodes; NaN for a single one.
    pub smallest_spacing: f64,
    /// Largest distance of two nodes; NaN for a single one.
    pub largest_spacing: f64,
}

/// A variable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariableInspection {
    /// Its name.
    pub name: String,
    /// What it is, if it is understood: "potential temperature", "bathymetry (…)".
    pub role: Option<String>,
    /// Its units, if given.
    pub units: Option<String>,
    /// Names of its dimensions.
    pub dimensions: Vec<String>,
    /// Lengths of its dimensions.
    pub shape: Vec<usize>,
    /// How it is stored: type, fill value, scale and offset.
    pub encoding: String,
    /// Smallest value, decoded; NaN if all are missing.
    pub minimum: f64,
    /// Largest value, decoded; NaN if all are missing.
    pub maximum: f64,
    /// Fraction of missing values.
    pub missing_fraction: f64,
}

/// Says what a NetCDF file holds. All values are read, a block at a time.
///
/// # Errors
/// The file is missing, not NetCDF or damaged, or has an axis that is not monotonic or
/// times that are not understood.
pub fn inspect(path: &Path) -> Result<Inspection, OceanError> {
    let file = NetcdfFile::open(path)?;
    let mut dimensions: Vec<(String, usize)> = Vec::new();
    for dimension in file.variables().iter().flat_map(|variable| &variable.dimensions) {
        let entry = (dimension.name.clone(), dimension.length);
        if !dimensions.contains(&entry) {
            dimensions.push(entry);
        }
    }
    let is_coordinate =
        |variable: &&VariableInfo| variable.dimensions.len() <= 1 && role_of(variable).is_some();
    let numeric = |variable: &&VariableInfo| {
        !["char", "string", "user-defined"].contains(&variable.storage.as_str())
    };
    let mut variables = Vec::new();
    for variable in file.variables().iter().filter(|v| !is_coordinate(v)).filter(numeric) {
        variables.push(inspect_variable(&file, variable)?);
    }
    let understood = variables.iter().find(|variable| variable.role.is_some());
    let main = understood.and_then(|variable| file.variable(&variable.name));
    let (mut axes, mut times) = (Vec::new(), Vec::new());
    if let Some(main) = main {
        for role in [AxisRole::Depth, AxisRole::Latitude, AxisRole::Longitude] {
            if find_coordinate(&file, main, role).is_some() {
                axes.push(inspect_axis(&file, main, role)?);
            }
        }
        if let Some((coordinate, _)) = find_coordinate(&file, main, AxisRole::Time) {
            let values = read_decoded(&file, coordinate, &coordinate.everything())?;
            times = time::decode(&file, coordinate, &values)?;
        }
    }
    times.sort_unstable();
    let hours = |from: Timestamp, to: Timestamp| to.duration_since(from).as_secs_f64() / 3600.0;
    Ok(Inspection {
        path: path.to_owned(),
        format: file.format(),
        title: title(file.attributes()),
        dimensions,
        axes,
        time_span: times.first().copied().zip(times.last().copied()),
        time_step_h: (times.len() > 1).then(|| hours(times[0], times[1])),
        variables,
    })
}

fn title(attributes: &[Attribute]) -> Option<String> {
    let found = attributes.iter().find(|attribute| attribute.name == "title")?;
    Some(found.value.to_string())
}

fn inspect_axis(
    file: &NetcdfFile,
    variable: &VariableInfo,
    role: AxisRole,
) -> Result<AxisInspection, OceanError> {
    let axis = axis(file, variable, role)?;
    let spacings = || axis.nodes.windows(2).map(|pair| pair[1] - pair[0]);
    let name = axis.dimension.map_or_else(String::new, |i| variable.dimensions[i].name.clone());
    Ok(AxisInspection {
        role: role.to_string(),
        name,
        length: axis.nodes.len(),
        first: axis.nodes[0],
        last: axis.nodes[axis.nodes.len() - 1],
        smallest_spacing: spacings().fold(f64::NAN, f64::min),
        largest_spacing: spacings().fold(f64::NAN, f64::max),
    })
}

fn inspect_variable(
    file: &NetcdfFile,
    variable: &VariableInfo,
) -> Result<VariableInspection, OceanError> {
    let (mut minimum, mut maximum) = (f64::NAN, f64::NAN);
    let (mut missing, mut count) = (0_usize, 0_usize);
    let everything = variable.everything();
    let outer = everything.first().cloned().unwrap_or(0..1);
    let inner: usize = everything.iter().skip(1).map(Range::len).product();
    let block = (LARGEST_BLOCK / inner.max(1)).max(1);
    for start in outer.clone().step_by(block) {
        let mut selection = everything.clone();
        if let Some(first) = selection.first_mut() {
            *first = start..(start + block).min(outer.end);
        }
        for value in read_decoded(file, variable, &selection)? {
            count += 1;
            missing += usize::from(value.is_nan());
            minimum = minimum.min(value);
            maximum = maximum.max(value);
        }
    }
    let packing = ["_FillValue", "missing_value", "scale_factor", "add_offset"];
    let given = |name: &&str| Some(format!("{name} {}", short(variable.number(name)?)));
    let parts: Vec<String> =
        std::iter::once(variable.storage.clone()).chain(packing.iter().filter_map(given)).collect();
    Ok(VariableInspection {
        name: variable.name.clone(),
        role: role(file, variable),
        units: variable.text("units").map(str::to_owned),
        dimensions: variable.dimensions.iter().map(|d| d.name.clone()).collect(),
        shape: variable.shape(),
        encoding: parts.join(", "),
        minimum,
        maximum,
        missing_fraction: missing as f64 / count.max(1) as f64,
    })
}

impl fmt::Display for Inspection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}", self.path.display(), self.format)?;
        if let Some(title) = &self.title {
            writeln!(f, "  {title}")?;
        }
        for axis in &self.axes {
            write!(
                f,
                "  {:<10} {:>5} nodes, {} to {}",
                axis.role,
                axis.length,
                short(axis.first),
                short(axis.last)
            )?;
            if axis.smallest_spacing.is_nan() {
                writeln!(f)?;
            } else if axis.largest_spacing < 1.01 * axis.smallest_spacing {
                writeln!(f, ", every {:.6}", axis.smallest_spacing)?;
            } else {
                writeln!(f, ", {:.4} to {:.4} apart", axis.smallest_spacing, axis.largest_spacing)?;
            }
        }
        if let Some((start, end)) = self.time_span {
            write!(f, "  {:<10} {start} to {end}", "time")?;
            match self.time_step_h {
                Some(step) => writeln!(f, ", every {step} h")?,
                None => writeln!(f)?,
            }
        }
        for variable in &self.variables {
            let shape: Vec<String> = variable
                .dimensions
                .iter()
                .zip(&variable.shape)
                .map(|(name, length)| format!("{name} {length}"))
                .collect();
            writeln!(
                f,
                "  {}({}): {}",
                variable.name,
                shape.join(", "),
                variable.role.as_deref().unwrap_or("not used")
            )?;
            writeln!(
                f,
                "    {} to {} {}, {:.1} % missing; stored as {}",
                short(variable.minimum),
                short(variable.maximum),
                variable.units.as_deref().unwrap_or("(no units)"),
                100.0 * variable.missing_fraction,
                variable.encoding
            )?;
        }
        Ok(())
    }
}

/// A number with six significant digits or decimals, without trailing zeros.
fn short(value: f64) -> String {
    if value != 0.0 && !(1e-4..1e7).contains(&value.abs()) {
        return format!("{value:.6e}");
    }
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
