//! Transmission-loss tables in files: whole ones and shards of them, `.nc` or `.npz`.

use super::transmission_loss::TransmissionLossTable;
use crate::grid::{CellId, SurveillanceGrid};
use crate::npz::{self, Archive, NamedArray, NpzError};
use serde::{Deserialize, Serialize};
use sonarfleet_ocean::OceanError;
use sonarfleet_ocean::io::{
    Attribute, AttributeValue, DataSource, Dataset, Field, NetcdfFile, Values, read_field,
};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a table's file cannot be used.
#[derive(Debug, Error)]
pub enum LossFileError {
    /// Not a readable or writable NetCDF file.
    #[error(transparent)]
    NetCdf(#[from] OceanError),
    /// Not a readable or writable NumPy archive.
    #[error(transparent)]
    Npz(#[from] NpzError),
    /// Neither.
    #[error("{}: unknown format, expected a name that ends in .nc or .npz", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file does not hold a table, or not this one.
    #[error("{}: {what} is {found}, expected {expected}", path.display())]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// The quantity.
        what: &'static str,
        /// What was found.
        found: String,
        /// What was expected.
        expected: String,
    },
    /// Shards that overlap or leave gaps.
    #[error("cell {} is the source of {count} rows in the parts together, expected 1", cell.0)]
    NotAPartition {
        /// The first such cell.
        cell: CellId,
        /// How often it occurs.
        count: usize,
    },
}

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
    /// Ocean state, ISO 8601.
    pub time: String,
    /// Preset of beams and bearings.
    pub quality: String,
    /// Beams per slice.
    pub beams: usize,
    /// Bearings per source.
    pub bearings: usize,
}

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
        for (name, text) in [("time", &about.time), ("quality", &about.quality)] {
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

    /// Puts shards together, in any order.
    ///
    /// # Errors
    /// If they were computed for different things, overlap, or leave gaps.
    ///
    /// # Panics
    /// If there are no parts.
    pub fn merge(parts: &[(PathBuf, Self)]) -> Result<Self, LossFileError> {
        let ((_, first), others) = parts.split_first().expect("at least one part");
        for (path, part) in others {
            if part.description != first.description {
                return Err(LossFileError::Mismatch {
                    path: path.clone(),
                    what: "what the table was computed for",
                    found: format!("{:?}", part.description),
                    expected: format!("{:?}, as in {}", first.description, parts[0].0.display()),
                });
            }
        }
        let cells = first.cell_degrees.len();
        let mut loss_db = vec![f32::NAN; cells * cells];
        let mut counts = vec![0; cells];
        for (_, part) in parts {
            for (source, row) in part.sources.iter().zip(part.loss_db.chunks_exact(cells)) {
                counts[source.0] += 1;
                loss_db[source.0 * cells..][..cells].copy_from_slice(row);
            }
        }
        if let Some(cell) = counts.iter().position(|&count| count != 1) {
            return Err(LossFileError::NotAPartition { cell: CellId(cell), count: counts[cell] });
        }
        Ok(Self { sources: (0..cells).map(CellId).collect(), loss_db, ..first.clone() })
    }
}

/// Reads a whole table for a grid. Of an `.npz`, only `tl` is needed.
///
/// # Errors
/// If the file is not a table, or not one between all cells of the grid.
pub fn read_table(
    path: &Path,
    grid: &SurveillanceGrid,
) -> Result<TransmissionLossTable, LossFileError> {
    let (shape, values) = match extension(path) {
        "nc" => {
            let field = read_field(path, "transmission_loss")?;
            (lengths(&field), field.values)
        }
        "npz" => {
            let array = Archive::open(path)?.f64s("tl")?;
            (array.shape, array.values)
        }
        _ => return Err(LossFileError::UnknownFormat { path: path.to_owned() }),
    };
    let cells = grid.cell_count();
    let mismatch = |what, found, expected| {
        Err(LossFileError::Mismatch { path: path.to_owned(), what, found, expected })
    };
    if shape != [cells, cells] {
        let expected = format!("[{cells}, {cells}] for {} × {} cells", grid.columns, grid.rows);
        return mismatch("the table's shape", format!("{shape:?}"), expected);
    }
    if let Some(index) = values.iter().position(|loss| loss.is_nan()) {
        let found = format!("missing from cell {} to cell {}", index / cells, index % cells);
        return mismatch("the loss", found, "a number of dB".into());
    }
    let loss_db = values.iter().map(|&loss| loss as f32).collect();
    Ok(TransmissionLossTable { cell_count: cells, loss_db })
}

/// Reads the rows of a shard or of a whole table, with what they were computed for.
///
/// # Errors
/// If the file is not a NetCDF table as this program writes it.
pub fn read_rows(path: &Path) -> Result<LossRows, LossFileError> {
    if extension(path) != "nc" {
        return Err(LossFileError::UnknownFormat { path: path.to_owned() });
    }
    let loss = read_field(path, "transmission_loss")?;
    let sources = read_field(path, "source")?;
    let (longitude, latitude) = (read_field(path, "longitude")?, read_field(path, "latitude")?);
    let description = description(path)?;
    let cells = description.columns * description.rows;
    let expected = [sources.values.len(), cells];
    let in_grid = sources.values.iter().all(|&n| n >= 0.0 && n < cells as f64);
    if lengths(&loss) != expected || longitude.values.len() != cells || !in_grid {
        return Err(LossFileError::Mismatch {
            path: path.to_owned(),
            what: "the table's shape",
            found: format!("{:?}", lengths(&loss)),
            expected: format!("{expected:?} and sources among the {cells} cells"),
        });
    }
    Ok(LossRows {
        description,
        cell_degrees: longitude.values.into_iter().zip(latitude.values).collect(),
        sources: sources.values.iter().map(|&n| CellId(n as usize)).collect(),
        loss_db: loss.values.iter().map(|&value| value as f32).collect(),
    })
}

fn description(path: &Path) -> Result<LossDescription, LossFileError> {
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
    Ok(LossDescription {
        columns: number("columns")? as usize,
        rows: number("rows")? as usize,
        frequency_hz: number("frequency_hz")?,
        fleet_depth_m: number("fleet_depth_m")?,
        time: text("time")?,
        quality: text("quality")?,
        beams: number("beams")? as usize,
        bearings: number("bearings")? as usize,
    })
}

fn lengths(field: &Field) -> Vec<usize> {
    field.dimensions.iter().map(|dimension| dimension.length).collect()
}

fn extension(path: &Path) -> &str {
    path.extension().and_then(|extension| extension.to_str()).unwrap_or_default()
}
