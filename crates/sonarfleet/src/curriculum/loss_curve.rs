//! How loss grows with distance, in the median over a table.

use super::PracticeTable;

/// Distances are told apart to so many parts of a cell.
const PARTS: usize = 2;

/// As far as the curve goes, cells.
const LONGEST_CELLS: usize = 14;

/// Median loss over distance; distances are in cells, of their mean length.
#[derive(Debug, Clone, PartialEq)]
pub struct LossCurve {
    /// Mean distance of the pairs of cells at about each half cell, from one cell on,
    /// ascending.
    distance_cells: Vec<f64>,
    /// Their median loss, dB.
    median_db: Vec<f64>,
}

impl LossCurve {
    /// The curve of a table. What lies in the ground, and hears nothing, is left out.
    pub fn of(table: &PracticeTable) -> Self {
        let PracticeTable { grid, loss_db } = table;
        let cell_m = 0.5 * (grid.cell_width_m + grid.cell_height_m);
        let cells = grid.cell_count();
        let open = table.open_cells();
        let mut bins = vec![(0.0, Vec::new()); PARTS * (LONGEST_CELLS - 1) + 1];
        for source in grid.cells().filter(|cell| open[cell.0]) {
            let row = &loss_db[source.0 * cells..(source.0 + 1) * cells];
            for target in grid.cells().filter(|cell| open[cell.0]) {
                let distance = grid.centre(source).distance_m(grid.centre(target)) / cell_m;
                let place = (PARTS as f64 * distance).round() as usize;
                let bin = place.checked_sub(PARTS).and_then(|bin| bins.get_mut(bin));
                if let Some((sum, losses)) = bin {
                    *sum += distance;
                    losses.push(row[target.0]);
                }
            }
        }
        bins.retain(|(_, losses)| !losses.is_empty());
        Self {
            distance_cells: bins.iter().map(|(sum, losses)| sum / losses.len() as f64).collect(),
            median_db: bins.into_iter().map(|(_, losses)| f64::from(median(losses))).collect(),
        }
    }

    /// Median loss at a distance, dB: linear over distance, constant up to one cell, +∞
    /// beyond the curve.
    pub fn loss_db(&self, distance_cells: f64) -> f64 {
        let after = self.distance_cells.partition_point(|&d| d < distance_cells);
        let Some(&beyond_db) = self.median_db.get(after) else { return f64::INFINITY };
        if after == 0 {
            return beyond_db;
        }
        let (near, far) = (self.distance_cells[after - 1], self.distance_cells[after]);
        let weight = (distance_cells - near) / (far - near);
        self.median_db[after - 1] + weight * (beyond_db - self.median_db[after - 1])
    }

    /// The largest distance, cells, at which the median loss is at most this; 0 where it is
    /// more from one cell on.
    pub fn radius_cells(&self, loss_db: f64) -> f64 {
        let Some(last) = self.median_db.iter().rposition(|&median| median <= loss_db) else {
            return 0.0;
        };
        let (near, within_db) = (self.distance_cells[last], self.median_db[last]);
        match (self.distance_cells.get(last + 1), self.median_db.get(last + 1)) {
            (Some(far), Some(beyond_db)) => {
                near + (far - near) * (loss_db - within_db) / (beyond_db - within_db)
            }
            _ => near,
        }
    }

    /// The least of the median losses from a distance on, dB: with less the radius is
    /// shorter.
    pub fn least_beyond_db(&self, distance_cells: f64) -> f64 {
        let first = self.distance_cells.partition_point(|&d| d < distance_cells);
        let beyond = self.median_db[first..].iter().copied();
        beyond.fold(self.loss_db(distance_cells), f64::min)
    }
}

/// The upper median of at least one loss.
fn median(mut losses: Vec<f32>) -> f32 {
    let middle = losses.len() / 2;
    *losses.select_nth_unstable_by(middle, f32::total_cmp).1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::SurveillanceGrid;

    /// Losses that grow by 6 dB a cell come back so, within what pairs of cells up to a
    /// quarter of a cell nearer and farther leave.
    #[test]
    fn a_law_of_distance_comes_back() {
        const TOLERANCE_CELLS: f64 = 0.15;
        let grid =
            SurveillanceGrid { columns: 20, rows: 18, cell_width_m: 800.0, cell_height_m: 800.0 };
        let law = |cells: f64| 50.0 + 6.0 * cells;
        let loss_db = grid
            .cells()
            .flat_map(|a| grid.cells().map(move |b| grid.centre(a).distance_m(grid.centre(b))))
            .map(|distance_m| law(distance_m / 800.0) as f32)
            .collect();
        let curve = LossCurve::of(&PracticeTable { grid, loss_db });
        for distance in [1.0, 2.0, 3.2, 4.7, 9.0] {
            let radius = curve.radius_cells(law(distance));
            assert!((radius - distance).abs() < TOLERANCE_CELLS, "{distance}: {radius}");
            let loss = curve.loss_db(distance);
            assert!((loss - law(distance)).abs() < 6.0 * TOLERANCE_CELLS, "{distance}: {loss}");
            assert!((curve.least_beyond_db(distance) - law(distance)).abs() < 4.0);
        }
        assert!(curve.radius_cells(50.0).abs() < f64::EPSILON);
    }
}
