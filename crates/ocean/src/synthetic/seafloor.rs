//! The sea floor of the synthetic ocean: a continental slope that falls towards the
//! south-east from 850 m to 1950 m across the region, cut by a canyon, with a spur beside
//! it and hills a few kilometres wide.

use super::plane_m;
use std::f64::consts::{PI, TAU};

/// Depth halfway down the slope, metres.
const MIDDLE_M: f64 = 1400.0;
/// Half the depth between shelf break and abyssal plain, metres.
const HALF_FALL_M: f64 = 1150.0;
/// Steepest gradient of the slope.
const GRADIENT: f64 = 0.0275;
/// Direction down the slope, radians counter-clockwise from east (towards south-east).
const DOWNSLOPE: f64 = -0.25 * PI;

/// The canyon: where it runs across the slope, half its width, its depth, all in metres.
const CANYON: Trench = Trench { centre_m: -6_000.0, half_width_m: 2_600.0, deeper_by_m: 170.0 };
/// The spur beside the canyon: a trench of negative depth.
const SPUR: Trench = Trench { centre_m: 7_500.0, half_width_m: 4_200.0, deeper_by_m: -130.0 };
/// How far canyon and spur meander, and over what distance, metres.
const MEANDER_M: f64 = 1_800.0;
const MEANDER_LENGTH_M: f64 = 27_000.0;

/// Hills: amplitude (m), wavelength (m), direction (radians) and phase.
const HILLS: [(f64, f64, f64, f64); 5] = [
    (22.0, 9_100.0, 0.3, 0.9),
    (15.0, 5_700.0, 1.4, 2.3),
    (11.0, 3_900.0, 2.5, 4.4),
    (7.0, 2_700.0, 0.9, 1.7),
    (5.0, 2_100.0, 2.0, 5.6),
];

#[expect(clippy::struct_field_names, reason = "the postfix is the unit")]
struct Trench {
    centre_m: f64,
    half_width_m: f64,
    deeper_by_m: f64,
}

impl Trench {
    fn at(&self, across_m: f64) -> f64 {
        let s = (across_m - self.centre_m) / self.half_width_m;
        self.deeper_by_m * (-0.5 * s * s).exp()
    }
}

/// Depth of the sea, metres, positive down.
pub fn depth_m(longitude_deg: f64, latitude_deg: f64) -> f64 {
    let (x, y) = plane_m(longitude_deg, latitude_deg);
    let (sin, cos) = DOWNSLOPE.sin_cos();
    let (down, across) = (x * cos + y * sin, -x * sin + y * cos);
    let slope = HALF_FALL_M * (GRADIENT * down / HALF_FALL_M).tanh();
    // Relief fades towards the shelf and the plain, where the slope levels out.
    let relief = 1.0 - (slope / HALF_FALL_M).powi(2);
    let bent = across - MEANDER_M * (TAU * down / MEANDER_LENGTH_M).sin();
    let hills: f64 = HILLS
        .iter()
        .map(|&(amplitude, wavelength, direction, phase)| {
            let along = x * direction.cos() + y * direction.sin();
            amplitude * (TAU * along / wavelength + phase).sin()
        })
        .sum();
    MIDDLE_M + slope + relief * (CANYON.at(bent) + SPUR.at(bent) + hills)
}
