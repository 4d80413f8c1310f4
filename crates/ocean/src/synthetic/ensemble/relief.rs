//! The sea floor of an ensemble ocean: a plane with mounts, a trench and waves on it.
//! Coordinates are metres east and north of the region's middle; directions are radians
//! counter-clockwise from east.

use std::f64::consts::TAU;

/// A sea floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Relief {
    /// Depth of the plane at the region's middle, metres.
    pub middle_m: f64,
    /// Gradient of the plane, metres deeper per metre.
    pub gradient: f64,
    /// Direction in which the plane falls.
    pub downslope_rad: f64,
    /// Seamounts and hills, and hollows.
    pub mounts: Vec<Mount>,
    /// Canyons, and ridges.
    pub trenches: Vec<Trench>,
    /// Waves of the floor: amplitude (m), wavelength (m), direction (radians) and phase
    /// (radians).
    pub waves: Vec<[f64; 4]>,
    /// It is nowhere shallower than this, metres.
    pub shallowest_m: f64,
    /// It is nowhere deeper than this, metres.
    pub deepest_m: f64,
}

/// A Gaussian hill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mount {
    /// Summit, metres east and north.
    pub centre_m: [f64; 2],
    /// Radius at which it falls to e^(−1/2), metres.
    pub radius_m: f64,
    /// Height over the plane, metres; negative for a hollow.
    pub height_m: f64,
}

/// A canyon with a Gaussian cross-section that meanders along a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trench {
    /// Direction along it.
    pub direction_rad: f64,
    /// Its distance from the region's middle, metres to the left of its direction.
    pub offset_m: f64,
    /// Standard deviation of its cross-section, metres.
    pub half_width_m: f64,
    /// Depth under the plane, metres; negative for a ridge.
    pub deeper_by_m: f64,
    /// Amplitude of its meanders, metres.
    pub meander_m: f64,
    /// Wavelength of its meanders, metres.
    pub wavelength_m: f64,
}

impl Relief {
    /// A floor that is the same everywhere.
    pub fn flat(depth_m: f64) -> Self {
        Self {
            middle_m: depth_m,
            gradient: 0.0,
            downslope_rad: 0.0,
            mounts: Vec::new(),
            trenches: Vec::new(),
            waves: Vec::new(),
            shallowest_m: 0.0,
            deepest_m: depth_m,
        }
    }

    /// Depth of the sea at a point, metres, positive down.
    pub fn depth_m(&self, x_m: f64, y_m: f64) -> f64 {
        let along = |direction: f64| x_m * direction.cos() + y_m * direction.sin();
        let mounts: f64 = self.mounts.iter().map(|mount| mount.height_m(x_m, y_m)).sum();
        let trenches: f64 = self.trenches.iter().map(|t| t.deeper_by_m(x_m, y_m)).sum();
        let waves: f64 = self
            .waves
            .iter()
            .map(|&[amplitude, wavelength, direction, phase]| {
                amplitude * (TAU * along(direction) / wavelength + phase).sin()
            })
            .sum();
        let plane = self.middle_m + self.gradient * along(self.downslope_rad);
        (plane + trenches - mounts + waves).clamp(self.shallowest_m, self.deepest_m)
    }
}

impl Mount {
    fn height_m(&self, x_m: f64, y_m: f64) -> f64 {
        let r = (x_m - self.centre_m[0]).hypot(y_m - self.centre_m[1]) / self.radius_m;
        self.height_m * (-0.5 * r * r).exp()
    }
}

impl Trench {
    fn deeper_by_m(&self, x_m: f64, y_m: f64) -> f64 {
        let (sine, cosine) = self.direction_rad.sin_cos();
        let (along, across) = (x_m * cosine + y_m * sine, y_m * cosine - x_m * sine);
        let meander = self.meander_m * (TAU * along / self.wavelength_m).sin();
        let s = (across - self.offset_m - meander) / self.half_width_m;
        self.deeper_by_m * (-0.5 * s * s).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn slope_mount_and_trench_are_where_they_should_be() {
        let slope = Relief {
            gradient: 0.02,
            downslope_rad: 0.5 * PI,
            shallowest_m: 100.0,
            deepest_m: 2_000.0,
            ..Relief::flat(1_000.0)
        };
        assert!((slope.depth_m(7_000.0, 10_000.0) - 1_200.0).abs() < 1e-9);
        assert!((slope.depth_m(0.0, -1e6) - 100.0).abs() < 1e-9);
        assert!((slope.depth_m(0.0, 1e6) - 2_000.0).abs() < 1e-9);

        let mount = Mount { centre_m: [1_000.0, 0.0], radius_m: 2_000.0, height_m: 400.0 };
        let hill = Relief { mounts: vec![mount], ..Relief::flat(1_000.0) };
        assert!((hill.depth_m(1_000.0, 0.0) - 600.0).abs() < 1e-9);
        let flank = 1_000.0 - 400.0 * (-0.5_f64).exp();
        assert!((hill.depth_m(1_000.0, 2_000.0) - flank).abs() < 1e-9);

        let trench = Trench {
            direction_rad: 0.0,
            offset_m: 3_000.0,
            half_width_m: 1_000.0,
            deeper_by_m: 250.0,
            meander_m: 500.0,
            wavelength_m: 20_000.0,
        };
        let canyon = Relief { trenches: vec![trench], deepest_m: 3_000.0, ..Relief::flat(1_000.0) };
        assert!((canyon.depth_m(5_000.0, 3_500.0) - 1_250.0).abs() < 1e-9);
        assert!((canyon.depth_m(5_000.0, -9_000.0) - 1_000.0).abs() < 1e-6);
    }
}
