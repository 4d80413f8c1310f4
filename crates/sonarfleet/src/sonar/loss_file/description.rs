use super::LossFileError;
use crate::sonar::transmission_loss::Directions;
use serde::{Deserialize, Serialize};
use sonarfleet_ocean::io::{AttributeValue, DataSource, NetcdfFile};
use std::path::Path;

/// What a table was computed for, as its file says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LossDescription {
    /// Columns of the grid.
    pub columns: usize,
    /// Rows of the grid.
    pub rows: usize,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Depth of sources and receivers, metres.
    pub fleet_depth_m: f64,
    /// Largest distance over which sound was followed, metres; none: to the region's edge.
    pub maximum_range_m: Option<f64>,
    /// Directions of the whole table. The rows of a shard are of one direction in any
    /// case: the mean of both is taken when the table is whole.
    pub directions: Directions,
    /// Ocean state, ISO 8601.
    pub time: String,
    /// What followed sound.
    pub model: String,
    /// Preset of beams and bearings.
    pub quality: String,
    /// Beams per slice.
    pub beams: usize,
    /// Bearings per source.
    pub bearings: usize,
    /// SHA-256 of everything that decides the rows
    /// ([`table_fingerprint`](crate::sonar::transmission_loss::table_fingerprint)).
    pub fingerprint: String,
}

impl LossDescription {
    /// The first thing in which another description differs: its name, this one's
    /// value, the other's.
    pub(super) fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let said = |about: &Self| {
            [
                ("the grid", format!("{} × {} cells", about.columns, about.rows)),
                ("the time", about.time.clone()),
                ("frequency_hz", about.frequency_hz.to_string()),
                ("fleet_depth_m", about.fleet_depth_m.to_string()),
                (
                    "maximum_range_m",
                    about.maximum_range_m.map_or("unlimited".into(), |range| range.to_string()),
                ),
                ("directions", about.directions.name().into()),
                ("the model", about.model.clone()),
                ("the quality", about.quality.clone()),
                ("the number of beams", about.beams.to_string()),
                ("the number of bearings", about.bearings.to_string()),
                (
                    "the fingerprint of ocean, sea floor, settings and program version",
                    about.fingerprint.clone(),
                ),
            ]
        };
        said(self)
            .into_iter()
            .zip(said(other))
            .find(|((_, mine), (_, theirs))| mine != theirs)
            .map(|((what, mine), (_, theirs))| (what, mine, theirs))
    }
}

/// Reads what a NetCDF table was computed for.
pub(super) fn read_description(path: &Path) -> Result<LossDescription, LossFileError> {
    let file = NetcdfFile::open(path)?;
    let value = |name: &'static str| {
        file.attributes().iter().find(|attribute| attribute.name == name).map(|found| &found.value)
    };
    let missing = |what| LossFileError::Mismatch {
        path: path.to_owned(),
        what,
        found: "not a global attribute of it".into(),
        expected: "there".into(),
    };
    let number =
        |name| value(name).and_then(AttributeValue::as_number).ok_or_else(|| missing(name));
    let text = |name| {
        let found = value(name).and_then(AttributeValue::as_text);
        found.map(str::to_owned).ok_or_else(|| missing(name))
    };
    let directions = match text("directions")?.as_str() {
        "one" => Directions::One,
        "both" => Directions::Both,
        found => {
            return Err(LossFileError::Mismatch {
                path: path.to_owned(),
                what: "directions",
                found: found.to_owned(),
                expected: "one or both".into(),
            });
        }
    };
    Ok(LossDescription {
        columns: number("columns")? as usize,
        rows: number("rows")? as usize,
        frequency_hz: number("frequency_hz")?,
        fleet_depth_m: number("fleet_depth_m")?,
        maximum_range_m: value("maximum_range_m").and_then(AttributeValue::as_number),
        directions,
        time: text("time")?,
        model: text("model")?,
        quality: text("quality")?,
        beams: number("beams")? as usize,
        bearings: number("bearings")? as usize,
        fingerprint: text("fingerprint")?,
    })
}
