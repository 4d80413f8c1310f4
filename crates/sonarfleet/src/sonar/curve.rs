//! A measured curve from signal-to-noise ratio to probability.

use super::SonarError;

/// Probability against signal-to-noise ratio as a table: linear between its
/// points, constant beyond them, never falling.
#[derive(Debug, Clone, PartialEq)]
pub struct ProbabilityCurve {
    snr_db: Vec<f64>,
    probability: Vec<f64>,
}

impl ProbabilityCurve {
    /// The curve through these points.
    ///
    /// # Errors
    /// Unless there are as many ratios as probabilities and at least one, the
    /// ratios are finite and ascend strictly, and the probabilities lie in
    /// [0, 1] and do not fall.
    pub fn new(snr_db: Vec<f64>, probability: Vec<f64>) -> Result<Self, SonarError> {
        if snr_db.is_empty() || probability.len() != snr_db.len() {
            return Err(SonarError::WrongLength {
                name: "probability",
                found: probability.len(),
                expected: format!("one per value of `snr_db` ({}), and at least 1", snr_db.len()),
            });
        }
        let bad_snr = (0..snr_db.len())
            .find(|&i| !snr_db[i].is_finite() || (i > 0 && snr_db[i] <= snr_db[i - 1]));
        if let Some(index) = bad_snr {
            return Err(SonarError::ElementOutOfRange {
                name: "snr_db",
                index,
                found: snr_db[index],
                expected: "a finite number above the one before it",
            });
        }
        let bad_probability = (0..probability.len()).find(|&i| {
            !(0.0..=1.0).contains(&probability[i]) || (i > 0 && probability[i] < probability[i - 1])
        });
        if let Some(index) = bad_probability {
            return Err(SonarError::ElementOutOfRange {
                name: "probability",
                index,
                found: probability[index],
                expected: "a number within [0, 1] that is not below the one before it",
            });
        }
        Ok(Self { snr_db, probability })
    }

    /// The probability at a signal-to-noise ratio, in dB.
    pub fn at(&self, snr_db: f64) -> f64 {
        let last = self.snr_db.len() - 1;
        let above = self.snr_db.partition_point(|&point| point <= snr_db);
        if above == 0 {
            return self.probability[0];
        }
        if above > last {
            return self.probability[last];
        }
        let (x0, x1) = (self.snr_db[above - 1], self.snr_db[above]);
        let (p0, p1) = (self.probability[above - 1], self.probability[above]);
        p0 + (p1 - p0) * (snr_db - x0) / (x1 - x0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_met_and_joined() {
        let curve = ProbabilityCurve::new(vec![-10.0, 0.0, 5.0], vec![0.1, 0.5, 1.0]).unwrap();
        for (snr_db, expected) in [
            (-20.0, 0.1),
            (-10.0, 0.1),
            (-5.0, 0.3),
            (0.0, 0.5),
            (4.0, 0.9),
            (5.0, 1.0),
            (9.0, 1.0),
        ] {
            assert!((curve.at(snr_db) - expected).abs() < 1e-15);
        }
        assert!((curve.at(f64::NEG_INFINITY) - 0.1).abs() < 1e-15);
    }

    #[test]
    fn bad_tables_are_refused() {
        let refused = |snr_db: &[f64], probability: &[f64]| {
            ProbabilityCurve::new(snr_db.to_vec(), probability.to_vec()).unwrap_err().to_string()
        };
        assert!(refused(&[], &[]).contains("at least 1"));
        assert!(refused(&[0.0, 1.0], &[0.5]).contains("has 1 values"));
        assert!(refused(&[1.0, 1.0], &[0.1, 0.2]).contains("`snr_db`: value 1 is 1"));
        assert!(refused(&[f64::NAN], &[0.1]).contains("NaN"));
        assert!(refused(&[0.0, 1.0], &[0.3, 0.2]).contains("`probability`: value 1 is 0.2"));
        assert!(refused(&[0.0], &[1.5]).contains("1.5"));
    }
}
