use anyhow::Result;
use sonarfleet::grid::{Position, SurveillanceGrid};
use sonarfleet::sonar::section::{BEHIND_M, Waters};
use sonarfleet_acoustics::environment::Section;
use sonarfleet_acoustics::field::{
    BeamCoordinates, BeamKind, BeamShape, Coherence, LaunchFan, Receivers, SourceGeometry,
    TraceSettings,
};
use sonarfleet_acoustics::model::{Case, Run};
use std::f64::consts::TAU;

/// Distance between receivers along a slice, metres.
pub(super) const STEP_M: f64 = 100.0;

/// Receivers whose intensity is averaged: a kilometre's, as a cell is averaged.
pub(super) const PER_CELL: usize = 10;

/// Shortest slice that is measured, metres.
const SHORTEST_M: f64 = 3000.0;

/// Distance between soundings of the sea floor, metres.
const SOUNDING_M: f64 = 250.0;

/// Steepest launch angle, degrees.
const STEEPEST_DEG: f64 = 60.0;

/// A vertical slice from a cell to the edge of the region.
#[derive(Debug)]
pub(super) struct Slice {
    pub(super) section: Section,
    /// Receivers along it.
    pub(super) count: usize,
}

impl Slice {
    /// Its length, metres.
    pub(super) fn length_m(&self) -> f64 {
        self.count as f64 * STEP_M
    }

    /// How rays are followed in it: nothing is shortened. Every level of the profile is
    /// kept; between levels, speeds are followed to a tolerance.
    pub(super) fn settings(&self, speed_tolerance_m_s: f64) -> TraceSettings {
        TraceSettings {
            near_m: -BEHIND_M,
            speed_tolerance_m_s,
            ..TraceSettings::to_range(self.length_m())
        }
    }

    /// The case that a BELLHOP user would write for it.
    pub(super) fn case(&self, frequency_hz: f64, depth_m: f64, beams: usize) -> Result<Case> {
        let range_m = (0..self.count).map(|k| (k as f64 + 0.5) * STEP_M).collect();
        Ok(Case {
            title: "a slice of a table of transmission loss".into(),
            frequency_hz,
            section: self.section.clone(),
            source_depth_m: vec![depth_m],
            geometry: SourceGeometry::Point,
            beam_pattern: None,
            receivers: Receivers::new(range_m, vec![depth_m])?,
            fan: fan(beams)?,
            beams: BeamKind { shape: BeamShape::Gaussian, coordinates: BeamCoordinates::Cartesian },
            run: Run::Field(Coherence::Incoherent),
            settings: TraceSettings::to_range(self.length_m()),
        })
    }
}

/// Beams at equal distances within ±60°.
pub(super) fn fan(beams: usize) -> Result<LaunchFan> {
    Ok(LaunchFan::uniform(-STEEPEST_DEG, STEEPEST_DEG, beams)?)
}

/// Slices from cells all over a region, in directions all around, to its edge.
pub(super) fn sample(
    waters: &Waters,
    grid: &SurveillanceGrid,
    depth_m: f64,
    count: usize,
) -> Result<Vec<Slice>> {
    const GOLDEN_RATIO: f64 = 1.618_033_988_749_895;
    let cells: Vec<Position> = grid
        .cells()
        .map(|cell| grid.centre(cell))
        .filter(|centre| waters.floor_m(*centre) > depth_m)
        .collect();
    let mut slices = Vec::new();
    for k in 0..4 * count {
        let from = cells[(2 * k + 1) * cells.len() / (8 * count)];
        let bearing_rad = TAU * (k as f64 * GOLDEN_RATIO).fract();
        let length_m = until_edge_m(grid, from, bearing_rad);
        if length_m < SHORTEST_M {
            continue;
        }
        let samples = (length_m / STEP_M) as usize;
        let length_m = samples as f64 * STEP_M;
        let section = waters.section(from, bearing_rad, length_m, SOUNDING_M)?;
        slices.push(Slice { section, count: samples });
    }
    let step = slices.len().div_ceil(count).max(1);
    Ok(slices.into_iter().step_by(step).collect())
}

/// Distance from a point along a bearing to the edge of the region, metres.
fn until_edge_m(grid: &SurveillanceGrid, from: Position, bearing_rad: f64) -> f64 {
    let until = |from: f64, speed: f64, length: f64| {
        let edge = if speed > 0.0 { length } else { 0.0 };
        if speed == 0.0 { f64::INFINITY } else { (edge - from) / speed }
    };
    let (sine, cosine) = bearing_rad.sin_cos();
    until(from.east_m, sine, grid.width_m()).min(until(from.north_m, cosine, grid.height_m()))
}

/// Loss of intensities averaged over a kilometre each, dB.
pub(super) fn cell_losses_db(intensity: &[f64]) -> impl Iterator<Item = f64> + '_ {
    intensity
        .chunks_exact(PER_CELL)
        .map(|cell| -10.0 * (cell.iter().sum::<f64>() / PER_CELL as f64).log10())
}
