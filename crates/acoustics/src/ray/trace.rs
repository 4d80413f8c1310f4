use super::medium::{Medium, MediumLimits};
use super::segment::{Segment, SegmentSink};
use super::tracer::{Launch, RayEnd, Tracer};
use crate::environment::Section;
use crate::error::AcousticsError;
use crate::field::{Source, TraceSettings};

/// A point on a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RayPoint {
    /// Distance from the source along the section, metres.
    pub range_m: f64,
    /// Depth, metres, positive down.
    pub depth_m: f64,
    /// Travel time from the source, s.
    pub time_s: f64,
}

/// The path of one ray.
#[derive(Debug, Clone, PartialEq)]
pub struct Ray {
    /// Launch angle below the horizontal, degrees.
    pub launch_angle_deg: f64,
    /// Points along it, in the order of travel.
    pub points: Vec<RayPoint>,
    /// Reflections off the surface.
    pub surface_bounces: u32,
    /// Reflections off the sea floor.
    pub bottom_bounces: u32,
    /// Why it ended.
    pub end: RayEnd,
}

/// Traces one ray from a source at range 0, launched `launch_angle_deg` below
/// the horizontal.
///
/// # Errors
/// If the source is not in the water.
pub fn trace(
    section: &Section,
    source: &Source,
    launch_angle_deg: f64,
    settings: &TraceSettings,
) -> Result<Ray, AcousticsError> {
    source.check(section)?;
    let medium = Medium::new(section, &MediumLimits::from(settings));
    let tracer = Tracer::new(section, &medium, settings.amplitude_cutoff);
    let launch = Launch { depth_m: source.depth_m, angle_rad: launch_angle_deg.to_radians() };
    Ok(record(&tracer, launch, f64::INFINITY))
}

/// Traces one ray up to a length of its path.
pub(crate) fn record(tracer: &Tracer<'_>, launch: Launch, until_m: f64) -> Ray {
    let mut path = Path { until_m, points: Vec::new(), surface_bounces: 0, bottom_bounces: 0 };
    let end = tracer.run(launch, &mut path);
    Ray {
        launch_angle_deg: launch.angle_rad.to_degrees(),
        points: path.points,
        surface_bounces: path.surface_bounces,
        bottom_bounces: path.bottom_bounces,
        end,
    }
}

/// Records a ray. Within a cell it adds points where chords would depart from
/// the parabola by more than [`Path::CHORD_M`].
struct Path {
    /// Length of the path after which nothing is recorded.
    until_m: f64,
    points: Vec<RayPoint>,
    surface_bounces: u32,
    bottom_bounces: u32,
}

impl Path {
    const CHORD_M: f64 = 0.1;
}

impl SegmentSink for Path {
    fn segment(&mut self, segment: &Segment) {
        let point = |sigma: f64| {
            let position = segment.position(sigma);
            RayPoint { range_m: position.x, depth_m: position.z, time_s: segment.time_s(sigma) }
        };
        if self.points.is_empty() {
            self.points.push(point(0.0));
        }
        let left_m = self.until_m - segment.burden.path_m;
        if left_m <= 0.0 {
            return;
        }
        let length_m = segment.path_m(segment.sigma) - segment.burden.path_m;
        let end = if length_m > left_m { segment.sigma * left_m / length_m } else { segment.sigma };
        let bend = segment.gradient.dot(segment.gradient).sqrt();
        let sagitta_m = bend * end * end / 8.0;
        let parts = (sagitta_m / Self::CHORD_M).sqrt().ceil().clamp(1.0, 1000.0) as u32;
        self.points.extend((1..=parts).map(|part| point(end * f64::from(part) / f64::from(parts))));
        self.surface_bounces = segment.burden.surface_bounces;
        self.bottom_bounces = segment.burden.bottom_bounces;
    }
}
