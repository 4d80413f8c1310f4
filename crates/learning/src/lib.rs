//! Policies that place and steer a fleet, and how they learn: networks, proximal
//! policy optimisation, and the policies of the paper and beyond it.
//!
//! The rest of the system does not need this crate: it implements
//! [`Solver`](sonarfleet::placement::Solver) and
//! [`Proposer`](sonarfleet::placement::Proposer).

pub mod files;
pub mod network;
pub mod placement;
pub mod ppo;
