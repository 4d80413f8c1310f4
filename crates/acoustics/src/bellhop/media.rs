//! What a file says of water and of half-spaces, checked.

use super::options::AttenuationUnit;
use super::records::Records;
use crate::environment::{Boundary, ElasticHalfSpace, FluidHalfSpace};
use crate::error::{AcousticsError, within};

/// Checks that a sound speed is one of water, generously: what is far from it makes
/// profiles too steep to follow.
pub(crate) fn check_speed(records: &Records, speed_m_s: f64) -> Result<(), AcousticsError> {
    let watery = (100.0..=10_000.0).contains(&speed_m_s);
    records.blame(within("a sound speed in water in m/s", "from 100 to 10 000", speed_m_s, watery))
}

/// A half-space of its speeds of compressional and shear waves, its density, and the
/// attenuations of both.
pub(crate) fn half_space(
    records: &Records,
    [speed, shear, density, attenuation, shear_attenuation]: [f64; 5],
    unit: AttenuationUnit,
    water_density: f64,
) -> Result<Boundary, AcousticsError> {
    let attenuation = unit.db_wavelength(attenuation, speed);
    let fluid = records.blame(FluidHalfSpace::new(speed, density / water_density, attenuation))?;
    if shear == 0.0 {
        return Ok(Boundary::Fluid(fluid));
    }
    let attenuation = unit.db_wavelength(shear_attenuation, shear);
    records.blame(ElasticHalfSpace::new(fluid, shear, attenuation)).map(Boundary::Elastic)
}
