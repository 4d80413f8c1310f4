//! Sound fields: what a fan of beams leaves on receivers.

mod arrivals;
mod batch;
mod beam_kind;
mod beam_pattern;
mod fan;
mod influence;
mod range_profile;
mod settings;
mod shot;
mod sound_field;
mod transmission_loss;

pub use arrivals::{Arrival, Arrivals};
pub use batch::{FanPart, Slice, batch_intensity};
pub use beam_kind::{BeamCoordinates, BeamKind, BeamShape, Coherence};
pub use beam_pattern::BeamPattern;
pub use fan::{Beam, LaunchFan};
pub use range_profile::{RangeProfile, RangeProfiler};
pub use settings::{ReceiverLayout, Receivers, Source, SourceGeometry, TraceSettings};
pub(crate) use shot::Shot;
pub use sound_field::Field;
pub use transmission_loss::transmission_loss;
