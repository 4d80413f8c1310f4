use super::beam_kind::{BeamCoordinates, BeamKind, BeamShape, Coherence};
use super::fan::LaunchFan;
use super::settings::{Receivers, Source, SourceGeometry, TraceSettings};
use super::shot::Shot;
use crate::complex::Complex;
use crate::environment::Section;
use crate::error::AcousticsError;
use crate::ray::{Medium, MediumLimits};

/// Decibels per neper of amplitude.
pub(crate) const DB_PER_NEPER: f64 = 8.685_889_638_065_037;

/// The sound field of a source on a grid of receivers.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Ranges of the receivers, metres.
    pub range_m: Vec<f64>,
    /// Depths of the receivers, metres.
    pub depth_m: Vec<f64>,
    /// Pressure over that at 1 m from the source, [depth, range], or of each pair of
    /// receivers that are no grid; of incoherent fields the root of the intensity,
    /// without a phase.
    pub pressure: Vec<Complex>,
}

impl Field {
    /// Transmission loss, in the order of the pressures, dB re 1 m; infinite where no beam
    /// came.
    pub fn loss_db(&self) -> Vec<f64> {
        self.pressure.iter().map(|p| -20.0 * p.modulus().log10()).collect()
    }
}

/// The sound field of a point source in a section, summed over a fan of Cartesian
/// beams. [`crate::model::Native`] answers everything else.
///
/// # Errors
/// If the source is not in the water.
pub fn transmission_loss(
    section: &Section,
    source: &Source,
    fan: &LaunchFan,
    receivers: &Receivers,
    shape: BeamShape,
    coherence: Coherence,
    settings: &TraceSettings,
) -> Result<Field, AcousticsError> {
    source.check(section)?;
    let medium = Medium::new(section, &MediumLimits::from(settings));
    let shot = Shot {
        section,
        medium: &medium,
        source: *source,
        geometry: SourceGeometry::Point,
        beam_pattern: None,
        fan,
        beams: BeamKind { shape, coordinates: BeamCoordinates::Cartesian },
        receivers,
        amplitude_cutoff: settings.amplitude_cutoff,
    };
    Ok(shot.field(coherence))
}
