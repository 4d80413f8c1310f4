//! The grid's symmetries: a turned ocean is another ocean.

use super::PracticeTable;
use crate::grid::{CellId, SurveillanceGrid};

/// One of the eight symmetries of the square: first a mirror image west for east, if so,
/// then another south for north, then columns become rows. On a grid that is not square
/// the last makes another grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Symmetry {
    /// West becomes east.
    pub mirror_columns: bool,
    /// South becomes north.
    pub mirror_rows: bool,
    /// Columns become rows.
    pub transpose: bool,
}

impl Symmetry {
    /// All eight; the first leaves everything where it is.
    pub fn all() -> [Self; 8] {
        std::array::from_fn(|bits| Self {
            mirror_columns: bits & 1 != 0,
            mirror_rows: bits & 2 != 0,
            transpose: bits & 4 != 0,
        })
    }

    /// The grid that a grid becomes.
    pub fn of_grid(self, grid: &SurveillanceGrid) -> SurveillanceGrid {
        let SurveillanceGrid { columns, rows, cell_width_m, cell_height_m } = *grid;
        if self.transpose {
            SurveillanceGrid {
                columns: rows,
                rows: columns,
                cell_width_m: cell_height_m,
                cell_height_m: cell_width_m,
            }
        } else {
            *grid
        }
    }

    /// The cell that a cell of `grid` becomes.
    pub fn of_cell(self, grid: &SurveillanceGrid, cell: CellId) -> CellId {
        let (mut column, mut row) = grid.column_row(cell);
        if self.mirror_columns {
            column = grid.columns - 1 - column;
        }
        if self.mirror_rows {
            row = grid.rows - 1 - row;
        }
        if self.transpose {
            CellId(column * grid.rows + row)
        } else {
            CellId(row * grid.columns + column)
        }
    }

    /// The table that a table becomes.
    pub fn of_table(self, table: &PracticeTable) -> PracticeTable {
        let PracticeTable { grid, loss_db } = table;
        let place: Vec<usize> = grid.cells().map(|cell| self.of_cell(grid, cell).0).collect();
        let cells = place.len();
        let mut turned = vec![0.0; loss_db.len()];
        for (row, &source) in loss_db.chunks_exact(cells).zip(&place) {
            let turned = &mut turned[source * cells..(source + 1) * cells];
            for (loss, &target) in row.iter().zip(&place) {
                turned[target] = *loss;
            }
        }
        PracticeTable { grid: self.of_grid(grid), loss_db: turned }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Not square, and no loss like another.
    fn table() -> PracticeTable {
        let grid =
            SurveillanceGrid { columns: 4, rows: 3, cell_width_m: 100.0, cell_height_m: 90.0 };
        PracticeTable { grid, loss_db: (0..144u16).map(f32::from).collect() }
    }

    #[test]
    fn a_loss_goes_with_its_cells() {
        let table = table();
        for symmetry in Symmetry::all() {
            let turned = symmetry.of_table(&table);
            let places: BTreeSet<CellId> =
                table.grid.cells().map(|cell| symmetry.of_cell(&table.grid, cell)).collect();
            assert_eq!(places.len(), 12, "{symmetry:?}");
            for a in table.grid.cells() {
                for b in table.grid.cells() {
                    let [c, d] = [a, b].map(|cell| symmetry.of_cell(&table.grid, cell));
                    assert_eq!(
                        turned.loss_db[c.0 * 12 + d.0].to_bits(),
                        table.loss_db[a.0 * 12 + b.0].to_bits()
                    );
                    let before = table.grid.centre(a).distance_m(table.grid.centre(b));
                    let after = turned.grid.centre(c).distance_m(turned.grid.centre(d));
                    assert!((before - after).abs() < 1e-9, "{symmetry:?} keeps distances");
                }
            }
        }
    }

    #[test]
    fn all_eight_differ() {
        let tables = Symmetry::all().map(|symmetry| symmetry.of_table(&table()));
        for (i, a) in tables.iter().enumerate() {
            assert!(tables[..i].iter().all(|b| a != b));
        }
        assert_eq!(tables[0], table());
    }
}
