//! From transmission loss to what a fleet is worth: how well a cell is heard
//! (Eqs. 3–6 of the paper), how well the vehicles hear each other (Eqs. 7–9),
//! and where targets are expected.

mod error;

pub mod connectivity;
pub mod curve;
pub mod detection;
pub mod gaussian;
pub mod link;
pub mod loss_file;
pub mod noise;
pub mod objective;
pub mod prior;
pub mod section;
pub mod transmission_loss;

pub use error::SonarError;
