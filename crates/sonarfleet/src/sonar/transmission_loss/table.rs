use super::cache::{LossCache, table_fingerprint};
use super::error::TransmissionLossError;
use super::row::RowComputer;
use super::settings::LossTableSettings;
use crate::grid::{CellId, SurveillanceGrid};
use crate::sonar::section::Waters;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Transmission loss from every cell to every cell at the fleet's depth.
#[derive(Debug, Clone, PartialEq)]
pub struct TransmissionLossTable {
    /// Number of cells.
    pub cell_count: usize,
    /// [source cell, target cell], dB re 1 m; at most [`LARGEST_LOSS_DB`](super::LARGEST_LOSS_DB).
    ///
    /// A source is a point in the middle of its cell; intensity is averaged over
    /// the target cell. On the diagonal it is the intensity half a cell away.
    pub loss_db: Vec<f32>,
}

impl TransmissionLossTable {
    /// Loss from one cell to another, dB.
    pub fn loss_db(&self, source: CellId, target: CellId) -> f32 {
        self.loss_db[source.0 * self.cell_count + target.0]
    }

    /// Losses from one cell to all, dB.
    pub fn row(&self, source: CellId) -> &[f32] {
        &self.loss_db[source.0 * self.cell_count..(source.0 + 1) * self.cell_count]
    }
}

/// Rows of a table, and how many of them had been computed before.
#[derive(Debug, Clone, PartialEq)]
pub struct LossTableRows {
    /// Losses from each source, in the order of the sources, to all cells, dB.
    pub rows: Vec<Vec<f32>>,
    /// How many were read from the cache.
    pub from_cache: usize,
}

/// Computes the table of a region's waters. `progress` is told how many sources
/// of how many are done, from any thread. The result does not depend on the
/// number of threads.
///
/// # Errors
/// If a setting is not positive.
pub fn compute_transmission_loss(
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<TransmissionLossTable, TransmissionLossError> {
    let sources: Vec<CellId> = grid.cells().collect();
    let rows = compute_rows(waters, grid, settings, &sources, progress)?;
    Ok(TransmissionLossTable { cell_count: grid.cell_count(), loss_db: rows.concat() })
}

/// The rows of some sources, in their order: parts of a table, which the rows of
/// all sources make up.
///
/// # Errors
/// If a setting is not positive.
pub fn compute_rows(
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
    sources: &[CellId],
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<Vec<Vec<f32>>, TransmissionLossError> {
    Ok(rows_with_cache(waters, grid, settings, sources, None, progress)?.rows)
}

/// The rows of some sources, in their order, as [`compute_rows`] gives them: those
/// in the cache are read, the others computed and put there while it goes on.
/// `progress` is first told how many were there.
///
/// # Errors
/// If a setting is not positive. A cache that does not work is no error: it is
/// warned of.
pub fn rows_with_cache(
    waters: &Waters,
    grid: &SurveillanceGrid,
    settings: &LossTableSettings,
    sources: &[CellId],
    cache: Option<&LossCache>,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<LossTableRows, TransmissionLossError> {
    settings.check()?;
    let entry =
        cache.map(|cache| cache.open(table_fingerprint(waters, grid, settings), grid.cell_count()));
    let kept = |source: CellId| entry.as_ref().and_then(|entry| entry.row(source));
    let from_cache = sources.iter().filter(|&&source| kept(source).is_some()).count();
    progress(from_cache, sources.len());
    let slice_error =
        |source_cell| move |reason| TransmissionLossError::Slice { source_cell, reason };
    let computer = RowComputer::new(waters, grid, settings).map_err(slice_error(CellId(0)))?;
    let done = AtomicUsize::new(from_cache);
    let rows = sources
        .par_iter()
        .map(|&source| {
            if let Some(row) = kept(source) {
                return Ok(row.to_vec());
            }
            let row = computer.row(source).map_err(slice_error(source))?;
            if let Some(entry) = &entry {
                entry.keep(source, &row);
            }
            progress(done.fetch_add(1, Ordering::Relaxed) + 1, sources.len());
            Ok(row)
        })
        .collect::<Result<_, _>>()?;
    if let Some(entry) = entry {
        tracing::info!(from_cache, sources = sources.len(), cache = %entry.directory().display());
        entry.close();
    }
    Ok(LossTableRows { rows, from_cache })
}

#[cfg(test)]
mod tests {
    use super::super::{Quality, TableModel, estimate_error};
    use super::*;
    use sonarfleet_acoustics::environment::{Boundary, Seabed};
    use sonarfleet_acoustics::seawater::SoundSpeedEquation;
    use sonarfleet_ocean::synthetic::SyntheticOcean;
    use sonarfleet_ocean::{Bathymetry, LocalFrame, Region};
    use std::sync::Mutex;

    /// The middle of the default region in 4 × 4 cells of about 1 km.
    fn region() -> Region {
        Region { west_deg: 118.23, east_deg: 118.27, south_deg: 21.72, north_deg: 21.757 }
    }

    fn setting(change: impl Fn(&mut Bathymetry)) -> (Waters, SurveillanceGrid, LossTableSettings) {
        let ocean = SyntheticOcean { region: region(), states: 1, ..SyntheticOcean::default() };
        let frame = LocalFrame::new(region());
        let grid = SurveillanceGrid {
            columns: 4,
            rows: 4,
            cell_width_m: frame.width_m() / 4.0,
            cell_height_m: frame.height_m() / 4.0,
        };
        let mut bathymetry = ocean.bathymetry();
        change(&mut bathymetry);
        let waters = Waters::new(
            &ocean.forecast().states[0],
            &bathymetry,
            &frame,
            SoundSpeedEquation::Mackenzie,
            Boundary::Fluid(Seabed::Mud.half_space()),
        )
        .unwrap();
        let settings = LossTableSettings {
            frequency_hz: 1000.0,
            fleet_depth_m: 200.0,
            maximum_range_m: f64::INFINITY,
            numerics: Quality::Fast.numerics(),
            model: TableModel::Native,
        };
        (waters, grid, settings)
    }

    #[test]
    fn losses_grow_from_the_source_outward_and_progress_is_told() {
        let (waters, grid, settings) = setting(|_| {});
        let told = Mutex::new(Vec::new());
        let progress = |done, total| told.lock().unwrap().push((done, total));
        let table = compute_transmission_loss(&waters, &grid, &settings, &progress).unwrap();
        assert_eq!(table.loss_db.len(), 256);
        let source = CellId(0);
        // Spherical spreading to half a cell, and surface-reflected sound.
        let nearest = table.loss_db(source, source);
        assert!((50.0..56.0).contains(&nearest), "{nearest}");
        assert!(table.loss_db(source, CellId(1)) > nearest);
        assert!(table.loss_db(source, CellId(15)) > table.loss_db(source, CellId(5)));
        assert!(table.loss_db.iter().all(|loss| (40.0..100.0).contains(loss)));
        let mut told = told.into_inner().unwrap();
        told.sort_unstable();
        assert_eq!(told, (0..=16).map(|done| (done, 16)).collect::<Vec<_>>());
    }

    #[test]
    fn the_number_of_threads_changes_no_bit() {
        let (waters, grid, settings) = setting(|_| {});
        let [one, two] = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| compute_transmission_loss(&waters, &grid, &settings, &|_, _| {}))
                .unwrap()
        });
        assert_eq!(one, two);
    }

    #[test]
    fn rows_are_parts_of_the_table() {
        let (waters, grid, settings) = setting(|_| {});
        let table = compute_transmission_loss(&waters, &grid, &settings, &|_, _| {}).unwrap();
        let rows = compute_rows(&waters, &grid, &settings, &[CellId(7)], &|_, _| {}).unwrap();
        assert_eq!(rows[0], table.row(CellId(7)));
    }

    /// A wall of land from north to south between the second and third columns.
    #[test]
    fn land_blocks_sound() {
        let middle_deg = 0.5 * (region().west_deg + region().east_deg);
        let (waters, grid, settings) = setting(|bathymetry| {
            let columns = bathymetry.longitude_deg.len();
            for (node, depth) in bathymetry.values_m.iter_mut().enumerate() {
                if (bathymetry.longitude_deg[node % columns] - middle_deg).abs() < 0.004 {
                    *depth = -50.0;
                }
            }
        });
        let table = compute_transmission_loss(&waters, &grid, &settings, &|_, _| {}).unwrap();
        for (source, target) in [(CellId(0), CellId(3)), (CellId(7), CellId(4))] {
            assert!(table.loss_db(source, target) > 199.0);
        }
        assert!(table.loss_db(CellId(0), CellId(4)) < 90.0);
    }

    /// A pit around a cell's middle: straight lines between soundings cut it off.
    #[test]
    fn a_source_close_above_the_ground_is_no_error() {
        let source = CellId(5);
        let in_pit = |bathymetry: &mut Bathymetry| {
            let columns = bathymetry.longitude_deg.len();
            let (west_deg, south_deg) = (region().west_deg, region().south_deg);
            for (node, depth) in bathymetry.values_m.iter_mut().enumerate() {
                // The cell's middle is 1.5 of 4 cells from the corner.
                let east = bathymetry.longitude_deg[node % columns] - (west_deg + 0.015);
                let north = bathymetry.latitude_deg[node / columns] - (south_deg + 0.013_875);
                *depth = (300.0 - 4_000.0 * east.hypot(north)).max(120.0) as f32;
            }
        };
        let (waters, grid, mut settings) = setting(in_pit);
        settings.fleet_depth_m = waters.floor_m(grid.centre(source)) - 0.01;
        let rows = compute_rows(&waters, &grid, &settings, &[source], &|_, _| {}).unwrap();
        assert!(rows[0].iter().all(|loss| (40.0..=200.0).contains(loss)), "{rows:?}");
    }

    #[test]
    fn sound_beyond_the_largest_range_is_not_followed() {
        let (waters, grid, settings) = setting(|_| {});
        let settings = LossTableSettings { maximum_range_m: 1500.0, ..settings };
        let table = compute_transmission_loss(&waters, &grid, &settings, &|_, _| {}).unwrap();
        assert!(table.loss_db(CellId(0), CellId(15)) > 199.0);
        assert!(table.loss_db(CellId(0), CellId(1)) < 80.0);
    }

    #[test]
    fn settings_are_checked() {
        let (waters, grid, settings) = setting(|_| {});
        let settings = LossTableSettings { frequency_hz: -1.0, ..settings };
        let refused = compute_transmission_loss(&waters, &grid, &settings, &|_, _| {});
        assert!(matches!(refused, Err(TransmissionLossError::NotPositive { .. })));
    }

    #[test]
    fn the_standard_quality_is_near_the_fine_one() {
        let (waters, grid, mut settings) = setting(|_| {});
        settings.numerics = Quality::Standard.numerics();
        let sources = [CellId(5)];
        let row = compute_rows(&waters, &grid, &settings, &sources, &|_, _| {}).unwrap();
        let mut loss_db = vec![0.0; 256];
        loss_db[5 * 16..6 * 16].copy_from_slice(&row[0]);
        let table = TransmissionLossTable { cell_count: 16, loss_db };
        let estimate =
            estimate_error(&table, &waters, &grid, &settings, &sources, &|_, _| {}).unwrap();
        assert_eq!(estimate.compared, 16);
        assert!(estimate.median_db < 0.3, "{estimate:?}");
    }
}
