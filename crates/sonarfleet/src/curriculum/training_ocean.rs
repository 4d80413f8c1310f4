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

/// The fleet is no shallower and no deeper than this, metres.
const SHALLOWEST_M: f64 = 30.0;
const DEEPEST_M: f64 = 300.0;

/// The fleet is no deeper than this share of the depth.
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
    /// else 300–3000 Hz; a fleet 30–300 m deep. In a few the floor comes up to the fleet in
    /// places: nothing can be there.
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

/// A depth for the fleet: above all of the floor; sometimes, where the floor comes up high
/// enough, above most of it.
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
    if happens(random, 1.0 / 12.0) {
        let most = floor_m.len() / 12;
        let depth_m = floor_m[random.random_range(1..=most)].round();
        // Over a flat floor there is no such depth.
        if depth_m < DEEPEST_M && floor_m.partition_point(|&floor| floor.round() <= depth_m) <= most
        {
            return depth_m;
        }
    }
    let deepest_m = (DEEPEST_SHARE * floor_m[0]).clamp(35.0, DEEPEST_M);
    between(random, SHALLOWEST_M, deepest_m).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_drawn_is_in_range_and_repeats() {
        let mut shoals = 0;
        for index in 0..200 {
            let drawn = TrainingOcean::draw(2, index);
            assert_eq!(drawn, TrainingOcean::draw(2, index));
            let TrainingOcean { grid, ocean, settings, bottom } = &drawn;
            assert!((18..=36).contains(&grid.columns) && (18..=36).contains(&grid.rows));
            assert!((600.0..=1600.0).contains(&grid.cell_width_m));
            assert!((300.0..=3000.0).contains(&settings.frequency_hz));
            assert!((30.0..=300.0).contains(&settings.fleet_depth_m));
            assert!((1450.0..=5250.0).contains(&bottom.speed_m_s));
            assert!((10.0..=120.0).contains(&ocean.column.mixed_layer_m));
            let (mut in_ground, half_m) = (0, [0.5 * grid.width_m(), 0.5 * grid.height_m()]);
            for cell in grid.cells() {
                let centre = grid.centre(cell);
                let (x, y) = (centre.east_m - half_m[0], centre.north_m - half_m[1]);
                let floor_m = ocean.relief.depth_m(x, y);
                in_ground += usize::from(floor_m <= settings.fleet_depth_m);
                for depth in [0.0, 50.0, 150.0, 500.0].into_iter().filter(|&z| z < floor_m) {
                    let (temperature, salinity) = ocean.water(x, y, depth);
                    assert!((-1.9..=33.0).contains(&temperature), "{index}: {temperature} °C");
                    assert!((30.0..=39.5).contains(&salinity), "{index}: {salinity}");
                }
            }
            shoals += usize::from(in_ground > 0);
            assert!(
                12 * in_ground <= 2 * grid.cell_count(),
                "{index}: {in_ground} cells in the ground"
            );
        }
        assert!((2..40).contains(&shoals), "{shoals} of 200 with shoals");
    }

    #[test]
    fn oceans_differ_and_so_do_their_fingerprints() {
        let prints: std::collections::BTreeSet<String> =
            (0..20).map(|index| TrainingOcean::draw(1, index).fingerprint()).collect();
        assert_eq!(prints.len(), 20);
        let ocean = TrainingOcean::draw(1, 0);
        let mut other = ocean.clone();
        other.ocean.relief.middle_m += 1e-9;
        assert_ne!(ocean.fingerprint(), other.fingerprint());
    }

    #[test]
    fn the_number_of_threads_changes_no_bit() {
        let mut ocean = TrainingOcean::draw(1, 1);
        (ocean.grid.columns, ocean.grid.rows) = (4, 3);
        let [one, two] = [1, 2].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| ocean.transmission_loss(&|_, _| {})).unwrap()
        });
        assert_eq!(one, two);
        assert!(one.loss_db.iter().all(|loss| (40.0..110.0).contains(loss)));
    }
}
