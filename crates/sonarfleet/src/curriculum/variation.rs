//! More tables from the computed ones: turned, blended, with deeper shadows, with returns
//! from the bottom, and speckled.

use super::chance::{between, gamma, happens};
use super::levels::uneven_db;
use super::{LossCurve, PracticeTable, Symmetry};
use crate::random::Stream;
use crate::sonar::transmission_loss::LARGEST_LOSS_DB;
use rand::Rng;

/// A turned table of any of the oceans, often blended with another of the same grid or
/// with deeper shadows, sometimes with returns from a firm bottom or speckled.
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
    if happens(random, 0.5) {
        let edge_db = LossCurve::of(&table).loss_db(between(random, 1.5, 3.5)) as f32;
        deepen_shadows(&mut table, edge_db, between(random, 0.5, 3.0) as f32);
    }
    if happens(random, 0.25) {
        let level_db = LossCurve::of(&table).loss_db(between(random, 2.0, 4.0));
        let level_db = level_db + between(random, -3.0, 8.0);
        return_from_bottom(random, &mut table, level_db);
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

/// Sharper edges between what is heard and what is not: losses above that of the edge
/// exceed it by more, as over a softer bottom and under a steeper thermocline.
fn deepen_shadows(table: &mut PracticeTable, edge_db: f32, by: f32) {
    for loss in &mut table.loss_db {
        if *loss < LARGEST_LOSS_DB {
            *loss = (*loss + by * (*loss - edge_db).max(0.0)).min(LARGEST_LOSS_DB);
        }
    }
}

/// Adds paths by way of a firm bottom, which reach everywhere at nearly the same level: it
/// changes by a few decibels over the region, as the depth does, and from pair to pair.
fn return_from_bottom(random: &mut Stream, table: &mut PracticeTable, level_db: f64) {
    let offsets_db = uneven_db(random, 0.0, &table.grid);
    let roughness_db = between(random, 0.3, 2.0);
    change_pairs(table, |source, target| {
        let change_db = between(random, -roughness_db, roughness_db);
        let trend_db = f64::midpoint(offsets_db[source], offsets_db[target]);
        let bottom = 10f64.powf(-0.1 * (level_db + trend_db + change_db));
        move |loss| (-10.0 * (10f64.powf(-0.1 * f64::from(loss)) + bottom).log10()) as f32
    });
}

/// What several coherent arrivals do to a table: every pair of cells has its own chance.
/// The intensity is that of the table times a gamma variable of mean 1.
fn speckle(random: &mut Stream, table: &mut PracticeTable, shape: f64) {
    change_pairs(table, |_, _| {
        let change_db = (10.0 * gamma(random, shape).log10()) as f32;
        move |loss| loss - change_db
    });
}

/// Changes the losses of every pair of cells, alike in both directions; what lies in the
/// ground stays there.
fn change_pairs<C: Fn(f32) -> f32>(
    table: &mut PracticeTable,
    mut change_of: impl FnMut(usize, usize) -> C,
) {
    let cells = table.grid.cell_count();
    for source in 0..cells {
        for target in 0..=source {
            let change = change_of(source, target);
            let ways = [source * cells + target, target * cells + source];
            for &way in &ways[..if source == target { 1 } else { 2 }] {
                let loss = &mut table.loss_db[way];
                if *loss < LARGEST_LOSS_DB {
                    *loss = change(*loss).min(LARGEST_LOSS_DB);
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
    fn shadows_deepen_beyond_their_edge_only() {
        let mut losses = table([60.0, 75.0, 90.0, LARGEST_LOSS_DB]);
        deepen_shadows(&mut losses, 70.0, 2.0);
        assert_eq!(losses.loss_db, [60.0, 85.0, 130.0, LARGEST_LOSS_DB]);
    }

    #[test]
    fn the_bottom_returns_its_level_where_nothing_else_arrives() {
        let grid = SurveillanceGrid { columns: 5, rows: 4, cell_width_m: 1.0, cell_height_m: 1.0 };
        let mut losses = PracticeTable { grid, loss_db: vec![150.0; 400] };
        losses.loss_db[..20].fill(60.0);
        losses.loss_db[399] = LARGEST_LOSS_DB;
        return_from_bottom(&mut stream(2, "test/bottom", 0), &mut losses, 80.0);
        for (index, &loss) in losses.loss_db.iter().enumerate() {
            match index {
                0..20 => assert!((loss - 60.0).abs() < 0.2, "{loss} beside a stronger path"),
                399 => assert_eq!(loss.to_bits(), LARGEST_LOSS_DB.to_bits()),
                _ => assert!((loss - 80.0).abs() < 6.0, "{loss}"),
            }
        }
        assert_eq!(losses.loss_db[20 * 7 + 12].to_bits(), losses.loss_db[20 * 12 + 7].to_bits());
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
