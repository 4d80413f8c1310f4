//! Where vehicles may not be, by chance.

use super::chance::{between, direction_rad, happens};
use crate::grid::SurveillanceGrid;
use crate::random::Stream;

/// Whether a vehicle may be in a cell, [row, column]: not beyond a straight border, or not
/// on an island.
pub(super) fn allowed_cells(random: &mut Stream, grid: &SurveillanceGrid) -> Vec<bool> {
    if happens(random, 0.5) { this_side(random, grid) } else { off_island(random, grid) }
}

/// A tenth to a third of the region lies beyond a straight border.
fn this_side(random: &mut Stream, grid: &SurveillanceGrid) -> Vec<bool> {
    let (sine, cosine) = direction_rad(random).sin_cos();
    let share = between(random, 0.1, 0.35);
    let places: Vec<f64> = grid
        .cells()
        .map(|cell| grid.centre(cell))
        .map(|centre| centre.east_m * cosine + centre.north_m * sine)
        .collect();
    let mut sorted = places.clone();
    sorted.sort_by(f64::total_cmp);
    let border = sorted[(share * places.len() as f64) as usize];
    places.into_iter().map(|place| place >= border).collect()
}

/// An island of 2 to 6 cells' radius, with bays.
fn off_island(random: &mut Stream, grid: &SurveillanceGrid) -> Vec<bool> {
    let east_m = between(random, 0.1, 0.9) * grid.width_m();
    let north_m = between(random, 0.1, 0.9) * grid.height_m();
    let radius_m = between(random, 2.0, 6.0) * grid.cell_width_m;
    let bays = [2.0, 3.0].map(|order| (order, between(random, 0.0, 0.3), direction_rad(random)));
    grid.cells()
        .map(|cell| grid.centre(cell))
        .map(|centre| {
            let (east, north) = (centre.east_m - east_m, centre.north_m - north_m);
            let bearing = north.atan2(east);
            let coast = bays
                .map(|(order, size, phase)| size * (order * bearing + phase).cos())
                .iter()
                .sum::<f64>();
            east.hypot(north) >= radius_m * (1.0 + coast)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    #[test]
    fn some_cells_are_excluded_and_most_are_not() {
        let grid =
            SurveillanceGrid { columns: 30, rows: 24, cell_width_m: 900.0, cell_height_m: 900.0 };
        for index in 0..100 {
            let mut random = stream(7, "test/exclusions", index);
            let excluded = allowed_cells(&mut random, &grid).iter().filter(|&&a| !a).count();
            // An island is at least a quarter on the map; 6 cells · 1.6 in radius at most.
            assert!((1..300).contains(&excluded), "{index}: {excluded}");
        }
    }
}
