//! Methods side by side: what each achieves on a problem, over several seeds.

use super::{Budget, PlacementProblem, SCORING_MULTIPLIER, Solver, bound};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// A problem, and what methods achieved on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// Name of the problem.
    pub problem: String,
    /// Required algebraic connectivity τ.
    pub connectivity_threshold: f64,
    /// Number of vehicles, G.
    pub vehicles: usize,
    /// No feasible layout has a higher `J_d` than this.
    pub upper_bound: f64,
    /// What was run, in order.
    pub trials: Vec<Trial>,
}

/// One run of a method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Name of the method.
    pub method: String,
    /// Seed.
    pub seed: u64,
    /// `J_d` of the layout found.
    pub detection_utility: f64,
    /// Its λ₂.
    pub algebraic_connectivity: f64,
    /// Its reward R under [`SCORING_MULTIPLIER`].
    pub reward: f64,
    /// Whether λ₂ ≥ τ.
    pub feasible: bool,
    /// Proposals evaluated.
    pub evaluations: u64,
    /// Wall-clock seconds.
    pub seconds: f64,
}

/// The trials of a method on a problem: medians, but for the counts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Name of the method.
    pub method: String,
    /// Number of trials.
    pub trials: usize,
    /// Share of the trials that ended feasible.
    pub feasible_share: f64,
    /// `J_d`, of feasible and infeasible layouts.
    pub detection_utility: f64,
    /// λ₂.
    pub algebraic_connectivity: f64,
    /// Reward R under [`SCORING_MULTIPLIER`].
    pub reward: f64,
    /// How far `J_d` of the feasible layouts is below the upper bound, as a share of
    /// it; none where none is feasible.
    pub gap: Option<f64>,
    /// Proposals evaluated.
    pub evaluations: f64,
    /// Wall-clock seconds.
    pub seconds: f64,
}

impl Comparison {
    /// A problem on which nothing was run yet.
    pub fn new(name: impl Into<String>, problem: &PlacementProblem) -> Self {
        Self {
            problem: name.into(),
            connectivity_threshold: problem.connectivity_threshold(),
            vehicles: problem.vehicles(),
            upper_bound: bound::upper_bound(problem),
            trials: Vec::new(),
        }
    }

    /// Runs a method on the problem and notes what it achieved.
    pub fn run(
        &mut self,
        problem: &PlacementProblem,
        solver: &dyn Solver,
        budget: Budget,
        seed: u64,
    ) {
        let started = Instant::now();
        let placement = solver.solve(problem, budget, seed);
        let seconds = started.elapsed().as_secs_f64();
        let evaluation = placement.evaluation;
        self.trials.push(Trial {
            method: solver.name().to_owned(),
            seed,
            detection_utility: evaluation.detection_utility,
            algebraic_connectivity: evaluation.algebraic_connectivity,
            reward: evaluation.reward(problem.connectivity_threshold(), SCORING_MULTIPLIER),
            feasible: evaluation.feasible,
            evaluations: placement.evaluations,
            seconds,
        });
    }

    /// Names of the methods, in the order in which they were first run.
    pub fn methods(&self) -> Vec<&str> {
        let mut methods: Vec<&str> = Vec::new();
        for trial in &self.trials {
            if !methods.contains(&trial.method.as_str()) {
                methods.push(&trial.method);
            }
        }
        methods
    }

    /// One summary per method, in the same order.
    pub fn summaries(&self) -> Vec<Summary> {
        self.methods().into_iter().map(|method| self.summary(method)).collect()
    }

    fn summary(&self, method: &str) -> Summary {
        let trials: Vec<&Trial> = self.trials.iter().filter(|t| t.method == method).collect();
        let feasible: Vec<&Trial> = trials.iter().copied().filter(|t| t.feasible).collect();
        let of_all = |value: fn(&Trial) -> f64| median(trials.iter().map(|t| value(t)));
        let gap = |trial: &&Trial| 1.0 - trial.detection_utility / self.upper_bound;
        Summary {
            method: method.to_owned(),
            trials: trials.len(),
            feasible_share: feasible.len() as f64 / trials.len() as f64,
            detection_utility: of_all(|trial| trial.detection_utility),
            algebraic_connectivity: of_all(|trial| trial.algebraic_connectivity),
            reward: of_all(|trial| trial.reward),
            gap: (!feasible.is_empty()).then(|| median(feasible.iter().map(gap))),
            evaluations: of_all(|trial| trial.evaluations as f64),
            seconds: of_all(|trial| trial.seconds),
        }
    }

    /// The highest `J_d` of a feasible layout that any method found.
    pub fn best_found(&self) -> Option<f64> {
        let feasible = self.trials.iter().filter(|trial| trial.feasible);
        feasible.map(|trial| trial.detection_utility).reduce(f64::max)
    }
}

/// The middle value, or the mean of the two in the middle.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let (low, high) = (values[(values.len() - 1) / 2], values[values.len() / 2]);
    if low.total_cmp(&high).is_eq() { low } else { f64::midpoint(low, high) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial(method: &str, detection_utility: f64, feasible: bool) -> Trial {
        Trial {
            method: method.into(),
            seed: 1,
            detection_utility,
            algebraic_connectivity: if feasible { f64::INFINITY } else { 0.45 },
            reward: detection_utility - if feasible { 0.0 } else { 15.0 },
            feasible,
            evaluations: 100,
            seconds: 0.5,
        }
    }

    #[test]
    fn medians_and_gaps_are_those_of_the_trials() {
        let comparison = Comparison {
            problem: "p".into(),
            connectivity_threshold: 0.95,
            vehicles: 3,
            upper_bound: 40.0,
            trials: vec![
                trial("b", 35.0, true),
                trial("a", 39.0, false),
                trial("b", 30.0, true),
                trial("a", 20.0, true),
                trial("b", 38.0, true),
            ],
        };
        assert_eq!(comparison.methods(), ["b", "a"]);
        assert_eq!(comparison.best_found(), Some(38.0));
        let [b, a] = &comparison.summaries()[..] else { panic!("two methods") };
        assert_eq!((b.trials, b.feasible_share, b.detection_utility), (3, 1.0, 35.0));
        assert_eq!((b.gap, b.algebraic_connectivity), (Some(0.125), f64::INFINITY));
        assert_eq!((a.trials, a.feasible_share, a.detection_utility), (2, 0.5, 29.5));
        assert_eq!((a.gap, a.reward), (Some(0.5), 22.0));
    }
}
