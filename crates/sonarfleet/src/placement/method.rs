//! Placement methods by name.

use super::Solver;
use super::annealing::Annealing;
use super::auto::Auto;
use super::genetic::Genetic;
use super::greedy::{ConnectedGreedy, Greedy};
use super::local_search::LocalSearch;
use super::particle_swarm::ParticleSwarm;
use super::random::RandomSearch;
use std::str::FromStr;
use thiserror::Error;

/// A placement method.
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
    /// The paper's policy, trained on the problem with our settings.
    SequentialPpo,
    /// The same with the paper's settings.
    SequentialPpoPaper,
    /// The paper's policy of exchanges, trained on the problem with our settings.
    ExchangePpo,
    /// The same with the paper's settings.
    ExchangePpoPaper,
    /// A trained policy that serves any problem.
    Policy,
    /// Proposals of quick methods, polished by annealing.
    Auto,
}

impl Method {
    /// All methods.
    pub const ALL: [Self; 15] = [
        Self::Random,
        Self::Greedy,
        Self::ConnectedGreedy,
        Self::LocalSearch,
        Self::Annealing,
        Self::ParticleSwarm,
        Self::Genetic,
        Self::ParticleSwarmPaper,
        Self::GeneticPaper,
        Self::SequentialPpo,
        Self::SequentialPpoPaper,
        Self::ExchangePpo,
        Self::ExchangePpoPaper,
        Self::Policy,
        Self::Auto,
    ];

    /// Its name, as on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Random => "random",
            Self::Greedy => "greedy",
            Self::ConnectedGreedy => "connected-greedy",
            Self::LocalSearch => "local-search",
            Self::Annealing => "annealing",
            Self::ParticleSwarm => "particle-swarm",
            Self::Genetic => "genetic",
            Self::ParticleSwarmPaper => "particle-swarm-paper",
            Self::GeneticPaper => "genetic-paper",
            Self::SequentialPpo => "sequential-ppo",
            Self::SequentialPpoPaper => "sequential-ppo-paper",
            Self::ExchangePpo => "exchange-ppo",
            Self::ExchangePpoPaper => "exchange-ppo-paper",
            Self::Policy => "policy",
            Self::Auto => "auto",
        }
    }

    /// The method's solver; none where it learns, which this crate cannot. `auto`
    /// comes without learned proposals.
    pub fn solver(self) -> Option<Box<dyn Solver>> {
        Some(match self {
            Self::Random => Box::new(RandomSearch),
            Self::Greedy => Box::new(Greedy),
            Self::ConnectedGreedy => Box::new(ConnectedGreedy),
            Self::LocalSearch => Box::new(LocalSearch),
            Self::Annealing => Box::new(Annealing::default()),
            Self::ParticleSwarm => Box::new(ParticleSwarm::default()),
            Self::Genetic => Box::new(Genetic::default()),
            Self::ParticleSwarmPaper => Box::new(ParticleSwarm::PAPER),
            Self::GeneticPaper => Box::new(Genetic::PAPER),
            Self::Auto => Box::new(Auto::default()),
            Self::SequentialPpo
            | Self::SequentialPpoPaper
            | Self::ExchangePpo
            | Self::ExchangePpoPaper
            | Self::Policy => return None,
        })
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
        Self::ALL.into_iter().find(|method| method.name() == name).ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|method| method.name()).collect();
            UnknownMethod { found: name.to_owned(), known: names.join(", ") }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solvers_call_themselves_as_their_methods() {
        for method in Method::ALL {
            assert_eq!(method.name().parse(), Ok(method));
            if let Some(solver) = method.solver() {
                assert_eq!(solver.name(), method.name());
            }
        }
        assert!("magic".parse::<Method>().is_err());
    }
}
