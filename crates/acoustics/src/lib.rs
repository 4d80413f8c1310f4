//! Underwater sound: the speed and absorption of seawater, beam tracing through
//! vertical sections of the sea, and transmission loss.
//!
//! The nouns are the field's: a [`environment::Section`] (sound speed over
//! range and depth, sea floor, what reflects above and below), a
//! [`field::Source`], [`field::Receivers`], a [`field::LaunchFan`] of beams. The
//! verbs are [`ray::trace`], [`field::transmission_loss`] and, for tables of
//! transmission loss, [`field::RangeProfiler`]. A [`model::Case`] holds all nouns,
//! and a [`model::PropagationModel`] answers it.
//!
//! Lengths are in metres, depth is positive down, launch and grazing angles are
//! below the horizontal, transmission loss is in dB re 1 m.
//!
//! ```
//! use sonarfleet_acoustics::environment::{Interface, Boundary, Seabed, Section, SoundSpeedField};
//! use sonarfleet_acoustics::field::{LaunchFan, RangeProfiler, Source, TraceSettings};
//!
//! let sound_speed = SoundSpeedField::profile(vec![0.0, 200.0], vec![1520.0, 1500.0])?;
//! let bottom = Boundary::Fluid(Seabed::Mud.half_space());
//! let section = Section::new(sound_speed, Interface::flat(200.0)?, bottom)?;
//! let source = Source { depth_m: 50.0, frequency_hz: 1000.0 };
//! let fan = LaunchFan::uniform(-60.0, 60.0, 601)?;
//! let profiler = RangeProfiler::new(&section, &TraceSettings::to_range(5000.0));
//! let profile = profiler.intensity(&source, &fan, 50.0, 100.0, 50)?;
//! let loss_db = -10.0 * profile.intensity_at(2000.0).log10();
//! assert!((50.0..80.0).contains(&loss_db));
//! # Ok::<(), sonarfleet_acoustics::AcousticsError>(())
//! ```

pub mod bellhop;
pub mod environment;
pub mod field;
pub mod model;
pub mod ray;
pub mod seawater;

mod complex;
mod decibel;
mod error;

pub use complex::Complex;
pub use error::AcousticsError;
