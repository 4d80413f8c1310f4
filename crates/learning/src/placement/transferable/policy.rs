//! The policy as a method that places the fleet.

use super::decoding::{Decoding, Sample};
use super::landscape::Landscape;
use super::network::Network;
use sonarfleet::grid::CellId;
use sonarfleet::placement::{Budget, Placement, PlacementProblem, Proposer, Solver};

/// The transferable policy with its weights.
#[derive(Debug, Clone)]
pub struct TransferablePolicy {
    /// The network.
    pub network: Network,
    /// How layouts are drawn from it.
    pub decoding: Decoding,
}

impl TransferablePolicy {
    /// A policy of these weights with the usual decoding.
    pub fn new(network: Network) -> Self {
        Self { network, decoding: Decoding::default() }
    }

    /// Layouts in the order of their drawing.
    fn draw(&self, problem: &PlacementProblem, seed: u64) -> Vec<Sample> {
        self.decoding.draw(&self.network, &Landscape::new(problem), seed)
    }

    /// Layouts for a problem, the best first.
    pub fn samples(&self, problem: &PlacementProblem, seed: u64) -> Vec<Sample> {
        let mut samples = self.draw(problem, seed);
        samples.sort_by(|a, b| b.evaluation.compare(&a.evaluation));
        samples
    }
}

impl Solver for TransferablePolicy {
    fn name(&self) -> &'static str {
        "policy"
    }

    /// The best of the layouts drawn, whatever the budget.
    fn solve(&self, problem: &PlacementProblem, _budget: Budget, seed: u64) -> Placement {
        let samples = self.draw(problem, seed);
        let mut history: Vec<(u64, f64)> = Vec::new();
        let mut best: Option<&Sample> = None;
        for (index, sample) in samples.iter().enumerate() {
            if best.is_none_or(|best| sample.evaluation.compare(&best.evaluation).is_gt()) {
                best = Some(sample);
                if sample.evaluation.feasible {
                    history.push((index as u64 + 1, sample.evaluation.detection_utility));
                }
            }
        }
        let cells = best.map(|sample| sample.layout.clone()).unwrap_or_default();
        Placement::new(Solver::name(self), problem, cells, samples.len() as u64, history)
    }
}

impl Proposer for TransferablePolicy {
    fn name(&self) -> &'static str {
        "policy"
    }

    fn propose(&self, problem: &PlacementProblem, seed: u64) -> Vec<Vec<CellId>> {
        let policy = Self { decoding: self.decoding.diverse(), network: self.network.clone() };
        policy.samples(problem, seed).into_iter().map(|sample| sample.layout).collect()
    }
}
