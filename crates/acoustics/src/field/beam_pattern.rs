use crate::error::{AcousticsError, ascending, length, within};

/// How strongly a source sends in which direction.
#[derive(Debug, Clone, PartialEq)]
pub struct BeamPattern {
    angle_deg: Vec<f64>,
    level_db: Vec<f64>,
}

impl BeamPattern {
    /// Levels in dB at ascending angles below the horizontal, in degrees; amplitudes
    /// are linear between them and constant beyond.
    ///
    /// # Errors
    /// If there is no angle, the two differ in length, angles do not ascend, or a
    /// level is not finite.
    pub fn new(angle_deg: Vec<f64>, level_db: Vec<f64>) -> Result<Self, AcousticsError> {
        let count = angle_deg.len();
        within("the number of angles of a beam pattern", "at least 1", count as f64, count > 0)?;
        length("levels of a beam pattern", count, level_db.len())?;
        ascending("angles of a beam pattern", &angle_deg)?;
        for &level in &level_db {
            within("a level of a beam pattern", "finite", level, true)?;
        }
        Ok(Self { angle_deg, level_db })
    }

    /// Angles below the horizontal, degrees.
    pub fn angle_deg(&self) -> &[f64] {
        &self.angle_deg
    }

    /// Levels, dB.
    pub fn level_db(&self) -> &[f64] {
        &self.level_db
    }

    /// What the source sends at an angle, as a factor of amplitude.
    pub(crate) fn amplitude(&self, angle_deg: f64) -> f64 {
        let linear = |index: usize| 10f64.powf(self.level_db[index] / 20.0);
        let after = self.angle_deg.partition_point(|&angle| angle <= angle_deg);
        let last = self.angle_deg.len() - 1;
        if after == 0 || after > last {
            return linear(after.min(last));
        }
        let (a0, a1) = (self.angle_deg[after - 1], self.angle_deg[after]);
        let weight = (angle_deg - a0) / (a1 - a0);
        linear(after - 1) + weight * (linear(after) - linear(after - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amplitudes_are_linear_between_angles() {
        let pattern = BeamPattern::new(vec![-10.0, 10.0], vec![0.0, -20.0]).unwrap();
        for (angle, exact) in [(-90.0, 1.0), (-10.0, 1.0), (0.0, 0.55), (10.0, 0.1), (45.0, 0.1)] {
            assert!((pattern.amplitude(angle) - exact).abs() < 1e-12);
        }
    }
}
