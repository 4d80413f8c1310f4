//! Sonar and modems.

use super::Checker;
use crate::scenario::{
    CommunicationsSection, DetectionSection, LinkSection, ScenarioError, SonarSection,
};
use crate::sonar::curve::ProbabilityCurve;
use crate::sonar::detection::{DetectionModel, FalseAlarmProbability, PassiveSonar};
use crate::sonar::link::{LinkModel, Modem};
use crate::sonar::noise::NoiseLevel;

/// Bounds of levels, dB re 1 µPa: from the quietest ocean to the loudest machine.
const SOURCE_LEVELS_DB: (f64, f64) = (60.0, 260.0);
const NOISE_LEVELS_DB: (f64, f64) = (10.0, 150.0);
/// Bounds of frequencies, Hz: below, rays are no longer sound; above, sound dies in metres.
const FREQUENCIES_HZ: (f64, f64) = (10.0, 200_000.0);
const LEVEL_UNIT: &str = "dB re 1 µPa";

pub(super) fn sonar(
    checker: &Checker<'_>,
    section: &SonarSection,
) -> Result<PassiveSonar, ScenarioError> {
    let false_alarm = || {
        let key = "sonar.false_alarm_probability";
        let found = section.false_alarm_probability;
        FalseAlarmProbability::new(found).map_err(|_| checker.wrong(key, found, "between 0 and 1"))
    };
    let model = match &section.detection {
        DetectionSection::MeanShift => DetectionModel::MeanShift(false_alarm()?),
        DetectionSection::Threshold => DetectionModel::Threshold,
        DetectionSection::RayleighEnergy => DetectionModel::RayleighEnergy(false_alarm()?),
        DetectionSection::Table { snr_db, probability } => {
            DetectionModel::Tabulated(curve(checker, "sonar.detection", snr_db, probability)?)
        }
    };
    Ok(PassiveSonar {
        source_level_db: checker.within(
            "sonar.source_level_db",
            section.source_level_db,
            SOURCE_LEVELS_DB,
            LEVEL_UNIT,
        )?,
        noise_level_db: NoiseLevel::Uniform(checker.within(
            "sonar.noise_level_db",
            section.noise_level_db,
            NOISE_LEVELS_DB,
            LEVEL_UNIT,
        )?),
        directivity_index_db: checker.within(
            "sonar.directivity_index_db",
            section.directivity_index_db,
            (0.0, 60.0),
            "dB",
        )?,
        detection_threshold_db: checker.within(
            "sonar.detection_threshold_db",
            section.detection_threshold_db,
            (-60.0, 60.0),
            "dB",
        )?,
        model,
    })
}

/// Frequencies of detection and of communication, Hz.
pub(super) fn frequencies_hz(
    checker: &Checker<'_>,
    sonar: &SonarSection,
    communications: &CommunicationsSection,
) -> Result<(f64, f64), ScenarioError> {
    let detection =
        checker.within("sonar.frequency_hz", sonar.frequency_hz, FREQUENCIES_HZ, "Hz")?;
    let key = "communications.frequency_hz";
    let own = communications.frequency_hz.map(|hz| checker.within(key, hz, FREQUENCIES_HZ, "Hz"));
    Ok((detection, own.transpose()?.unwrap_or(detection)))
}

pub(super) fn modem(
    checker: &Checker<'_>,
    section: &CommunicationsSection,
) -> Result<Modem, ScenarioError> {
    let bits = section.packet_bits as usize;
    checker.count("communications.packet_bits", bits, (1, 1_000_000))?;
    let packet_bits = section.packet_bits;
    let model = match &section.link {
        LinkSection::CoherentBpsk => LinkModel::CoherentBpsk { packet_bits },
        LinkSection::NoncoherentFskRayleigh => LinkModel::NoncoherentFskRayleigh { packet_bits },
        LinkSection::Table { snr_db, probability } => {
            LinkModel::Tabulated(curve(checker, "communications.link", snr_db, probability)?)
        }
    };
    Ok(Modem {
        source_level_db: checker.within(
            "communications.source_level_db",
            section.source_level_db,
            SOURCE_LEVELS_DB,
            LEVEL_UNIT,
        )?,
        noise_level_db: NoiseLevel::Uniform(checker.within(
            "communications.noise_level_db",
            section.noise_level_db,
            NOISE_LEVELS_DB,
            LEVEL_UNIT,
        )?),
        model,
    })
}

fn curve(
    checker: &Checker<'_>,
    key: &'static str,
    snr_db: &[f64],
    probability: &[f64],
) -> Result<ProbabilityCurve, ScenarioError> {
    ProbabilityCurve::new(snr_db.to_vec(), probability.to_vec())
        .map_err(|error| checker.wrong(key, error, "a curve that rises from 0 toward 1"))
}
