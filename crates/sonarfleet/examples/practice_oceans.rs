//! Makes a store of practice oceans, and prints of each what was drawn and the median loss
//! at 1, 2, 3, 5, 8 and 12 cells: `practice_oceans DIR [COUNT] [SEED] [FIRST]`.
//!
//! `practice_oceans --numerics [COUNT] [SEED]` prints how long tables take instead, and how
//! far they are from `fast` and from `fine` ones on three sources.

use sonarfleet::curriculum::{OceanStore, PracticeTable, TrainingOcean};
use sonarfleet::grid::CellId;
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
    let mut text = String::new();
    for distance in [0.0, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0] {
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
        text += &format!(" {:5.1}", losses[losses.len() / 2]);
    }
    text
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
