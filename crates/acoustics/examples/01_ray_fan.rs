//! A fan of rays in Munk's canonical sound channel, drawn into a PNG.
//!
//!     cargo run --release -p sonarfleet-acoustics --example 01_ray_fan -- munk-rays.png

mod paper;
mod section;

use paper::{Outcome, paper};
use plotters::prelude::*;
use section::{ground, section};
use sonarfleet_acoustics::environment::{Boundary, Interface, Seabed, Section, SoundSpeedField};
use sonarfleet_acoustics::field::{LaunchFan, Source, TraceSettings};
use sonarfleet_acoustics::ray::trace;
use std::path::PathBuf;

const RANGE_KM: f64 = 100.0;
const FLOOR_M: f64 = 5000.0;

/// Munk's canonical profile (doi:10.1121/1.1914492), m/s.
fn munk_m_s(depth_m: f64) -> f64 {
    let eta = 2.0 * (depth_m - 1300.0) / 1300.0;
    1500.0 * (1.0 + 0.00737 * (eta - 1.0 + (-eta).exp()))
}

fn main() -> Outcome<()> {
    let path = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "munk-rays.png".into()));
    let levels: Vec<f64> = (0..=100).map(|k| f64::from(k) * FLOOR_M / 100.0).collect();
    let speeds = levels.iter().map(|&depth| munk_m_s(depth)).collect();
    let water = SoundSpeedField::profile(levels, speeds)?;
    let mud = Boundary::Fluid(Seabed::Mud.half_space());
    let sea = Section::new(water, Interface::flat(FLOOR_M)?, mud)?;
    let source = Source { depth_m: 1000.0, frequency_hz: 50.0 };
    let settings = TraceSettings::to_range(RANGE_KM * 1000.0);

    let sheet = paper(&path, 1000, 420)?;
    let mut chart = section(&sheet, "Rays in Munk's channel", RANGE_KM, FLOOR_M * 1.04)?;
    for beam in LaunchFan::uniform(-14.0, 14.0, 41)?.beams() {
        let ray = trace(&sea, &source, beam.angle_rad.to_degrees(), &settings)?;
        // Rays that touch neither surface nor floor go farthest.
        let colour = match (ray.surface_bounces, ray.bottom_bounces) {
            (0, 0) => RGBColor(0x14, 0x5d, 0xa0),
            (_, 0) => RGBColor(0x6f, 0xa8, 0xdc),
            _ => RGBColor(0xc8, 0xcd, 0xd2),
        };
        let points = ray.points.iter().map(|point| (point.range_m / 1000.0, point.depth_m));
        chart.draw_series(LineSeries::new(points, &colour))?;
    }
    let floor = [(0.0, FLOOR_M), (RANGE_KM, FLOOR_M)];
    ground(&mut chart, &floor, RANGE_KM, FLOOR_M * 1.04)?;
    sheet.present()?;
    println!("{}", path.display());
    Ok(())
}
