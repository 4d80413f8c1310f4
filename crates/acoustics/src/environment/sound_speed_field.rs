use crate::error::{AcousticsError, ascending, length, within};

/// How the sound speed runs between two levels of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ProfileLaw {
    /// c is linear in depth (rays are arcs of circles).
    #[default]
    LinearSpeed,
    /// 1/c², the square of the index, is linear in depth (rays are parabolas).
    LinearSquaredIndex,
}

/// The sound speed of a section on nodes of range × depth: linear in range
/// between columns, constant beyond the first and the last column, and by its
/// [`ProfileLaw`] in depth.
#[derive(Debug, Clone, PartialEq)]
pub struct SoundSpeedField {
    range_m: Vec<f64>,
    depth_m: Vec<f64>,
    speed_m_s: Vec<f64>,
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
        Ok(Self { range_m, depth_m, speed_m_s, law })
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

    /// The profile at a range on the field's own levels, written to `profile`.
    pub(crate) fn profile_at(&self, range_m: f64, profile: &mut Vec<f64>) {
        let levels = self.depth_m.len();
        let column = |index: usize| &self.speed_m_s[index * levels..(index + 1) * levels];
        let after = self.range_m.partition_point(|&node| node <= range_m);
        profile.clear();
        if after == 0 || after == self.range_m.len() {
            profile.extend_from_slice(column(after.min(self.range_m.len() - 1)));
            return;
        }
        let (r0, r1) = (self.range_m[after - 1], self.range_m[after]);
        let weight = (range_m - r0) / (r1 - r0);
        profile.extend(
            column(after - 1).iter().zip(column(after)).map(|(c0, c1)| c0 + weight * (c1 - c0)),
        );
    }

    /// Sound speed at a point, m/s; beyond the levels that of the nearest.
    pub fn speed_at_m_s(&self, range_m: f64, depth_m: f64) -> f64 {
        let mut profile = Vec::new();
        self.profile_at(range_m, &mut profile);
        let below = self.depth_m.partition_point(|&level| level <= depth_m);
        if below == 0 || below == profile.len() {
            return profile[below.min(profile.len() - 1)];
        }
        let (z0, z1) = (self.depth_m[below - 1], self.depth_m[below]);
        self.law.between(profile[below - 1], profile[below], (depth_m - z0) / (z1 - z0))
    }
}

impl ProfileLaw {
    /// Speed at a fraction of the way from one level to the next.
    pub(crate) fn between(self, upper: f64, lower: f64, fraction: f64) -> f64 {
        match self {
            Self::LinearSpeed => upper + fraction * (lower - upper),
            Self::LinearSquaredIndex => {
                let (u, l) = (upper.powi(-2), lower.powi(-2));
                (u + fraction * (l - u)).powf(-0.5)
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
    fn bad_fields_are_refused_with_evidence() {
        let refused = SoundSpeedField::profile(vec![0.0, 10.0], vec![1500.0, -1.0]);
        assert!(matches!(refused, Err(AcousticsError::OutOfRange { found, .. }) if found < 0.0));
        let refused = SoundSpeedField::profile(vec![0.0, 10.0], vec![1500.0]);
        assert!(matches!(refused, Err(AcousticsError::Length { expected: 2, found: 1, .. })));
    }
}
