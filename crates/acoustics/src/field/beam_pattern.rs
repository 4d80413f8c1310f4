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
}
