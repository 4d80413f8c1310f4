//! Oceans to practise in.

use super::CurriculumError;
use super::chance::{between, happens, log_between, weighted};
use super::climate;
use crate::fingerprint::Fingerprint;
use crate::grid::SurveillanceGrid;
use crate::random::{Stream, stream};
use crate::sonar::section::{Waters, WatersError};
use crate::sonar::transmission_loss::{
    BeamClass, LossTableSettings, Numerics, TABLE_VERSION, TableModel, TransmissionLossTable,
    compute_transmission_loss,
};
use rand::Rng;
use sonarfleet_acoustics::environment::{Boundary, FluidHalfSpace, Seabed};
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::synthetic::ensemble::EnsembleOcean;
use sonarfleet_ocean::{LocalFrame, Region};

/// Version of the way from drawn parameters to waters. It is raised with every change
/// that moves a sound speed or a depth.
const OCEANS_VERSION: u32 = 1;

/// Equation for the speed of sound: this one holds in cold water too.
const EQUATION: SoundSpeedEquation = SoundSpeedEquation::ChenMillero;

/// The fleet keeps so far from the floor, as a share of the depth.
const DEEPEST_SHARE: f64 = 0.9;

/// An ocean to practise in, with the grid on it and what decides its transmission loss.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainingOcean {
    /// The cells of the region.
    pub grid: SurveillanceGrid,
    /// Waters and sea floor.
    pub ocean: EnsembleOcean,
    /// What the floor is made of.
    pub bottom: FluidHalfSpace,
    /// Frequency, depth and numerics of the table.
    pub settings: LossTableSettings,
}

impl TrainingOcean {
    /// Ocean number `index` of a seed.
    ///
    /// Mostly 30 × 30 cells of 1.03 km, else 18–36 columns and rows of 0.6–1.6 km; 1 kHz,
    /// else 300–3000 Hz; a fleet 30–300 m deep. In one of twelve the floor comes up to the
    /// fleet in places: nothing can be there.
    pub fn draw(seed: u64, index: u64) -> Self {
        let mut random = stream(seed, "curriculum/ocean", index);
        let grid = draw_grid(&mut random);
        let width_m = grid.width_m().max(grid.height_m());
        let ocean = EnsembleOcean {
            region: region_of(&grid, between(&mut random, -50.0, 65.0)),
            column: climate::water_column(&mut random),
            eddies: climate::eddies(&mut random, width_m),
            front: climate::front(&mut random, width_m),
            waves: climate::internal_waves(&mut random),
            relief: climate::relief(&mut random, width_m),
        };
        let bottom = draw_bottom(&mut random);
        let frequency_hz = if happens(&mut random, 0.4) {
            1000.0
        } else {
            log_between(&mut random, 300.0, 3000.0)
        };
        let fleet_depth_m = draw_depth(&mut random, &grid, &ocean);
        let settings = LossTableSettings {
            frequency_hz,
            fleet_depth_m,
            maximum_range_m: f64::INFINITY,
            numerics: practice_numerics(),
            model: TableModel::Native,
        };
        Self { grid, ocean, bottom, settings }
    }

    /// The waters as sound meets them.
    ///
    /// # Errors
    /// None is expected of a drawn ocean.
    pub fn waters(&self) -> Result<Waters, WatersError> {
        Waters::new(
            &self.ocean.state(),
            &self.ocean.bathymetry(),
            &LocalFrame::new(self.ocean.region),
            EQUATION,
            Boundary::Fluid(self.bottom),
        )
    }

    /// Computes transmission loss between all cells. `progress` is told how many sources
    /// of how many are done, from any thread; the result does not depend on the number of
    /// threads.
    ///
    /// # Errors
    /// None is expected of a drawn ocean.
    pub fn transmission_loss(
        &self,
        progress: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<TransmissionLossTable, CurriculumError> {
        let waters = self.waters()?;
        Ok(compute_transmission_loss(&waters, &self.grid, &self.settings, progress)?)
    }

    /// SHA-256 of everything that decides the table: 64 hexadecimal digits.
    pub fn fingerprint(&self) -> String {
        // `{:?}` says numbers with as many digits as tell them apart.
        Fingerprint::default()
            .text(&format!("oceans {OCEANS_VERSION}, rows {TABLE_VERSION}"))
            .text(&format!("{self:?}"))
            .finish()
    }
}

/// Numerics for practice: a placement policy learns nothing from tenths of a decibel.
pub fn practice_numerics() -> Numerics {
    let classes = [(9.0, 20, 0.3), (14.0, 24, 0.4), (25.0, 20, 1.5), (55.0, 14, 3.0)];
    Numerics {
        bearings: 48,
        beam_classes: classes
            .map(|(limit_deg, beams, speed_tolerance_m_s)| BeamClass {
                limit_deg,
                beams,
                speed_tolerance_m_s,
            })
            .to_vec(),
        amplitude_cutoff: 0.05,
        sounding_m: 300.0,
        range_step_m: 200.0,
    }
}

fn draw_grid(random: &mut Stream) -> SurveillanceGrid {
    let (columns, rows, cell_m) = if happens(random, 0.7) {
        (30, 30, 1030.0)
    } else {
        let columns = random.random_range(18..=36);
        let rows = if happens(random, 0.5) { columns } else { random.random_range(18..=36) };
        (columns, rows, between(random, 600.0, 1600.0).round())
    };
    SurveillanceGrid { columns, rows, cell_width_m: cell_m, cell_height_m: cell_m }
}

/// A region as large as the grid, at a latitude.
fn region_of(grid: &SurveillanceGrid, latitude_deg: f64) -> Region {
    const METRES_PER_DEGREE: f64 = 111_195.0;
    let height_deg = grid.height_m() / METRES_PER_DEGREE;
    let width_deg = grid.width_m() / (METRES_PER_DEGREE * latitude_deg.to_radians().cos());
    Region {
        west_deg: -0.5 * width_deg,
        east_deg: 0.5 * width_deg,
        south_deg: latitude_deg - 0.5 * height_deg,
        north_deg: latitude_deg + 0.5 * height_deg,
    }
}

/// A floor of the library, soft ones more often, or any fluid between mud and gravel.
fn draw_bottom(random: &mut Stream) -> FluidHalfSpace {
    if happens(random, 0.4) {
        let speed_m_s = between(random, 1450.0, 1850.0);
        return FluidHalfSpace {
            speed_m_s,
            // Denser where faster, as sediments are.
            density_ratio: 1.3 + 0.0018 * (speed_m_s - 1450.0) + between(random, -0.15, 0.15),
            attenuation_db_wavelength: log_between(random, 0.08, 1.0),
        };
    }
    let shares = [0.16, 0.22, 0.18, 0.16, 0.10, 0.06, 0.05, 0.04, 0.03];
    let choices: Vec<(f64, Seabed)> = shares.into_iter().zip(Seabed::ALL).collect();
    weighted(random, &choices).half_space()
}

/// A depth for the fleet over the floor: over all of it, but sometimes only over most.
fn draw_depth(random: &mut Stream, grid: &SurveillanceGrid, ocean: &EnsembleOcean) -> f64 {
    let (half_width_m, half_height_m) = (0.5 * grid.width_m(), 0.5 * grid.height_m());
    let mut floor_m: Vec<f64> = grid
        .cells()
        .map(|cell| {
            let centre = grid.centre(cell);
            ocean.relief.depth_m(centre.east_m - half_width_m, centre.north_m - half_height_m)
        })
        .collect();
    floor_m.sort_by(f64::total_cmp);
    let shoals = if happens(random, 1.0 / 12.0) { floor_m.len() / 12 } else { 0 };
    let deepest_m = (DEEPEST_SHARE * floor_m[shoals]).clamp(35.0, 300.0);
    between(random, 30.0, deepest_m).round()
}
