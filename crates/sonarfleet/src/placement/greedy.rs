//! Layouts built one vehicle at a time.

use super::coverage::Coverage;
use super::{Budget, Evaluation, Placement, PlacementProblem, Solver};
use crate::grid::CellId;

/// Always the cell with the largest gain, without regard to connectivity: within
/// a factor 1 − 1/e of the best *unconstrained* layout (Nemhauser, Wolsey & Fisher
/// 1978, doi:10.1007/BF01588971), and usually infeasible. Takes G·N evaluations.
#[derive(Debug, Clone, Copy, Default)]
pub struct Greedy;

impl Solver for Greedy {
    fn name(&self) -> &'static str {
        "greedy"
    }

    fn solve(&self, problem: &PlacementProblem, _budget: Budget, _seed: u64) -> Placement {
        let (cells, evaluations) = build(problem, 0.0);
        Placement::new(self.name(), problem, cells, evaluations, Vec::new())
    }
}

/// Always the cell with the largest gain among those whose links to the vehicles
/// and fixed sensors already there add up to a required degree (all of them while
/// none reaches it). Layouts are built for each of [`REQUIRED_DEGREES`]; the best
/// is kept. Takes ten times G·N evaluations; often, but not always, feasible.
#[derive(Debug, Clone, Copy, Default)]
pub struct ConnectedGreedy;

/// Required degrees in multiples of the connectivity threshold τ. λ₂ falls as a
/// layout stretches, so a long fleet needs more links per vehicle than τ.
const REQUIRED_DEGREES: [f64; 10] = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];

impl Solver for ConnectedGreedy {
    fn name(&self) -> &'static str {
        "connected-greedy"
    }

    fn solve(&self, problem: &PlacementProblem, _budget: Budget, _seed: u64) -> Placement {
        let (cells, evaluations, history) = connected(problem);
        Placement::new(self.name(), problem, cells, evaluations, history)
    }
}

/// The best connected greedy layout, evaluations, and the curve up to it.
pub(super) fn connected(problem: &PlacementProblem) -> (Vec<CellId>, u64, Vec<(u64, f64)>) {
    let mut evaluations = 0;
    let mut history: Vec<(u64, f64)> = Vec::new();
    let layouts: Vec<(Evaluation, Vec<CellId>)> = REQUIRED_DEGREES
        .iter()
        .map(|multiple| {
            let required = multiple * problem.connectivity_threshold();
            let (layout, further) = build(problem, required);
            let evaluation = problem.evaluate(&layout);
            evaluations += further;
            let best = history.last().map_or(f64::NEG_INFINITY, |&(_, utility)| utility);
            if evaluation.feasible && evaluation.detection_utility > best {
                history.push((evaluations, evaluation.detection_utility));
            }
            (evaluation, layout)
        })
        .collect();
    let (_, layout) = layouts
        .into_iter()
        .max_by(|(a, _), (b, _)| a.compare(b))
        .expect("there is a layout for each required degree");
    (layout, evaluations, history)
}

/// A greedy layout and its evaluations.
fn build(problem: &PlacementProblem, required_degree: f64) -> (Vec<CellId>, u64) {
    let deployable = problem.deployable();
    let mut coverage = Coverage::new(problem, &[]);
    let mut degrees: Vec<f64> = deployable
        .iter()
        .map(|&cell| problem.fixed_sensors().iter().map(|&other| problem.link(cell, other)).sum())
        .collect();
    let mut free = vec![true; deployable.len()];
    let mut evaluations = 0;
    for slot in 0..problem.vehicles() {
        // Not more than the present stations could give.
        let stations = problem.fixed_sensors().len() + slot;
        let required = required_degree.min(REACHABLE_SHARE * stations as f64);
        let near = |at: &usize| free[*at] && degrees[*at] >= required;
        let mut eligible: Vec<usize> = (0..deployable.len()).filter(near).collect();
        if eligible.is_empty() {
            eligible = (0..deployable.len()).filter(|&at| free[at]).collect();
            // Where nothing is near enough, the nearest.
            let most = eligible.iter().map(|&at| degrees[at]).fold(0.0, f64::max);
            eligible.retain(|&at| degrees[at] >= most);
        }
        evaluations += eligible.len() as u64;
        let utility = |at: usize| coverage.utility_with(deployable[at]);
        let (best, _) = eligible
            .iter()
            .map(|&at| (at, utility(at)))
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .expect("a problem has at least as many deployable cells as vehicles");
        coverage.insert(slot, deployable[best]);
        free[best] = false;
        for (degree, &cell) in degrees.iter_mut().zip(deployable) {
            *degree += problem.link(cell, deployable[best]);
        }
    }
    (coverage.layout().to_vec(), evaluations)
}

/// Share of the stations already there to which a new vehicle can be asked to have
/// perfect links while there are few.
const REACHABLE_SHARE: f64 = 0.8;
