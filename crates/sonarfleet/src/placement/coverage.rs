//! Detection utility of a layout while it changes.

use super::problem::{LANES, PlacementProblem};
use crate::grid::CellId;

/// The residual of a layout, prior × what all its sensors miss, kept up to date
/// as vehicles come and go.
///
/// Coming multiplies the residual by one row. Going multiplies the remaining rows
/// again instead of dividing: 39 rows cost a few microseconds, exact zeros
/// (`P_d` = 1) need no care, and no rounding builds up however long the search.
/// A proposal to put a vehicle elsewhere is then one scalar product, in single
/// precision (about 1e-6 of `J_d`); what is reported comes from
/// [`PlacementProblem::evaluate`].
#[derive(Debug, Clone)]
pub struct Coverage<'p> {
    problem: &'p PlacementProblem,
    layout: Vec<CellId>,
    residual: Vec<f32>,
}

impl<'p> Coverage<'p> {
    /// The coverage of a layout together with the fixed sensors.
    pub fn new(problem: &'p PlacementProblem, layout: &[CellId]) -> Self {
        let mut coverage = Self {
            problem,
            layout: layout.to_vec(),
            residual: problem.initial_residual().to_vec(),
        };
        coverage.multiply();
        coverage
    }

    /// The vehicles' cells, in order of their slots.
    pub fn layout(&self) -> &[CellId] {
        &self.layout
    }

    /// `J_d` of the layout.
    pub fn utility(&self) -> f64 {
        self.problem.utility_of_residual(sum(&self.residual))
    }

    /// `J_d` if one more vehicle were in `cell`.
    pub fn utility_with(&self, cell: CellId) -> f64 {
        self.problem.utility_of_residual(scalar_product(&self.residual, self.problem.miss(cell)))
    }

    /// Puts a vehicle into `cell`, as slot `slot`; later slots move up.
    ///
    /// # Panics
    /// Where `slot` exceeds the number of vehicles.
    pub fn insert(&mut self, slot: usize, cell: CellId) {
        self.layout.insert(slot, cell);
        multiply(&mut self.residual, self.problem.miss(cell));
    }

    /// Takes the vehicle in `slot` away; later slots move down.
    ///
    /// # Panics
    /// Where there is no such slot.
    pub fn remove(&mut self, slot: usize) -> CellId {
        let cell = self.layout.remove(slot);
        self.residual.copy_from_slice(self.problem.initial_residual());
        self.multiply();
        cell
    }

    fn multiply(&mut self) {
        for &cell in &self.layout {
            multiply(&mut self.residual, self.problem.miss(cell));
        }
    }
}

fn multiply(residual: &mut [f32], miss: &[f32]) {
    for (residual, miss) in residual.iter_mut().zip(miss) {
        *residual *= miss;
    }
}

fn sum(values: &[f32]) -> f32 {
    let mut sums = [0.0; LANES];
    for values in values.chunks_exact(LANES) {
        for (sum, value) in sums.iter_mut().zip(values) {
            *sum += value;
        }
    }
    sums.iter().sum()
}

fn scalar_product(left: &[f32], right: &[f32]) -> f32 {
    let mut sums = [0.0; LANES];
    for (left, right) in left.chunks_exact(LANES).zip(right.chunks_exact(LANES)) {
        for ((sum, left), right) in sums.iter_mut().zip(left).zip(right) {
            *sum += left * right;
        }
    }
    sums.iter().sum()
}
