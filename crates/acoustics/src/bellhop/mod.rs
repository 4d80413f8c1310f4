//! Files of the BELLHOP family of beam tracers.

mod case;
mod environment_file;
mod lines;
mod tables;

pub use case::{BellhopCase, Run};
