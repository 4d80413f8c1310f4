//! Makes a store of practice oceans, and prints of each what was drawn and the median loss
//! within a cell and at 1, 2, 3, 5, 8 and 12 cells: `practice_oceans DIR [COUNT] [SEED] [FIRST]`.
//!
//! `practice_oceans --numerics [COUNT] [SEED]` prints how long tables take instead, and how
//! far they are from `fast` and from `fine` ones on three sources.
//!
//! `practice_oceans --problems DIR [COUNT] [SEED] [OCEANS]` draws problems from the first
//! oceans of the store's seed 1 and prints what was drawn, with the compact disc that a
//! fleet would be.

use sonarfleet::curriculum::{
    LossCurve, OceanStore, PracticeTable, TrainingOcean, practice_problem,
};
use sonarfleet::grid::CellId;
use sonarfleet::placement::compact::best_disc;
use sonarfleet::placement::greedy::ConnectedGreedy;
use sonarfleet::placement::{Budget, PlacementProblem, Solver};
use sonarfleet::sonar::transmission_loss::{
    ErrorEstimate, LossTableSettings, Quality, compute_rows,
};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let first = arguments.first().ok_or("usage: practice_oceans DIR [COUNT] [SEED] [FIRST]")?;
    let number = |at: usize, otherwise: u64| -> Result<u64, Box<dyn Error>> {
        Ok(arguments.get(at).map_or(Ok(otherwise), |text| text.parse())?)
    };
    if first == "--problems" {
        let directory = arguments.get(1).ok_or("--problems needs the store's directory")?;
        return problems(directory, number(2, 10)?, number(3, 1)?, number(4, 30)?);
    }
    let (count, seed) = (number(1, 10)?, number(2, 1)?);
    if first == "--numerics" {
        return (0..count).try_for_each(|index| compare(seed, index));
    }
    let store = OceanStore::new(first);
    for index in number(3, 0)?..count {
        let start = Instant::now();
        let ocean = TrainingOcean::draw(seed, index);
        let table = store.table(seed, index)?;
        let seconds = start.elapsed().as_secs_f64();
        println!("{index:4} {seconds:5.1} s {} median loss {}", describe(&ocean), medians(&table));
    }
    Ok(())
}

fn describe(ocean: &TrainingOcean) -> String {
    let TrainingOcean { grid, ocean, bottom, settings } = ocean;
    let column = &ocean.column;
    format!(
        "{}×{} of {:.2} km, {:4.0} Hz at {:3.0} m, surface {:4.1} °C, mixed {:3.0} m, deep {:4.1} °C, {} eddies {} front, floor {:4.0} m {:.3} {} mounts {} trenches, bottom {:4.0} m/s",
        grid.columns,
        grid.rows,
        1e-3 * grid.cell_width_m,
        settings.frequency_hz,
        settings.fleet_depth_m,
        column.temperature_c(0.0),
        column.mixed_layer_m,
        column.deep_temperature_c,
        ocean.eddies.len(),
        u8::from(ocean.front.is_some()),
        ocean.relief.middle_m,
        ocean.relief.gradient,
        ocean.relief.mounts.len(),
        ocean.relief.trenches.len(),
        bottom.speed_m_s,
    )
}

/// Median losses at whole distances.
fn medians(table: &PracticeTable) -> String {
    let PracticeTable { grid, loss_db } = table;
    let cells = grid.cell_count();
    let median = |distance: f64| {
        let mut losses: Vec<f32> = grid
            .cells()
            .flat_map(|a| grid.cells().map(move |b| (a, b)))
            .filter(|&(a, b)| {
                let d = grid.centre(a).distance_m(grid.centre(b)) / grid.cell_width_m;
                (d - distance).abs() <= 0.3
            })
            .map(|(a, b)| loss_db[a.0 * cells + b.0])
            .collect();
        losses.sort_by(f32::total_cmp);
        format!("{:5.1}", losses[losses.len() / 2])
    };
    [0.0, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0].map(median).join(" ")
}

fn compare(seed: u64, index: u64) -> Result<(), Box<dyn Error>> {
    let ocean = TrainingOcean::draw(seed, index);
    let waters = ocean.waters()?;
    let count = ocean.grid.cell_count();
    let sources = [count / 4, count / 2 + ocean.grid.columns / 2, 4 * count / 5].map(CellId);
    let rows = |settings: &LossTableSettings| {
        let start = Instant::now();
        let rows = compute_rows(&waters, &ocean.grid, settings, &sources, &|_, _| {})?;
        let row_ms = 1e3 * start.elapsed().as_secs_f64() / sources.len() as f64;
        Ok::<_, Box<dyn Error>>((rows, row_ms))
    };
    let (practice, practice_ms) = rows(&ocean.settings)?;
    let fast = LossTableSettings { numerics: Quality::Fast.numerics(), ..ocean.settings.clone() };
    let (fast, fast_ms) = rows(&fast)?;
    let (fine, _) = rows(&ocean.settings.fine())?;
    println!("{index:4} {}", describe(&ocean));
    println!("     {practice_ms:.1} ms a source, fast {fast_ms:.1} ms");
    for (what, estimate) in [
        ("practice from fast", ErrorEstimate::between(&practice, &fast)),
        ("practice from fine", ErrorEstimate::between(&practice, &fine)),
        ("fast from fine", ErrorEstimate::between(&fast, &fine)),
    ] {
        let ErrorEstimate { compared, median_db, p90_db, p99_db, .. } = estimate;
        println!(
            "     {what}: {compared} losses, median {median_db:.2}, p90 {p90_db:.2}, p99 {p99_db:.2} dB"
        );
    }
    Ok(())
}

fn problems(directory: &str, count: u64, seed: u64, oceans: u64) -> Result<(), Box<dyn Error>> {
    let tables = OceanStore::new(directory).tables(1, oceans, &|_, _| {})?;
    for index in 0..count {
        let start = Instant::now();
        let input = practice_problem(seed, index, &tables)?;
        let milliseconds = 1e3 * start.elapsed().as_secs_f64();
        let curve_of = |loss_db: &[f32]| {
            LossCurve::of(&PracticeTable { grid: input.grid, loss_db: loss_db.to_vec() })
        };
        let reach = |curve: &LossCurve, heard: &dyn Fn(f64) -> bool| {
            let last = (10..140)
                .map(|tenth| 0.1 * f64::from(tenth))
                .filter(|&r| heard(curve.loss_db(r)))
                .last();
            last.unwrap_or(0.0)
        };
        let curve = curve_of(&input.detection_loss_db);
        let sonar = &input.sonar;
        let detection =
            reach(&curve, &|loss| sonar.model.probability(sonar.snr_db(CellId(0), loss)) > 0.5);
        let links =
            curve_of(input.communication_loss_db.as_ref().unwrap_or(&input.detection_loss_db));
        let modem = &input.modem;
        let link =
            reach(&links, &|loss| modem.model.packet_success(modem.snr_db(CellId(0), loss)) > 0.5);
        let problem = PlacementProblem::new(&input)?;
        let disc = problem.evaluate(&best_disc(&problem));
        let spread = ConnectedGreedy.solve(&problem, Budget::Evaluations(1), 1).evaluation;
        println!(
            "{index:4} {milliseconds:4.0} ms {}×{} of {:.2} km, SL {:5.1} ({detection:.1} cells), SLc {:5.1} ({link:.1} cells), G {}, τ {:.2}, ΣP_T {:.1}, {} excluded, {} fixed: disc J_d {:5.2} λ₂ {:5.2}, connected greedy J_d {:5.2} λ₂ {:5.2} {}",
            input.grid.columns,
            input.grid.rows,
            1e-3 * input.grid.cell_width_m,
            sonar.source_level_db,
            modem.source_level_db,
            input.vehicles,
            input.connectivity_threshold,
            input.prior.total(),
            input.deployable.as_ref().map_or(0, |mask| mask.iter().filter(|&&d| !d).count()),
            input.fixed_sensors.len(),
            disc.detection_utility,
            disc.algebraic_connectivity,
            spread.detection_utility,
            spread.algebraic_connectivity,
            if spread.feasible { "feasible" } else { "infeasible" },
        );
    }
    Ok(())
}
