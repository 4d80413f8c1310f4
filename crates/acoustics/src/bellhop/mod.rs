//! Files of the BELLHOP family of beam tracers.

mod environment_file;
mod lines;
mod tables;

pub use environment_file::read_case;
