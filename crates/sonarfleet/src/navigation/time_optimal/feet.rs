//! Where the steps from a node end, for all headings at once.

use super::value_function::{NodeGrid, Stencil};
use std::f64::consts::TAU;

/// How a vehicle moves in one step from a node: x + drift + steering · e(ψ), counted
/// in nodes. The current is taken along the way: u + ∇u · (u + V e(ψ)) Δt/2, the
/// midpoint rule with the field linearised about the node.
#[derive(Clone, Copy)]
pub(super) struct Motion {
    pub(super) drift: [f32; 2],
    /// Rows: east and north; columns: parts of e(ψ).
    pub(super) steering: [[f32; 2]; 2],
}

/// The feet of the characteristics through a node. Its arrays hold one entry per
/// heading and are filled by loops that vectorise: this is the second hottest place
/// of the solver.
#[derive(Clone)]
pub(super) struct Feet {
    /// Parts of e(ψ).
    east: Vec<f32>,
    north: Vec<f32>,
    /// Coordinates counted in nodes.
    x: Vec<f32>,
    y: Vec<f32>,
    stencils: Vec<Stencil>,
}

impl Feet {
    /// Room for the feet of equally spaced headings.
    pub(super) fn new(headings: usize) -> Self {
        let part = |part: fn(f64) -> f64| -> Vec<f32> {
            let turn = TAU / headings as f64;
            (0..headings).map(|heading| part(heading as f64 * turn) as f32).collect()
        };
        Self {
            east: part(libm::sin),
            north: part(libm::cos),
            x: vec![0.0; headings],
            y: vec![0.0; headings],
            stencils: Vec::with_capacity(headings),
        }
    }

    /// Stencils of the feet of a node, without those of headings that come too near
    /// the wall or run aground (`land` of each node; empty where all is water).
    pub(super) fn of(
        &mut self,
        grid: &NodeGrid,
        column: usize,
        row: usize,
        motion: &Motion,
        land: &[bool],
    ) -> &[Stencil] {
        let [[ee, en], [ne, nn]] = motion.steering;
        let (x0, y0) = (column as f32 + motion.drift[0], row as f32 + motion.drift[1]);
        let directions = self.east.iter().zip(&self.north);
        let coordinates = self.x.iter_mut().zip(&mut self.y);
        for ((x, y), (&east, &north)) in coordinates.zip(directions) {
            *x = x0 + (ee * east + en * north);
            *y = y0 + (ne * east + nn * north);
        }
        self.stencils.clear();
        let clear = grid.clear_of_wall();
        let inside = |x: f32, y: f32| {
            x >= clear.west && x <= clear.east && y >= clear.south && y <= clear.north
        };
        for (&x, &y) in self.x.iter().zip(&self.y) {
            if inside(x, y) && !aground(grid, land, (column, row), (x, y)) {
                self.stencils.push(grid.stencil(x, y));
            }
        }
        &self.stencils
    }
}

/// Whether the middle or the end of a step is nearest to a node on land.
#[inline]
fn aground(
    grid: &NodeGrid,
    land: &[bool],
    (column, row): (usize, usize),
    (x, y): (f32, f32),
) -> bool {
    if land.is_empty() {
        return false;
    }
    let dry = |x: f32, y: f32| land[(y + 0.5) as usize * grid.columns + (x + 0.5) as usize];
    dry(x, y) || dry(x.midpoint(column as f32), y.midpoint(row as f32))
}
