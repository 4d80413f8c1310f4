use crate::environment::{AttenuationProfile, Section};
use crate::field::beam_kind::BeamShape;
use crate::field::settings::Source;
use crate::field::transmission_loss::DB_PER_NEPER;
use crate::ray::{Pair, Segment};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Gaussians are cut off at this many standard deviations.
const GAUSSIAN_REACH: f64 = 4.0;

/// Tubes are not thinner than this, m/rad: amplitudes are finite at caustics.
const LEAST_TUBE_M_RAD: f64 = 1e-9;

/// What all beams of a source share.
pub(crate) struct BeamPhysics<'a> {
    shape: BeamShape,
    frequency: f64,
    source_speed: f64,
    /// Amplitude absorbed per metre, nepers.
    absorption: f64,
    attenuation: Option<&'a AttenuationProfile>,
}

impl<'a> BeamPhysics<'a> {
    pub(crate) fn new(section: &'a Section, source: &Source, shape: BeamShape) -> Self {
        let absorption_db_km = section.absorption.db_km(source.frequency_hz);
        Self {
            shape,
            frequency: source.frequency_hz,
            source_speed: section.sound_speed().speed_at_m_s(0.0, source.depth_m),
            absorption: absorption_db_km / (1000.0 * DB_PER_NEPER),
            attenuation: section.attenuation.as_ref(),
        }
    }

    /// Nepers per metre at a depth, where the slowness is given.
    fn absorption_at(&self, depth: f64, slowness: Pair) -> f64 {
        let profile = self.attenuation.map_or(0.0, |attenuation| {
            let wavelengths_m = self.frequency * slowness.dot(slowness).sqrt();
            attenuation.at_db_wavelength(depth) * wavelengths_m / DB_PER_NEPER
        });
        self.absorption + profile
    }

    /// Nepers absorbed from the beginning of a segment to σ, as if absorption were linear
    /// along it.
    fn absorbed(&self, segment: &Segment, sigma: f64) -> f64 {
        let path = segment.path_m(sigma) - segment.burden.path_m;
        if self.attenuation.is_none() {
            return self.absorption * path;
        }
        let at =
            |sigma: f64| self.absorption_at(segment.position(sigma).z, segment.slowness_at(sigma));
        0.5 * (at(0.0) + at(sigma)) * path
    }
}

/// A beam as it leaves the source.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct BeamLaunch {
    /// Its place in the fan.
    pub index: usize,
    pub angle_rad: f64,
    pub width_rad: f64,
    /// √cos α for point sources, and what else scales the whole beam.
    pub strength: f64,
}

/// What is known of the beam that is being traced.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BeamState {
    launch: BeamLaunch,
    /// Signed width of the tube where the last segment began or ended.
    last_width: f64,
    /// Phase from the caustics passed.
    caustic_phase: f64,
    /// Nepers absorbed before the segment.
    absorbed: f64,
    /// Range that the beam has reached, metres.
    pub(super) front_m: f64,
}

/// What a beam brings to a receiver. Spreading in cylinders is still missing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Contribution {
    pub beam: BeamLaunch,
    /// Of the middle of the beam, without absorption.
    pub amplitude: f64,
    /// Share of the receiver in the beam; shares of neighbours add up to 1.
    pub weight: f64,
    pub absorption_nepers: f64,
    pub phase_rad: f64,
    pub time_s: f64,
    pub path_m: f64,
    /// Slowness of the ray there.
    pub slowness: Pair,
    pub surface_bounces: u32,
    pub bottom_bounces: u32,
}

/// A place on a segment, with what deposits around it have in common.
pub(super) struct Place {
    sigma: f64,
    pub(super) position: Pair,
    slowness: Pair,
    speed: f64,
    /// Tangent of the ray.
    pub(super) along: Pair,
    width: f64,
    /// Change of the width per metre of path.
    widening: f64,
    time: f64,
    absorbed: f64,
    absorption: f64,
}

impl Place {
    pub(super) fn new(physics: &BeamPhysics<'_>, segment: &Segment, sigma: f64) -> Self {
        let slowness = segment.slowness_at(sigma);
        let speed = slowness.dot(slowness).sqrt().recip();
        let position = segment.position(sigma);
        let width = segment.width(sigma);
        Self {
            sigma,
            position,
            slowness,
            speed,
            along: slowness * speed,
            width,
            // At constant tangent and along its turning (COA 3.5).
            widening: segment.width(sigma + speed) - width,
            time: segment.time_s(sigma),
            absorbed: physics.absorbed(segment, sigma),
            absorption: physics.absorption_at(position.z, slowness),
        }
    }
}

impl BeamState {
    pub(super) fn new(launch: BeamLaunch) -> Self {
        Self { launch, ..Self::default() }
    }

    /// Notes the caustics that lie between the end of the last segment and this one.
    pub(super) fn enter(&mut self, segment: &Segment) {
        let width = segment.width(0.0);
        if width * self.last_width < 0.0 {
            self.caustic_phase += FRAC_PI_2;
        }
        if width != 0.0 {
            self.last_width = width;
        }
    }

    pub(super) fn leave(&mut self, segment: &Segment, physics: &BeamPhysics<'_>) {
        self.absorbed += physics.absorbed(segment, segment.sigma);
    }

    /// Half the width of the beam where its tube is `tube` wide, and the share of it
    /// that spreading leaves at its middle.
    fn half_width(
        &self,
        physics: &BeamPhysics<'_>,
        tube: f64,
        time: f64,
        speed: f64,
    ) -> (f64, f64) {
        let spread = tube * self.launch.width_rad;
        match physics.shape {
            BeamShape::Hat => (spread, 1.0),
            BeamShape::Gaussian => {
                let least = (0.2 * physics.frequency * time).min(PI * speed / physics.frequency);
                let half_width = spread.max(least);
                (half_width, spread / (half_width * TAU.sqrt()))
            }
        }
    }

    /// How far from the ray the beam reaches at a place, metres.
    pub(super) fn reach(&self, physics: &BeamPhysics<'_>, place: &Place) -> f64 {
        let (half_width, _) = self.half_width(physics, place.width.abs(), place.time, place.speed);
        half_width * shape_reach(physics.shape)
    }

    /// How far above and below a place the beam may reach.
    pub(super) fn vertical_reach(&self, physics: &BeamPhysics<'_>, place: &Place) -> f64 {
        // |z| |tₓ| < reach + |z| |t_z| · change of the reach per metre of path
        let growth = place.widening.abs() * self.launch.width_rad * shape_reach(physics.shape);
        let flatness = place.along.x.abs() - growth * place.along.z.abs();
        // Gaussians grow in time as well, up to πλ.
        let (half_width, _) =
            self.half_width(physics, place.width.abs(), f64::INFINITY, place.speed);
        let reach = half_width * shape_reach(physics.shape);
        if flatness > 0.0 { reach / flatness } else { f64::INFINITY }
    }

    /// What the beam brings to a point that lies `ahead` of a place along the ray and
    /// `across` from it; nothing beyond its rim.
    pub(super) fn contribution(
        &self,
        physics: &BeamPhysics<'_>,
        segment: &Segment,
        place: &Place,
        ahead: f64,
        across: f64,
    ) -> Option<Contribution> {
        let width = place.width + place.widening * ahead;
        let tube = width.abs().max(LEAST_TUBE_M_RAD);
        let time = place.time + ahead / place.speed;
        let (half_width, middle) = self.half_width(physics, tube, time, place.speed);
        let distance = across / half_width;
        if distance >= shape_reach(physics.shape) {
            return None;
        }
        let weight = match physics.shape {
            BeamShape::Hat => 1.0 - distance,
            BeamShape::Gaussian => middle * (-0.5 * distance * distance).exp(),
        };
        // Intensity in the tube: cos α · c_r/(c₀ |∂x/∂α|).
        let intensity = place.speed / (physics.source_speed * tube);
        let passes_caustic = width * self.last_width < 0.0;
        Some(Contribution {
            beam: self.launch,
            amplitude: self.launch.strength * intensity.sqrt() * segment.burden.amplitude,
            weight,
            absorption_nepers: self.absorbed + place.absorbed + place.absorption * ahead,
            phase_rad: segment.burden.phase_rad
                + self.caustic_phase
                + if passes_caustic { FRAC_PI_2 } else { 0.0 },
            time_s: time,
            path_m: segment.path_m(place.sigma) + ahead,
            slowness: place.slowness,
            surface_bounces: segment.burden.surface_bounces,
            bottom_bounces: segment.burden.bottom_bounces,
        })
    }
}

/// How far a beam reaches, in half widths.
const fn shape_reach(shape: BeamShape) -> f64 {
    match shape {
        BeamShape::Hat => 1.0,
        BeamShape::Gaussian => GAUSSIAN_REACH,
    }
}
