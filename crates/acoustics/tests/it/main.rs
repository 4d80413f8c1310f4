//! Integration tests of the acoustics crate.

mod analytic;
mod batch;
mod bellhop_files;
mod executable;
mod mutations;
mod properties;
mod reference;
