//! Sound fields: what a fan of beams leaves on receivers.

mod batch;
mod fan;
mod influence;
mod range_profile;
mod settings;
mod transmission_loss;

pub use batch::{FanPart, batch_intensity};
pub use fan::{Beam, LaunchFan};
pub use influence::{BeamShape, Coherence};
pub use range_profile::{RangeProfile, RangeProfiler};
pub use settings::{Receivers, Source, TraceSettings};
pub use transmission_loss::{Field, transmission_loss};
