use super::environment_file;
use crate::environment::Section;
use crate::error::AcousticsError;
use crate::field::{
    BeamShape, Coherence, Field, LaunchFan, Receivers, Source, TraceSettings, transmission_loss,
};
use crate::ray::{Ray, trace};
use std::path::Path;

/// What a case asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Run {
    /// The field on the receivers.
    Field(BeamShape, Coherence),
    /// The paths of the rays.
    Rays,
}

/// A case of the BELLHOP family, read from its files.
#[derive(Debug, Clone, PartialEq)]
pub struct BellhopCase {
    /// Its title.
    pub title: String,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// The environment.
    pub section: Section,
    /// Depths of the sources, metres.
    pub source_depth_m: Vec<f64>,
    /// The receivers.
    pub receivers: Receivers,
    /// The beams.
    pub fan: LaunchFan,
    /// What to compute.
    pub run: Run,
    /// How far rays go.
    pub settings: TraceSettings,
}

impl BellhopCase {
    /// Reads `CASE.env`, and `CASE.ssp`, `.bty`, `.brc` and `.trc` where it
    /// refers to them. Understood are one medium; profiles C, N and Q; flat
    /// surfaces and straight-piecewise sea floors; boundaries V, R, A (fluid)
    /// and F; volume attenuation T and F; run types C, S, I and R with
    /// Cartesian hat and Gaussian beams.
    ///
    /// # Errors
    /// If a file cannot be read, a line does not hold what belongs there or asks
    /// for something else, or the environment makes no sense.
    pub fn read(path: &Path) -> Result<Self, AcousticsError> {
        environment_file::read(path)
    }

    fn sources(&self) -> impl Iterator<Item = Source> {
        let frequency_hz = self.frequency_hz;
        self.source_depth_m.iter().map(move |&depth_m| Source { depth_m, frequency_hz })
    }

    /// The field of every source with the beams and the coherence given.
    ///
    /// # Errors
    /// If a source is not in the water.
    pub fn fields(
        &self,
        shape: BeamShape,
        coherence: Coherence,
    ) -> Result<Vec<Field>, AcousticsError> {
        self.sources()
            .map(|source| {
                transmission_loss(
                    &self.section,
                    &source,
                    &self.fan,
                    &self.receivers,
                    shape,
                    coherence,
                    &self.settings,
                )
            })
            .collect()
    }

    /// All rays of every source, source by source.
    ///
    /// # Errors
    /// If a source is not in the water.
    pub fn rays(&self) -> Result<Vec<Ray>, AcousticsError> {
        let mut rays = Vec::new();
        for source in self.sources() {
            for beam in self.fan.beams() {
                let angle = beam.angle_rad.to_degrees();
                rays.push(trace(&self.section, &source, angle, &self.settings)?);
            }
        }
        Ok(rays)
    }
}
