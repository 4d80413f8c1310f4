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
    /// A solid that fills the half-space beyond.
    Elastic(ElasticHalfSpace),
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

/// A solid half-space: a fluid one that carries shear waves as well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticHalfSpace {
    /// What it is to compressional waves.
    pub compressional: FluidHalfSpace,
    /// Speed of shear waves, m/s.
    pub shear_speed_m_s: f64,
    /// Attenuation of shear waves, dB per wavelength of theirs.
    pub shear_attenuation_db_wavelength: f64,
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
        let squared = squared_slowness(self.speed_m_s, self.attenuation_db_wavelength);
        let gamma = decay(along, squared); // γ = √(k_x² − (ω/c_p)²)
        let impedance = Complex::new(0.0, across * self.density_ratio); // i k_z ρ_b/ρ_w
        let ratio = (gamma - impedance) / (gamma + impedance);
        Complex::new(-ratio.re, -ratio.im)
    }
}

impl ElasticHalfSpace {
    /// A half-space of checked properties.
    ///
    /// # Errors
    /// If the shear speed is not positive, or its attenuation negative.
    pub fn new(
        compressional: FluidHalfSpace,
        shear_speed_m_s: f64,
        shear_attenuation_db_wavelength: f64,
    ) -> Result<Self, AcousticsError> {
        within(
            "the shear speed of a half-space",
            "positive",
            shear_speed_m_s,
            shear_speed_m_s > 0.0,
        )?;
        within(
            "the shear attenuation of a half-space",
            "zero or positive",
            shear_attenuation_db_wavelength,
            shear_attenuation_db_wavelength >= 0.0,
        )?;
        Ok(Self { compressional, shear_speed_m_s, shear_attenuation_db_wavelength })
    }

    /// As of a fluid half-space, but with the impedance of compressional and shear waves
    /// together, Zₚ cos² 2θₛ + Zₛ sin² 2θₛ (COA section 1.6).
    fn reflection(&self, along: f64, across: f64) -> Complex {
        let fluid = &self.compressional;
        let squared_p = squared_slowness(fluid.speed_m_s, fluid.attenuation_db_wavelength);
        let squared_s =
            squared_slowness(self.shear_speed_m_s, self.shear_attenuation_db_wavelength);
        let (gamma_p, gamma_s) = (decay(along, squared_p), decay(along, squared_s));
        let two = Complex::new(2.0, 0.0);
        let along_squared = Complex::new(along * along, 0.0);
        // cos² 2θ_s + sin² 2θ_s Z_s/Z_p = [(k_s² − 2k_x²)² − 4k_x²γ_pγ_s]/k_s⁴
        let bent = squared_s - two * along_squared;
        let rayleigh = bent * bent - two * two * along_squared * gamma_p * gamma_s;
        let stiffness = rayleigh / (squared_s * squared_s);
        let impedance = Complex::new(0.0, across * fluid.density_ratio) * stiffness;
        let ratio = (gamma_p - impedance) / (gamma_p + impedance);
        Complex::new(-ratio.re, -ratio.im)
    }
}

/// 1/c² of a medium with an attenuation in dB per wavelength.
fn squared_slowness(speed_m_s: f64, attenuation_db_wavelength: f64) -> Complex {
    const DB_PER_NEPER: f64 = 8.685_889_638_065_037;
    let loss = attenuation_db_wavelength / (std::f64::consts::TAU * DB_PER_NEPER);
    let speed = Complex::new(speed_m_s, speed_m_s * loss);
    Complex::new(1.0, 0.0) / (speed * speed)
}

/// √(kₓ² − k²)/ω of a wave that decays, or travels, away from the boundary.
fn decay(along: f64, squared_slowness: Complex) -> Complex {
    let mut under_root = Complex::new(along * along, 0.0) - squared_slowness;
    under_root.im = under_root.im.max(0.0);
    under_root.sqrt()
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

    /// Grazing angles, degrees.
    pub fn grazing_angle_deg(&self) -> &[f64] {
        &self.grazing_angle_deg
    }

    /// Moduli of the coefficients.
    pub fn modulus(&self) -> &[f64] {
        &self.modulus
    }

    /// Phases of the coefficients, radians.
    pub fn phase_rad(&self) -> &[f64] {
        &self.phase_rad
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
            Self::Elastic(half_space) => half_space.reflection(along_s_m, across_s_m.abs()),
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

    /// A soft solid is almost a fluid; a hard one reflects, at normal incidence, like a
    /// fluid, and converts so much at a slant that nothing is left to reflect totally
    /// between the critical angles of the two waves.
    #[test]
    fn solids_convert_sound_to_shear() {
        let fluid = FluidHalfSpace::new(3000.0, 2.4, 0.1).unwrap();
        let solid = |speed| Boundary::Elastic(ElasticHalfSpace::new(fluid, speed, 0.2).unwrap());
        for degrees in [3.0, 30.0, 65.0, 90.0] {
            let (soft, none) = (solid(1.0), Boundary::Fluid(fluid));
            let apart = at_grazing(&soft, 1500.0, degrees) - at_grazing(&none, 1500.0, degrees);
            assert!(apart.modulus() < 1e-3, "{degrees}: {apart:?}");
        }
        // c_s under c_w: below the critical angle of 60°, shear carries sound away.
        assert!(at_grazing(&Boundary::Fluid(fluid), 1500.0, 40.0).modulus() > 0.98);
        assert!(at_grazing(&solid(1400.0), 1500.0, 40.0).modulus() < 0.8);
        // Rayleigh's function is real: a lossless solid with c_s over c_w reflects all
        // sound that grazes under the critical angle of shear, acos(1500/2000) = 41°.
        let lossless = FluidHalfSpace::new(4000.0, 2.5, 0.0).unwrap();
        let rock = Boundary::Elastic(ElasticHalfSpace::new(lossless, 2000.0, 0.0).unwrap());
        assert!((at_grazing(&rock, 1500.0, 35.0).modulus() - 1.0).abs() < 1e-9);
        assert!(at_grazing(&rock, 1500.0, 50.0).modulus() < 0.99);
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
