use super::{Case, Output, ProfileRequest, PropagationModel, Run};
use crate::error::AcousticsError;
use crate::field::{RangeProfile, RangeProfiler, Shot};
use crate::ray::{Medium, MediumLimits};

/// The model of this crate.
#[derive(Debug, Clone, Copy, Default)]
pub struct Native;

impl PropagationModel for Native {
    fn name(&self) -> &'static str {
        "native"
    }

    fn solve(&self, case: &Case) -> Result<Output, AcousticsError> {
        for source in case.sources() {
            source.check(&case.section)?;
        }
        let medium = Medium::new(&case.section, &MediumLimits::from(&case.settings));
        let shots = case.sources().map(|source| Shot {
            section: &case.section,
            medium: &medium,
            source,
            geometry: case.geometry,
            beam_pattern: case.beam_pattern.as_ref(),
            fan: &case.fan,
            beams: case.beams,
            receivers: &case.receivers,
            amplitude_cutoff: case.settings.amplitude_cutoff,
        });
        Ok(match case.run {
            Run::Field(coherence) => {
                Output::Fields(shots.map(|shot| shot.field(coherence)).collect())
            }
            Run::Rays => Output::Rays(shots.map(|shot| shot.rays()).collect()),
            Run::Eigenrays => Output::Rays(shots.map(|shot| shot.eigenrays()).collect()),
            Run::Arrivals => Output::Arrivals(shots.map(|shot| shot.arrivals()).collect()),
        })
    }

    fn intensity_profile(
        &self,
        request: &ProfileRequest<'_>,
    ) -> Result<RangeProfile, AcousticsError> {
        RangeProfiler::new(request.section, request.settings).intensity(
            &request.source,
            request.fan,
            request.receiver_depth_m,
            request.step_m,
            request.count,
        )
    }
}
