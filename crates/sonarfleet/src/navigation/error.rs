//! What can go wrong in navigation.

use std::path::PathBuf;

/// Why currents, a planner or a route file could not be made.
#[derive(Debug, thiserror::Error)]
pub enum NavigationError {
    /// An axis of the current field has no nodes, or they do not ascend.
    #[error("axis `{axis}` of the current field must have ascending, finite nodes, found {found}")]
    InvalidAxis {
        /// `east`, `north` or `time`.
        axis: &'static str,
        /// What it holds, in short.
        found: String,
    },
    /// An array of the current field has a wrong number of values.
    #[error("`{component}` current must hold {expected} values [time, north, east], found {found}")]
    WrongShape {
        /// `eastward` or `northward`.
        component: &'static str,
        /// Values that the axes ask for.
        expected: usize,
        /// Values found.
        found: usize,
    },
    /// A current is infinite or too fast to be one (see `CurrentField`).
    #[error(
        "the current at ({east_m:.0} m E, {north_m:.0} m N, {time_h} h) is {speed_m_s} m/s: \
         are the units metres per second?"
    )]
    ImplausibleCurrent {
        /// Eastward coordinate of the node.
        east_m: f64,
        /// Northward coordinate of the node.
        north_m: f64,
        /// Time of the node.
        time_h: f64,
        /// Speed found there.
        speed_m_s: f64,
    },
    /// The field has no node with a current at all times.
    #[error(
        "no current anywhere in the field ({nodes} nodes, {times} times): all is land, missing, \
         or below the bottom"
    )]
    NoWater {
        /// Number of horizontal nodes.
        nodes: usize,
        /// Number of times.
        times: usize,
    },
    /// A number of the vehicle, the domain or the planner is out of its range.
    #[error("{quantity} must be {expected}, found {found}")]
    OutOfRange {
        /// The quantity, with its unit.
        quantity: &'static str,
        /// What it must be.
        expected: &'static str,
        /// What it is.
        found: f64,
    },
    /// A planner was asked to plan for no goals.
    #[error("no goals to plan for")]
    NoGoals,
    /// A goal is not a place.
    #[error("goal {goal} has a coordinate that is not a finite number: ({east_m}, {north_m}) m")]
    InvalidGoal {
        /// Index of the goal.
        goal: usize,
        /// Its eastward coordinate.
        east_m: f64,
        /// Its northward coordinate.
        north_m: f64,
    },
    /// An instance archive could not be read.
    #[error(transparent)]
    Archive(#[from] crate::npz::NpzError),
    /// The parameters of an instance are not the JSON object they should be.
    #[error("{}: `params` is not the expected JSON object: {source}", path.display())]
    InstanceParameters {
        /// The archive.
        path: PathBuf,
        /// What the JSON reader says.
        source: serde_json::Error,
    },
    /// No writer for the extension of a route file.
    #[error("{}: no route format for this extension, known are {known}", path.display())]
    UnknownRouteFormat {
        /// The file.
        path: PathBuf,
        /// Known extensions.
        known: &'static str,
    },
    /// No writer for the extension of a matrix file.
    #[error("{}: no matrix format for this extension, known are .npz, .nc", path.display())]
    UnknownMatrixFormat {
        /// The file.
        path: PathBuf,
    },
    /// A NetCDF file cannot be written.
    #[error(transparent)]
    NetCdf(#[from] sonarfleet_ocean::OceanError),
    /// A time of a route is outside the calendar.
    #[error("{hours} h after {start} is no date")]
    NoDate {
        /// Start of the run.
        start: jiff::Timestamp,
        /// Hours since.
        hours: f64,
    },
    /// A file could not be written.
    #[error("{}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
}
