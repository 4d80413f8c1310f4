//! A table of transmission loss between the cells of a small region of the synthetic
//! South China Sea, and what one of its rows says: how much of a sound that is made
//! in the middle is lost on the way to every cell.
//!
//!     cargo run --release -p sonarfleet --example 04_tl_table

use sonarfleet::grid::{CellId, SurveillanceGrid};
use sonarfleet::sonar::section::Waters;
use sonarfleet::sonar::transmission_loss::{
    LossTableSettings, Quality, TableModel, compute_transmission_loss,
};
use sonarfleet_acoustics::environment::{Boundary, Seabed};
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::synthetic::SyntheticOcean;
use sonarfleet_ocean::{LocalFrame, Region};

const CELLS: usize = 11;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let region = Region { west_deg: 118.15, east_deg: 118.26, south_deg: 21.65, north_deg: 21.752 };
    let ocean = SyntheticOcean { region, states: 1, ..SyntheticOcean::default() };
    let frame = LocalFrame::new(region);
    let grid = SurveillanceGrid {
        columns: CELLS,
        rows: CELLS,
        cell_width_m: frame.width_m() / CELLS as f64,
        cell_height_m: frame.height_m() / CELLS as f64,
    };
    let waters = Waters::new(
        &ocean.forecast().states[0],
        &ocean.bathymetry(),
        &frame,
        SoundSpeedEquation::Mackenzie,
        Boundary::Fluid(Seabed::Mud.half_space()),
    )?;
    let settings = LossTableSettings {
        frequency_hz: 1000.0,
        fleet_depth_m: 200.0,
        maximum_range_m: f64::INFINITY,
        numerics: Quality::Fast.numerics(),
        model: TableModel::Native,
    };
    let table = compute_transmission_loss(&waters, &grid, &settings, &|done, total| {
        eprint!("\r{done} of {total} sources");
    })?;

    eprintln!();
    println!(
        "dB lost from the middle to each cell of {:.1} km, north up:",
        grid.cell_width_m / 1e3
    );
    let row = table.row(CellId(grid.cell_count() / 2));
    for losses in row.chunks_exact(CELLS).rev() {
        let line: Vec<String> = losses.iter().map(|loss| format!("{loss:5.1}")).collect();
        println!("{}", line.join(" "));
    }
    Ok(())
}
