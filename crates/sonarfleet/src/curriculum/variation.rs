//! More tables from the computed ones: turned, blended and speckled.

use super::chance::{between, gamma, happens};
use super::{PracticeTable, Symmetry};
use crate::random::Stream;
use crate::sonar::transmission_loss::LARGEST_LOSS_DB;
use rand::Rng;

/// A turned table of any of the oceans, often blended with another of the same grid, and
/// sometimes speckled.
pub(super) fn varied_table(random: &mut Stream, tables: &[PracticeTable]) -> PracticeTable {
    let turned = |random: &mut Stream| {
        let table = &tables[random.random_range(0..tables.len())];
        Symmetry::all()[random.random_range(0..8)].of_table(table)
    };
    let mut table = turned(random);
    if happens(random, 0.5) {
        let other = turned(random);
        if other.grid == table.grid {
            let weight = between(random, 0.0, 0.5) as f32;
            blend(&mut table, &other, weight, happens(random, 0.5));
        }
    }
    if happens(random, 0.25) {
        let shape = between(random, 1.5, 6.0);
        speckle(random, &mut table, shape);
    }
    table
}

/// Mixes another table of the same grid in: a mean of levels, or of intensities. A cell
/// that lies in the ground in either table does so in the blend.
fn blend(table: &mut PracticeTable, other: &PracticeTable, weight: f32, of_intensities: bool) {
    let intensity = |loss_db: f32| (-loss_db * (std::f32::consts::LN_10 / 10.0)).exp();
    for (loss, &other) in table.loss_db.iter_mut().zip(&other.loss_db) {
        *loss = if loss.max(other) >= LARGEST_LOSS_DB {
            LARGEST_LOSS_DB
        } else if of_intensities {
            -10.0 * ((1.0 - weight) * intensity(*loss) + weight * intensity(other)).log10()
        } else {
            *loss + weight * (other - *loss)
        };
    }
}

/// What several coherent arrivals do to a table: every pair of cells has its own chance,
/// the same in both directions. The intensity is that of the table times a gamma variable
/// of mean 1.
fn speckle(random: &mut Stream, table: &mut PracticeTable, shape: f64) {
    let cells = table.grid.cell_count();
    for source in 0..cells {
        for target in 0..=source {
            let change_db = (10.0 * gamma(random, shape).log10()) as f32;
            let ways = [source * cells + target, target * cells + source];
            for &way in &ways[..if source == target { 1 } else { 2 }] {
                let loss = &mut table.loss_db[way];
                if *loss < LARGEST_LOSS_DB {
                    *loss = (*loss - change_db).min(LARGEST_LOSS_DB);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::SurveillanceGrid;
    use crate::random::stream;

    fn table(losses: [f32; 4]) -> PracticeTable {
        let grid = SurveillanceGrid { columns: 2, rows: 1, cell_width_m: 1.0, cell_height_m: 1.0 };
        PracticeTable { grid, loss_db: losses.to_vec() }
    }

    #[test]
    fn blends_are_means() {
        let other = table([60.0, 80.0, 90.0, 200.0]);
        let mut levels = table([50.0, 70.0, 90.0, 50.0]);
        blend(&mut levels, &other, 0.25, false);
        assert_eq!(levels.loss_db, [52.5, 72.5, 90.0, 200.0]);
        let mut intensities = table([50.0, 70.0, 90.0, 50.0]);
        blend(&mut intensities, &other, 0.25, true);
        // −10 lg(0.75·10⁻⁵ + 0.25·10⁻⁶) is 51.1070.
        assert!((intensities.loss_db[0] - 51.1070).abs() < 1e-3, "{}", intensities.loss_db[0]);
        assert!((intensities.loss_db[2] - 90.0).abs() < 1e-4);
    }

    #[test]
    fn speckle_is_the_same_both_ways_and_keeps_the_mean_intensity() {
        let grid =
            SurveillanceGrid { columns: 20, rows: 10, cell_width_m: 1.0, cell_height_m: 1.0 };
        let mut table = PracticeTable { grid, loss_db: vec![70.0; 200 * 200] };
        table.loss_db[7] = LARGEST_LOSS_DB;
        speckle(&mut stream(5, "test/speckle", 0), &mut table, 2.0);
        let at = |a: usize, b: usize| table.loss_db[200 * a + b];
        assert_eq!(at(3, 150).to_bits(), at(150, 3).to_bits());
        assert_eq!(at(0, 7).to_bits(), LARGEST_LOSS_DB.to_bits(), "silence stays");
        let heard = table.loss_db.iter().filter(|&&loss| loss < LARGEST_LOSS_DB);
        let mean: f64 =
            heard.map(|&loss| 10f64.powf(7.0 - 0.1 * f64::from(loss))).sum::<f64>() / 39_999.0;
        // 20 000 draws of variance 1/2: four standard errors.
        assert!((mean - 1.0).abs() < 0.02, "{mean}");
    }
}
