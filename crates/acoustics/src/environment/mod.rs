//! The environment: a vertical section through the sea along one bearing.

mod boundary;
mod interface;
mod seabed;
mod section;
mod sound_speed_field;

pub use boundary::{Boundary, FluidHalfSpace, ReflectionTable};
pub use interface::{Interface, InterfaceShape};
pub use seabed::{Seabed, UnknownSeabed};
pub use section::Section;
pub use sound_speed_field::{ProfileLaw, SoundSpeedField};
