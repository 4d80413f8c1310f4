use sonarfleet_acoustics::AcousticsError;
use sonarfleet_acoustics::field::LaunchFan;
use std::str::FromStr;

/// How much work goes into a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Quality {
    /// For placement.
    #[default]
    Fast,
    /// For results whose numerical error should not matter.
    Standard,
    /// For checking the others: 720 bearings.
    Fine,
}

/// Beams of similar launch angles. The steeper they are, the less does the fine
/// structure of the sound speed bend them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BeamClass {
    /// How far up and down from the horizontal the class reaches, degrees.
    pub limit_deg: f64,
    /// Number of beams, half of them upward.
    pub beams: usize,
    /// How far sound-speed profiles may be simplified, m/s.
    pub speed_tolerance_m_s: f64,
}

/// What a quality means, number by number.
#[derive(Debug, Clone, PartialEq)]
pub struct Numerics {
    /// Vertical slices around a source.
    pub bearings: usize,
    /// Beams of a slice by class of launch angle, shallowest first.
    pub beam_classes: Vec<BeamClass>,
    /// Product of reflection coefficients under which a ray ends.
    pub amplitude_cutoff: f64,
    /// Distance between soundings of the sea floor along a slice, metres.
    pub sounding_m: f64,
    /// Distance between samples of intensity along a slice, metres.
    pub range_step_m: f64,
}

impl Quality {
    /// The numbers behind a quality. Bearings matter most over floors that reflect;
    /// over a floor that returns little, beams near 11° do, because they make the edge of
    /// the shadow in a thermocline. ±55° is enough: what is steeper soon fades in the floor.
    ///
    /// Differences from `Fine` over the synthetic South China Sea slope (losses
    /// under 90 dB, 1 kHz, 200 m; median, 90th and 99th percentile, dB; the example
    /// `loss_table` measures them; `firm` is a fluid of 1600 m/s, 1.7, 0.5 dB/λ):
    ///
    /// | quality | clay | mud | firm | sand |
    /// |---|---|---|---|---|
    /// | `Fast` | 0.09, 0.43, 0.73 | 0.10, 0.42, 1.14 | 0.14, 0.68, 1.77 | 0.12, 0.57, 1.49 |
    /// | `Standard` | 0.07, 0.30, 0.51 | 0.06, 0.25, 0.73 | 0.08, 0.43, 1.11 | 0.07, 0.37, 0.93 |
    pub fn numerics(self) -> Numerics {
        match self {
            Self::Fast => Numerics {
                bearings: 136,
                beam_classes: classes([
                    (9.0, 30, 0.2),
                    (14.0, 50, 0.2),
                    (25.0, 60, 1.0),
                    (55.0, 50, 2.0),
                ]),
                amplitude_cutoff: 0.03,
                sounding_m: 250.0,
                range_step_m: 150.0,
            },
            Self::Standard => Numerics {
                bearings: 252,
                beam_classes: classes([
                    (9.0, 40, 0.1),
                    (14.0, 80, 0.1),
                    (25.0, 80, 0.5),
                    (55.0, 70, 2.0),
                ]),
                amplitude_cutoff: 0.02,
                sounding_m: 250.0,
                range_step_m: 100.0,
            },
            Self::Fine => Numerics {
                bearings: 720,
                beam_classes: classes([
                    (9.0, 160, 0.02),
                    (14.0, 200, 0.02),
                    (25.0, 180, 0.05),
                    (55.0, 120, 0.2),
                ]),
                amplitude_cutoff: 0.01,
                sounding_m: 250.0,
                range_step_m: 100.0,
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
        self.beam_classes.iter().map(|class| class.beams).sum()
    }

    /// The fan of each class.
    ///
    /// # Errors
    /// If the classes do not ascend or hold odd numbers of beams.
    pub fn fans(&self) -> Result<Vec<LaunchFan>, AcousticsError> {
        let mut inner_deg = 0.0;
        let fan = |class: &BeamClass| {
            let fan = LaunchFan::class(inner_deg, class.limit_deg, class.beams);
            inner_deg = class.limit_deg;
            fan
        };
        self.beam_classes.iter().map(fan).collect()
    }
}

/// Classes from (limit in degrees, beams, tolerance in m/s).
fn classes<const N: usize>(classes: [(f64, usize, f64); N]) -> Vec<BeamClass> {
    let class = |(limit_deg, beams, speed_tolerance_m_s)| BeamClass {
        limit_deg,
        beams,
        speed_tolerance_m_s,
    };
    classes.map(class).to_vec()
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
            let fans = numerics.fans().unwrap();
            let beams: usize = fans.iter().map(|fan| fan.beams().len()).sum();
            assert_eq!(beams, numerics.beam_count());
        }
        assert!("best".parse::<Quality>().is_err());
    }
}
