//! What can be wrong with ocean input.

use crate::{Quantity, Region};
use jiff::Timestamp;
use std::path::PathBuf;

/// What can be wrong with ocean input and output.
#[derive(Debug, thiserror::Error)]
pub enum OceanError {
    /// The file cannot be opened or read.
    #[error("cannot read {}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is something else.
    #[error("{} is not a NetCDF file: found {found}", path.display())]
    NotNetcdf {
        /// The file.
        path: PathBuf,
        /// What it looks like.
        found: String,
    },
    /// The file is truncated, damaged, or of a kind that cannot be read.
    #[error("{} is damaged, truncated or of an unsupported kind ({part})", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The part that cannot be read.
        part: String,
        /// Why.
        source: Box<netcdf_reader::Error>,
    },
    /// No file holds a variable that is needed.
    #[error("no {wanted} in {}: looked for {}", list(files), names.join(", "))]
    MissingVariable {
        /// What was wanted.
        wanted: String,
        /// The names looked for.
        names: Vec<String>,
        /// The files looked in.
        files: Vec<PathBuf>,
    },
    /// A variable lacks a coordinate.
    #[error(
        "{}: variable {variable} has no one-dimensional {coordinate} coordinate (its dimensions are {})",
        path.display(),
        dimensions.join(", ")
    )]
    MissingCoordinate {
        /// The file.
        path: PathBuf,
        /// The variable.
        variable: String,
        /// What the coordinate should measure.
        coordinate: String,
        /// The variable's dimensions.
        dimensions: Vec<String>,
    },
    /// A variable has a dimension that is none of time, depth, latitude and longitude.
    #[error("{}: variable {variable} has a dimension {dimension} of length {length} that is not understood", path.display())]
    UnknownDimension {
        /// The file.
        path: PathBuf,
        /// The variable.
        variable: String,
        /// The dimension.
        dimension: String,
        /// Its length.
        length: usize,
    },
    /// A coordinate neither rises nor falls throughout.
    #[error("{}: coordinate {variable} is not monotonic: {before} is followed by {after}", path.display())]
    AxisNotMonotonic {
        /// The file.
        path: PathBuf,
        /// The coordinate variable.
        variable: String,
        /// A value, in ascending order, with longitudes unwrapped and depths positive down.
        before: f64,
        /// The value after it.
        after: f64,
    },
    /// A coordinate has no values.
    #[error("{}: coordinate {variable} is empty", path.display())]
    EmptyAxis {
        /// The file.
        path: PathBuf,
        /// The coordinate variable.
        variable: String,
    },
    /// Times in a unit or calendar that is not understood, or out of all bounds.
    #[error("{}: times of {variable} are not understood: units \"{units}\", calendar \"{calendar}\"", path.display())]
    TimeUnits {
        /// The file.
        path: PathBuf,
        /// The time coordinate.
        variable: String,
        /// Its units.
        units: String,
        /// Its calendar.
        calendar: String,
    },
    /// There is no state at all.
    #[error("no time steps in {}", list(files))]
    NoTimeSteps {
        /// The files looked in; none for a forecast in memory.
        files: Vec<PathBuf>,
    },
    /// Quantities come at times that have nothing in common.
    #[error("{first} and {second} have no time in common in {}", list(files))]
    NoCommonTimes {
        /// One quantity.
        first: Quantity,
        /// The other.
        second: Quantity,
        /// The files looked in.
        files: Vec<PathBuf>,
    },
    /// A time before the first or after the last state.
    #[error("no ocean state for {asked}: the data span {start} to {end}")]
    TimeOutsideData {
        /// The time asked for.
        asked: Timestamp,
        /// First time of the data.
        start: Timestamp,
        /// Last time of the data.
        end: Timestamp,
    },
    /// The region is not covered.
    #[error("{} does not cover the region: asked for {asked}, the file spans {span}", path.display())]
    RegionOutsideData {
        /// The file.
        path: PathBuf,
        /// The region asked for.
        asked: Region,
        /// What the file spans.
        span: Region,
    },
    /// Two files give their quantities on different nodes.
    #[error("{axis} nodes of {variable} in {} differ from those of {}", path.display(), other.display())]
    GridMismatch {
        /// The file.
        path: PathBuf,
        /// Its variable.
        variable: String,
        /// The axis that differs.
        axis: String,
        /// The file it differs from.
        other: PathBuf,
    },
    /// A variable has no value in the region, at any time.
    #[error("{}: variable {variable} holds only missing values in the region", path.display())]
    OnlyMissingValues {
        /// The file.
        path: PathBuf,
        /// The variable.
        variable: String,
    },
    /// A file cannot be written.
    #[error("cannot write {}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// Data that a NetCDF file cannot hold.
    #[error("cannot encode {} as NetCDF", path.display())]
    Unencodable {
        /// The file.
        path: PathBuf,
        /// Why.
        source: Box<netcdf_writer::Error>,
    },
}

fn list(files: &[PathBuf]) -> String {
    if files.is_empty() {
        return "the forecast".to_owned();
    }
    files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>().join(", ")
}
