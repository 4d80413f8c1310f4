//! The paper's policies as placement methods.

use super::settings::PaperSettings;
use super::trainer::{PlacementTrainer, PlacementUpdate};
use crate::ppo::BadSettings;
use sonarfleet::placement::mdp::{ExchangeMdp, PlacementMdp};
use sonarfleet::placement::solver::Meter;
use sonarfleet::placement::{Budget, Placement, PlacementProblem, Solver};
use std::fmt;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Is told about every update and the time since the start.
pub type Observer = Arc<dyn Fn(&PlacementUpdate, Duration) + Send + Sync>;

/// Which process is learnt.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Process {
    /// One vehicle after the other.
    Sequential,
    /// Swaps from a random layout.
    Exchange,
}

/// Proximal policy optimisation on the problem itself, from random weights; an
/// evaluation is an episode.
///
/// Trains in whole rollouts, one at least, until the budget is used up; takes the
/// better of the best layout that an episode ended with and of the one decoded with the
/// most probable actions.
#[derive(Clone)]
pub struct PaperPpo {
    process: Process,
    settings: PaperSettings,
    observer: Option<Observer>,
}

impl PaperPpo {
    /// The method for a process.
    ///
    /// # Errors
    /// Where the settings make no sense.
    pub fn new(process: Process, settings: PaperSettings) -> Result<Self, BadSettings> {
        settings.ppo.check()?;
        Ok(Self { process, settings, observer: None })
    }

    /// The same with somebody who watches it learn.
    #[must_use]
    pub fn observed(self, observer: Observer) -> Self {
        Self { observer: Some(observer), ..self }
    }

    fn train<M: PlacementMdp>(&self, mdp: M, budget: Budget, seed: u64) -> Placement {
        let start = Instant::now();
        let meter = Meter::new(budget);
        let mut trainer =
            PlacementTrainer::new(mdp, &self.settings, seed).expect("settings are checked");
        loop {
            let update = trainer.update(meter.used(trainer.episodes()));
            if let Some(observer) = &self.observer {
                observer(&update, start.elapsed());
            }
            if meter.used(trainer.episodes()) >= 1.0 {
                break;
            }
        }
        let mdp = trainer.mdp();
        let problem = mdp.problem();
        let decoded = trainer.policy().decode(mdp, mdp.decisions(), seed);
        let evaluation = problem.evaluate(&decoded);
        let episodes = trainer.episodes() + 1;
        let mut history = trainer.history().to_vec();
        let sampled = trainer
            .best_sampled()
            .filter(|sampled| problem.evaluate(sampled).compare(&evaluation).is_ge());
        let cells = match sampled {
            Some(sampled) => sampled.to_vec(),
            None => decoded,
        };
        if history.is_empty() && evaluation.feasible {
            history.push((episodes, evaluation.detection_utility));
        }
        Placement::new(self.name(), problem, cells, episodes, history)
    }
}

impl Solver for PaperPpo {
    fn name(&self) -> &'static str {
        match self.process {
            Process::Sequential => "sequential-ppo",
            Process::Exchange => "exchange-ppo",
        }
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement {
        match self.process {
            Process::Sequential => self.train(self.settings.sequential_mdp(problem), budget, seed),
            Process::Exchange => self.train(ExchangeMdp::new(problem), budget, seed),
        }
    }
}

impl fmt::Debug for PaperPpo {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("PaperPpo")
            .field("process", &self.process)
            .field("settings", &self.settings)
            .finish_non_exhaustive()
    }
}
