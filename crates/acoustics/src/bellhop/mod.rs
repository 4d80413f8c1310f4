//! Files of the BELLHOP family of beam tracers, and such programs themselves.
//!
//! Input files are held in memory as [`CaseFiles`], from which a [`crate::model::Case`]
//! is read and into which it is written; what a model makes of it goes to [`ShadeFile`]s,
//! [`ArrivalsFile`]s and [`RayFile`]s. [`Executable`] is an external program as a model.

mod arrivals_file;
mod case_files;
mod companions;
mod executable;
mod media;
mod options;
mod output;
mod ray_file;
mod read;
mod records;
mod shade_file;
mod water;
mod write;

pub use arrivals_file::ArrivalsFile;
pub use case_files::CaseFiles;
pub use executable::{Executable, abandon_all};
pub use output::{FATAL_ERROR, fatal_text, output_file, print_text};
pub use ray_file::{RayFile, RayPath};
pub use read::{Reading, read_case};
pub use shade_file::ShadeFile;
