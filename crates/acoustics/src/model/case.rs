use crate::environment::Section;
use crate::field::{
    BeamKind, BeamPattern, Coherence, LaunchFan, Receivers, Source, SourceGeometry, TraceSettings,
};

/// What a case asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Run {
    /// The field on the receivers.
    Field(Coherence),
    /// The paths of all rays.
    Rays,
    /// The paths of the rays that pass near a receiver.
    Eigenrays,
    /// What arrives at each receiver, and when.
    Arrivals,
}

/// Everything that decides a sound field: the environment, sources and receivers in
/// it, the beams, and what is asked about them.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its title.
    pub title: String,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// The environment.
    pub section: Section,
    /// Depths of the sources, metres. All are at range 0.
    pub source_depth_m: Vec<f64>,
    /// How sound spreads out of the section.
    pub geometry: SourceGeometry,
    /// How strongly a source sends in which direction; all alike without it.
    pub beam_pattern: Option<BeamPattern>,
    /// The receivers.
    pub receivers: Receivers,
    /// The directions of the beams.
    pub fan: LaunchFan,
    /// What a beam looks like.
    pub beams: BeamKind,
    /// What to compute.
    pub run: Run,
    /// How far rays go, and how closely they are followed.
    pub settings: TraceSettings,
}

impl Case {
    /// The sources.
    pub fn sources(&self) -> impl Iterator<Item = Source> {
        let frequency_hz = self.frequency_hz;
        self.source_depth_m.iter().map(move |&depth_m| Source { depth_m, frequency_hz })
    }
}
