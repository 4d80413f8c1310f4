//! Simulated annealing with exchanges.

use super::coverage::Coverage;
use super::network::Network;
use super::solver::Meter;
use super::{Budget, Placement, PlacementProblem, Solver, compact, greedy};
use crate::grid::CellId;
use crate::random::{Stream, stream};
use rand::Rng;
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Simulated annealing (Kirkpatrick, Gelatt & Vecchi 1983,
/// doi:10.1126/science.220.4598.671) over feasible layouts: a vehicle moves to a
/// free cell near itself or near another vehicle; exchanges that would bring λ₂
/// below τ are refused whatever the temperature, which falls geometrically.
///
/// Starts from connected greedy or, where that is infeasible, from the best disc;
/// where no disc is feasible either, exchanges that raise λ₂ come first. A proposal
/// costs about a microsecond; several chains share the budget.
#[derive(Debug, Clone, Copy)]
pub struct Annealing {
    /// Independent chains; an evaluation budget is divided among them, and they
    /// run on as many threads as there are. The result depends on their number,
    /// not on that of the threads.
    pub chains: NonZeroUsize,
}

impl Default for Annealing {
    fn default() -> Self {
        Self { chains: const { NonZeroUsize::new(2).unwrap() } }
    }
}

/// Temperatures at start and end, in units of the starting layout's `J_d` per vehicle.
const TEMPERATURES: [f64; 2] = [0.2, 0.002];

/// Proposals for one vehicle before the next one is chosen: taking a vehicle out
/// of the coverage costs as much as about ten proposals.
const PROPOSALS_PER_VISIT: u64 = 12;

/// Share of the proposals that look around the vehicle itself.
const OWN_NEIGHBOURHOOD: f64 = 0.6;

/// Largest distance of a proposal from the cell it looks around, in cells.
const REACH: i64 = 3;

/// Share of the budget for reaching feasibility where no simple layout has it.
const REPAIR_SHARE: f64 = 0.5;

/// Improvements of `J_d` below this are rounding.
const LEAST_IMPROVEMENT: f64 = 1e-5;

impl Solver for Annealing {
    fn name(&self) -> &'static str {
        "annealing"
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement {
        let meter = Meter::new(budget);
        let (start, spent) = start(problem);
        let chains = self.chains.get() as u64;
        let results: Vec<Chain> = (0..chains)
            .into_par_iter()
            .map(|index| {
                let random = stream(seed, "placement/annealing", index);
                let mut chain = Chain::new(problem, &start, random, chains, spent);
                chain.run(&meter);
                chain
            })
            .collect();

        let evaluations = spent + results.iter().map(|chain| chain.own).sum::<u64>();
        let history = joined_history(&results);
        let best = results
            .into_iter()
            .map(|chain| (problem.evaluate(&chain.best), chain.best))
            .reduce(|a, b| if b.0.compare(&a.0).is_gt() { b } else { a })
            .map(|(_, layout)| layout)
            .expect("there is at least one chain");
        Placement::new(self.name(), problem, best, evaluations, history)
    }
}

/// A layout to start from, feasible where a simple one is, and its evaluations.
fn start(problem: &PlacementProblem) -> (Vec<CellId>, u64) {
    let (greedy, evaluations, _) = greedy::connected(problem);
    if problem.evaluate(&greedy).feasible {
        return (greedy, evaluations);
    }
    let disc = compact::best_disc(problem);
    let better = problem.evaluate(&disc).compare(&problem.evaluate(&greedy)).is_gt();
    (if better { disc } else { greedy }, evaluations + problem.deployable().len() as u64)
}

/// The best over all chains against the evaluations of all of them.
fn joined_history(chains: &[Chain]) -> Vec<(u64, f64)> {
    let mut points: Vec<(u64, f64)> =
        chains.iter().flat_map(|chain| chain.history.iter().copied()).collect();
    points.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    let mut best = f64::NEG_INFINITY;
    points.retain(|&(_, utility)| {
        let better = utility > best;
        best = best.max(utility);
        better
    });
    points
}

struct Chain<'p> {
    problem: &'p PlacementProblem,
    random: Stream,
    layout: Vec<CellId>,
    taken: Vec<bool>,
    best: Vec<CellId>,
    /// Proposals of this chain.
    own: u64,
    /// Chains that share the budget, and evaluations before they started.
    chains: u64,
    spent: u64,
    history: Vec<(u64, f64)>,
}

impl<'p> Chain<'p> {
    fn new(
        problem: &'p PlacementProblem,
        start: &[CellId],
        random: Stream,
        chains: u64,
        spent: u64,
    ) -> Self {
        let mut taken = vec![true; problem.grid().cell_count()];
        for cell in problem.deployable() {
            taken[cell.0] = start.contains(cell);
        }
        let (layout, best) = (start.to_vec(), start.to_vec());
        Self { problem, random, layout, taken, best, own: 0, chains, spent, history: Vec::new() }
    }

    fn run(&mut self, meter: &Meter) {
        self.repair(meter);
        self.best.copy_from_slice(&self.layout);
        if let Some(network) = Network::new(self.problem, &self.layout) {
            self.anneal(meter, network);
        }
    }

    /// Evaluations of all chains, taken to be equally far.
    fn evaluations(&self) -> u64 {
        self.spent + self.own * self.chains
    }

    /// Exchanges that do not lower λ₂, until the layout is feasible.
    fn repair(&mut self, meter: &Meter) {
        let mut present = self.problem.evaluate(&self.layout);
        while !present.feasible && meter.used(self.evaluations()) < REPAIR_SHARE {
            self.own += 1;
            let slot = self.random.random_range(0..self.layout.len());
            let old = self.layout[slot];
            let Some(cell) = self.proposal(old) else { continue };
            self.layout[slot] = cell;
            let proposed = self.problem.evaluate(&self.layout);
            if proposed.compare(&present).is_ge() {
                present = proposed;
                self.taken[old.0] = false;
                self.taken[cell.0] = true;
            } else {
                self.layout[slot] = old;
            }
        }
    }

    fn anneal(&mut self, meter: &Meter, mut network: Network) {
        let mut coverage = Coverage::new(self.problem, &self.layout);
        let mut utility = coverage.utility();
        let mut best = utility;
        self.history.push((self.evaluations(), best));
        let [hot, cold] = TEMPERATURES.map(|share| share * utility / self.layout.len() as f64);
        let first = meter.used(self.evaluations());
        loop {
            let used = meter.used(self.evaluations());
            if used >= 1.0 {
                return;
            }
            let temperature = hot * (cold / hot).powf((used - first) / (1.0 - first));
            let slot = self.random.random_range(0..self.layout.len());
            coverage.remove(slot);
            for _ in 0..PROPOSALS_PER_VISIT {
                self.own += 1;
                let old = self.layout[slot];
                let Some(cell) = self.proposal(old) else { continue };
                let proposed = coverage.utility_with(cell);
                // Metropolis: accepted with probability exp(ΔJ / T).
                let chance: f64 = self.random.random();
                if proposed <= utility + temperature * chance.ln()
                    || !network.try_exchange(slot, cell)
                {
                    continue;
                }
                utility = proposed;
                self.layout[slot] = cell;
                self.taken[old.0] = false;
                self.taken[cell.0] = true;
                if utility > best + LEAST_IMPROVEMENT {
                    best = utility;
                    self.best.copy_from_slice(&self.layout);
                    self.history.push((self.evaluations(), best));
                }
            }
            coverage.insert(slot, self.layout[slot]);
        }
    }

    /// A free cell near the vehicle in `own` or near any other; none where the
    /// draw hits a cell that is not free.
    fn proposal(&mut self, own: CellId) -> Option<CellId> {
        let grid = self.problem.grid();
        let around = if self.random.random::<f64>() < OWN_NEIGHBOURHOOD {
            own
        } else {
            self.layout[self.random.random_range(0..self.layout.len())]
        };
        let (column, row) = grid.column_row(around);
        let column = column as i64 + self.random.random_range(-REACH..=REACH);
        let row = row as i64 + self.random.random_range(-REACH..=REACH);
        let inside =
            (0..grid.columns as i64).contains(&column) && (0..grid.rows as i64).contains(&row);
        let cell = CellId((row * grid.columns as i64 + column) as usize);
        (inside && !self.taken[cell.0]).then_some(cell)
    }
}
