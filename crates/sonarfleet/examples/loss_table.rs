//! Time and error of a table of transmission loss at every quality, over clay,
//! mud, a firm fluid and sand, in the synthetic South China Sea.
//!
//! `cargo run --release --example loss_table -- [fast|standard|fine]… [sampled sources]`

use sonarfleet::grid::{CellId, SurveillanceGrid};
use sonarfleet::sonar::section::Waters;
use sonarfleet::sonar::transmission_loss::{
    LossTableSettings, Quality, TableModel, compute_transmission_loss, estimate_error,
};
use sonarfleet_acoustics::environment::{Boundary, FluidHalfSpace, Seabed};
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::LocalFrame;
use sonarfleet_ocean::synthetic::SyntheticOcean;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut qualities = Vec::new();
    let mut sampled = 10;
    for argument in std::env::args().skip(1) {
        match argument.parse::<usize>() {
            Ok(count) => sampled = count,
            Err(_) => qualities.push(argument.parse::<Quality>()?),
        }
    }
    if qualities.is_empty() {
        qualities = vec![Quality::Fast, Quality::Standard];
    }

    let ocean = SyntheticOcean { states: 1, ..SyntheticOcean::default() };
    let frame = LocalFrame::new(ocean.region);
    let (forecast, bathymetry) = (ocean.forecast(), ocean.bathymetry());
    let grid = SurveillanceGrid {
        columns: 30,
        rows: 30,
        cell_width_m: frame.width_m() / 30.0,
        cell_height_m: frame.height_m() / 30.0,
    };
    let count = grid.cell_count();
    let sample: Vec<CellId> =
        (0..sampled).map(|k| CellId((k * count + count / 2) / sampled.max(1) % count)).collect();
    let firm = FluidHalfSpace::new(1600.0, 1.7, 0.5)?;
    let floors = [
        ("clay", Seabed::Clay.half_space()),
        ("mud", Seabed::Mud.half_space()),
        ("firm", firm),
        ("sand", Seabed::Sand.half_space()),
    ];
    for (name, floor) in floors {
        let waters = Waters::new(
            &forecast.states[0],
            &bathymetry,
            &frame,
            SoundSpeedEquation::Mackenzie,
            Boundary::Fluid(floor),
        )?;
        for &quality in &qualities {
            let settings = LossTableSettings {
                frequency_hz: 1000.0,
                fleet_depth_m: 200.0,
                maximum_range_m: f64::INFINITY,
                numerics: quality.numerics(),
                model: TableModel::Native,
            };
            let start = Instant::now();
            let table = compute_transmission_loss(&waters, &grid, &settings, &|_, _| {})?;
            let seconds = start.elapsed().as_secs_f64();
            let error = estimate_error(&table, &waters, &grid, &settings, &sample, &|_, _| {})?;
            let numerics = quality.numerics();
            println!(
                "{} {}: {} bearings × {} beams, {seconds:.1} s; of {} losses median {:.3}, p90 {:.3}, p99 {:.3} dB from fine",
                name,
                quality.name(),
                numerics.bearings,
                numerics.beam_count(),
                error.compared,
                error.median_db,
                error.p90_db,
                error.p99_db,
            );
        }
    }
    Ok(())
}
