use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::field::LaunchFan;
use std::str::FromStr;

/// How much work goes into a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Quality {
    /// For exploring.
    Fast,
    /// For placement.
    #[default]
    Standard,
    /// For checking the others: 720 bearings.
    Fine,
}

/// What a quality means, number by number.
#[derive(Debug, Clone, PartialEq)]
pub struct Numerics {
    /// Vertical slices around a source.
    pub bearings: usize,
    /// Beams of a slice by class of launch angle: how far up and down the class
    /// reaches, degrees, and how many beams it holds.
    pub beam_classes: Vec<(f64, usize)>,
    /// Product of reflection coefficients under which a ray ends.
    pub amplitude_cutoff: f64,
    /// How far sound-speed profiles may be simplified, m/s.
    pub speed_tolerance_m_s: f64,
    /// Distance between soundings of the sea floor along a slice, metres.
    pub sounding_m: f64,
    /// Distance between samples of intensity along a slice, metres.
    pub range_step_m: f64,
}

impl Quality {
    /// The numbers behind a quality. Beams are densest where sound goes far; ±60°
    /// is enough, what is steeper meets the floor too often.
    pub fn numerics(self) -> Numerics {
        match self {
            Self::Fast => Numerics {
                bearings: 36,
                beam_classes: vec![(12.0, 160), (25.0, 100), (60.0, 60)],
                amplitude_cutoff: 0.03,
                speed_tolerance_m_s: 0.2,
                sounding_m: 1000.0,
                range_step_m: 100.0,
            },
            Self::Standard => Numerics {
                bearings: 72,
                beam_classes: vec![(12.0, 200), (25.0, 130), (60.0, 80)],
                amplitude_cutoff: 0.02,
                speed_tolerance_m_s: 0.1,
                sounding_m: 500.0,
                range_step_m: 100.0,
            },
            Self::Fine => Numerics {
                bearings: 720,
                beam_classes: vec![(12.0, 600), (25.0, 360), (60.0, 240)],
                amplitude_cutoff: 0.005,
                speed_tolerance_m_s: 0.01,
                sounding_m: 250.0,
                range_step_m: 50.0,
            },
        }
    }

    /// The name by which scenarios and the command line call it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Fast => "fast",
            Self::Standard => "standard",
            Self::Fine => "fine",
        }
    }
}

impl Numerics {
    /// Beams per slice.
    pub fn beam_count(&self) -> usize {
        self.beam_classes.iter().map(|(_, count)| count).sum()
    }

    /// The fan of a slice.
    ///
    /// # Errors
    /// If the classes do not ascend or hold odd numbers of beams.
    pub fn fan(&self) -> Result<LaunchFan, AcousticsError> {
        LaunchFan::graded(&self.beam_classes)
    }
}

/// The name of no known quality.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no known quality: fast, standard, fine")]
pub struct UnknownQuality(pub String);

impl FromStr for Quality {
    type Err = UnknownQuality;

    fn from_str(name: &str) -> Result<Self, UnknownQuality> {
        [Self::Fast, Self::Standard, Self::Fine]
            .into_iter()
            .find(|quality| quality.name() == name)
            .ok_or_else(|| UnknownQuality(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_quality_has_a_name_and_a_fan() {
        for quality in [Quality::Fast, Quality::Standard, Quality::Fine] {
            assert_eq!(quality.name().parse(), Ok(quality));
            let numerics = quality.numerics();
            assert_eq!(numerics.fan().unwrap().beams().len(), numerics.beam_count());
        }
        assert!("best".parse::<Quality>().is_err());
    }
}
