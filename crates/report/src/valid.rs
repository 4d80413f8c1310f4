//! Whether a record's arrays have the shapes that its grids ask for, checked
//! once before drawing, so that nothing below can index out of bounds.

use crate::error::{ReportError, Result};
use sonarfleet::grid::{CellId, SurveillanceGrid};
use sonarfleet::record::{EpochRecord, LayoutsRecord, RunRecord};

/// Checks every shape and every cell of a record.
pub(crate) fn check(record: &RunRecord) -> Result<()> {
    let grid = record.grid;
    check_area(grid)?;
    let count = grid.cell_count();
    shape("cell_longitude_deg", None, count, record.cell_longitude_deg.len())?;
    shape("cell_latitude_deg", None, count, record.cell_latitude_deg.len())?;
    shape("cell_depth_m", None, count, record.cell_depth_m.len())?;
    cells("blocked_cells", None, count, &record.blocked_cells)?;
    cells("fixed_sensors", None, count, &record.fixed_sensors)?;
    record.epochs.iter().try_for_each(|epoch| check_epoch(epoch, count))
}

/// Checks every shape and every cell of layouts side by side.
pub(crate) fn check_layouts(record: &LayoutsRecord) -> Result<()> {
    check_area(record.grid)?;
    let count = record.grid.cell_count();
    shape("prior", None, count, record.prior.len())?;
    cells("blocked_cells", None, count, &record.blocked_cells)?;
    cells("fixed_sensors", None, count, &record.fixed_sensors)?;
    record.layouts.iter().try_for_each(|layout| {
        shape("detection_probability", None, count, layout.detection_probability.len())?;
        cells("cells", None, count, &layout.cells)
    })
}

fn check_area(grid: SurveillanceGrid) -> Result<()> {
    let has_area = grid.width_m() > 0.0 && grid.height_m() > 0.0;
    if has_area && (grid.width_m() + grid.height_m()).is_finite() {
        return Ok(());
    }
    Err(ReportError::Grid {
        columns: grid.columns,
        rows: grid.rows,
        cell_width_m: grid.cell_width_m,
        cell_height_m: grid.cell_height_m,
    })
}

fn check_epoch(epoch: &EpochRecord, count: usize) -> Result<()> {
    let at = Some(epoch.epoch);
    for (field, found) in [
        ("prior", epoch.prior.len()),
        ("detection_probability", epoch.detection_probability.len()),
        ("random_detection_probability", epoch.random_detection_probability.len()),
        ("loss_db", epoch.loss_db.len()),
    ] {
        shape(field, at, count, found)?;
    }
    cells("random_layout", at, count, &epoch.random_layout)?;
    cells("loss_source", at, count, &[epoch.loss_source])?;
    cells("layout", at, count, &epoch.layout)?;
    for route in &epoch.routes {
        cells("routes.post", at, count, &[route.post])?;
    }
    let sound = &epoch.sound_speed;
    let points = sound.depth_m.len() * sound.north_m.len() * sound.east_m.len();
    shape("sound_speed.speed_m_s", at, points, sound.speed_m_s.len())?;
    let current = &epoch.current;
    let points = current.north_m.len() * current.east_m.len();
    shape("current.u_m_s", at, points, current.u_m_s.len())?;
    shape("current.v_m_s", at, points, current.v_m_s.len())
}

fn shape(field: &'static str, epoch: Option<usize>, expected: usize, found: usize) -> Result<()> {
    if expected == found {
        return Ok(());
    }
    Err(ReportError::Shape { field, epoch, expected, found })
}

fn cells(field: &'static str, epoch: Option<usize>, count: usize, cells: &[CellId]) -> Result<()> {
    match cells.iter().find(|cell| cell.0 >= count) {
        Some(cell) => Err(ReportError::Cell { field, epoch, count, found: cell.0 }),
        None => Ok(()),
    }
}
