use super::beam_kind::{BeamCoordinates, BeamKind, BeamShape, Coherence};
use super::fan::LaunchFan;
use super::settings::{Receivers, Source, SourceGeometry, TraceSettings};
use super::shot::Shot;
use super::sound_field::Field;
use crate::environment::Section;
use crate::error::AcousticsError;
use crate::ray::{Medium, MediumLimits};

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
