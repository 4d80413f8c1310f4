//! The environment: a vertical section through the sea along one bearing.

mod attenuation;
mod boundary;
mod interface;
mod profile_curve;
mod seabed;
mod section;
mod sound_speed_field;

pub use attenuation::AttenuationProfile;
pub use boundary::{Boundary, ElasticHalfSpace, FluidHalfSpace, ReflectionTable};
pub(crate) use interface::Bend;
pub use interface::{Interface, InterfaceShape};
pub use seabed::{Seabed, UnknownSeabed};
pub use section::Section;
pub(crate) use sound_speed_field::Profile;
pub use sound_speed_field::{ProfileLaw, SoundSpeedField};
