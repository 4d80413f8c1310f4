use super::profile_curve::{monotone_slopes, spline_slopes};
use crate::error::{AcousticsError, ascending, length, within};

/// How the sound speed runs between two levels of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ProfileLaw {
    /// c is linear in depth (rays are arcs of circles).
    #[default]
    LinearSpeed,
    /// 1/c², the square of the index, is linear in depth (rays are parabolas).
    LinearSquaredIndex,
    /// c is a cubic spline in depth (not-a-knot): smooth, but it may overshoot.
    CubicSpline,
    /// c is a piecewise cubic with a steady slope that overshoots nowhere (PCHIP).
    MonotoneCubic,
}

/// The sound speed of a section on nodes of range × depth: linear in range
/// between columns, constant beyond the first and the last column, and by its
/// [`ProfileLaw`] in depth.
#[derive(Debug, Clone, PartialEq)]
pub struct SoundSpeedField {
    range_m: Vec<f64>,
    depth_m: Vec<f64>,
    speed_m_s: Vec<f64>,
    /// dc/dz at the nodes, [range, depth], s⁻¹; of cubic laws only.
    slope: Vec<f64>,
    law: ProfileLaw,
}

impl SoundSpeedField {
    /// A range-dependent field: `speed_m_s` is [range, depth]. Depths are
    /// positive down; the first level is the surface.
    ///
    /// # Errors
    /// If there is no column or fewer than two levels, coordinates do not
    /// ascend, the number of speeds is not columns × levels, or a speed is not
    /// positive.
    pub fn new(
        range_m: Vec<f64>,
        depth_m: Vec<f64>,
        speed_m_s: Vec<f64>,
        law: ProfileLaw,
    ) -> Result<Self, AcousticsError> {
        let (columns, levels) = (range_m.len(), depth_m.len());
        within("the number of sound-speed columns", "at least 1", columns as f64, columns > 0)?;
        within("the number of sound-speed levels", "at least 2", levels as f64, levels > 1)?;
        ascending("ranges of sound-speed columns", &range_m)?;
        ascending("depths of sound-speed levels", &depth_m)?;
        length("sound speeds", columns * levels, speed_m_s.len())?;
        for &speed in &speed_m_s {
            within("a sound speed", "positive", speed, speed > 0.0)?;
        }
        let profiles = speed_m_s.chunks_exact(levels);
        let slope = match law {
            ProfileLaw::LinearSpeed | ProfileLaw::LinearSquaredIndex => Vec::new(),
            ProfileLaw::CubicSpline => {
                profiles.flat_map(|profile| spline_slopes(&depth_m, profile)).collect()
            }
            ProfileLaw::MonotoneCubic => {
                profiles.flat_map(|profile| monotone_slopes(&depth_m, profile)).collect()
            }
        };
        Ok(Self { range_m, depth_m, speed_m_s, slope, law })
    }

    /// One profile for all ranges, with speed linear in depth.
    ///
    /// # Errors
    /// As [`SoundSpeedField::new`].
    pub fn profile(depth_m: Vec<f64>, speed_m_s: Vec<f64>) -> Result<Self, AcousticsError> {
        Self::new(vec![0.0], depth_m, speed_m_s, ProfileLaw::LinearSpeed)
    }

    /// Ranges of the columns, metres.
    pub fn range_m(&self) -> &[f64] {
        &self.range_m
    }

    /// Depths of the levels, metres.
    pub fn depth_m(&self) -> &[f64] {
        &self.depth_m
    }

    /// Speeds, [range, depth], m/s.
    pub fn speed_m_s(&self) -> &[f64] {
        &self.speed_m_s
    }

    /// How the speed runs between levels.
    pub const fn law(&self) -> ProfileLaw {
        self.law
    }

    /// The profile at a range, on the field's own levels.
    pub(crate) fn profile_at(&self, range_m: f64) -> Profile<'_> {
        let after = self.range_m.partition_point(|&node| node <= range_m);
        let last = self.range_m.len() - 1;
        let (near, far) = (after.saturating_sub(1), after.min(last));
        let weight = if near == far {
            0.0
        } else {
            let (r0, r1) = (self.range_m[near], self.range_m[far]);
            ((range_m - r0) / (r1 - r0)).max(0.0)
        };
        Profile { field: self, near, far, weight }
    }

    /// The profiles at the columns, one after the other.
    pub(crate) fn columns(&self) -> impl Iterator<Item = Profile<'_>> {
        (0..self.range_m.len()).map(|at| Profile { field: self, near: at, far: at, weight: 0.0 })
    }

    /// Sound speed at a point, m/s; beyond the levels that of the nearest.
    pub fn speed_at_m_s(&self, range_m: f64, depth_m: f64) -> f64 {
        let profile = self.profile_at(range_m);
        let last = self.depth_m.len() - 1;
        let below = self.depth_m.partition_point(|&level| level <= depth_m);
        if below == 0 || below > last {
            return profile.speed_m_s(below.min(last));
        }
        let (z0, z1) = (self.depth_m[below - 1], self.depth_m[below]);
        profile.between_m_s(below - 1, (depth_m - z0) / (z1 - z0))
    }
}

/// The sound speed over depth at one range: a mean of two columns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Profile<'a> {
    field: &'a SoundSpeedField,
    near: usize,
    far: usize,
    /// Of the far column.
    weight: f64,
}

impl Profile<'_> {
    fn mean(&self, values: &[f64], level: usize) -> f64 {
        let levels = self.field.depth_m.len();
        let (near, far) = (values[self.near * levels + level], values[self.far * levels + level]);
        near + self.weight * (far - near)
    }

    /// Speed at a level.
    pub(crate) fn speed_m_s(&self, level: usize) -> f64 {
        self.mean(&self.field.speed_m_s, level)
    }

    /// Speed at a fraction of the way from a level to the next.
    pub(crate) fn between_m_s(&self, above: usize, fraction: f64) -> f64 {
        let (upper, lower) = (self.speed_m_s(above), self.speed_m_s(above + 1));
        match self.field.law {
            ProfileLaw::LinearSpeed => upper + fraction * (lower - upper),
            ProfileLaw::LinearSquaredIndex => {
                let (u, l) = (upper.powi(-2), lower.powi(-2));
                (u + fraction * (l - u)).powf(-0.5)
            }
            ProfileLaw::CubicSpline | ProfileLaw::MonotoneCubic => {
                let height = self.field.depth_m[above + 1] - self.field.depth_m[above];
                let slope = |level| self.mean(&self.field.slope, level) * height;
                let (rise, t) = (lower - upper, fraction);
                let bend = (1.0 - t) * (slope(above) - rise) + t * (rise - slope(above + 1));
                upper + t * rise + t * (1.0 - t) * bend
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_is_bilinear_and_constant_beyond() {
        let field = SoundSpeedField::new(
            vec![0.0, 100.0],
            vec![0.0, 10.0],
            vec![1500.0, 1510.0, 1520.0, 1530.0],
            ProfileLaw::LinearSpeed,
        )
        .unwrap();
        assert!((field.speed_at_m_s(50.0, 5.0) - 1515.0).abs() < 1e-9);
        assert!((field.speed_at_m_s(-50.0, 5.0) - 1505.0).abs() < 1e-9);
        assert!((field.speed_at_m_s(500.0, 50.0) - 1530.0).abs() < 1e-9);
    }

    #[test]
    fn cubics_pass_through_their_levels_and_follow_a_cubic_profile() {
        let depth: Vec<f64> = [0.0, 30.0, 100.0, 180.0, 300.0].to_vec();
        let exact = |z: f64| 1520.0 - 0.2 * z + 5e-4 * z * z - 1e-7 * z * z * z;
        let speed: Vec<f64> = depth.iter().copied().map(exact).collect();
        let law = ProfileLaw::CubicSpline;
        let field = SoundSpeedField::new(vec![0.0], depth.clone(), speed.clone(), law).unwrap();
        for depth in [0.0, 12.0, 30.0, 77.0, 250.0, 300.0] {
            assert!((field.speed_at_m_s(0.0, depth) - exact(depth)).abs() < 1e-9, "{depth}");
        }
        let law = ProfileLaw::MonotoneCubic;
        let monotone = SoundSpeedField::new(vec![0.0], depth.clone(), speed, law).unwrap();
        for depth in depth {
            assert!((monotone.speed_at_m_s(0.0, depth) - exact(depth)).abs() < 1e-9, "{depth}");
        }
    }

    #[test]
    fn bad_fields_are_refused_with_evidence() {
        let refused = SoundSpeedField::profile(vec![0.0, 10.0], vec![1500.0, -1.0]);
        assert!(matches!(refused, Err(AcousticsError::OutOfRange { found, .. }) if found < 0.0));
        let refused = SoundSpeedField::profile(vec![0.0, 10.0], vec![1500.0]);
        assert!(matches!(refused, Err(AcousticsError::Length { expected: 2, found: 1, .. })));
    }
}
