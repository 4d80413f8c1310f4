//! A placement problem as the policy sees it: sparse tables of who hears what and
//! who reaches whom, and what stays the same while a layout is built.

use sonarfleet::grid::CellId;
use sonarfleet::placement::PlacementProblem;

/// Probabilities below this are left out of the sparse tables. What is reported comes
/// from the problem's own evaluation, which leaves nothing out.
const NEGLIGIBLE: f32 = 0.01;

/// Rows of a matrix without its small values.
#[derive(Debug, Clone, Default)]
pub(super) struct SparseRows {
    ends: Vec<usize>,
    entries: Vec<(u32, f32)>,
}

impl SparseRows {
    /// The large values of some columns of rows that are handed over one by one.
    fn new<'v>(rows: usize, columns: &[u32], row: impl Fn(usize) -> &'v [f64]) -> Self {
        let mut sparse = Self::default();
        for index in 0..rows {
            let values = row(index);
            for &column in columns {
                let value = values[column as usize] as f32;
                if value > NEGLIGIBLE {
                    sparse.entries.push((column, value));
                }
            }
            sparse.ends.push(sparse.entries.len());
        }
        sparse
    }

    /// Columns as rows, of some rows only.
    fn transposed(&self, columns: usize, rows: &[u32]) -> Self {
        let mut ends = vec![0; columns + 1];
        for &row in rows {
            for &(column, _) in self.row(row as usize) {
                ends[column as usize + 1] += 1;
            }
        }
        for column in 0..columns {
            ends[column + 1] += ends[column];
        }
        let mut entries = vec![(0, 0.0); ends[columns]];
        let mut next = ends.clone();
        for &row in rows {
            for &(column, value) in self.row(row as usize) {
                entries[next[column as usize]] = (row, value);
                next[column as usize] += 1;
            }
        }
        ends.remove(0);
        Self { ends, entries }
    }

    /// Columns and values of a row.
    pub(super) fn row(&self, row: usize) -> &[(u32, f32)] {
        let start = if row == 0 { 0 } else { self.ends[row - 1] };
        &self.entries[start..self.ends[row]]
    }
}

/// What stays the same while layouts of a problem are built. Cells are indices into
/// the grid.
#[derive(Debug, Clone)]
pub(super) struct Landscape<'p> {
    pub(super) problem: &'p PlacementProblem,
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// Cells where a vehicle may be placed.
    pub(super) deployable: Vec<u32>,
    /// [sonar] → (target, `P_d`)
    pub(super) hears: SparseRows,
    /// [target] → (deployable sonar, `P_d`)
    pub(super) heard: SparseRows,
    /// [cell] → (cell, link weight)
    pub(super) links: SparseRows,
    /// Prior × what the fixed sensors miss.
    pub(super) residual: Vec<f32>,
    /// What a first vehicle would add to the detection utility; 0 where none may be.
    pub(super) first_gains: Vec<f32>,
    pub(super) best_first_gain: f32,
    /// Gains that are within reach of a cell's links, relative to the largest.
    pub(super) potential: Vec<f32>,
    /// Links to all deployable cells, summed, relative to the largest.
    pub(super) reach: Vec<f32>,
    pub(super) best_reach: f32,
    pub(super) largest_prior: f32,
}

impl<'p> Landscape<'p> {
    pub(super) fn new(problem: &'p PlacementProblem) -> Self {
        let grid = problem.grid();
        let cells = grid.cell_count();
        let all: Vec<u32> = (0..cells as u32).collect();
        let deployable: Vec<u32> =
            problem.deployable().iter().map(|&CellId(cell)| cell as u32).collect();
        let prior = problem.prior().values();
        let mut missed = prior.to_vec();
        for &sensor in problem.fixed_sensors() {
            for (missed, p_d) in missed.iter_mut().zip(problem.detection(sensor)) {
                *missed *= 1.0 - p_d;
            }
        }
        let residual: Vec<f32> = missed.iter().map(|&missed| missed as f32).collect();
        let targets: Vec<u32> = all.iter().copied().filter(|&t| prior[t as usize] > 0.0).collect();
        let hears = SparseRows::new(cells, &targets, |sonar| problem.detection(CellId(sonar)));
        let heard = hears.transposed(cells, &deployable);
        let links = SparseRows::new(cells, &all, |from| problem.links(CellId(from)));

        let mut first_gains = vec![0.0; cells];
        for &cell in &deployable {
            let heard = hears.row(cell as usize).iter();
            first_gains[cell as usize] = heard.map(|&(t, p_d)| residual[t as usize] * p_d).sum();
        }
        let over_links = |value: &dyn Fn(usize) -> f32| -> Vec<f32> {
            let row = |cell: usize| links.row(cell).iter();
            (0..cells).map(|cell| row(cell).map(|&(to, w)| w * value(to as usize)).sum()).collect()
        };
        let mut open = vec![0.0; cells];
        for &cell in &deployable {
            open[cell as usize] = 1.0;
        }
        let mut potential = over_links(&|cell| first_gains[cell]);
        relative_to_largest(&mut potential);
        let mut reach = over_links(&|cell| open[cell]);
        let best_reach = relative_to_largest(&mut reach);
        Self {
            problem,
            columns: grid.columns,
            rows: grid.rows,
            deployable,
            hears,
            heard,
            links,
            best_first_gain: largest(&first_gains),
            largest_prior: prior.iter().fold(0.0_f64, |a, &b| a.max(b)) as f32,
            residual,
            first_gains,
            potential,
            reach,
            best_reach,
        }
    }

    /// Vehicles and fixed sensors together.
    pub(super) fn stations(&self) -> usize {
        self.problem.vehicles() + self.problem.fixed_sensors().len()
    }
}

pub(super) fn largest(values: &[f32]) -> f32 {
    values.iter().fold(0.0, |a, &b| a.max(b))
}

/// Divides by the largest value, if it is positive; gives it.
fn relative_to_largest(values: &mut [f32]) -> f32 {
    let largest = largest(values);
    if largest > 0.0 {
        for value in values {
            *value /= largest;
        }
    }
    largest
}
