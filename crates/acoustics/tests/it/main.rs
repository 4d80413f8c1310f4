//! Integration tests of the acoustics crate.

mod analytic;
mod bellhop_files;
mod properties;
mod reference;
