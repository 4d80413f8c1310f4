use super::fan::LaunchFan;
use super::settings::{Source, TraceSettings};
use crate::decibel::DB_PER_NEPER;
use crate::environment::Section;
use crate::error::{AcousticsError, within};
use crate::ray::{Launch, Medium, MediumLimits, Pair, Segment, SegmentSink, Tracer};
use std::f64::consts::{PI, TAU};

/// Gaussians are cut off at this many standard deviations: 0.3 % of their energy,
/// 0.01 dB, is left out, and a quarter of the work that 4 would make.
pub(super) const REACH: f64 = 3.0;

/// Reach in the quick test of a segment: a tenth more than in deposits, because
/// slownesses stand for directions there.
const GENEROUS_REACH: f64 = 1.1 * REACH;

/// Rays steeper than 84° may lose the rims of their beams.
const LEAST_FLATNESS: f64 = 0.1;

/// No water is faster, m/s.
pub(super) const FASTEST_M_S: f64 = 1700.0;

/// Standard deviation of a beam over the distance of its neighbours. BELLHOP has 1;
/// with half of it, Gaussians side by side still add up to a level within 1.5 %, and
/// resolve what 1 does with twice the beams.
pub(super) const BEAM_SPREAD: f64 = 0.5;

/// Standard deviation of the window over which intensities are averaged in
/// range, in steps of the profile. Samples one step apart then add up to the
/// whole within 1.5 %, which averages out over a fan.
pub(super) const WINDOW_STEPS: f64 = 0.5;

/// Incoherent intensity against range at one receiver depth, averaged over range
/// with a Gaussian window as wide as the steps.
#[derive(Debug, Clone, PartialEq)]
pub struct RangeProfile {
    /// Distance between the samples, metres; sample k lies at (k + ½) steps.
    pub step_m: f64,
    /// Intensity over that at 1 m from the source.
    pub intensity: Vec<f64>,
}

impl RangeProfile {
    /// Standard deviation of the window, in steps.
    pub const WINDOW_STEPS: f64 = WINDOW_STEPS;

    /// Intensity at a range, linear between samples of r · intensity (which
    /// keeps spherical spreading near the source); 0 beyond the last.
    pub fn intensity_at(&self, range_m: f64) -> f64 {
        let place = range_m / self.step_m - 0.5;
        let Some(last) = self.intensity.len().checked_sub(1) else { return 0.0 };
        if place <= 0.0 {
            // Spherical spreading from the source to the first sample.
            let first_m = 0.5 * self.step_m;
            return self.intensity[0] * (first_m / range_m.max(1.0)).powi(2);
        }
        let before = place as usize;
        if before >= last {
            return if place <= last as f64 + 0.5 { self.intensity[last] } else { 0.0 };
        }
        let weight = place - before as f64;
        self.intensity[before] * (1.0 - weight) + self.intensity[before + 1] * weight
    }
}

/// Computes [`RangeProfile`]s: the fast path of tables of transmission loss.
///
/// Gaussian beams, one receiver depth, intensities only. With cylindrical
/// spreading last,
///
/// I(r) = (1/r) Σ (cos α · c · Δα/c₀) A² e^(−2as) e^(−n²/2σ²)/(√(2π) σ),
///
/// and because averaging over a Gaussian window of standard deviation h in
/// range turns σ² into σ² + h² sin²θ for a ray that passes at the angle θ, steep
/// and shallow rays are treated alike.
#[derive(Debug, Clone)]
pub struct RangeProfiler<'a> {
    section: &'a Section,
    medium: Medium,
    settings: TraceSettings,
}

impl<'a> RangeProfiler<'a> {
    /// Prepares a section.
    pub fn new(section: &'a Section, settings: &TraceSettings) -> Self {
        let medium = Medium::new(section, &MediumLimits::from(settings)).coarse();
        Self { section, medium, settings: *settings }
    }

    /// The intensity at one depth in `count` steps of `step_m` from the source.
    ///
    /// # Errors
    /// If the source is not in the water, the step is not positive, or the section has
    /// attenuation given by level, which profiles do not know.
    pub fn intensity(
        &self,
        source: &Source,
        fan: &LaunchFan,
        receiver_depth_m: f64,
        step_m: f64,
        count: usize,
    ) -> Result<RangeProfile, AcousticsError> {
        source.check(self.section)?;
        refuse_attenuation(self.section)?;
        within("the step of a range profile", "positive", step_m, step_m > 0.0)?;
        let tracer = Tracer::new(self.section, &self.medium, self.settings.amplitude_cutoff);
        let absorption_db_km = self.section.absorption.db_km(source.frequency_hz);
        let source_speed = self.section.sound_speed().speed_at_m_s(0.0, source.depth_m);
        let mut deposits = Deposits {
            depth: receiver_depth_m,
            step: step_m,
            steps_per_metre: step_m.recip(),
            widest_least: PI * FASTEST_M_S / source.frequency_hz,
            window: WINDOW_STEPS * step_m,
            frequency: source.frequency_hz,
            absorption: 2.0 * absorption_db_km / (1000.0 * DB_PER_NEPER),
            beam_width: 0.0,
            beam_weight: 0.0,
            sums: vec![0.0; count],
        };
        for beam in fan.beams() {
            deposits.beam_width = BEAM_SPREAD * beam.width_rad;
            deposits.beam_weight =
                beam.angle_rad.cos() * beam.width_rad / (source_speed * TAU.sqrt());
            let launch = Launch { depth_m: source.depth_m, angle_rad: beam.angle_rad };
            tracer.run(launch, &mut deposits);
        }
        let mut intensity = deposits.sums;
        for (k, sum) in intensity.iter_mut().enumerate() {
            *sum /= (k as f64 + 0.5) * step_m;
        }
        Ok(RangeProfile { step_m, intensity })
    }
}

/// Refuses what neither this path nor the batch takes into account.
pub(super) fn refuse_attenuation(section: &Section) -> Result<(), AcousticsError> {
    match section.attenuation {
        None => Ok(()),
        Some(_) => Err(AcousticsError::NotOffered {
            model: "range profile",
            what: "attenuation given by level",
        }),
    }
}

struct Deposits {
    depth: f64,
    step: f64,
    steps_per_metre: f64,
    /// Least spread of a beam where sound is fastest.
    widest_least: f64,
    /// h, metres.
    window: f64,
    frequency: f64,
    /// Intensity absorbed per metre, nepers.
    absorption: f64,
    beam_width: f64,
    /// cos α Δα/(c₀ √(2π)).
    beam_weight: f64,
    sums: Vec<f64>,
}

impl Deposits {
    /// Standard deviation of the beam across it, without the window.
    fn spread(&self, width: f64, speed: f64, time: f64) -> f64 {
        let least = (0.2 * self.frequency * time).min(PI * speed / self.frequency);
        (width * self.beam_width).abs().max(least)
    }

    /// Whether the segment, vertex included, comes near the receivers' depth.
    fn comes_near(&self, segment: &Segment, end: Pair) -> bool {
        let (mut top, mut bottom) = (segment.start.z.min(end.z), segment.start.z.max(end.z));
        if segment.slowness.z * segment.slowness_at(segment.sigma).z < 0.0 {
            let vertex = segment.position(-segment.slowness.z / segment.gradient.z).z;
            top = top.min(vertex);
            bottom = bottom.max(vertex);
        }
        let distance = (top - self.depth).max(self.depth - bottom);
        if distance <= 0.0 {
            return true;
        }
        let (start, end) = (segment.slowness, segment.slowness_at(segment.sigma));
        let scale = start.dot(start).sqrt().recip();
        let width = segment.width(0.0).abs().max(segment.width(segment.sigma).abs());
        let steepest = start.z.abs().max(end.z.abs()) * scale;
        let flattest = (start.x.abs().min(end.x.abs()) * scale).max(LEAST_FLATNESS);
        let spread = self.widest_least + width * self.beam_width + self.window * steepest;
        distance * flattest <= GENEROUS_REACH * spread
    }

    fn deposit(&mut self, segment: &Segment, index: usize) {
        let distance = (index as f64 + 0.5) * self.step - segment.start.x;
        let sigma = segment.sigma_at_distance(distance);
        let slowness = segment.slowness_at(sigma);
        let speed = slowness.dot(slowness).sqrt().recip();
        let below = self.depth - segment.position(sigma).z;
        let across = below * slowness.x * speed;
        let spread = self.spread(segment.width(sigma), speed, segment.time_s(sigma));
        let smear = self.window * slowness.z * speed;
        let variance = spread * spread + smear * smear;
        let exponent = across * across / variance;
        if exponent < REACH * REACH {
            let decay = self.absorption * (segment.burden.path_m + sigma / speed);
            let amplitude = segment.burden.amplitude;
            self.sums[index] += self.beam_weight * speed * amplitude * amplitude / variance.sqrt()
                * (-0.5 * exponent - decay).exp();
        }
    }
}

impl SegmentSink for Deposits {
    fn segment(&mut self, segment: &Segment) {
        let end = segment.position(segment.sigma);
        let sample = |x: f64| (x * self.steps_per_metre + 0.5).max(0.0) as usize;
        let (near, far) = (segment.start.x.min(end.x), segment.start.x.max(end.x));
        let (first, last) = (sample(near), sample(far).min(self.sums.len()));
        if first < last && self.comes_near(segment, end) {
            for index in first..last {
                self.deposit(segment, index);
            }
        }
    }
}
