//! What arrives at a receiver 6 km down a slope of the South China Sea, path by path:
//! a table, and the channel's impulse response as a PNG.
//!
//!     cargo run --release -p sonarfleet-acoustics --example 03_arrivals -- arrivals.png

mod paper;

use paper::{Outcome, paper};
use plotters::prelude::*;
use sonarfleet_acoustics::bellhop::read_case;
use sonarfleet_acoustics::field::{Arrival, Receivers};
use sonarfleet_acoustics::model::{Case, Native, Output, PropagationModel, Run};
use std::path::{Path, PathBuf};

const RANGE_M: f64 = 6000.0;
const DEPTH_M: f64 = 200.0;

/// Arrivals fainter than the strongest by more than this are left out, dB.
const DYNAMIC_RANGE_DB: f64 = 40.0;

fn main() -> Outcome<()> {
    let path = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "arrivals.png".into()));
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/scs_ib/case.env");
    let receivers = Receivers::new(vec![RANGE_M], vec![DEPTH_M])?;
    let case = Case { receivers, run: Run::Arrivals, ..read_case(&data)? };
    let Output::Arrivals(of_sources) = Native.solve(&case)? else {
        return Err("no arrivals".into());
    };
    let level_db =
        |arrival: &Arrival| 20.0 * (arrival.amplitude * (-arrival.absorption_nepers).exp()).log10();
    let strongest_db = of_sources[0].at[0].iter().map(level_db).fold(f64::MIN, f64::max);
    let heard: Vec<Arrival> = of_sources[0].at[0]
        .iter()
        .copied()
        .filter(|arrival| level_db(arrival) > strongest_db - DYNAMIC_RANGE_DB)
        .collect();

    println!("  delay, s   level, dB   launch, °   arrival, °   surface   bottom");
    for arrival in &heard {
        println!(
            "{:>10.4} {:>11.1} {:>11.2} {:>12.2} {:>9} {:>8}",
            arrival.delay_s,
            level_db(arrival),
            arrival.launch_angle_deg,
            arrival.arrival_angle_deg,
            arrival.surface_bounces,
            arrival.bottom_bounces,
        );
    }

    let delays = || heard.iter().map(|arrival| arrival.delay_s);
    let (first, last) = (delays().fold(f64::MAX, f64::min), delays().fold(f64::MIN, f64::max));
    let margin = 0.05 * (last - first).max(0.01);
    let floor_db = strongest_db - DYNAMIC_RANGE_DB;
    let sheet = paper(&path, 1000, 380)?;
    let mut chart = ChartBuilder::on(&sheet)
        .caption(
            "Arrivals 6 km down the slope: no bottom bounce (orange), one (light), more (dark)",
            ("sans-serif", 20),
        )
        .margin(14)
        .x_label_area_size(44)
        .y_label_area_size(66)
        .build_cartesian_2d(first - margin..last + margin, floor_db..strongest_db + 3.0)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc("delay, s")
        .y_desc("level, dB re the source at 1 m")
        .y_label_formatter(&|y| format!("{y:.0}"))
        .label_style(("sans-serif", 15))
        .draw()?;
    for arrival in &heard {
        // Darker the more often the path has met the sea floor.
        let colour = match arrival.bottom_bounces {
            0 => RGBColor(0xd9, 0x5f, 0x0e),
            1 => RGBColor(0x6f, 0xa8, 0xdc),
            _ => RGBColor(0x14, 0x5d, 0xa0),
        };
        let top = (arrival.delay_s, level_db(arrival));
        chart.draw_series(LineSeries::new([(top.0, floor_db), top], &colour))?;
        chart.draw_series([Circle::new(top, 4, colour.filled())])?;
    }
    sheet.present()?;
    println!("{}", path.display());
    Ok(())
}
