use super::arrivals::Arrivals;
use super::beam_kind::{BeamKind, Coherence};
use super::beam_pattern::BeamPattern;
use super::fan::{Beam, LaunchFan};
use super::influence::{
    ArrivalSink, BeamLaunch, BeamPhysics, ContributionSink, HitSink, Influence, IntensitySink,
    PressureSink, Stations,
};
use super::settings::{Receivers, Source, SourceGeometry};
use super::transmission_loss::Field;
use crate::complex::Complex;
use crate::environment::Section;
use crate::ray::{Launch, Medium, Ray, Tracer, record};
use rayon::prelude::*;
use std::f64::consts::{PI, SQRT_2, TAU};

/// Into how many chunks a fan is divided. Their sums are added up in the order of the
/// fan, so that results do not depend on the number of threads.
const CHUNKS: usize = 64;

/// The most sums that chunks may hold together: many receivers make fewer chunks.
const MOST_SUMS: usize = 1 << 25;

/// One source in a section, and the beams it sends to receivers.
#[derive(Clone, Copy)]
pub(crate) struct Shot<'a> {
    pub section: &'a Section,
    /// Made of the section.
    pub medium: &'a Medium,
    pub source: Source,
    pub geometry: SourceGeometry,
    pub beam_pattern: Option<&'a BeamPattern>,
    pub fan: &'a LaunchFan,
    pub beams: BeamKind,
    pub receivers: &'a Receivers,
    pub amplitude_cutoff: f64,
}

impl Shot<'_> {
    /// The field on the receivers.
    pub(crate) fn field(&self, coherence: Coherence) -> Field {
        let count = self.receivers.count();
        let spreading = |receiver: usize| self.spreading(receiver);
        let strength = |beam: &Beam| self.strength(beam) * self.lloyd(beam, coherence);
        let pressure = match coherence {
            Coherence::Coherent => {
                let angular_frequency = TAU * self.source.frequency_hz;
                let sums = vec![Complex::default(); count];
                let new = || PressureSink { angular_frequency, sums: sums.clone() };
                let sums = self.sum(new, strength).sums.into_iter().enumerate();
                let scaled = |(receiver, p): (usize, Complex)| {
                    let spreading = spreading(receiver);
                    Complex::new(p.re * spreading, p.im * spreading)
                };
                sums.map(scaled).collect()
            }
            Coherence::SemiCoherent | Coherence::Incoherent => {
                let sums = vec![0.0; count];
                let new = || IntensitySink { sums: sums.clone() };
                let sums = self.sum(new, strength).sums.into_iter().enumerate();
                let root = |(receiver, intensity): (usize, f64)| {
                    Complex::new(intensity.sqrt() * spreading(receiver), 0.0)
                };
                sums.map(root).collect()
            }
        };
        let receivers = self.receivers;
        let (range_m, depth_m) = (receivers.range_m().to_vec(), receivers.depth_m().to_vec());
        Field { range_m, depth_m, pressure }
    }

    /// What arrives at the receivers.
    pub(crate) fn arrivals(&self) -> Arrivals {
        let angular_frequency = TAU * self.source.frequency_hz;
        let new = || ArrivalSink::new(self.receivers.count(), angular_frequency);
        let sink = self.sum(new, |beam| self.strength(beam));
        let receivers = self.receivers;
        Arrivals {
            range_m: receivers.range_m().to_vec(),
            depth_m: receivers.depth_m().to_vec(),
            at: sink.into_arrivals(|receiver| self.spreading(receiver)),
        }
    }

    /// The rays whose beams touch a receiver, up to there.
    pub(crate) fn eigenrays(&self) -> Vec<Ray> {
        let hits = self.sum(HitSink::default, |beam| self.strength(beam)).hits;
        let tracer = self.tracer();
        let beams = self.fan.beams();
        hits.par_iter()
            .map(|&(beam, path_m)| record(&tracer, self.launch(&beams[beam]), path_m))
            .collect()
    }

    /// The rays of all beams.
    pub(crate) fn rays(&self) -> Vec<Ray> {
        let tracer = self.tracer();
        let beams = self.fan.beams();
        beams.par_iter().map(|beam| record(&tracer, self.launch(beam), f64::INFINITY)).collect()
    }

    fn tracer(&self) -> Tracer<'_> {
        Tracer::new(self.section, self.medium, self.amplitude_cutoff)
    }

    fn launch(&self, beam: &Beam) -> Launch {
        Launch { depth_m: self.source.depth_m, angle_rad: beam.angle_rad }
    }

    /// Traces all beams, and joins what they leave in sinks.
    fn sum<S: ContributionSink + Send>(
        &self,
        new_sink: impl Fn() -> S + Sync,
        strength: impl Fn(&Beam) -> f64 + Sync,
    ) -> S {
        let stations = Stations::new(self.receivers);
        let physics = BeamPhysics::new(self.section, &self.source, self.beams.shape);
        let tracer = self.tracer();
        let chunks = (MOST_SUMS / self.receivers.count().max(1)).clamp(1, CHUNKS);
        let beams = self.fan.beams();
        let size = beams.len().div_ceil(chunks).max(1);
        let sinks: Vec<S> = beams
            .par_chunks(size)
            .enumerate()
            .map(|(chunk, beams)| {
                let mut influence = Influence::new(&stations, &physics, self.beams, new_sink());
                for (index, beam) in beams.iter().enumerate() {
                    let (angle_rad, width_rad) = (beam.angle_rad, beam.width_rad);
                    let index = chunk * size + index;
                    let strength = strength(beam);
                    influence.begin(BeamLaunch { index, angle_rad, width_rad, strength });
                    tracer.run(self.launch(beam), &mut influence);
                }
                influence.into_sink()
            })
            .collect();
        let mut sinks = sinks.into_iter();
        let mut sum = sinks.next().unwrap_or_else(new_sink);
        for next in sinks {
            sum.join(next);
        }
        sum
    }

    /// What the source sends into a beam, as a factor of amplitude.
    fn strength(&self, beam: &Beam) -> f64 {
        let pattern = self.beam_pattern;
        let sent = pattern.map_or(1.0, |pattern| pattern.amplitude(beam.angle_rad.to_degrees()));
        match self.geometry {
            SourceGeometry::Point => sent * beam.angle_rad.cos().abs().sqrt(),
            SourceGeometry::Line => sent,
        }
    }

    /// The interference of the source with its image in the surface.
    fn lloyd(&self, beam: &Beam, coherence: Coherence) -> f64 {
        if coherence != Coherence::SemiCoherent {
            return 1.0;
        }
        let source = &self.source;
        let speed = self.section.sound_speed().speed_at_m_s(0.0, source.depth_m);
        let vertical = TAU * source.frequency_hz / speed * beam.angle_rad.sin();
        SQRT_2 * (vertical * source.depth_m).sin().abs()
    }

    /// Spreading in cylinders around a point source, as a factor of amplitude. That of a
    /// line does not depend on range, but on what strength it is given: BELLHOP's.
    fn spreading(&self, receiver: usize) -> f64 {
        match self.geometry {
            SourceGeometry::Point => {
                let range_m = self.receivers.range_of_m(receiver).abs();
                if range_m > 0.0 { range_m.sqrt().recip() } else { 0.0 }
            }
            SourceGeometry::Line => 4.0 * PI.sqrt(),
        }
    }
}
