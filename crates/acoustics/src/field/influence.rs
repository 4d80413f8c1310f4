use super::settings::Receivers;
use crate::complex::Complex;
use crate::ray::{Segment, SegmentSink};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How sound is spread across a beam (COA section 3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamShape {
    /// A triangle that reaches to the neighbouring beams: exact where rays are.
    Hat,
    /// A Gaussian of the same width, but not narrower than a few wavelengths:
    /// smooth, and finite at caustics.
    Gaussian,
}

/// Along what lines a beam is spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamCoordinates {
    /// Down the column of receivers at a range.
    Cartesian,
    /// Across the ray.
    RayCentred,
}

/// What a beam looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BeamKind {
    /// Across itself.
    pub shape: BeamShape,
    /// How it meets receivers.
    pub coordinates: BeamCoordinates,
}

/// What is added up at a receiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coherence {
    /// Pressures, with their phases.
    Coherent,
    /// Intensities, with the surface image's interference kept at the source.
    SemiCoherent,
    /// Intensities.
    Incoherent,
}

/// Deposits the segments of one beam after another on a grid of receivers.
pub(crate) struct Influence<'a> {
    receivers: &'a Receivers,
    shape: BeamShape,
    coherence: Coherence,
    angular_frequency: f64,
    /// Amplitude absorbed per metre, nepers.
    absorption: f64,
    source_speed: f64,
    source_depth: f64,
    beam: BeamState,
    /// [depth, range]: pressure, or intensity in the real part; the cylindrical
    /// 1/r is still missing.
    sums: Vec<Complex>,
}

/// What is known of the beam that is being traced.
#[derive(Debug, Clone, Copy, Default)]
struct BeamState {
    width_rad: f64,
    /// √cos α, and what else scales the whole beam.
    strength: f64,
    /// Signed width of the tube where the last segment ended.
    last_width: f64,
    /// Phase from the caustics passed.
    caustic_phase: f64,
}

/// Gaussians are cut off at this many standard deviations.
const GAUSSIAN_REACH: f64 = 4.0;

/// Tubes are not thinner than this, m/rad: amplitudes are finite at caustics.
const LEAST_TUBE_M_RAD: f64 = 1e-9;

impl<'a> Influence<'a> {
    pub(crate) fn new(
        receivers: &'a Receivers,
        shape: BeamShape,
        coherence: Coherence,
        frequency_hz: f64,
        absorption_nepers_m: f64,
        source: (f64, f64),
    ) -> Self {
        Self {
            receivers,
            shape,
            coherence,
            angular_frequency: TAU * frequency_hz,
            absorption: absorption_nepers_m,
            source_speed: source.1,
            source_depth: source.0,
            beam: BeamState::default(),
            sums: vec![Complex::default(); receivers.depth_m().len() * receivers.range_m().len()],
        }
    }

    /// Begins a beam.
    pub(crate) fn begin(&mut self, angle_rad: f64, width_rad: f64) {
        let mut strength = angle_rad.cos().abs().sqrt();
        if self.coherence == Coherence::SemiCoherent {
            let vertical = self.angular_frequency / self.source_speed * angle_rad.sin();
            strength *= std::f64::consts::SQRT_2 * (vertical * self.source_depth).sin().abs();
        }
        self.beam = BeamState { width_rad, strength, last_width: 0.0, caustic_phase: 0.0 };
    }

    /// The sums over all beams, [depth, range].
    pub(crate) fn into_sums(self) -> Vec<Complex> {
        self.sums
    }

    /// Deposits on the receivers of one range, which the segment passes at σ.
    fn deposit(&mut self, segment: &Segment, range_index: usize, sigma: f64) {
        let position = segment.position(sigma);
        let slowness = segment.slowness_at(sigma);
        let speed = slowness.dot(slowness).sqrt().recip();
        let (along_x, along_z) = (slowness.x * speed, slowness.z * speed);
        let width = segment.width(sigma);
        // d(width)/ds at constant tangent and along its turning (COA 3.5).
        let ahead = segment.width(sigma + speed);
        let widening = ahead - width;
        let wavelength = TAU * speed / self.angular_frequency;
        let count = self.receivers.range_m().len();

        for (depth_index, depth) in self.receivers.depth_m().iter().enumerate() {
            let below = depth - position.z;
            let across = (below * along_x).abs();
            let foot = below * along_z;
            let width_there = width + widening * foot;
            let tube_width = width_there.abs().max(LEAST_TUBE_M_RAD);
            let spread = tube_width * self.beam.width_rad;
            let time = segment.time_s(sigma) + foot / speed;
            let path = segment.path_m(sigma) + foot;
            let half_width = match self.shape {
                BeamShape::Hat => spread,
                BeamShape::Gaussian => {
                    let least = 0.2 * self.angular_frequency / TAU * time;
                    spread.max(least.min(PI * wavelength))
                }
            };
            let weight = match self.shape {
                BeamShape::Hat if across < half_width => 1.0 - across / half_width,
                BeamShape::Gaussian if across < GAUSSIAN_REACH * half_width => {
                    (-0.5 * (across / half_width).powi(2)).exp() / TAU.sqrt()
                        * (spread / half_width)
                }
                _ => continue,
            };
            // Intensity in the tube: cos α · c_r/(c₀ |∂x/∂α|).
            let tube = speed / (self.source_speed * tube_width);
            let decay = segment.burden.amplitude * (-self.absorption * path).exp();
            let amplitude = self.beam.strength * tube.sqrt() * decay;
            let sum = &mut self.sums[depth_index * count + range_index];
            if self.coherence == Coherence::Coherent {
                let passes_caustic = width_there * self.beam.last_width < 0.0;
                let phase = segment.burden.phase_rad
                    + self.beam.caustic_phase
                    + if passes_caustic { FRAC_PI_2 } else { 0.0 };
                *sum +=
                    Complex::from_polar(amplitude * weight, phase - self.angular_frequency * time);
            } else {
                sum.re += amplitude * amplitude * weight;
            }
        }
    }
}

impl SegmentSink for Influence<'_> {
    fn segment(&mut self, segment: &Segment) {
        let start_width = segment.width(0.0);
        if start_width * self.beam.last_width < 0.0 {
            self.beam.caustic_phase += FRAC_PI_2;
        }
        if start_width != 0.0 {
            self.beam.last_width = start_width;
        }
        let (x0, x1) = (segment.start.x, segment.position(segment.sigma).x);
        let ranges = self.receivers.range_m();
        let first = ranges.partition_point(|&range| range < x0.min(x1));
        let last = ranges.partition_point(|&range| range < x0.max(x1));
        for index in first..last {
            let distance = self.receivers.range_m()[index] - x0;
            let sigma = segment.sigma_at_distance(distance);
            self.deposit(segment, index, sigma);
        }
    }
}
