//! Tables of practice oceans, kept in files.

use super::{CurriculumError, TrainingOcean};
use crate::grid::SurveillanceGrid;
use crate::npz::{self, Archive, NamedArray, NpzError, Values};
use crate::sonar::transmission_loss::LARGEST_LOSS_DB;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// Transmission loss of one practice ocean.
#[derive(Debug, Clone, PartialEq)]
pub struct PracticeTable {
    /// Its cells.
    pub grid: SurveillanceGrid,
    /// [source cell, target cell], dB.
    pub loss_db: Vec<f32>,
}

impl PracticeTable {
    /// Whether a cell lies in the water at the fleet's depth, and not in the ground, where
    /// nothing is heard: [row, column].
    pub fn open_cells(&self) -> Vec<bool> {
        let cells = self.grid.cell_count();
        (0..cells).map(|cell| self.loss_db[cell * cells + cell] < LARGEST_LOSS_DB).collect()
    }
}

/// A directory of tables, one `.npz` file an ocean: `tl` [cell, cell] in dB and `params`,
/// a JSON object stored as bytes. A file whose fingerprint is not that of its ocean, or
/// that is damaged, is computed again.
#[derive(Debug, Clone)]
pub struct OceanStore {
    directory: PathBuf,
}

/// What a file says of its ocean; all but the fingerprint are notes.
#[derive(Debug, Serialize, Deserialize)]
struct Parameters {
    fingerprint: String,
    seed: u64,
    index: u64,
    nx: usize,
    ny: usize,
    cell_km: f64,
    frequency_hz: f64,
    fleet_depth_m: f64,
    /// Everything that was drawn, for the curious.
    ocean: String,
}

impl OceanStore {
    /// The store in a directory, which need not exist yet.
    pub fn new(directory: impl Into<PathBuf>) -> Self {
        Self { directory: directory.into() }
    }

    /// The file of an ocean.
    pub fn path(&self, seed: u64, index: u64) -> PathBuf {
        self.directory.join(format!("ocean-{seed}-{index:04}.npz"))
    }

    /// The tables of the first `count` oceans of a seed, in order: those that are kept are
    /// read, the others computed and kept. `progress` is told how many oceans of how many
    /// are there.
    ///
    /// # Errors
    /// Where a table cannot be computed or written.
    pub fn tables(
        &self,
        seed: u64,
        count: u64,
        progress: &dyn Fn(u64, u64),
    ) -> Result<Vec<PracticeTable>, CurriculumError> {
        (0..count)
            .map(|index| {
                progress(index, count);
                self.table(seed, index)
            })
            .collect()
    }

    /// The table of an ocean: read, or computed and kept.
    ///
    /// # Errors
    /// Where it cannot be computed or written.
    pub fn table(&self, seed: u64, index: u64) -> Result<PracticeTable, CurriculumError> {
        self.table_of(&TrainingOcean::draw(seed, index), seed, index)
    }

    fn table_of(
        &self,
        ocean: &TrainingOcean,
        seed: u64,
        index: u64,
    ) -> Result<PracticeTable, CurriculumError> {
        let path = self.path(seed, index);
        let fingerprint = ocean.fingerprint();
        let grid = ocean.grid;
        if path.exists() {
            match read(&path, &fingerprint, grid) {
                Ok(Some(loss_db)) => return Ok(PracticeTable { grid, loss_db }),
                Ok(None) => tracing::info!("{}: of another ocean, made again", path.display()),
                Err(error) => tracing::warn!("{error}; made again"),
            }
        }
        let loss_db = ocean.transmission_loss(&|_, _| {})?.loss_db;
        let parameters = Parameters {
            fingerprint,
            seed,
            index,
            nx: grid.columns,
            ny: grid.rows,
            cell_km: 1e-3 * grid.cell_width_m,
            frequency_hz: ocean.settings.frequency_hz,
            fleet_depth_m: ocean.settings.fleet_depth_m,
            ocean: format!("{ocean:?}"),
        };
        self.keep(&path, &parameters, grid, &loss_db)?;
        Ok(PracticeTable { grid, loss_db })
    }

    fn keep(
        &self,
        path: &Path,
        parameters: &Parameters,
        grid: SurveillanceGrid,
        loss_db: &[f32],
    ) -> Result<(), CurriculumError> {
        fs::create_dir_all(&self.directory).map_err(|source| CurriculumError::Directory {
            path: self.directory.clone(),
            source,
        })?;
        let text = serde_json::to_vec(parameters).unwrap_or_default(); // numbers and text
        let cells = grid.cell_count();
        npz::write(
            path,
            &[
                NamedArray { key: "tl", shape: &[cells, cells], values: Values::F32(loss_db) },
                NamedArray { key: "params", shape: &[text.len()], values: Values::Bytes(&text) },
            ],
        )?;
        Ok(())
    }
}

/// The losses of a file, if it has this fingerprint.
fn read(
    path: &Path,
    fingerprint: &str,
    grid: SurveillanceGrid,
) -> Result<Option<Vec<f32>>, NpzError> {
    let archive = Archive::open(path)?;
    let parameters = serde_json::from_slice::<Parameters>(&archive.bytes("params")?);
    if !parameters.is_ok_and(|parameters| parameters.fingerprint == fingerprint) {
        return Ok(None);
    }
    let cells = grid.cell_count();
    let losses = archive.f64s_of_shape("tl", &[cells, cells])?;
    Ok(Some(losses.values.into_iter().map(|loss| loss as f32).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A drawn ocean with a grid so small that its table takes no time.
    fn small_ocean(index: u64) -> TrainingOcean {
        let mut ocean = TrainingOcean::draw(1, index);
        (ocean.grid.columns, ocean.grid.rows) = (3, 2);
        ocean
    }

    #[test]
    fn tables_are_kept_and_found_again() {
        let home = tempfile::tempdir().unwrap();
        let store = OceanStore::new(home.path().join("not/there/yet"));
        let ocean = small_ocean(0);
        let made = store.table_of(&ocean, 1, 0).unwrap();
        assert_eq!(made.loss_db, ocean.transmission_loss(&|_, _| {}).unwrap().loss_db);
        assert_eq!(made.open_cells(), [true; 6]);

        // What is found is what the file says, not what would be computed.
        let loss_db = vec![61.5; 36];
        let path = store.path(1, 0);
        let bytes = Archive::open(&path).unwrap().bytes("params").unwrap();
        let parameters: Parameters = serde_json::from_slice(&bytes).unwrap();
        store.keep(&path, &parameters, ocean.grid, &loss_db).unwrap();
        assert_eq!(store.table_of(&ocean, 1, 0).unwrap().loss_db, loss_db);

        // The file of another ocean, and a damaged one, are made again.
        let mut lower = ocean.clone();
        lower.settings.frequency_hz *= 0.5;
        assert_ne!(store.table_of(&lower, 1, 0).unwrap().loss_db, loss_db);
        fs::write(&path, "no archive").unwrap();
        assert_eq!(store.table_of(&ocean, 1, 0).unwrap(), made);
        assert!(Archive::open(&path).unwrap().contains("tl"));
    }

    #[test]
    fn ground_is_not_open() {
        let grid = SurveillanceGrid { columns: 2, rows: 1, cell_width_m: 1.0, cell_height_m: 1.0 };
        let table = PracticeTable { grid, loss_db: vec![50.0, 70.0, 200.0, 200.0] };
        assert_eq!(table.open_cells(), [true, false]);
    }
}
