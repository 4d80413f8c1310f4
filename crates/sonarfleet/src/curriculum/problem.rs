//! Placement problems by chance.

use super::chance::{between, happens, log_between};
use super::exclusions::allowed_cells;
use super::levels::{self, Links};
use super::priors::prior;
use super::variation::varied_table;
use super::{CurriculumError, LossCurve, PracticeTable};
use crate::grid::{CellId, Position, SurveillanceGrid};
use crate::placement::PlacementInput;
use crate::random::{Stream, stream};
use crate::sonar::SonarError;
use crate::sonar::detection::PassiveSonar;
use crate::sonar::prior::TargetPrior;
use crate::sonar::transmission_loss::LARGEST_LOSS_DB;
use rand::Rng;

/// Draws before a problem is given up.
const MOST_ATTEMPTS: usize = 40;

/// Share of the targets that the best of the discs hears, least and most: where it is
/// nearly all, or hardly anything, there is nothing to learn.
const LEAST_HEARD: f64 = 0.12;
const MOST_HEARD: f64 = 0.9;

/// Cells that are left free, at least, when the fleet is placed.
const FREE_CELLS: usize = 40;

/// Problem number `index` of a seed, from tables of oceans: the paper's problem and
/// instances like it are in the middle of what is drawn.
///
/// - Loss: a turned table, half of the time blended with another, half of the time with
///   deeper shadows, sometimes with returns from the bottom or speckled.
/// - Prior: corridors, blobs, rings or uniform, Σ `P_T` from 20 to 60.
/// - Target: as loud that half are heard, in the median, at 1 to 5 cells.
/// - Fleet: 12 to 60 vehicles, mostly 30 to 50; τ from 0.5 to 1.5, mostly near 0.95.
/// - Modem: as loud that a compact disc of the fleet reaches τ, and that half of the
///   packets arrive at no more than 5 cells; 128 to 1024 bits.
/// - Some have excluded cells, fixed sensors, uneven noise, other detectors, another loss
///   for the links.
///
/// # Errors
/// [`CurriculumError::NoProblem`] where no draw gave one; none is expected of the oceans of
/// [`OceanStore`](super::OceanStore).
///
/// # Panics
/// Where there are no tables.
pub fn practice_problem(
    seed: u64,
    index: u64,
    tables: &[PracticeTable],
) -> Result<PlacementInput, CurriculumError> {
    assert!(!tables.is_empty(), "problems are drawn from at least one table");
    let mut random = stream(seed, "curriculum/problem", index);
    for _ in 0..MOST_ATTEMPTS {
        if let Some(input) = attempt(&mut random, tables)? {
            return Ok(input);
        }
    }
    Err(CurriculumError::NoProblem { seed, index, attempts: MOST_ATTEMPTS })
}

fn attempt(
    random: &mut Stream,
    tables: &[PracticeTable],
) -> Result<Option<PlacementInput>, SonarError> {
    let table = varied_table(random, tables);
    let grid = table.grid;
    let prior = prior(random, &grid);
    let vehicles = draw_vehicles(random);
    let connectivity_threshold = draw_threshold(random);

    let curve = LossCurve::of(&table);
    let Some(sonar) = levels::sonar(random, &curve, &grid)? else { return Ok(None) };

    let mut deployable = table.open_cells();
    if happens(random, 0.12) {
        let allowed = allowed_cells(random, &grid);
        deployable.iter_mut().zip(allowed).for_each(|(cell, allowed)| *cell &= allowed);
    }
    let home = middle_of(&prior, &grid);
    let fixed_sensors = if happens(random, 0.12) {
        draw_fixed_sensors(random, &table, home, vehicles)
    } else {
        Vec::new()
    };
    let mut free: Vec<CellId> = grid.cells().filter(|cell| deployable[cell.0]).collect();
    free.retain(|cell| !fixed_sensors.contains(cell));
    if free.len() < vehicles + FREE_CELLS {
        return Ok(None);
    }

    let elsewhere = grid.centre(free[random.random_range(0..free.len())]);
    let middle = Position::new(0.5 * grid.width_m(), 0.5 * grid.height_m());
    // A fleet that must keep in touch with fixed sensors is near them.
    let centres = if fixed_sensors.is_empty() { vec![home, middle, elsewhere] } else { vec![home] };
    let discs: Vec<Vec<CellId>> = centres
        .into_iter()
        .map(|centre| {
            let mut disc = nearest(&grid, &mut free, centre, vehicles);
            disc.extend(&fixed_sensors);
            disc
        })
        .collect();
    let shares = discs.iter().map(|disc| heard_share(&sonar, &table, &prior, disc));
    let heard = shares.fold(0.0, f64::max);
    if !(LEAST_HEARD..=MOST_HEARD).contains(&heard) {
        return Ok(None);
    }
    let communication = happens(random, 0.1)
        .then(|| PracticeTable { grid, loss_db: higher_pitched(random, &table) });
    let table_of_links = communication.as_ref().unwrap_or(&table);
    let links = Links { loss_db: &table_of_links.loss_db, curve: LossCurve::of(table_of_links) };
    let Some(modem) = levels::modem(random, &links, &discs, connectivity_threshold) else {
        return Ok(None);
    };
    Ok(Some(PlacementInput {
        grid,
        prior: TargetPrior::new(prior)?,
        detection_loss_db: table.loss_db,
        communication_loss_db: communication.map(|table| table.loss_db),
        sonar,
        modem,
        vehicles,
        connectivity_threshold,
        deployable: deployable.contains(&false).then_some(deployable),
        fixed_sensors,
    }))
}

/// Share of the expected targets that are heard from some cells, `J_d` / Σ `P_T`.
fn heard_share(
    sonar: &PassiveSonar,
    table: &PracticeTable,
    prior: &[f64],
    stations: &[CellId],
) -> f64 {
    let cells = table.grid.cell_count();
    let mut missed = prior.to_vec();
    for &cell in stations {
        let losses_db = &table.loss_db[cell.0 * cells..(cell.0 + 1) * cells];
        for (missed, p_d) in missed.iter_mut().zip(sonar.detection_probabilities(cell, losses_db)) {
            *missed *= 1.0 - p_d;
        }
    }
    1.0 - missed.iter().sum::<f64>() / prior.iter().sum::<f64>()
}

fn draw_vehicles(random: &mut Stream) -> usize {
    if happens(random, 0.25) {
        40
    } else if happens(random, 0.7) {
        random.random_range(30..=50)
    } else {
        random.random_range(12..=60)
    }
}

fn draw_threshold(random: &mut Stream) -> f64 {
    if happens(random, 0.3) {
        0.95
    } else if happens(random, 0.6) {
        between(random, 0.85, 1.05)
    } else {
        log_between(random, 0.5, 1.5)
    }
}

/// The point about which targets are expected.
fn middle_of(prior: &[f64], grid: &SurveillanceGrid) -> Position {
    let (mut east, mut north, mut total) = (0.0, 0.0, 0.0);
    for (cell, expected) in grid.cells().zip(prior) {
        let centre = grid.centre(cell);
        east += expected * centre.east_m;
        north += expected * centre.north_m;
        total += expected;
    }
    Position::new(east / total, north / total)
}

/// One to three open cells in and around the disc that the fleet fills about a point.
fn draw_fixed_sensors(
    random: &mut Stream,
    table: &PracticeTable,
    home: Position,
    vehicles: usize,
) -> Vec<CellId> {
    let grid = table.grid;
    let open = table.open_cells();
    let mut free: Vec<CellId> = grid.cells().filter(|cell| open[cell.0]).collect();
    let disc_m = (vehicles as f64 / std::f64::consts::PI).sqrt() * grid.cell_width_m;
    let mut sensors = Vec::new();
    for _ in 0..random.random_range(1..=3) {
        let [east, north] = [0, 1].map(|_| between(random, -0.8, 0.8) * disc_m);
        let point = Position::new(home.east_m + east, home.north_m + north);
        let cell = nearest(&grid, &mut free, point, 1);
        free.retain(|other| !cell.contains(other));
        sensors.extend(cell);
    }
    sensors
}

/// The cells nearest to a point, `count` of them; `cells` are reordered.
fn nearest(
    grid: &SurveillanceGrid,
    cells: &mut [CellId],
    point: Position,
    count: usize,
) -> Vec<CellId> {
    let distance_m = |cell: &CellId| grid.centre(*cell).distance_m(point);
    cells.sort_by(|a, b| distance_m(a).total_cmp(&distance_m(b)).then(a.cmp(b)));
    cells[..count.min(cells.len())].to_vec()
}

/// Losses at a higher frequency: as they are, with more absorption.
fn higher_pitched(random: &mut Stream, table: &PracticeTable) -> Vec<f32> {
    let PracticeTable { grid, loss_db } = table;
    let absorption_db_km = between(random, 0.2, 2.0);
    let cells = grid.cell_count();
    let loss = |(index, &loss): (usize, &f32)| {
        let [a, b] = [index / cells, index % cells].map(|cell| grid.centre(CellId(cell)));
        let more_db = 1e-3 * a.distance_m(b) * absorption_db_km;
        (loss + more_db as f32).min(LARGEST_LOSS_DB)
    };
    loss_db.iter().enumerate().map(loss).collect()
}

#[cfg(test)]
mod tests {
    use super::super::levels::{DETECTION_CELLS, LONGEST_LINK_CELLS};
    use super::*;
    use crate::placement::PlacementProblem;
    use crate::placement::compact::best_disc;
    use crate::sonar::noise::NoiseLevel;

    /// What half-cell steps of the median loss leave of a radius, cells.
    const CURVE_CELLS: f64 = 0.3;

    /// Oceans by formula: spherical spreading with absorption; a shadow from 3 cells on, on
    /// another grid; a shoal in the first that is in the ground.
    fn tables() -> Vec<PracticeTable> {
        let table = |columns, rows, law: fn(f64) -> f64| {
            let grid =
                SurveillanceGrid { columns, rows, cell_width_m: 1030.0, cell_height_m: 1030.0 };
            let loss = |a: CellId, b: CellId| {
                let distance_m = grid.centre(a).distance_m(grid.centre(b)).max(500.0);
                law(distance_m) as f32
            };
            let cells = grid.cells().flat_map(|a| grid.cells().map(move |b| (a, b)));
            PracticeTable { grid, loss_db: cells.map(|(a, b)| loss(a, b)).collect() }
        };
        let spherical = |m: f64| 20.0 * m.log10() + 0.5e-3 * m;
        let shadow = |m: f64| if m < 3_000.0 { 15.0 * m.log10() + 13.0 } else { 78.0 + 0.5e-3 * m };
        let mut tables = vec![table(18, 18, spherical), table(20, 16, shadow)];
        let shoal = PracticeTable {
            loss_db: (0..324 * 324)
                .map(|at| if at / 324 < 20 || at % 324 < 20 { LARGEST_LOSS_DB } else { 0.0 })
                .zip(&tables[0].loss_db)
                .map(|(ground, &loss)| loss.max(ground))
                .collect(),
            ..tables[0].clone()
        };
        tables.push(shoal);
        tables
    }

    #[test]
    fn problems_are_valid_and_a_disc_solves_them() {
        let tables = tables();
        let (mut vehicles, mut with_mask, mut with_sensors) = (Vec::new(), 0, 0);
        for index in 0..40 {
            let input = practice_problem(3, index, &tables).unwrap();
            let problem = PlacementProblem::new(&input).unwrap();
            assert!((12..=60).contains(&input.vehicles));
            assert!((0.5..=1.5).contains(&input.connectivity_threshold));
            let total = input.prior.total();
            assert!((20.0 - 1e-9..=60.0 + 1e-9).contains(&total), "{index}: {total}");
            let layout = best_disc(&problem);
            let evaluation = problem.evaluate(&layout);
            assert!(evaluation.feasible, "{index}: {:?}", input.modem);
            let heard = evaluation.detection_utility / total;
            assert!((LEAST_HEARD..0.99).contains(&heard), "{index}: {heard}");
            vehicles.push(input.vehicles);
            with_mask += usize::from(input.deployable.is_some());
            with_sensors += usize::from(!input.fixed_sensors.is_empty());
        }
        let usual = vehicles.iter().filter(|count| (30..=50).contains(*count)).count();
        assert!(usual > 22, "{usual} of 40 have 30 to 50 vehicles");
        assert!(with_mask > 6 && with_sensors > 1, "{with_mask} {with_sensors}");
    }

    #[test]
    fn radii_are_in_range_and_vary() {
        let tables = tables();
        let mut radii = Vec::new();
        for index in 0..40 {
            let input = practice_problem(4, index, &tables).unwrap();
            let curve_of = |loss_db: &[f32]| {
                LossCurve::of(&PracticeTable { grid: input.grid, loss_db: loss_db.to_vec() })
            };
            let noise_db = |noise: &NoiseLevel, cells: usize| {
                (0..cells).map(|cell| noise.at_db(CellId(cell))).sum::<f64>() / cells as f64
            };
            // The largest distance, in tenths of cells, at which more than half succeed.
            let radius = |succeeds: &dyn Fn(f64) -> bool| {
                (10..120).map(|tenth| 0.1 * f64::from(tenth)).rfind(|&r| succeeds(r)).unwrap_or(0.0)
            };
            let curve = curve_of(&input.detection_loss_db);
            let sonar = &input.sonar;
            let noise = noise_db(&sonar.noise_level_db, input.grid.cell_count());
            let detection = radius(&|r| {
                let snr_db = sonar.source_level_db - curve.loss_db(r) - noise
                    + sonar.directivity_index_db
                    - sonar.detection_threshold_db;
                sonar.model.probability(snr_db) > 0.5 - 0.01
            });
            let [shortest, longest] = DETECTION_CELLS;
            assert!(
                (shortest - CURVE_CELLS..longest + CURVE_CELLS).contains(&detection),
                "{index}: {detection}"
            );
            let curve =
                curve_of(input.communication_loss_db.as_ref().unwrap_or(&input.detection_loss_db));
            let link = radius(&|r| {
                let snr_db = input.modem.snr_db(CellId(0), curve.loss_db(r));
                input.modem.model.packet_success(snr_db) > 0.5
            });
            assert!(link < LONGEST_LINK_CELLS + CURVE_CELLS, "{index}: {link}");
            radii.push((detection, link));
        }
        for pick in [|r: &(f64, f64)| r.0, |r: &(f64, f64)| r.1] {
            let mut sorted: Vec<f64> = radii.iter().map(pick).collect();
            sorted.sort_by(f64::total_cmp);
            assert!(sorted[36] - sorted[4] > 1.0, "{sorted:?}");
        }
    }

    #[test]
    fn the_same_seed_and_index_give_the_same_problem() {
        let tables = tables();
        let draw = |index| format!("{:?}", practice_problem(5, index, &tables).unwrap());
        assert_eq!(draw(2), draw(2));
        assert_ne!(draw(2), draw(3));
    }

    #[test]
    fn silent_oceans_are_an_error_that_says_so() {
        let grid =
            SurveillanceGrid { columns: 10, rows: 10, cell_width_m: 1.0, cell_height_m: 1.0 };
        let silent = PracticeTable { grid, loss_db: vec![LARGEST_LOSS_DB; 10_000] };
        let error = practice_problem(5, 2, &[silent]).unwrap_err();
        assert_eq!(error.to_string(), "problem 2 of seed 5: none of 40 draws has a connected disc");
    }
}
