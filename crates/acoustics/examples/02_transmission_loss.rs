//! Transmission loss of four classic environments, drawn into PNGs: Lloyd's mirror,
//! Munk's channel, a seamount, and a slope of the South China Sea.
//!
//!     cargo run --release -p sonarfleet-acoustics --example 02_transmission_loss -- DIRECTORY
//!
//! The environments are BELLHOP cases of the tests; only their receivers are others.

mod paper;
mod section;

use paper::{Outcome, paper};
use plotters::prelude::*;
use section::{ground, section};
use sonarfleet_acoustics::bellhop::read_case;
use sonarfleet_acoustics::field::Receivers;
use sonarfleet_acoustics::model::{Case, Native, Output, PropagationModel};
use std::path::{Path, PathBuf};

/// A case, its title, and how far and deep to look at it.
const PICTURES: [(&str, &str, f64, f64); 4] = [
    ("lloyd", "Lloyd's mirror: 220 Hz, source at 36 m", 6.0, 600.0),
    ("munk_cb", "Munk's channel: 75 Hz, source at 900 m", 80.0, 4800.0),
    ("seamount", "A seamount: 230 Hz, source at 120 m", 35.0, 2600.0),
    ("scs_ib", "South China Sea slope: 1 kHz, source at 200 m, incoherent", 44.0, 1950.0),
];

/// Range and depth of the receivers' grid, in pixels.
const GRID: (usize, usize) = (840, 300);

/// Losses at the two ends of the colours, dB.
const LOSS_DB: (f64, f64) = (50.0, 100.0);

fn main() -> Outcome<()> {
    let directory = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".into()));
    for (name, title, range_km, depth_m) in PICTURES {
        let path = directory.join(format!("{}-loss.png", name.split('_').next().unwrap_or(name)));
        draw(name, title, range_km, depth_m, &path)?;
        println!("{}", path.display());
    }
    Ok(())
}

fn draw(name: &str, title: &str, range_km: f64, depth_m: f64, path: &Path) -> Outcome<()> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let case = read_case(&data.join(name).join("case.env"))?;
    let step = (1000.0 * range_km / GRID.0 as f64, depth_m / GRID.1 as f64);
    let middles = |count: usize, step: f64| (0..count).map(|k| (k as f64 + 0.5) * step).collect();
    let receivers = Receivers::new(middles(GRID.0, step.0), middles(GRID.1, step.1))?;
    let case = Case { receivers, ..case };
    let Output::Fields(fields) = Native.solve(&case)? else {
        return Err("the case does not ask for a field".into());
    };

    let sheet = paper(path, 1000, 420)?;
    let (picture, scale) = sheet.split_horizontally(910);
    let mut chart = section(&picture, title, range_km, depth_m)?;
    let pixels = fields[0].loss_db().into_iter().enumerate().map(|(node, loss)| {
        let (column, row) = (node % GRID.0, node / GRID.0);
        let corner =
            |column: usize, row: usize| (column as f64 * step.0 / 1000.0, row as f64 * step.1);
        let pixel = [corner(column, row), corner(column + 1, row + 1)];
        Rectangle::new(pixel, colour(loss).filled())
    });
    chart.draw_series(pixels)?;
    let bathymetry = case.section.bathymetry();
    let floor: Vec<(f64, f64)> = (0..=GRID.0)
        .map(|k| (k as f64 * step.0 / 1000.0, bathymetry.depth_at_m(k as f64 * step.0)))
        .collect();
    ground(&mut chart, &floor, range_km, depth_m)?;
    let source = (0.0, case.source_depth_m[0]);
    chart.draw_series([Circle::new(source, 5, WHITE.filled()), Circle::new(source, 5, BLACK)])?;
    draw_scale(&scale)?;
    sheet.present()?;
    Ok(())
}

/// Bright where sound is strong: cmocean's haline (doi:10.5670/oceanog.2016.66), as
/// in the reports of sonarfleet.
fn colour(loss_db: f64) -> RGBColor {
    const HALINE: &str = include_str!("../../report/assets/colormaps/haline.txt");
    let (strong, faint) = LOSS_DB;
    let place = ((faint - loss_db) / (faint - strong)).clamp(0.0, 1.0);
    let hex = HALINE.lines().nth((place * 255.0) as usize).unwrap_or("ffffff");
    let part = |at: usize| u8::from_str_radix(&hex[at..at + 2], 16).unwrap_or(255);
    RGBColor(part(0), part(2), part(4))
}

fn draw_scale(area: &paper::Paper<'_>) -> Outcome<()> {
    let (strong, faint) = LOSS_DB;
    let mut chart = ChartBuilder::on(area)
        .margin_top(50)
        .margin_bottom(58)
        .margin_right(8)
        .y_label_area_size(56)
        .build_cartesian_2d(0.0..1.0, faint..strong)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .disable_x_axis()
        .y_desc("transmission loss, dB")
        .y_label_formatter(&|y| format!("{y:.0}"))
        .label_style(("sans-serif", 15))
        .draw()?;
    let steps = 100;
    let bands = (0..steps).map(|k| {
        let loss = |k: i32| strong + (faint - strong) * f64::from(k) / f64::from(steps);
        Rectangle::new([(0.0, loss(k)), (1.0, loss(k + 1))], colour(loss(k)).filled())
    });
    chart.draw_series(bands)?;
    Ok(())
}
