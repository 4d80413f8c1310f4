//! Propagation models: what answers a [`Case`]. There are two, this crate's own
//! ([`Native`]) and an external program of the BELLHOP family
//! ([`crate::bellhop::Executable`]).

mod case;
mod native;
mod profile_request;

pub use case::{Case, Run};
pub use native::Native;
pub use profile_request::ProfileRequest;

use crate::error::AcousticsError;
use crate::field::{Arrivals, Field, RangeProfile};
use crate::ray::Ray;

/// The answer to a [`Case`], an entry for each of its sources.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// To [`Run::Field`].
    Fields(Vec<Field>),
    /// To [`Run::Rays`] and [`Run::Eigenrays`].
    Rays(Vec<Vec<Ray>>),
    /// To [`Run::Arrivals`].
    Arrivals(Vec<Arrivals>),
}

/// Computes how sound spreads through a section of the sea.
pub trait PropagationModel: Send + Sync {
    /// By what name people know it.
    fn name(&self) -> &str;

    /// Answers a case.
    ///
    /// # Errors
    /// If a source is not in the water, the case asks for something that the model
    /// does not offer, or the model fails.
    fn solve(&self, case: &Case) -> Result<Output, AcousticsError>;

    /// The intensity over range that tables of transmission loss are made of.
    ///
    /// Here it is averaged from the field of a [`ProfileRequest::case`]; models that have a more
    /// direct way take it.
    ///
    /// # Errors
    /// As [`PropagationModel::solve`], or if the step is not positive.
    fn intensity_profile(
        &self,
        request: &ProfileRequest<'_>,
    ) -> Result<RangeProfile, AcousticsError> {
        Ok(request.profile(&self.solve(&request.case()?)?))
    }
}
