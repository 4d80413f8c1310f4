use super::description::read_description;
use super::{LossFileError, LossRows, extension};
use crate::grid::{CellId, SurveillanceGrid};
use crate::npz::Archive;
use crate::sonar::transmission_loss::TransmissionLossTable;
use sonarfleet_ocean::io::{Field, read_field};
use std::path::Path;

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
    let description = read_description(path)?;
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

fn lengths(field: &Field) -> Vec<usize> {
    field.dimensions.iter().map(|dimension| dimension.length).collect()
}
