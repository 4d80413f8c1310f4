use super::error::TransmissionLossError;
use super::quality::{Numerics, Quality};
use crate::fingerprint::hexadecimal;
use sha2::{Digest, Sha256};
use sonarfleet_acoustics::bellhop::Executable;

/// Losses are not given beyond this, dB: nothing is heard there.
pub const LARGEST_LOSS_DB: f32 = 200.0;

/// What a table is computed for.
#[derive(Debug, Clone, PartialEq)]
pub struct LossTableSettings {
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Depth of sources and receivers, metres.
    pub fleet_depth_m: f64,
    /// Largest distance over which sound is followed, metres; infinite for the
    /// whole region.
    pub maximum_range_m: f64,
    /// How much work goes into it: those of a [`Quality`](super::Quality), as a rule.
    pub numerics: Numerics,
    /// What follows sound.
    pub model: TableModel,
}

impl LossTableSettings {
    /// The same at the quality that others are compared with.
    #[must_use]
    pub fn fine(&self) -> Self {
        Self { numerics: Quality::Fine.numerics(), ..self.clone() }
    }

    pub(super) fn check(&self) -> Result<(), TransmissionLossError> {
        for (setting, found) in [
            ("the frequency", self.frequency_hz),
            ("the fleet's depth", self.fleet_depth_m),
            ("the largest range", self.maximum_range_m),
        ] {
            if found.is_nan() || found <= 0.0 {
                return Err(TransmissionLossError::NotPositive { setting, found });
            }
        }
        Ok(())
    }

    /// Beams per slice.
    pub fn beam_count(&self) -> usize {
        match self.model {
            TableModel::Native => self.numerics.beam_count(),
            TableModel::Bellhop(_) => dense_beams(&self.numerics).1,
        }
    }
}

/// What follows sound along the slices of a table.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum TableModel {
    /// This program's own rays, many at a time.
    #[default]
    Native,
    /// An external program of the BELLHOP family, started once for every slice: tens of
    /// thousands of times for a table.
    Bellhop(Executable),
}

impl TableModel {
    /// The name by which scenarios and files call it.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Native => "native",
            Self::Bellhop(_) => "bellhop",
        }
    }

    /// What tells this model's rows from another's: the name, and of an external program
    /// the SHA-256 of its file.
    pub(super) fn identity(&self) -> String {
        match self {
            Self::Native => self.name().to_owned(),
            Self::Bellhop(program) => {
                // Without the program there will be no rows to tell apart.
                let file = std::fs::read(program.program()).unwrap_or_default();
                format!("{} {}", self.name(), hexadecimal(&Sha256::digest(file)))
            }
        }
    }
}

/// How far up and down a fan over all classes reaches that is everywhere as dense as the
/// densest, degrees, and its number of beams.
pub(super) fn dense_beams(numerics: &Numerics) -> (f64, usize) {
    let (mut inner_deg, mut finest_deg) = (0.0, f64::INFINITY);
    for class in &numerics.beam_classes {
        let spacing_deg = 2.0 * (class.limit_deg - inner_deg) / class.beams as f64;
        finest_deg = spacing_deg.min(finest_deg);
        inner_deg = class.limit_deg;
    }
    (inner_deg, (2.0 * inner_deg / finest_deg).round() as usize + 1)
}
