use crate::environment::Section;
use crate::error::{AcousticsError, ascending, length, within};
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
    /// If the frequency is not positive, there is no water in the section somewhere, or
    /// the depth is not between surface and sea floor.
    pub fn check(&self, section: &Section) -> Result<(), AcousticsError> {
        within("a frequency", "positive", self.frequency_hz, self.frequency_hz > 0.0)?;
        section.check()?;
        let surface_m = section.surface_at_m(0.0);
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

/// How ranges and depths make up receivers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ReceiverLayout {
    /// A receiver at every depth of every range.
    Grid,
    /// A receiver at each pair of a range and a depth.
    Pairs,
}

/// Where sound is received.
#[derive(Debug, Clone, PartialEq)]
pub struct Receivers {
    range_m: Vec<f64>,
    depth_m: Vec<f64>,
    layout: ReceiverLayout,
}

impl Receivers {
    /// Receivers at all pairs of ascending ranges and of depths. At range 0, where
    /// cylindrical spreading begins, there is no field.
    ///
    /// # Errors
    /// If ranges do not ascend, or a depth is not finite.
    pub fn new(range_m: Vec<f64>, depth_m: Vec<f64>) -> Result<Self, AcousticsError> {
        ascending("receiver ranges", &range_m)?;
        finite("a receiver depth", &depth_m)?;
        Ok(Self { range_m, depth_m, layout: ReceiverLayout::Grid })
    }

    /// Receivers at pairs of a range and a depth, in any order.
    ///
    /// # Errors
    /// If there are not as many ranges as depths, or one is not finite.
    pub fn pairs(range_m: Vec<f64>, depth_m: Vec<f64>) -> Result<Self, AcousticsError> {
        length("receiver depths", range_m.len(), depth_m.len())?;
        finite("a receiver range", &range_m)?;
        finite("a receiver depth", &depth_m)?;
        Ok(Self { range_m, depth_m, layout: ReceiverLayout::Pairs })
    }

    /// Ranges, metres, ascending in a grid.
    pub fn range_m(&self) -> &[f64] {
        &self.range_m
    }

    /// Depths, metres.
    pub fn depth_m(&self) -> &[f64] {
        &self.depth_m
    }

    /// How ranges and depths make up receivers.
    pub const fn layout(&self) -> ReceiverLayout {
        self.layout
    }

    /// The number of receivers.
    pub fn count(&self) -> usize {
        match self.layout {
            ReceiverLayout::Grid => self.range_m.len() * self.depth_m.len(),
            ReceiverLayout::Pairs => self.range_m.len(),
        }
    }

    /// The range of a receiver: in a grid they are counted [depth, range].
    pub(crate) fn range_of_m(&self, receiver: usize) -> f64 {
        self.range_m[receiver % self.range_m.len()]
    }
}

fn finite(quantity: &'static str, values: &[f64]) -> Result<(), AcousticsError> {
    values.iter().try_for_each(|&value| within(quantity, "finite", value, true))
}

/// How far and how closely rays are followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TraceSettings {
    /// Where rays end behind the source, metres, not positive: sound that a
    /// slope sends back may return.
    pub near_m: f64,
    /// Where rays end ahead of the source, metres.
    pub far_m: f64,
    /// Depth below which rays end, metres.
    pub deepest_m: f64,
    /// Product of reflection coefficients under which a ray ends.
    pub amplitude_cutoff: f64,
    /// Widest column with one gradient where sound speed depends on range,
    /// metres. Columns of 9 km instead of 1 km cost dBs.
    pub column_m: f64,
    /// Profiles are cut into layers linear in 1/c² that depart from them by no more
    /// than this, m/s.
    pub speed_tolerance_m_s: f64,
}

impl TraceSettings {
    /// Settings for fields out to a range: as far behind the source, amplitudes
    /// to 0.005, columns of 1 km, profiles to 0.1 mm/s.
    pub const fn to_range(far_m: f64) -> Self {
        Self {
            near_m: -far_m,
            far_m,
            deepest_m: f64::INFINITY,
            amplitude_cutoff: 0.005,
            column_m: 1000.0,
            speed_tolerance_m_s: 1e-4,
        }
    }

    /// Settings for fields that are compared point by point, phases included: columns of
    /// 100 m.
    pub const fn fine(far_m: f64) -> Self {
        Self { column_m: 100.0, ..Self::to_range(far_m) }
    }
}

impl From<&TraceSettings> for MediumLimits {
    fn from(settings: &TraceSettings) -> Self {
        Self {
            near_m: settings.near_m,
            far_m: settings.far_m,
            deepest_m: settings.deepest_m,
            column_m: settings.column_m,
            speed_tolerance_m_s: settings.speed_tolerance_m_s,
        }
    }
}
