//! Placement methods by name.

use super::Solver;
use super::annealing::Annealing;
use super::genetic::Genetic;
use super::greedy::{ConnectedGreedy, Greedy};
use super::local_search::LocalSearch;
use super::particle_swarm::ParticleSwarm;
use super::random::RandomSearch;
use std::str::FromStr;
use thiserror::Error;

/// A placement method that needs nothing but the problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// The best of random layouts.
    Random,
    /// The best marginal gain first, whatever the links.
    Greedy,
    /// The best marginal gain first among cells that keep the graph connected.
    ConnectedGreedy,
    /// Swaps from connected greedy while they gain.
    LocalSearch,
    /// Simulated annealing with swaps.
    Annealing,
    /// Particle swarm optimisation from feasible layouts.
    ParticleSwarm,
    /// A genetic algorithm from feasible layouts.
    Genetic,
    /// Particle swarm optimisation as the paper ran it, from random layouts.
    ParticleSwarmPaper,
    /// A genetic algorithm as the paper ran it, from random layouts.
    GeneticPaper,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 9] = [
        Self::Random,
        Self::Greedy,
        Self::ConnectedGreedy,
        Self::LocalSearch,
        Self::Annealing,
        Self::ParticleSwarm,
        Self::Genetic,
        Self::ParticleSwarmPaper,
        Self::GeneticPaper,
    ];

    /// The method's solver.
    pub fn solver(self) -> Box<dyn Solver> {
        match self {
            Self::Random => Box::new(RandomSearch),
            Self::Greedy => Box::new(Greedy),
            Self::ConnectedGreedy => Box::new(ConnectedGreedy),
            Self::LocalSearch => Box::new(LocalSearch),
            Self::Annealing => Box::new(Annealing::default()),
            Self::ParticleSwarm => Box::new(ParticleSwarm::default()),
            Self::Genetic => Box::new(Genetic::default()),
            Self::ParticleSwarmPaper => Box::new(ParticleSwarm::PAPER),
            Self::GeneticPaper => Box::new(Genetic::PAPER),
        }
    }
}

/// There is no method of that name.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{found}` is no placement method; there are {known}")]
pub struct UnknownMethod {
    /// The name given.
    pub found: String,
    /// All names.
    pub known: String,
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        Self::ALL.into_iter().find(|method| method.solver().name() == name).ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|method| method.solver().name()).collect();
            UnknownMethod { found: name.to_owned(), known: names.join(", ") }
        })
    }
}
