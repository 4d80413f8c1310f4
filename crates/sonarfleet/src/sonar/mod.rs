//! sonar

pub mod section;
pub mod transmission_loss;
