//! What moves in the synthetic ocean.
//!
//! Three geostrophic features (an anticyclonic eddy shed by the Kuroshio, a front, and
//! the current along the slope) are given by a stream function ψ = Σᵢ Aᵢ(x, y, t) Fᵢ(z),
//! Fᵢ = 1 / (1 + (z/Hᵢ)²): the current is u = −∂ψ/∂y, v = ∂ψ/∂x, and thermal-wind
//! balance, g α T′ = −f ∂ψ/∂z (z down), gives the temperature that goes with it. To these
//! come rotating tidal and near-inertial currents, and the internal tide, which heaves
//! the thermocline and so tells one six-hourly state from the next.

use super::profile;
use std::f64::consts::{PI, TAU};

/// Coriolis parameter at 21.74° N, 1/s.
const CORIOLIS_1_S: f64 = 5.402e-5;
const GRAVITY_M_S2: f64 = 9.79;
const DAY_S: f64 = 86_400.0;

/// The eddy: Gaussian in the stream function, fastest at its radius from the centre.
mod eddy {
    /// Swirl at the surface at one radius from the centre, m/s.
    pub(super) const SPEED_M_S: f64 = 0.24;
    pub(super) const RADIUS_M: f64 = 26_000.0;
    /// Centre at the start, metres east and north of the region's middle.
    pub(super) const CENTRE_M: [f64; 2] = [18_000.0, -24_000.0];
    /// Drift of the centre along the slope, m/s (0.9 km a day).
    pub(super) const DRIFT_M_S: [f64; 2] = [-0.006, -0.008];
    pub(super) const SCALE_DEPTH_M: f64 = 260.0;
}

/// The front: a temperature step and a jet along it in the upper hundred metres.
mod front {
    /// Jet at the surface, m/s.
    pub(super) const SPEED_M_S: f64 = 0.20;
    pub(super) const HALF_WIDTH_M: f64 = 12_000.0;
    /// Direction of the jet, radians counter-clockwise from east.
    pub(super) const DIRECTION: f64 = 0.55;
    /// Distance of the front from the region's middle at the start, metres across the jet.
    pub(super) const OFFSET_M: f64 = 3_000.0;
    /// Meanders: amplitude and wavelength in metres, period in seconds.
    pub(super) const MEANDER_M: f64 = 3_500.0;
    pub(super) const WAVELENGTH_M: f64 = 60_000.0;
    pub(super) const PERIOD_S: f64 = 7.0 * super::DAY_S;
    pub(super) const SCALE_DEPTH_M: f64 = 90.0;
}

/// The current along the slope, uniform over the region.
mod slope_current {
    pub(super) const EAST_M_S: f64 = 0.015;
    pub(super) const NORTH_M_S: f64 = 0.03;
    pub(super) const SCALE_DEPTH_M: f64 = 600.0;
}

/// Near-inertial motion: rotates clockwise once in 32 hours, weaker and turned with depth.
mod inertial {
    pub(super) const SPEED_M_S: f64 = 0.030;
    pub(super) const DECAY_DEPTH_M: f64 = 600.0;
    /// Depth over which the phase turns once, metres, and horizontal wavelength, metres.
    pub(super) const VERTICAL_WAVELENGTH_M: f64 = 450.0;
    pub(super) const WAVELENGTH_M: f64 = 160_000.0;
}

/// A tidal constituent: a barotropic current ellipse with its long axis across the
/// slope, and an internal wave of the first mode that runs up the slope.
struct Tide {
    period_s: f64,
    current_m_s: f64,
    phase: f64,
    /// Largest vertical displacement, metres, and wavelength, metres, of the internal wave.
    displacement_m: f64,
    wavelength_m: f64,
}

/// K1, O1 and M2: in the South China Sea the diurnal tides rule.
const TIDES: [Tide; 3] = [
    Tide {
        period_s: 23.9345 * 3600.0,
        current_m_s: 0.011,
        phase: 0.4,
        displacement_m: 18.0,
        wavelength_m: 260_000.0,
    },
    Tide {
        period_s: 25.8193 * 3600.0,
        current_m_s: 0.007,
        phase: 2.1,
        displacement_m: 10.0,
        wavelength_m: 290_000.0,
    },
    Tide {
        period_s: 12.4206 * 3600.0,
        current_m_s: 0.008,
        phase: 4.0,
        displacement_m: 20.0,
        wavelength_m: 120_000.0,
    },
];

/// Direction up the slope, radians counter-clockwise from east (towards north-west).
const UPSLOPE: f64 = 0.75 * PI;
/// Minor over major axis of the tidal ellipses; they turn clockwise.
const TIDAL_ELLIPTICITY: f64 = 0.45;
/// Depth over which the first internal mode has half a wave, metres.
const MODE_DEPTH_M: f64 = 2_200.0;

/// The water at one point and time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Water {
    /// Temperature in situ, °C.
    pub temperature_c: f64,
    /// Practical salinity.
    pub salinity_psu: f64,
    /// Eastward current, m/s.
    pub current_east_m_s: f64,
    /// Northward current, m/s.
    pub current_north_m_s: f64,
}

/// One geostrophic feature over a point: its stream function and velocity at the surface.
#[derive(Debug, Clone, Copy)]
struct Feature {
    stream_function_m2_s: f64,
    velocity_m_s: [f64; 2],
    scale_depth_m: f64,
}

/// The circulation over one point at one time.
#[derive(Debug, Clone, Copy)]
pub struct Circulation {
    features: [Feature; 3],
    tidal_m_s: [f64; 2],
    inertial_phase: f64,
    /// Displacement of the first mode at its maximum, metres, positive down.
    displacement_m: f64,
}

impl Circulation {
    /// The circulation over a point `x_m` east and `y_m` north of the region's middle,
    /// `seconds` after the start.
    pub fn at(x_m: f64, y_m: f64, seconds: f64) -> Self {
        let upslope_m = x_m * UPSLOPE.cos() + y_m * UPSLOPE.sin();
        let (mut tidal_m_s, mut displacement_m) = ([0.0; 2], 0.0);
        for tide in &TIDES {
            let phase = TAU * seconds / tide.period_s + tide.phase;
            let (across, along) = (
                tide.current_m_s * phase.cos(),
                -TIDAL_ELLIPTICITY * tide.current_m_s * phase.sin(),
            );
            tidal_m_s[0] += across * UPSLOPE.cos() - along * UPSLOPE.sin();
            tidal_m_s[1] += across * UPSLOPE.sin() + along * UPSLOPE.cos();
            displacement_m +=
                tide.displacement_m * (TAU * upslope_m / tide.wavelength_m - phase).cos();
        }
        Self {
            features: [
                eddy_at(x_m, y_m, seconds),
                front_at(x_m, y_m, seconds),
                slope_current_at(x_m, y_m),
            ],
            tidal_m_s,
            inertial_phase: CORIOLIS_1_S * seconds + TAU * x_m / inertial::WAVELENGTH_M,
            displacement_m,
        }
    }

    /// The water at a depth in metres.
    pub fn water(&self, depth_m: f64) -> Water {
        let heave_m = self.displacement_m * (PI * (depth_m / MODE_DEPTH_M).min(1.0)).sin();
        let anomaly_c: f64 = self.features.iter().map(|f| f.temperature_anomaly_c(depth_m)).sum();
        let [mut east, mut north] = self.tidal_m_s;
        for feature in &self.features {
            let shape = feature.shape(depth_m);
            east += shape * feature.velocity_m_s[0];
            north += shape * feature.velocity_m_s[1];
        }
        let speed = inertial::SPEED_M_S * (-depth_m / inertial::DECAY_DEPTH_M).exp();
        let phase = self.inertial_phase + TAU * depth_m / inertial::VERTICAL_WAVELENGTH_M;
        Water {
            temperature_c: profile::temperature_c(depth_m - heave_m) + anomaly_c,
            salinity_psu: profile::salinity_psu(depth_m - heave_m),
            current_east_m_s: east + speed * phase.cos(),
            current_north_m_s: north - speed * phase.sin(),
        }
    }
}

impl Feature {
    fn shape(&self, depth_m: f64) -> f64 {
        1.0 / (1.0 + (depth_m / self.scale_depth_m).powi(2))
    }

    /// T′ = −f ψ F′(z) / (g α).
    fn temperature_anomaly_c(&self, depth_m: f64) -> f64 {
        let shape_slope = -2.0 * depth_m / self.scale_depth_m.powi(2) * self.shape(depth_m).powi(2);
        let alpha = profile::thermal_expansion_1_c(depth_m);
        -CORIOLIS_1_S * self.stream_function_m2_s * shape_slope / (GRAVITY_M_S2 * alpha)
    }
}

fn eddy_at(x_m: f64, y_m: f64, seconds: f64) -> Feature {
    use eddy::{CENTRE_M, DRIFT_M_S, RADIUS_M, SCALE_DEPTH_M, SPEED_M_S};
    let gaussian = |x: f64, y: f64| (-(x * x + y * y) / (2.0 * RADIUS_M * RADIUS_M)).exp();
    let amplitude = SPEED_M_S * RADIUS_M * 0.5_f64.exp();
    let x = x_m - CENTRE_M[0] - DRIFT_M_S[0] * seconds;
    let y = y_m - CENTRE_M[1] - DRIFT_M_S[1] * seconds;
    let value = amplitude * gaussian(x, y);
    // The profile is that of the region's middle, so the anomaly is counted from there.
    let middle = amplitude * gaussian(CENTRE_M[0], CENTRE_M[1]);
    Feature {
        stream_function_m2_s: value - middle,
        velocity_m_s: [value * y / RADIUS_M.powi(2), -value * x / RADIUS_M.powi(2)],
        scale_depth_m: SCALE_DEPTH_M,
    }
}

fn front_at(x_m: f64, y_m: f64, seconds: f64) -> Feature {
    use front::{
        DIRECTION, HALF_WIDTH_M, MEANDER_M, OFFSET_M, PERIOD_S, SCALE_DEPTH_M, SPEED_M_S,
        WAVELENGTH_M,
    };
    let (sin, cos) = DIRECTION.sin_cos();
    let (along, across) = (x_m * cos + y_m * sin, -x_m * sin + y_m * cos);
    let phase = TAU * (along / WAVELENGTH_M - seconds / PERIOD_S);
    let s = (across - OFFSET_M - MEANDER_M * phase.sin()) / HALF_WIDTH_M;
    let tilt = -MEANDER_M * TAU / WAVELENGTH_M * phase.cos();
    // ψ = −U L tanh s, so −∂ψ/∂across = U sech² s along the jet.
    let jet = SPEED_M_S / s.cosh().powi(2);
    let (u, v) = (jet, -jet * tilt);
    Feature {
        stream_function_m2_s: -SPEED_M_S * HALF_WIDTH_M * s.tanh(),
        velocity_m_s: [u * cos - v * sin, u * sin + v * cos],
        scale_depth_m: SCALE_DEPTH_M,
    }
}

fn slope_current_at(x_m: f64, y_m: f64) -> Feature {
    use slope_current::{EAST_M_S, NORTH_M_S, SCALE_DEPTH_M};
    Feature {
        stream_function_m2_s: NORTH_M_S * x_m - EAST_M_S * y_m,
        velocity_m_s: [EAST_M_S, NORTH_M_S],
        scale_depth_m: SCALE_DEPTH_M,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [(f64, f64, f64); 4] =
        [(0.0, 0.0, 0.0), (9e3, -12e3, 2e5), (-14e3, 8e3, 5e5), (3e3, 13e3, 864e3)];

    /// u = −∂ψ/∂y, v = ∂ψ/∂x, by central differences of every feature.
    #[test]
    fn geostrophic_currents_follow_the_stream_function() {
        let step = 10.0;
        for (x, y, t) in POINTS {
            let psi = |x, y| Circulation::at(x, y, t).features.map(|f| f.stream_function_m2_s);
            let (east, west) = (psi(x + step, y), psi(x - step, y));
            let (north, south) = (psi(x, y + step), psi(x, y - step));
            for (i, feature) in Circulation::at(x, y, t).features.iter().enumerate() {
                let u = -(north[i] - south[i]) / (2.0 * step);
                let v = (east[i] - west[i]) / (2.0 * step);
                assert!((feature.velocity_m_s[0] - u).abs() < 1e-6);
                assert!((feature.velocity_m_s[1] - v).abs() < 1e-6);
            }
        }
    }

    /// f ∂v/∂z = −g α ∂T/∂x (z down), by central differences of the features alone.
    #[test]
    fn temperature_is_in_thermal_wind_balance() {
        let step = 50.0;
        for (x, y, t) in POINTS {
            for depth in [50.0, 150.0, 400.0] {
                let anomaly = |x| -> f64 {
                    let features = Circulation::at(x, y, t).features;
                    features.iter().map(|f| f.temperature_anomaly_c(depth)).sum()
                };
                let v = |z| -> f64 {
                    let features = Circulation::at(x, y, t).features;
                    features.iter().map(|f| f.shape(z) * f.velocity_m_s[1]).sum()
                };
                let shear = (v(depth + 0.1) - v(depth - 0.1)) / 0.2;
                let gradient = (anomaly(x + step) - anomaly(x - step)) / (2.0 * step);
                let alpha = profile::thermal_expansion_1_c(depth);
                let balance = -GRAVITY_M_S2 * alpha * gradient;
                assert!((CORIOLIS_1_S * shear - balance).abs() < 1e-4 * balance.abs() + 1e-14);
            }
        }
    }

    #[test]
    fn inertial_motion_turns_clockwise() {
        let phase = |hours: f64| {
            let mut c = Circulation::at(0.0, 0.0, hours * 3600.0);
            c.features.iter_mut().for_each(|f| f.velocity_m_s = [0.0; 2]);
            c.tidal_m_s = [0.0; 2];
            let water = c.water(0.0);
            water.current_north_m_s.atan2(water.current_east_m_s)
        };
        assert!((phase(1.0) - phase(0.0) + CORIOLIS_1_S * 3600.0).abs() < 1e-9);
    }
}
