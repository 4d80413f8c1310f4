use super::{LossDescription, LossFileError, extension};
use crate::grid::CellId;
use crate::npz::{self, NamedArray, NpzError};
use crate::sonar::transmission_loss::TransmissionLossTable;
use sonarfleet_ocean::io::{Attribute, Dataset, Values};
use std::path::Path;

/// Rows of a table: all of them, or those of a shard.
#[derive(Debug, Clone, PartialEq)]
pub struct LossRows {
    /// What they were computed for.
    pub description: LossDescription,
    /// Longitude and latitude of the cells' centres, degrees, [row, column].
    pub cell_degrees: Vec<(f64, f64)>,
    /// Source cells of the rows.
    pub sources: Vec<CellId>,
    /// Transmission loss, dB, [source, target].
    pub loss_db: Vec<f32>,
}

impl LossRows {
    /// Rows as computed, in one direction. If they are all rows of a table that is to
    /// be the mean of both directions, it is taken.
    pub fn new(
        description: LossDescription,
        cell_degrees: Vec<(f64, f64)>,
        sources: Vec<CellId>,
        loss_db: Vec<f32>,
    ) -> Self {
        let cell_count = cell_degrees.len();
        let loss_db = if sources.len() == cell_count {
            description.directions.of(TransmissionLossTable { cell_count, loss_db }).loss_db
        } else {
            loss_db
        };
        Self { description, cell_degrees, sources, loss_db }
    }

    /// Writes the rows as NetCDF or NumPy archive, by the file's extension.
    ///
    /// # Errors
    /// If the extension is neither, or the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), LossFileError> {
        match extension(path) {
            "nc" => Ok(self.dataset().write(path)?),
            "npz" => Ok(self.write_npz(path)?),
            _ => Err(LossFileError::UnknownFormat { path: path.to_owned() }),
        }
    }

    fn dataset(&self) -> Dataset {
        let mut file = Dataset::new("Transmission loss between the cells of a region");
        let about = &self.description;
        for (name, text) in [
            ("time", about.time.as_str()),
            ("model", &about.model),
            ("quality", &about.quality),
            ("directions", about.directions.name()),
            ("fingerprint", &about.fingerprint),
        ] {
            file.add_attribute(Attribute::text(name, text));
        }
        for (name, number) in [
            ("sonarfleet_format", crate::FILE_FORMAT),
            ("columns", about.columns as f64),
            ("rows", about.rows as f64),
            ("frequency_hz", about.frequency_hz),
            ("fleet_depth_m", about.fleet_depth_m),
            ("beams", about.beams as f64),
            ("bearings", about.bearings as f64),
        ] {
            file.add_attribute(Attribute::number(name, number));
        }
        if let Some(range_m) = about.maximum_range_m {
            file.add_attribute(Attribute::number("maximum_range_m", range_m));
        }
        let cell = [Attribute::text("long_name", "cell, counted eastward, then northward")];
        let sources = self.sources.iter().map(|cell| cell.0 as i32).collect();
        file.add_coordinate("source", Values::I32(sources), &cell);
        let targets = (0..self.cell_degrees.len() as i32).collect();
        file.add_coordinate("target", Values::I32(targets), &cell);
        let degrees = |part: fn(&(f64, f64)) -> f64| {
            Values::F64(self.cell_degrees.iter().map(part).collect())
        };
        let unit = |unit: &str| [Attribute::text("units", unit)];
        file.add_variable("longitude", &["target"], degrees(|d| d.0), &unit("degrees_east"));
        file.add_variable("latitude", &["target"], degrees(|d| d.1), &unit("degrees_north"));
        file.add_variable(
            "transmission_loss",
            &["source", "target"],
            Values::F32(self.loss_db.clone()),
            &[
                Attribute::text("units", "dB"),
                Attribute::text(
                    "long_name",
                    "transmission loss re 1 m, averaged over the target cell",
                ),
                Attribute::text("coordinates", "longitude latitude"),
            ],
        );
        file
    }

    fn write_npz(&self, path: &Path) -> Result<(), NpzError> {
        let about = serde_json::to_vec(&self.description)
            .expect("a description holds nothing that JSON cannot say");
        let sources: Vec<i64> = self.sources.iter().map(|cell| cell.0 as i64).collect();
        npz::write(
            path,
            &[
                NamedArray {
                    key: "tl",
                    shape: &[self.sources.len(), self.cell_degrees.len()],
                    values: npz::Values::F32(&self.loss_db),
                },
                NamedArray {
                    key: "source",
                    shape: &[sources.len()],
                    values: npz::Values::I64(&sources),
                },
                NamedArray {
                    key: "params",
                    shape: &[about.len()],
                    values: npz::Values::Bytes(&about),
                },
            ],
        )
    }
}
