use super::fan::LaunchFan;
use super::influence::{BeamShape, Coherence, Influence};
use super::settings::{Receivers, Source, TraceSettings};
use crate::complex::Complex;
use crate::environment::Section;
use crate::error::AcousticsError;
use crate::ray::{Launch, Medium, MediumLimits, Tracer};

/// Decibels per neper of amplitude.
pub(crate) const DB_PER_NEPER: f64 = 8.685_889_638_065_037;

/// The sound field of a source on a grid of receivers.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    /// Ranges of the receivers, metres.
    pub range_m: Vec<f64>,
    /// Depths of the receivers, metres.
    pub depth_m: Vec<f64>,
    /// Pressure over that at 1 m from the source, [depth, range]; of incoherent
    /// fields the root of the intensity, without a phase.
    pub pressure: Vec<Complex>,
}

impl Field {
    /// Transmission loss, [depth, range], dB re 1 m; infinite where no beam came.
    pub fn loss_db(&self) -> Vec<f64> {
        self.pressure.iter().map(|p| -20.0 * p.modulus().log10()).collect()
    }
}

/// The sound field of a source in a section, summed over a fan of beams.
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
    let tracer = Tracer::new(section, &medium, settings.amplitude_cutoff);
    let absorption = section.absorption.db_km(source.frequency_hz) / (1000.0 * DB_PER_NEPER);
    let speed = section.sound_speed().speed_at_m_s(0.0, source.depth_m);
    let mut influence = Influence::new(
        receivers,
        shape,
        coherence,
        source.frequency_hz,
        absorption,
        (source.depth_m, speed),
    );
    for beam in fan.beams() {
        influence.begin(beam.angle_rad, beam.width_rad);
        tracer.run(Launch { depth_m: source.depth_m, angle_rad: beam.angle_rad }, &mut influence);
    }
    let mut pressure = influence.into_sums();
    for row in pressure.chunks_exact_mut(receivers.range_m().len()) {
        for (p, range) in row.iter_mut().zip(receivers.range_m()) {
            *p = match coherence {
                Coherence::Coherent => {
                    let scale = range.sqrt().recip();
                    Complex::new(p.re * scale, p.im * scale)
                }
                Coherence::SemiCoherent | Coherence::Incoherent => {
                    Complex::new((p.re / range).sqrt(), 0.0)
                }
            };
        }
    }
    let (range_m, depth_m) = (receivers.range_m().to_vec(), receivers.depth_m().to_vec());
    Ok(Field { range_m, depth_m, pressure })
}
