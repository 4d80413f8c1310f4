use crate::environment::Section;
use crate::error::{AcousticsError, ascending, within};
use crate::ray::MediumLimits;

/// A point source at range 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Source {
    /// Depth, metres, positive down.
    pub depth_m: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
}

impl Source {
    /// Checks that the source sounds, and lies in the water of a section.
    ///
    /// # Errors
    /// If the frequency is not positive, or the depth not between surface and
    /// sea floor.
    pub fn check(&self, section: &Section) -> Result<(), AcousticsError> {
        within("a frequency", "positive", self.frequency_hz, self.frequency_hz > 0.0)?;
        let surface_m = section.sound_speed().depth_m()[0];
        let floor_m = section.bathymetry().depth_at_m(0.0);
        if self.depth_m >= surface_m && self.depth_m <= floor_m {
            return Ok(());
        }
        let source_depth_m = self.depth_m;
        Err(AcousticsError::SourceOutsideWater { source_depth_m, surface_m, floor_m })
    }
}

/// How sound spreads out of the section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SourceGeometry {
    /// From a point, over cylinders around it.
    #[default]
    Point,
    /// From a line across the section: not at all.
    Line,
}

/// A grid of receivers.
#[derive(Debug, Clone, PartialEq)]
pub struct Receivers {
    range_m: Vec<f64>,
    depth_m: Vec<f64>,
}

impl Receivers {
    /// Receivers at all pairs of ascending ranges, which are positive, and
    /// depths.
    ///
    /// # Errors
    /// If ranges do not ascend from above 0, or a depth is not finite.
    pub fn new(range_m: Vec<f64>, depth_m: Vec<f64>) -> Result<Self, AcousticsError> {
        ascending("receiver ranges", &range_m)?;
        if let Some(&range) = range_m.first() {
            within("the first receiver range", "positive", range, range > 0.0)?;
        }
        for &depth in &depth_m {
            within("a receiver depth", "finite", depth, true)?;
        }
        Ok(Self { range_m, depth_m })
    }

    /// Ranges, metres, ascending.
    pub fn range_m(&self) -> &[f64] {
        &self.range_m
    }

    /// Depths, metres.
    pub fn depth_m(&self) -> &[f64] {
        &self.depth_m
    }
}

/// How far and how closely rays are followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceSettings {
    /// Where rays end behind the source, metres, not positive: sound that a
    /// slope sends back may return.
    pub near_m: f64,
    /// Where rays end ahead of the source, metres.
    pub far_m: f64,
    /// Product of reflection coefficients under which a ray ends.
    pub amplitude_cutoff: f64,
    /// Widest column with one gradient where sound speed depends on range,
    /// metres. Columns of 9 km instead of 1 km cost dBs.
    pub column_m: f64,
    /// Profiles linear in speed are cut into layers linear in 1/c² that depart
    /// from them by no more than this, m/s.
    pub speed_tolerance_m_s: f64,
}

impl TraceSettings {
    /// Settings for fields out to a range: as far behind the source, amplitudes
    /// to 0.005, columns of 1 km, profiles to 0.1 mm/s.
    pub const fn to_range(far_m: f64) -> Self {
        Self {
            near_m: -far_m,
            far_m,
            amplitude_cutoff: 0.005,
            column_m: 1000.0,
            speed_tolerance_m_s: 1e-4,
        }
    }
}

impl From<&TraceSettings> for MediumLimits {
    fn from(settings: &TraceSettings) -> Self {
        Self {
            near_m: settings.near_m,
            far_m: settings.far_m,
            column_m: settings.column_m,
            speed_tolerance_m_s: settings.speed_tolerance_m_s,
        }
    }
}
