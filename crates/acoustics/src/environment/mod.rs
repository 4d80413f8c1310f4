//! The environment: a vertical section through the sea along one bearing.

mod bathymetry;
mod boundary;
mod seabed;
mod section;
mod sound_speed_field;

pub use bathymetry::Bathymetry;
pub use boundary::{Boundary, FluidHalfSpace, ReflectionTable};
pub use seabed::{Seabed, UnknownSeabed};
pub use section::Section;
pub use sound_speed_field::{ProfileLaw, SoundSpeedField};
