use crate::error::{AcousticsError, ascending, length, within};

/// What the water absorbs besides the law of its salts: attenuation given at the
/// levels of a profile, linear in depth between them and constant beyond.
#[derive(Debug, Clone, PartialEq)]
pub struct AttenuationProfile {
    depth_m: Vec<f64>,
    db_wavelength: Vec<f64>,
}

impl AttenuationProfile {
    /// Attenuations in dB per wavelength at ascending depths in metres.
    ///
    /// # Errors
    /// If there is no level, the two differ in length, depths do not ascend, or an
    /// attenuation is negative.
    pub fn new(depth_m: Vec<f64>, db_wavelength: Vec<f64>) -> Result<Self, AcousticsError> {
        let count = depth_m.len();
        within("the number of attenuation levels", "at least 1", count as f64, count > 0)?;
        length("attenuations", count, db_wavelength.len())?;
        ascending("depths of attenuation levels", &depth_m)?;
        for &value in &db_wavelength {
            within("an attenuation", "zero or positive", value, value >= 0.0)?;
        }
        Ok(Self { depth_m, db_wavelength })
    }

    /// Depths of the levels, metres.
    pub fn depth_m(&self) -> &[f64] {
        &self.depth_m
    }

    /// Attenuations at the levels, dB per wavelength.
    pub fn db_wavelength(&self) -> &[f64] {
        &self.db_wavelength
    }

    /// Attenuation at a depth, dB per wavelength.
    pub fn at_db_wavelength(&self, depth_m: f64) -> f64 {
        let after = self.depth_m.partition_point(|&level| level <= depth_m);
        let last = self.depth_m.len() - 1;
        if after == 0 || after > last {
            return self.db_wavelength[after.min(last)];
        }
        let (z0, z1) = (self.depth_m[after - 1], self.depth_m[after]);
        let (a0, a1) = (self.db_wavelength[after - 1], self.db_wavelength[after]);
        a0 + (depth_m - z0) / (z1 - z0) * (a1 - a0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attenuation_is_linear_between_levels_and_constant_beyond() {
        let profile = AttenuationProfile::new(vec![0.0, 100.0], vec![0.1, 0.3]).unwrap();
        for (depth, exact) in [(-5.0, 0.1), (0.0, 0.1), (25.0, 0.15), (100.0, 0.3), (900.0, 0.3)] {
            assert!((profile.at_db_wavelength(depth) - exact).abs() < 1e-12);
        }
        assert!(AttenuationProfile::new(vec![0.0], vec![-0.1]).is_err());
        assert!(AttenuationProfile::new(vec![], vec![]).is_err());
    }
}
