use super::Slice;
use super::lanes::Lanes;
use super::tables::REFERENCE_M_S;
use crate::decibel::DB_PER_NEPER;
use crate::environment::{Boundary, FluidHalfSpace};
use std::f64::consts::TAU;

/// As in the scalar tracer: rays leave a boundary at this grazing angle at least.
const LEAST_GRAZING: f32 = 1e-4;

/// What reflects the rays of a slice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Reflector<'a> {
    surface: EnergyLaw<'a>,
    bottom: EnergyLaw<'a>,
}

/// How much intensity a boundary reflects.
#[derive(Debug, Clone, Copy)]
enum EnergyLaw<'a> {
    All,
    Fluid(FluidLaw),
    Other(&'a Boundary),
}

/// A fluid half-space, its slowness squared (and conjugated) in units of the
/// reference.
#[derive(Debug, Clone, Copy)]
struct FluidLaw {
    squared_re: f64,
    squared_im: f64,
    density_ratio: f64,
}

impl<'a> EnergyLaw<'a> {
    fn new(boundary: &'a Boundary) -> Self {
        match boundary {
            Boundary::Vacuum | Boundary::Rigid => Self::All,
            Boundary::Fluid(fluid) => Self::Fluid(FluidLaw::new(fluid)),
            Boundary::Elastic(_) | Boundary::Table(_) => Self::Other(boundary),
        }
    }

    /// |R|² for components of the slowness along and across a boundary.
    #[inline(always)]
    fn energy(&self, along: f64, across: f64) -> f64 {
        match self {
            Self::All => 1.0,
            Self::Fluid(fluid) => fluid.energy(along, across),
            Self::Other(boundary) => {
                boundary.reflection(along / REFERENCE_M_S, across / REFERENCE_M_S).squared_modulus()
            }
        }
    }
}

impl FluidLaw {
    fn new(fluid: &FluidHalfSpace) -> Self {
        let loss = fluid.attenuation_db_wavelength / (TAU * DB_PER_NEPER);
        // 1/(c (1 + i loss))²
        let scale = (REFERENCE_M_S / (fluid.speed_m_s * (1.0 + loss * loss))).powi(2);
        Self {
            squared_re: scale * (1.0 - loss * loss),
            squared_im: scale * 2.0 * loss,
            density_ratio: fluid.density_ratio,
        }
    }

    /// |R|² with R = −(γ − iρk)/(γ + iρk), γ² = a + ib: in real numbers
    /// (|γ|² + ρ²k² − 2ρk Im γ)/(|γ|² + ρ²k² + 2ρk Im γ).
    #[inline(always)]
    fn energy(&self, along: f64, across: f64) -> f64 {
        let (a, b) = (along * along - self.squared_re, self.squared_im);
        let modulus = (a * a + b * b).sqrt();
        // Im γ, from the half that suffers no cancellation.
        let half = (0.5 * (modulus + a.abs())).sqrt();
        let imaginary = if a > 0.0 { 0.5 * b / half } else { half };
        let impedance = self.density_ratio * across;
        let sum = modulus + impedance * impedance;
        let product = 2.0 * impedance * imaginary;
        (sum - product) / (sum + product)
    }
}

impl<'a> Reflector<'a> {
    /// The boundaries of a slice's first part.
    pub(super) fn new(slice: &Slice<'a>) -> Self {
        let law = |boundary: fn(&'a crate::environment::Section) -> &'a Boundary| {
            slice
                .parts
                .first()
                .map_or(EnergyLaw::All, |part| EnergyLaw::new(boundary(part.section)))
        };
        Self { surface: law(|section| &section.surface), bottom: law(|section| &section.bottom) }
    }

    /// Puts a ray onto the surface, and reflects it.
    #[inline(always)]
    pub(super) fn off_surface(&self, lanes: &mut Lanes, i: usize) {
        lanes.local_z[i] = -lanes.here.half_height[i];
        lanes.slowness_z[i] = -lanes.slowness_z[i].abs();
        reflect(lanes, i, [0.0, -1.0], &self.surface);
    }

    /// Puts a ray onto the floor, and reflects it.
    #[inline(always)]
    pub(super) fn off_floor(&self, lanes: &mut Lanes, i: usize) {
        let slope = lanes.here.slope[i];
        lanes.local_z[i] = lanes.here.floor[i] + slope * lanes.local_x[i];
        let secant = (1.0 + slope * slope).sqrt();
        reflect(lanes, i, [-slope / secant, 1.0 / secant], &self.bottom);
    }
}

/// As the scalar tracer's reflection, at a plane with this outward normal.
#[inline(always)]
fn reflect(lanes: &mut Lanes, i: usize, n: [f32; 2], law: &EnergyLaw<'_>) {
    let mirror = |v: [f32; 2]| {
        let across = 2.0 * (v[0] * n[0] + v[1] * n[1]);
        [v[0] - across * n[0], v[1] - across * n[1]]
    };
    let slowness = [lanes.slowness_x[i], lanes.slowness_z[i]];
    let offset = [lanes.offset_x[i], lanes.offset_z[i]];
    let towards = slowness[0] * n[0] + slowness[1] * n[1];
    let along = slowness[0] * n[1] - slowness[1] * n[0];
    let least = LEAST_GRAZING * (towards * towards + along * along).sqrt();
    let across = if towards > least { towards } else { least };
    let here = &lanes.here;
    let gradient = [
        here.gradient_x[i] + here.twist[i] * lanes.local_z[i],
        here.gradient_z[i] + here.twist[i] * lanes.local_x[i],
    ];
    let delay = -(offset[0] * n[0] + offset[1] * n[1]) / across;
    let later = [gradient[0] * delay, gradient[1] * delay];
    let turned =
        mirror([lanes.offset_slowness_x[i] + later[0], lanes.offset_slowness_z[i] + later[1]]);
    [lanes.offset_slowness_x[i], lanes.offset_slowness_z[i]] =
        [turned[0] - later[0], turned[1] - later[1]];
    [lanes.offset_x[i], lanes.offset_z[i]] = mirror(offset);
    // p' = p − (pₙ + pₙ') n, so that 1 − p_x² loses nothing to rounding.
    let turn = -(towards + across);
    let turn_x = turn * n[0];
    lanes.defect[i] -= turn_x * (2.0 * slowness[0] + turn_x);
    lanes.slowness_x[i] = slowness[0] + turn_x;
    lanes.slowness_z[i] = slowness[1] + turn * n[1];
    lanes.energy[i] *= law.energy(f64::from(along), f64::from(across)) as f32;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::environment::Seabed;

    #[test]
    fn the_energy_is_that_of_the_reflection_coefficient() {
        for seabed in Seabed::ALL {
            let boundary = Boundary::Fluid(seabed.half_space());
            for speed in [1450.0, 1500.0, 1545.0] {
                for tenth_degrees in 0..=900 {
                    let (sine, cosine) = (f64::from(tenth_degrees) * 0.1).to_radians().sin_cos();
                    let (along, across) = (cosine / speed, sine / speed);
                    let expected = boundary.reflection(along, across).squared_modulus();
                    let found = EnergyLaw::new(&boundary)
                        .energy(along * REFERENCE_M_S, across * REFERENCE_M_S);
                    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
                }
            }
        }
    }
}
