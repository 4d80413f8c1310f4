//! Passive detection: from levels to the probability that one sonar hears a
//! target (Eqs. 3 and 4 of the paper).

use super::SonarError;
use super::curve::ProbabilityCurve;
use super::error::checked;
use super::gaussian::{inverse_tail_probability, tail_probability};
use super::noise::NoiseLevel;
use crate::grid::CellId;

/// False-alarm probability of a detector, within (0, 1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FalseAlarmProbability(f64);

impl FalseAlarmProbability {
    /// Checks the number.
    ///
    /// # Errors
    /// Outside (0, 1).
    pub fn new(probability: f64) -> Result<Self, SonarError> {
        checked("false_alarm_probability", probability, "a number within (0, 1)", |p| {
            p > 0.0 && p < 1.0
        })
        .map(Self)
    }

    /// The number.
    pub const fn get(self) -> f64 {
        self.0
    }
}

/// How the probability of detection depends on the signal-to-noise ratio.
#[derive(Debug, Clone, PartialEq)]
pub enum DetectionModel {
    /// The paper's Eq. (4): the test statistic is Gaussian and a signal moves its
    /// mean by √(2·snr) standard deviations (a known signal in white noise; Kay,
    /// *Detection Theory*, 1998, section 4.3). Never below the false-alarm probability.
    MeanShift(FalseAlarmProbability),
    /// Detected with certainty from a ratio of 0 dB (after the detection
    /// threshold) upwards, and never below: the cookie cutter.
    Threshold,
    /// Square-law (energy) detector of one look at a signal whose amplitude
    /// fluctuates as Rayleigh's (Swerling 1, a single look), in closed form
    /// `P_d` = `P_FA`^(1/(1 + snr)) (Swerling 1960, doi:10.1109/TIT.1960.1057561;
    /// Urick, *Principles of Underwater Sound*, 1983, chapter 12).
    RayleighEnergy(FalseAlarmProbability),
    /// A measured receiver operating characteristic at the operating false-alarm rate.
    Tabulated(ProbabilityCurve),
}

impl DetectionModel {
    /// Probability of detection at a signal-to-noise ratio, in dB; a ratio of −∞ dB
    /// is no signal at all.
    pub fn probability(&self, snr_db: f64) -> f64 {
        match self {
            Self::MeanShift(p_fa) => mean_shift(inverse_tail_probability(p_fa.get()), snr_db),
            Self::Threshold => f64::from(u8::from(snr_db >= 0.0)),
            Self::RayleighEnergy(p_fa) => p_fa.get().powf(1.0 / (1.0 + power_ratio(snr_db))),
            Self::Tabulated(curve) => curve.at(snr_db),
        }
    }
}

/// Eq. (4), with Q⁻¹(`P_FA`) given.
fn mean_shift(detection_level: f64, snr_db: f64) -> f64 {
    tail_probability(detection_level - (2.0 * power_ratio(snr_db)).sqrt()) // Eq. (4)
}

/// The power ratio of a level difference in dB.
pub(super) fn power_ratio(level_db: f64) -> f64 {
    libm::exp10(0.1 * level_db)
}

/// The passive sonar equation's terms besides transmission loss.
#[derive(Debug, Clone, PartialEq)]
pub struct PassiveSonar {
    /// Source level of the target, SL, dB re 1 µPa at 1 m.
    pub source_level_db: f64,
    /// Ambient noise level at the sonar, NL, dB re 1 µPa.
    pub noise_level_db: NoiseLevel,
    /// Directivity index of the sonar, DI, dB.
    pub directivity_index_db: f64,
    /// What the paper's Eq. (3) leaves out, dB: taken off the signal-to-noise
    /// ratio before the detection model sees it; 0 is the paper's equation.
    pub detection_threshold_db: f64,
    /// From signal-to-noise ratio to probability.
    pub model: DetectionModel,
}

impl PassiveSonar {
    /// Checks the levels against a grid of `cells` cells.
    ///
    /// # Errors
    /// Where a level is not finite, or the noise is not given for every cell.
    pub fn check(&self, cells: usize) -> Result<(), SonarError> {
        let finite = |name, value| checked(name, value, "a finite number", f64::is_finite);
        finite("source_level_db", self.source_level_db)?;
        finite("directivity_index_db", self.directivity_index_db)?;
        finite("detection_threshold_db", self.detection_threshold_db)?;
        self.noise_level_db.check(cells)
    }

    /// Signal-to-noise ratio at a sonar in `cell`, dB, of a target whose sound
    /// loses `loss_db` on its way, after the detection threshold.
    pub fn snr_db(&self, cell: CellId, loss_db: f64) -> f64 {
        let snr_db = self.source_level_db - loss_db - self.noise_level_db.at_db(cell)
            + self.directivity_index_db; // Eq. (3)
        snr_db - self.detection_threshold_db
    }

    /// Probability that a sonar in `cell` hears targets behind these losses, dB.
    pub fn detection_probabilities(&self, cell: CellId, losses_db: &[f32]) -> Vec<f64> {
        // Q⁻¹ costs as much as a hundred losses: taken out of the loop.
        let probability: Box<dyn Fn(f64) -> f64> = match &self.model {
            DetectionModel::MeanShift(p_fa) => {
                let level = inverse_tail_probability(p_fa.get());
                Box::new(move |snr_db| mean_shift(level, snr_db))
            }
            model => Box::new(|snr_db| model.probability(snr_db)),
        };
        losses_db
            .iter()
            .map(|&loss_db| probability(self.snr_db(cell, f64::from(loss_db))))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p_fa(probability: f64) -> FalseAlarmProbability {
        FalseAlarmProbability::new(probability).unwrap()
    }

    #[test]
    fn mean_shift_at_its_landmarks() {
        let model = DetectionModel::MeanShift(p_fa(1e-3));
        assert!((model.probability(f64::NEG_INFINITY) - 1e-3).abs() < 1e-15);
        // The shift equals Q⁻¹(P_FA) = 3.0902…: half of the targets are heard.
        let half_db = 10.0 * (3.090_232_306_167_813_f64.powi(2) / 2.0).log10();
        assert!((model.probability(half_db) - 0.5).abs() < 1e-12);
        assert!((model.probability(40.0) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn rayleigh_energy_at_its_landmarks() {
        let model = DetectionModel::RayleighEnergy(p_fa(1e-4));
        assert!((model.probability(f64::NEG_INFINITY) - 1e-4).abs() < 1e-18);
        assert!((model.probability(0.0) - 1e-2).abs() < 1e-15, "snr 1: the square root of P_FA");
        assert!((model.probability(10.0 * 3.0_f64.log10()) - 0.1).abs() < 1e-14);
    }

    #[test]
    fn threshold_is_a_step() {
        for (snr_db, expected) in [(-1e-9, 0.0), (0.0, 1.0), (30.0, 1.0)] {
            assert_eq!(
                DetectionModel::Threshold.probability(snr_db).to_bits(),
                f64::to_bits(expected)
            );
        }
    }

    #[test]
    fn no_model_ever_falls() {
        let curve = ProbabilityCurve::new(vec![-5.0, 5.0], vec![0.0, 0.9]).unwrap();
        for model in [
            DetectionModel::MeanShift(p_fa(1e-3)),
            DetectionModel::Threshold,
            DetectionModel::RayleighEnergy(p_fa(1e-3)),
            DetectionModel::Tabulated(curve),
        ] {
            let values: Vec<f64> =
                (-400..400).map(|step| model.probability(f64::from(step) * 0.1)).collect();
            assert!(values.is_sorted(), "{model:?}");
            assert!(values.iter().all(|p| (0.0..=1.0).contains(p)), "{model:?}");
        }
    }

    #[test]
    fn the_sonar_equation_adds_up() {
        let sonar = PassiveSonar {
            source_level_db: 154.0,
            noise_level_db: NoiseLevel::PerCell(vec![63.0, 70.0]),
            directivity_index_db: 2.0,
            detection_threshold_db: 5.0,
            model: DetectionModel::MeanShift(p_fa(1e-3)),
        };
        assert!(sonar.check(2).is_ok());
        assert!(sonar.check(3).unwrap_err().to_string().contains("one per cell (3)"));
        assert!((sonar.snr_db(CellId(0), 80.0) - 8.0).abs() < 1e-12);
        assert!((sonar.snr_db(CellId(1), 80.0) - 1.0).abs() < 1e-12);
        let row = sonar.detection_probabilities(CellId(1), &[80.0, 60.0]);
        assert!((row[0] - sonar.model.probability(1.0)).abs() < 1e-15);
        assert!((row[1] - sonar.model.probability(21.0)).abs() < 1e-15);
    }

    #[test]
    fn bad_false_alarm_probabilities_are_refused() {
        for bad in [0.0, 1.0, -0.1, f64::NAN] {
            assert!(FalseAlarmProbability::new(bad).is_err());
        }
    }
}
