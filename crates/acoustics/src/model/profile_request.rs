use super::{Case, Output, Run};
use crate::environment::Section;
use crate::error::{AcousticsError, within};
use crate::field::{
    BeamCoordinates, BeamKind, BeamShape, Coherence, Field, LaunchFan, RangeProfile, Receivers,
    Source, SourceGeometry, TraceSettings,
};

/// Receivers of a slice are so far apart at most, metres.
const RECEIVERS_APART_M: f64 = 25.0;

/// Receivers within a step of a slice at least.
const RECEIVERS_A_STEP: f64 = 4.0;

/// Weights beyond so many standard deviations of the window are left out.
const REACH: f64 = 3.0;

/// Beams in equal steps, in place of a fan of unequal ones, are no more than this.
const MOST_BEAMS: f64 = 20_000.0;

/// What tables of transmission loss ask of a model: the intensity of a source at one
/// depth over range, `count` steps long.
#[derive(Debug, Clone, Copy)]
pub struct ProfileRequest<'a> {
    /// The section of the sea.
    pub section: &'a Section,
    /// The source at its beginning.
    pub source: Source,
    /// The directions of the beams.
    pub fan: &'a LaunchFan,
    /// How far rays go, and how closely they are followed.
    pub settings: &'a TraceSettings,
    /// Depth of the receivers, metres.
    pub receiver_depth_m: f64,
    /// Distance between the samples, metres.
    pub step_m: f64,
    /// The number of samples.
    pub count: usize,
}

impl ProfileRequest<'_> {
    /// A case whose field, averaged over range, is the profile: Gaussian beams in equal
    /// steps, incoherent, with receivers at most 25 m apart.
    ///
    /// # Errors
    /// If there is no receiver or the step is not positive.
    pub fn case(&self) -> Result<Case, AcousticsError> {
        within("the step of a range profile", "positive", self.step_m, self.step_m > 0.0)?;
        let length_m = self.step_m * self.count as f64;
        let spacing_m = self.spacing_m();
        let receivers = (length_m / spacing_m).round() as usize;
        let ranges = (0..receivers).map(|index| (index as f64 + 0.5) * spacing_m);
        Ok(Case {
            title: "a slice of a table".to_owned(),
            frequency_hz: self.source.frequency_hz,
            section: self.section.clone(),
            source_depth_m: vec![self.source.depth_m],
            geometry: SourceGeometry::Point,
            beam_pattern: None,
            receivers: Receivers::new(ranges.collect(), vec![self.receiver_depth_m])?,
            fan: in_equal_steps(self.fan)?,
            beams: BeamKind { shape: BeamShape::Gaussian, coordinates: BeamCoordinates::Cartesian },
            run: Run::Field(Coherence::Incoherent),
            settings: *self.settings,
        })
    }

    /// The profile in a model's answer to the [`ProfileRequest::case`].
    pub(super) fn profile(&self, output: &Output) -> RangeProfile {
        let field = match output {
            Output::Fields(fields) => fields.first(),
            Output::Rays(_) | Output::Arrivals(_) => None,
        };
        let sample = |index| field.map_or(0.0, |field| self.average(field, index));
        RangeProfile { step_m: self.step_m, intensity: (0..self.count).map(sample).collect() }
    }

    /// Distance between the receivers.
    fn spacing_m(&self) -> f64 {
        self.step_m / (self.step_m / RECEIVERS_APART_M).ceil().max(RECEIVERS_A_STEP)
    }

    /// The mean of r · intensity over the window of [`RangeProfile`], over r: spreading is
    /// left out of the average.
    fn average(&self, field: &Field, index: usize) -> f64 {
        let middle_m = (index as f64 + 0.5) * self.step_m;
        let deviation_m = RangeProfile::WINDOW_STEPS * self.step_m;
        let reach_m = REACH * deviation_m;
        let first = field.range_m.partition_point(|&range| range < middle_m - reach_m);
        let last = field.range_m.partition_point(|&range| range <= middle_m + reach_m);
        let (mut sum, mut weights) = (0.0, 0.0);
        for (range, pressure) in field.range_m[first..last].iter().zip(&field.pressure[first..last])
        {
            let weight = (-0.5 * ((range - middle_m) / deviation_m).powi(2)).exp();
            sum += weight * range * pressure.squared_modulus();
            weights += weight;
        }
        sum / (weights * middle_m)
    }
}

/// A fan as wide and nowhere coarser, in equal steps, as external programs need it.
fn in_equal_steps(fan: &LaunchFan) -> Result<LaunchFan, AcousticsError> {
    let beams = fan.beams();
    let finest = beams.iter().map(|beam| beam.width_rad).fold(f64::INFINITY, f64::min);
    let (first, last) = (&beams[0], &beams[beams.len() - 1]);
    let width = last.angle_rad - first.angle_rad;
    let steps = (width / finest).round().clamp(1.0, MOST_BEAMS);
    LaunchFan::uniform(
        first.angle_rad.to_degrees(),
        last.angle_rad.to_degrees(),
        steps as usize + 1,
    )
}
