//! Files of the BELLHOP family of beam tracers, and such programs themselves.

mod case_files;
mod companions;
mod options;
mod read;
mod records;
mod write;

pub use case_files::CaseFiles;
pub use read::{Reading, read_case};
