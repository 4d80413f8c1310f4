use crate::complex::Complex;
use crate::error::{AcousticsError, ascending, length, within};

/// What reflects sound at the surface or at the sea floor.
#[derive(Debug, Clone, PartialEq)]
pub enum Boundary {
    /// Nothing above or below: all is reflected, with a phase of π.
    Vacuum,
    /// An immovable wall: all is reflected, without a phase.
    Rigid,
    /// A fluid that fills the half-space beyond.
    Fluid(FluidHalfSpace),
    /// Coefficients given over the grazing angle.
    Table(ReflectionTable),
}

/// A fluid half-space; densities are relative to the water's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FluidHalfSpace {
    /// Speed of sound, m/s.
    pub speed_m_s: f64,
    /// Density relative to the water's (g/cm³ over water of 1 g/cm³).
    pub density_ratio: f64,
    /// Attenuation, dB per wavelength.
    pub attenuation_db_wavelength: f64,
}

/// Reflection coefficients over the grazing angle, linear in modulus and in
/// phase between the entries, constant beyond them and symmetric about 90°.
#[derive(Debug, Clone, PartialEq)]
pub struct ReflectionTable {
    grazing_angle_deg: Vec<f64>,
    modulus: Vec<f64>,
    phase_rad: Vec<f64>,
}

impl FluidHalfSpace {
    /// A half-space of checked properties.
    ///
    /// # Errors
    /// If speed or density is not positive, or the attenuation negative.
    pub fn new(
        speed_m_s: f64,
        density_ratio: f64,
        attenuation_db_wavelength: f64,
    ) -> Result<Self, AcousticsError> {
        within("the sound speed of a half-space", "positive", speed_m_s, speed_m_s > 0.0)?;
        within("the density of a half-space", "positive", density_ratio, density_ratio > 0.0)?;
        within(
            "the attenuation of a half-space",
            "zero or positive",
            attenuation_db_wavelength,
            attenuation_db_wavelength >= 0.0,
        )?;
        Ok(Self { speed_m_s, density_ratio, attenuation_db_wavelength })
    }

    /// Plane-wave reflection coefficient for the components of the slowness
    /// along and across the boundary (COA Eq. 1.54 with time factor e^(−iωt);
    /// ω cancels because the attenuation is per wavelength).
    fn reflection(&self, along: f64, across: f64) -> Complex {
        const DB_PER_NEPER: f64 = 8.685_889_638_065_037;
        let loss = self.attenuation_db_wavelength / (std::f64::consts::TAU * DB_PER_NEPER);
        let speed = Complex::new(self.speed_m_s, self.speed_m_s * loss);
        let slowness_squared = Complex::new(1.0, 0.0) / (speed * speed);
        let mut under_root = Complex::new(along * along, 0.0) - slowness_squared;
        // Waves in the half-space decay or travel away from the boundary.
        under_root.im = under_root.im.max(0.0);
        let gamma = under_root.sqrt(); // γ = √(k_x² − (ω/c_p)²)
        let impedance = Complex::new(0.0, across * self.density_ratio); // i k_z ρ_b/ρ_w
        let ratio = (gamma - impedance) / (gamma + impedance);
        Complex::new(-ratio.re, -ratio.im)
    }
}

impl ReflectionTable {
    /// A table over ascending grazing angles, in degrees, of the modulus and the
    /// phase, in degrees, of the coefficient.
    ///
    /// # Errors
    /// If the table is empty or of unequal columns, angles do not ascend, or a
    /// modulus is negative.
    pub fn new(
        grazing_angle_deg: Vec<f64>,
        modulus: Vec<f64>,
        phase_deg: &[f64],
    ) -> Result<Self, AcousticsError> {
        let count = grazing_angle_deg.len();
        within("the number of reflection coefficients", "at least 1", count as f64, count > 0)?;
        length("moduli of reflection", count, modulus.len())?;
        length("phases of reflection", count, phase_deg.len())?;
        ascending("grazing angles of reflection coefficients", &grazing_angle_deg)?;
        for (&r, &phase) in modulus.iter().zip(phase_deg) {
            within("a modulus of reflection", "zero or positive", r, r >= 0.0)?;
            within("a phase of reflection", "finite", phase, true)?;
        }
        let phase_rad = phase_deg.iter().map(|phase| phase.to_radians()).collect();
        Ok(Self { grazing_angle_deg, modulus, phase_rad })
    }

    fn reflection(&self, along: f64, across: f64) -> Complex {
        let angle = across.abs().atan2(along.abs()).to_degrees();
        let last = self.grazing_angle_deg.len() - 1;
        let after = self.grazing_angle_deg.partition_point(|&a| a <= angle);
        if after == 0 || after > last {
            let end = after.min(last);
            return Complex::from_polar(self.modulus[end], self.phase_rad[end]);
        }
        let (a0, a1) = (self.grazing_angle_deg[after - 1], self.grazing_angle_deg[after]);
        let weight = (angle - a0) / (a1 - a0);
        let between = |v: &[f64]| v[after - 1] + weight * (v[after] - v[after - 1]);
        Complex::from_polar(between(&self.modulus), between(&self.phase_rad))
    }
}

impl Boundary {
    /// Reflection coefficient for a wave whose slowness has these components
    /// along the boundary and across it, s/m.
    pub fn reflection(&self, along_s_m: f64, across_s_m: f64) -> Complex {
        match self {
            Self::Vacuum => Complex::new(-1.0, 0.0),
            Self::Rigid => Complex::new(1.0, 0.0),
            Self::Fluid(half_space) => half_space.reflection(along_s_m, across_s_m.abs()),
            Self::Table(table) => table.reflection(along_s_m, across_s_m),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_grazing(boundary: &Boundary, speed: f64, degrees: f64) -> Complex {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        boundary.reflection(cosine / speed, sine / speed)
    }

    #[test]
    fn a_matched_half_space_reflects_nothing() {
        let matched = Boundary::Fluid(FluidHalfSpace::new(1500.0, 1.0, 0.0).unwrap());
        for degrees in [1.0, 20.0, 60.0, 90.0] {
            assert!(at_grazing(&matched, 1500.0, degrees).modulus() < 1e-6);
        }
    }

    #[test]
    fn a_fast_bottom_reflects_all_below_its_critical_angle() {
        let sand = Boundary::Fluid(FluidHalfSpace::new(1600.0, 1.7, 0.0).unwrap());
        let critical = (1500.0f64 / 1600.0).acos().to_degrees();
        assert!((at_grazing(&sand, 1500.0, critical - 1.0).modulus() - 1.0).abs() < 1e-12);
        assert!(at_grazing(&sand, 1500.0, critical + 5.0).modulus() < 0.7);
        // Normal incidence: (Z2 − Z1)/(Z2 + Z1).
        let (z1, z2) = (1500.0, 1.7 * 1600.0);
        let normal = at_grazing(&sand, 1500.0, 90.0);
        assert!((normal.re - (z2 - z1) / (z2 + z1)).abs() < 1e-12 && normal.im.abs() < 1e-12);
    }

    #[test]
    fn tables_are_linear_in_modulus_and_phase() {
        let table = ReflectionTable::new(vec![0.0, 10.0], vec![1.0, 0.5], &[180.0, 90.0]).unwrap();
        let r = at_grazing(&Boundary::Table(table.clone()), 1500.0, 5.0);
        assert!((r.modulus() - 0.75).abs() < 1e-9);
        assert!((r.phase_rad().to_degrees() - 135.0).abs() < 1e-9);
        let beyond = at_grazing(&Boundary::Table(table), 1500.0, 50.0);
        assert!((beyond.modulus() - 0.5).abs() < 1e-9);
    }
}
