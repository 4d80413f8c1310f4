use super::{Case, Output, PropagationModel, Run};
use crate::error::AcousticsError;
use crate::field::transmission_loss;
use crate::ray::trace;

/// The model of this crate.
#[derive(Debug, Clone, Copy, Default)]
pub struct Native;

impl PropagationModel for Native {
    fn name(&self) -> &'static str {
        "native"
    }

    fn solve(&self, case: &Case) -> Result<Output, AcousticsError> {
        match case.run {
            Run::Field(coherence) => case
                .sources()
                .map(|source| {
                    transmission_loss(
                        &case.section,
                        &source,
                        &case.fan,
                        &case.receivers,
                        case.beams.shape,
                        coherence,
                        &case.settings,
                    )
                })
                .collect::<Result<_, _>>()
                .map(Output::Fields),
            Run::Rays => case
                .sources()
                .map(|source| {
                    let rays = case.fan.beams().iter().map(|beam| {
                        trace(&case.section, &source, beam.angle_rad.to_degrees(), &case.settings)
                    });
                    rays.collect()
                })
                .collect::<Result<_, _>>()
                .map(Output::Rays),
            Run::Eigenrays | Run::Arrivals => {
                Err(AcousticsError::NotOffered { model: "native", what: "arrivals" })
            }
        }
    }
}
