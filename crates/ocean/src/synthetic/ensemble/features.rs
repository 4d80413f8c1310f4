//! What makes the water of an ensemble ocean differ from place to place. Coordinates are
//! metres east and north of the region's middle; directions are radians counter-clockwise
//! from east.

use std::f64::consts::TAU;

/// Share of a displacement at a depth: nothing at the surface, all of it at the depth
/// where it is largest, little far below.
fn mode(depth_m: f64, largest_at_m: f64) -> f64 {
    let s = depth_m / largest_at_m;
    s * (1.0 - s).exp()
}

/// An eddy: it presses the thermocline down (a warm one) or lifts it.
///
/// A displacement beyond a third of `core_depth_m` would fold the water over itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Eddy {
    /// Centre, metres east and north.
    pub centre_m: [f64; 2],
    /// Radius at which a Gaussian falls to e^(−1/2), metres.
    pub radius_m: f64,
    /// Largest displacement of the water, metres, positive down: warm.
    pub displacement_m: f64,
    /// Depth of the largest displacement, metres.
    pub core_depth_m: f64,
}

impl Eddy {
    /// Displacement of the water at a point, metres, positive down.
    pub fn heave_m(&self, x_m: f64, y_m: f64, depth_m: f64) -> f64 {
        let r = (x_m - self.centre_m[0]).hypot(y_m - self.centre_m[1]) / self.radius_m;
        self.displacement_m * (-0.5 * r * r).exp() * mode(depth_m, self.core_depth_m)
    }
}

/// A front: warmer or fresher water on one side, down to some depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Front {
    /// Direction along it.
    pub direction_rad: f64,
    /// Its distance from the region's middle, metres to the left of its direction.
    pub offset_m: f64,
    /// Half its width, metres.
    pub half_width_m: f64,
    /// Amplitude of its meanders, metres.
    pub meander_m: f64,
    /// Wavelength of its meanders, metres.
    pub wavelength_m: f64,
    /// Phase of its meanders, radians.
    pub phase_rad: f64,
    /// Temperature to its left less that to its right, at the surface, °C.
    pub temperature_step_c: f64,
    /// Salinity to its left less that to its right, at the surface.
    pub salinity_step_psu: f64,
    /// Depth over which the steps fade, metres.
    pub depth_m: f64,
}

impl Front {
    /// What it adds to temperature (°C) and salinity at a point.
    pub fn anomaly(&self, x_m: f64, y_m: f64, depth_m: f64) -> [f64; 2] {
        let (sine, cosine) = self.direction_rad.sin_cos();
        let (along, across) = (x_m * cosine + y_m * sine, y_m * cosine - x_m * sine);
        let meander = self.meander_m * (TAU * along / self.wavelength_m + self.phase_rad).sin();
        let side = ((across - self.offset_m - meander) / self.half_width_m).tanh();
        let share = 0.5 * side * (-(depth_m / self.depth_m).powi(2)).exp();
        [share * self.temperature_step_c, share * self.salinity_step_psu]
    }
}

/// An internal wave at one moment: it heaves the thermocline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InternalWave {
    /// Direction in which it runs.
    pub direction_rad: f64,
    /// Wavelength, metres.
    pub wavelength_m: f64,
    /// Phase, radians.
    pub phase_rad: f64,
    /// Largest displacement of the water, metres.
    pub displacement_m: f64,
    /// Depth of the largest displacement, metres.
    pub core_depth_m: f64,
}

impl InternalWave {
    /// Displacement of the water at a point, metres, positive down.
    pub fn heave_m(&self, x_m: f64, y_m: f64, depth_m: f64) -> f64 {
        let along = x_m * self.direction_rad.cos() + y_m * self.direction_rad.sin();
        let wave = (TAU * along / self.wavelength_m + self.phase_rad).cos();
        self.displacement_m * wave * mode(depth_m, self.core_depth_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn displacements_are_largest_at_their_depth() {
        let eddy = Eddy {
            centre_m: [3_000.0, 4_000.0],
            radius_m: 10_000.0,
            displacement_m: -40.0,
            core_depth_m: 200.0,
        };
        assert!((eddy.heave_m(3_000.0, 4_000.0, 200.0) + 40.0).abs() < 1e-12);
        assert!(eddy.heave_m(3_000.0, 4_000.0, 0.0).abs() < 1e-12);
        // One radius away and at twice the depth: e^(−1/2) · 2/e.
        let expected = -40.0 * (-0.5_f64).exp() * 2.0 * (-1.0_f64).exp();
        assert!((eddy.heave_m(13_000.0, 4_000.0, 400.0) - expected).abs() < 1e-12);

        let wave = InternalWave {
            direction_rad: 0.5 * std::f64::consts::PI,
            wavelength_m: 8_000.0,
            phase_rad: 0.0,
            displacement_m: 10.0,
            core_depth_m: 80.0,
        };
        assert!((wave.heave_m(123.0, 4_000.0, 80.0) + 10.0).abs() < 1e-9);
    }

    #[test]
    fn a_front_parts_two_waters() {
        let front = Front {
            direction_rad: 0.0,
            offset_m: 2_000.0,
            half_width_m: 1_500.0,
            meander_m: 0.0,
            wavelength_m: 30_000.0,
            phase_rad: 0.0,
            temperature_step_c: 4.0,
            salinity_step_psu: -0.6,
            depth_m: 150.0,
        };
        let [north, south] = [30_000.0, -30_000.0].map(|y| front.anomaly(0.0, y, 0.0));
        assert!((north[0] - south[0] - 4.0).abs() < 1e-6);
        assert!((north[1] - south[1] + 0.6).abs() < 1e-6);
        assert!(front.anomaly(9_000.0, 2_000.0, 0.0)[0].abs() < 1e-12);
        assert!(front.anomaly(0.0, 30_000.0, 600.0)[0].abs() < 1e-5);
    }
}
