//! Proposals of quick methods, polished by annealing.

use super::annealing::{self, anneal, join};
use super::chain::Cooling;
use super::solver::{Contribution, Meter};
use super::{Budget, Evaluation, Placement, PlacementProblem, Proposer, Solver};
use crate::grid::CellId;

/// The default: layouts from connected greedy and from any number of proposing
/// methods; the best of them are annealed for a while, and the best few of what comes
/// out for the rest of the budget.
#[derive(Default)]
pub struct Auto {
    /// Methods that propose layouts, beside connected greedy.
    pub proposers: Vec<Box<dyn Proposer>>,
}

/// Proposals that are polished at first: as many searches as differ.
const CANDIDATES: usize = 8;

/// Share of the budget for polishing all of them.
const FIRST_SHARE: f64 = 0.4;

/// Layouts that are polished to the end.
const FINALISTS: usize = 2;

/// Gentle, so that what a proposal knows is not forgotten.
const FIRST_COOLING: Cooling = Cooling { from: 0.06, to: 0.01 };
const FINAL_COOLING: Cooling = Cooling { from: 0.04, to: 0.004 };

/// Hot, for layouts that know nothing of this problem.
const COLD_START_COOLING: Cooling = Cooling { from: 0.2, to: 0.01 };

struct Proposal {
    by: &'static str,
    evaluation: Evaluation,
    layout: Vec<CellId>,
}

impl Solver for Auto {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement {
        let meter = Meter::new(budget);
        let (proposals, mut spent) = self.proposals(problem, seed);
        let mut contributions = contributions(&proposals);
        let informed = proposals.len() > 1;

        let starts = at_least_finalists(chosen(&proposals));
        let first = match meter.left(spent) {
            Budget::Evaluations(left) => Budget::Evaluations((FIRST_SHARE * left as f64) as u64),
            Budget::Seconds(left) => Budget::Seconds(FIRST_SHARE * left),
        };
        let cooling = if informed { FIRST_COOLING } else { COLD_START_COOLING };
        let chains = anneal(problem, &starts, first, cooling, (seed, "placement/auto/first"));
        let (_, evaluations, mut history) = join(problem, &chains, spent);
        spent = evaluations;

        let mut layouts: Vec<(Evaluation, Vec<CellId>)> =
            chains.into_iter().map(|chain| (problem.evaluate(&chain.best), chain.best)).collect();
        layouts.sort_by(|a, b| b.0.compare(&a.0));
        let finalists: Vec<Vec<CellId>> =
            layouts.into_iter().take(FINALISTS).map(|(_, layout)| layout).collect();
        let left = meter.left(spent);
        let chains = anneal(problem, &finalists, left, FINAL_COOLING, (seed, "placement/auto"));
        let (best, evaluations, further) = join(problem, &chains, spent);
        let reached = history.last().map_or(f64::NEG_INFINITY, |&(_, utility)| utility);
        history.extend(further.into_iter().filter(|&(_, utility)| utility > reached));

        contributions.push(Contribution {
            by: "annealing".into(),
            layouts: CANDIDATES as u64,
            best: problem.evaluate(&best),
        });
        let placement = Placement::new(self.name(), problem, best, evaluations, history);
        Placement { contributions, ..placement }
    }
}

impl Auto {
    /// All proposals, and what they cost in evaluations.
    fn proposals(&self, problem: &PlacementProblem, seed: u64) -> (Vec<Proposal>, u64) {
        let (layout, mut spent) = annealing::start(problem);
        let proposal = |by, layout: Vec<CellId>| Proposal {
            by,
            evaluation: problem.evaluate(&layout),
            layout,
        };
        let mut proposals = vec![proposal("connected-greedy", layout)];
        for proposer in &self.proposers {
            let layouts = proposer.propose(problem, seed);
            spent += layouts.len() as u64;
            proposals.extend(layouts.into_iter().map(|layout| proposal(proposer.name(), layout)));
        }
        (proposals, spent)
    }
}

/// The best proposals, no two of the same cells.
fn chosen(proposals: &[Proposal]) -> Vec<Vec<CellId>> {
    let mut order: Vec<&Proposal> = proposals.iter().collect();
    order.sort_by(|a, b| b.evaluation.compare(&a.evaluation));
    let mut starts: Vec<Vec<CellId>> = Vec::new();
    for proposal in order {
        let mut cells = proposal.layout.clone();
        cells.sort_unstable();
        if !starts.contains(&cells) {
            starts.push(cells);
        }
        if starts.len() == CANDIDATES {
            break;
        }
    }
    starts
}

/// Repeats the first layout where there are too few: searches differ all the same.
fn at_least_finalists(mut layouts: Vec<Vec<CellId>>) -> Vec<Vec<CellId>> {
    while layouts.len() < FINALISTS {
        layouts.push(layouts[0].clone());
    }
    layouts
}

/// The best of each proposer.
fn contributions(proposals: &[Proposal]) -> Vec<Contribution> {
    let mut found: Vec<Contribution> = Vec::new();
    for proposal in proposals {
        match found.iter_mut().find(|contribution| contribution.by == proposal.by) {
            Some(contribution) => {
                contribution.layouts += 1;
                if proposal.evaluation.compare(&contribution.best).is_gt() {
                    contribution.best = proposal.evaluation;
                }
            }
            None => found.push(Contribution {
                by: proposal.by.into(),
                layouts: 1,
                best: proposal.evaluation,
            }),
        }
    }
    found
}
