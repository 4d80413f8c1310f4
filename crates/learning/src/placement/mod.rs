//! Policies that place the fleet.

pub mod paper;
pub mod transferable;
