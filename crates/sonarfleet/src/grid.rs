//! The surveillance grid: cells of a rectangular region, and points in it.

use serde::{Deserialize, Serialize};

/// A point in the region's local frame, in metres east and north of its
/// south-west corner.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Position {
    /// Metres east of the region's south-west corner.
    pub east_m: f64,
    /// Metres north of the region's south-west corner.
    pub north_m: f64,
}

impl Position {
    /// A point from its two coordinates, in metres.
    pub const fn new(east_m: f64, north_m: f64) -> Self {
        Self { east_m, north_m }
    }

    /// Distance to another point, in metres.
    pub fn distance_m(self, other: Self) -> f64 {
        (self.east_m - other.east_m).hypot(self.north_m - other.north_m)
    }
}

/// Identity of a cell: `n = row · columns + column`, columns counted eastward
/// and rows northward.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct CellId(pub usize);

/// The region Ω = [0, `Lx`] × [0, `Ly`] cut into `columns` × `rows` equal cells
/// (section 2.1 of the paper).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct SurveillanceGrid {
    /// Number of cells from west to east, Nx.
    pub columns: usize,
    /// Number of cells from south to north, Ny.
    pub rows: usize,
    /// Length of a cell from west to east, Δx, in metres.
    pub cell_width_m: f64,
    /// Length of a cell from south to north, Δy, in metres.
    pub cell_height_m: f64,
}

impl SurveillanceGrid {
    /// Number of cells.
    pub const fn cell_count(&self) -> usize {
        self.columns * self.rows
    }

    /// All cells, in order of their index.
    pub fn cells(&self) -> impl Iterator<Item = CellId> + use<> {
        (0..self.cell_count()).map(CellId)
    }

    /// Length of the region from west to east, in metres.
    pub fn width_m(&self) -> f64 {
        self.columns as f64 * self.cell_width_m
    }

    /// Length of the region from south to north, in metres.
    pub fn height_m(&self) -> f64 {
        self.rows as f64 * self.cell_height_m
    }

    /// Column (eastward) and row (northward) of a cell.
    pub const fn column_row(&self, cell: CellId) -> (usize, usize) {
        (cell.0 % self.columns, cell.0 / self.columns)
    }

    /// Centre of a cell.
    pub fn centre(&self, cell: CellId) -> Position {
        let (column, row) = self.column_row(cell);
        Position::new(
            (column as f64 + 0.5) * self.cell_width_m,
            (row as f64 + 0.5) * self.cell_height_m,
        )
    }

    /// The cell that contains a point; none outside the region. A point on an
    /// inner edge belongs to the cell east or north of it, one on the region's
    /// outer edge to the last cell.
    pub fn cell_at(&self, point: Position) -> Option<CellId> {
        let index = |coordinate: f64, step: f64, count: usize| {
            let end = step * count as f64;
            (0.0..=end).contains(&coordinate).then(|| ((coordinate / step) as usize).min(count - 1))
        };
        let column = index(point.east_m, self.cell_width_m, self.columns)?;
        let row = index(point.north_m, self.cell_height_m, self.rows)?;
        Some(CellId(row * self.columns + column))
    }
}

/// Evenly spaced coordinates from `first` to `last`, both included, at most `most`
/// apart.
pub(crate) fn evenly(first: f64, last: f64, most: f64) -> Vec<f64> {
    let intervals = ((last - first) / most).ceil().max(1.0) as usize;
    (0..=intervals).map(|k| first + (last - first) * k as f64 / intervals as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: SurveillanceGrid =
        SurveillanceGrid { columns: 4, rows: 3, cell_width_m: 100.0, cell_height_m: 50.0 };

    #[test]
    fn centres_lie_in_their_own_cells() {
        for cell in GRID.cells() {
            assert_eq!(GRID.cell_at(GRID.centre(cell)), Some(cell));
        }
    }

    #[test]
    fn edges_belong_to_one_cell_and_outside_to_none() {
        assert_eq!(GRID.cell_at(Position::new(0.0, 0.0)), Some(CellId(0)));
        assert_eq!(GRID.cell_at(Position::new(100.0, 50.0)), Some(CellId(5)));
        assert_eq!(GRID.cell_at(Position::new(400.0, 150.0)), Some(CellId(11)));
        assert_eq!(GRID.cell_at(Position::new(400.1, 0.0)), None);
        assert_eq!(GRID.cell_at(Position::new(-0.1, 0.0)), None);
        assert_eq!(GRID.cell_at(Position::new(f64::NAN, 0.0)), None);
    }
}
