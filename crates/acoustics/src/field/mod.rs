//! Sound fields: what a fan of beams leaves on receivers.

mod arrivals;
mod batch;
mod beam_pattern;
mod fan;
mod influence;
mod range_profile;
mod settings;
mod transmission_loss;

pub use arrivals::{Arrival, Arrivals};
pub use batch::{FanPart, Slice, batch_intensity};
pub use beam_pattern::BeamPattern;
pub use fan::{Beam, LaunchFan};
pub use influence::{BeamCoordinates, BeamKind, BeamShape, Coherence};
pub use range_profile::{RangeProfile, RangeProfiler};
pub use settings::{Receivers, Source, SourceGeometry, TraceSettings};
pub use transmission_loss::{Field, transmission_loss};
