//! Waters and sea floors by chance: every climate, every kind of ground.

use super::chance::{between, direction_rad, happens, log_between, weighted};
use crate::random::Stream;
use rand::Rng;
use sonarfleet_ocean::synthetic::ensemble::{
    Eddy, Front, InternalWave, Layer, Mount, Relief, Trench, WaterColumn,
};

/// Kinds of water columns.
#[derive(Debug, Clone, Copy)]
enum Climate {
    /// Warm and sharply layered all year.
    Tropical,
    /// A shallow warm layer over a steep seasonal thermocline.
    TemperateSummer,
    /// Mixed deep down; sound is bent up or hardly at all.
    TemperateWinter,
    /// Warm and salty down to the floor, as the Mediterranean is.
    EnclosedSea,
    /// Cold and fresh on top of warmer water: a surface duct.
    Polar,
}

/// A water column of any climate.
pub(super) fn water_column(random: &mut Stream) -> WaterColumn {
    let climate = weighted(
        random,
        &[
            (0.34, Climate::Tropical),
            (0.26, Climate::TemperateSummer),
            (0.17, Climate::TemperateWinter),
            (0.10, Climate::EnclosedSea),
            (0.13, Climate::Polar),
        ],
    );
    let mut draw = |low, high| between(random, low, high);
    // Mixed layer (m); surface, deep temperature and seasonal step (°C); depth scales of
    // the seasonal and the permanent layer (m); deep salinity and the two layers' steps.
    let (mixed_layer_m, surface_c, deep_c, seasonal_c, thin_m, thick_m, salinity) = match climate {
        Climate::Tropical => (
            draw(20.0, 90.0),
            draw(26.0, 30.0),
            draw(2.0, 5.0),
            draw(5.0, 13.0),
            draw(25.0, 80.0),
            draw(200.0, 450.0),
            [draw(34.5, 34.9), draw(-1.0, 0.2), draw(-0.3, 0.6)],
        ),
        Climate::TemperateSummer => (
            draw(10.0, 45.0),
            draw(14.0, 25.0),
            draw(2.5, 6.0),
            draw(4.0, 10.0),
            draw(8.0, 40.0),
            draw(200.0, 600.0),
            [draw(34.5, 35.1), draw(-1.0, 0.2), draw(-0.2, 0.6)],
        ),
        Climate::TemperateWinter => {
            let deep_c = draw(3.0, 8.0);
            let seasonal_c = draw(0.0, 1.5);
            (
                draw(50.0, 120.0),
                deep_c + seasonal_c + draw(0.2, 5.0),
                deep_c,
                seasonal_c,
                draw(30.0, 100.0),
                draw(300.0, 700.0),
                [draw(34.5, 35.2), draw(-0.3, 0.0), draw(-0.2, 0.3)],
            )
        }
        Climate::EnclosedSea => {
            let deep_c = draw(12.5, 14.0);
            let seasonal_c = draw(0.0, 12.0);
            (
                draw(10.0, 80.0),
                deep_c + seasonal_c + draw(0.0, 1.5),
                deep_c,
                seasonal_c,
                draw(10.0, 40.0),
                draw(150.0, 400.0),
                [draw(38.0, 38.7), draw(-0.8, 0.0), draw(-0.3, 0.2)],
            )
        }
        Climate::Polar => {
            let deep_c = draw(-0.5, 2.5);
            let seasonal_c = draw(-4.0, -0.3);
            let middle_c = deep_c + draw(0.0, 2.0);
            (
                draw(20.0, 120.0),
                (middle_c + seasonal_c).max(-1.8),
                deep_c,
                seasonal_c,
                draw(20.0, 90.0),
                draw(200.0, 600.0),
                [draw(34.6, 34.95), draw(-2.5, -0.1), draw(-0.1, 0.1)],
            )
        }
    };
    let [deep_salinity_psu, thin_psu, thick_psu] = salinity;
    WaterColumn {
        mixed_layer_m,
        deep_temperature_c: deep_c,
        deep_salinity_psu,
        layers: vec![
            Layer { thickness_m: thin_m, temperature_c: seasonal_c, salinity_psu: thin_psu },
            Layer {
                thickness_m: thick_m,
                temperature_c: surface_c - deep_c - seasonal_c,
                salinity_psu: thick_psu,
            },
        ],
    }
}

/// The largest displacement of the water relative to the depth where it happens:
/// beyond 1/e the water would fold over itself. Features add up, so each gets less.
const LARGEST_HEAVE: f64 = 0.18;

/// None to three eddies, warm or cold, in and around a region of some width.
pub(super) fn eddies(random: &mut Stream, width_m: f64) -> Vec<Eddy> {
    let count = weighted(random, &[(0.3, 0), (0.35, 1), (0.2, 2), (0.15, 3)]);
    (0..count)
        .map(|_| {
            let core_depth_m = log_between(random, 90.0, 400.0);
            let share = between(random, 0.3, 1.0) * LARGEST_HEAVE;
            let sign = if happens(random, 0.5) { 1.0 } else { -1.0 };
            Eddy {
                centre_m: [0, 1].map(|_| between(random, -0.6, 0.6) * width_m),
                radius_m: log_between(random, 5_000.0, 25_000.0),
                displacement_m: sign * share * core_depth_m,
                core_depth_m,
            }
        })
        .collect()
}

/// A front across a region of some width, or none.
pub(super) fn front(random: &mut Stream, width_m: f64) -> Option<Front> {
    happens(random, 0.4).then(|| Front {
        direction_rad: direction_rad(random),
        offset_m: between(random, -0.35, 0.35) * width_m,
        half_width_m: log_between(random, 1_500.0, 8_000.0),
        meander_m: between(random, 0.0, 3_000.0),
        wavelength_m: between(random, 15_000.0, 60_000.0),
        phase_rad: direction_rad(random),
        temperature_step_c: between(random, 0.5, 4.0),
        salinity_step_psu: between(random, -0.3, 0.6),
        depth_m: log_between(random, 60.0, 400.0),
    })
}

/// None to three internal waves.
pub(super) fn internal_waves(random: &mut Stream) -> Vec<InternalWave> {
    let count = random.random_range(0..=3);
    (0..count)
        .map(|_| {
            let core_depth_m = log_between(random, 60.0, 300.0);
            InternalWave {
                direction_rad: direction_rad(random),
                wavelength_m: log_between(random, 6_000.0, 120_000.0),
                phase_rad: direction_rad(random),
                displacement_m: between(random, 0.02, 0.06) * core_depth_m,
                core_depth_m,
            }
        })
        .collect()
}

/// Shallowest and deepest sea floor, metres.
const FLOOR_M: [f64; 2] = [50.0, 3_000.0];

/// A sea floor under a region of some width: flat, sloping, with hills or a canyon.
pub(super) fn relief(random: &mut Stream, width_m: f64) -> Relief {
    let middle_m = log_between(random, 150.0, 2_600.0);
    // A slope does not take more than most of the depth over half the region.
    let steepest = (1.2 * middle_m / width_m).min(0.06);
    let gradient = if happens(random, 0.3) { 0.0 } else { between(random, 0.0, steepest) };
    let mounts = weighted(random, &[(0.5, 0), (0.2, 1), (0.15, 2), (0.15, 5)]);
    let trenches = weighted(random, &[(0.65, 0), (0.25, 1), (0.10, 2)]);
    let waves = weighted(random, &[(0.3, 0), (0.3, 2), (0.4, 5)]);
    let place = |random: &mut Stream| between(random, -0.5, 0.5) * width_m;
    Relief {
        middle_m,
        gradient,
        downslope_rad: direction_rad(random),
        mounts: (0..mounts)
            .map(|_| Mount {
                centre_m: [place(random), place(random)],
                radius_m: log_between(random, 1_500.0, 8_000.0),
                height_m: between(random, -0.15, 0.5) * middle_m,
            })
            .collect(),
        trenches: (0..trenches)
            .map(|_| Trench {
                direction_rad: direction_rad(random),
                offset_m: place(random),
                half_width_m: log_between(random, 1_200.0, 5_000.0),
                deeper_by_m: between(random, -0.2, 0.5) * middle_m,
                meander_m: between(random, 0.0, 2_500.0),
                wavelength_m: between(random, 12_000.0, 40_000.0),
            })
            .collect(),
        waves: (0..waves)
            .map(|_| {
                let wavelength_m = log_between(random, 2_000.0, 12_000.0);
                // Hills are hardly steeper than 4°.
                let amplitude_m = (0.012 * middle_m).min(0.01 * wavelength_m);
                let amplitude_m = amplitude_m * between(random, 0.1, 1.0);
                [amplitude_m, wavelength_m, direction_rad(random), direction_rad(random)]
            })
            .collect(),
        shallowest_m: FLOOR_M[0],
        deepest_m: FLOOR_M[1],
    }
}
