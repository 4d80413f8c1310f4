//! Compact layouts: discs of neighbouring cells, which are well connected where
//! anything is.

use super::PlacementProblem;
use super::network::Network;
use crate::grid::CellId;

/// The deployable cells nearest to `centre`, as many as vehicles.
pub fn disc(problem: &PlacementProblem, centre: CellId) -> Vec<CellId> {
    let grid = problem.grid();
    let middle = grid.centre(centre);
    let mut cells = problem.deployable().to_vec();
    let distance_m = |cell: &CellId| grid.centre(*cell).distance_m(middle);
    cells.sort_by(|a, b| distance_m(a).total_cmp(&distance_m(b)));
    cells.truncate(problem.vehicles());
    cells
}

/// The feasible disc with the highest `J_d`, or, where no disc is feasible, the
/// one with the highest λ₂.
pub fn best_disc(problem: &PlacementProblem) -> Vec<CellId> {
    let mut discs: Vec<(f64, Vec<CellId>)> = problem
        .deployable()
        .iter()
        .map(|&centre| {
            let layout = disc(problem, centre);
            (super::coverage::Coverage::new(problem, &layout).utility(), layout)
        })
        .collect();
    discs.sort_by(|a, b| b.0.total_cmp(&a.0));
    if let Some(first) = discs.iter().position(|(_, disc)| Network::new(problem, disc).is_some()) {
        return discs.swap_remove(first).1;
    }
    let connectivity = |layout: &[CellId]| problem.connectivity(layout);
    discs
        .into_iter()
        .map(|(_, disc)| disc)
        .max_by(|a, b| connectivity(a).total_cmp(&connectivity(b)))
        .expect("a problem has at least one deployable cell")
}
