//! Where the fleet should be: the placement problem, its incremental evaluation,
//! and the methods that solve it.

mod chain;
mod error;
mod evaluation;
mod method;
mod price;

pub mod annealing;
pub mod auto;
pub mod bound;
pub mod compact;
pub mod comparison;
pub mod coverage;
pub mod genetic;
pub mod greedy;
pub mod instance;
pub mod local_search;
pub mod mdp;
pub mod network;
pub mod particle_swarm;
pub mod population;
pub mod problem;
pub mod random;
pub mod solver;

pub use error::PlacementError;
pub use evaluation::{Evaluation, SCORING_MULTIPLIER};
pub use method::{Method, UnknownMethod};
pub use problem::{PlacementInput, PlacementProblem};
pub use solver::{Budget, Contribution, Placement, Proposer, Solver};
