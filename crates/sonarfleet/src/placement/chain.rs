//! One chain of simulated annealing.

use super::coverage::Coverage;
use super::network::Network;
use super::price::Price;
use super::solver::Meter;
use super::{Budget, PlacementProblem};
use crate::grid::CellId;
use crate::random::Stream;
use rand::Rng;

/// A Markov chain of layouts: a vehicle moves to a free cell near itself, near another
/// vehicle or, now and then, anywhere; layouts pay for λ₂ below τ ([`Price`]). The best
/// layout is the best feasible one.
pub(super) struct Chain<'p> {
    problem: &'p PlacementProblem,
    random: Stream,
    layout: Vec<CellId>,
    taken: Vec<bool>,
    /// The best layout so far.
    pub(super) best: Vec<CellId>,
    /// Proposals so far.
    pub(super) proposals: u64,
    /// Best feasible `J_d` against proposals.
    pub(super) history: Vec<(u64, f64)>,
}

/// Temperatures at start and end, in units of the starting layout's `J_d` per vehicle;
/// geometric in between.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cooling {
    pub(super) from: f64,
    pub(super) to: f64,
}

/// Proposals for one vehicle before the next one is chosen: taking a vehicle out
/// of the coverage costs as much as the utilities of tens of proposals.
const PROPOSALS_PER_VISIT: u64 = 12;

/// Share of the proposals that look around the vehicle itself.
const OWN_NEIGHBOURHOOD: f64 = 0.8;

/// Share of the proposals that look anywhere: cells may be linked by way of the bottom
/// with none between them that is.
const ANYWHERE: f64 = 0.02;

/// Largest distance of a proposal from the cell it looks around, in cells.
const REACH: i64 = 2;

/// Share of the budget for reaching feasibility from a layout that has it not.
const REPAIR_SHARE: f64 = 0.5;

/// Improvements of `J_d` below this are rounding.
const LEAST_IMPROVEMENT: f64 = 1e-5;

impl<'p> Chain<'p> {
    pub(super) fn new(problem: &'p PlacementProblem, start: &[CellId], random: Stream) -> Self {
        let mut taken = vec![true; problem.grid().cell_count()];
        for cell in problem.deployable() {
            taken[cell.0] = start.contains(cell);
        }
        let (layout, best) = (start.to_vec(), start.to_vec());
        Self { problem, random, layout, taken, best, proposals: 0, history: Vec::new() }
    }

    /// Spends a budget of its own. Its best layout is feasible where its start is or
    /// could be made so.
    pub(super) fn run(&mut self, budget: Budget, cooling: Cooling) {
        let meter = Meter::new(budget);
        self.repair(&meter);
        self.best.copy_from_slice(&self.layout);
        if let Some(network) = Network::new(self.problem, &self.layout) {
            self.anneal(&meter, cooling, network);
        }
    }

    /// Exchanges that do not lower λ₂, until the layout is feasible.
    fn repair(&mut self, meter: &Meter) {
        let mut present = self.problem.evaluate(&self.layout);
        while !present.feasible && meter.used(self.proposals) < REPAIR_SHARE {
            self.proposals += 1;
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

    fn anneal(&mut self, meter: &Meter, cooling: Cooling, mut network: Network) {
        let mut coverage = Coverage::new(self.problem, &self.layout);
        let mut utility = coverage.utility();
        let mut best = utility;
        self.history.push((self.proposals, best));
        let scale = utility / self.layout.len() as f64;
        let (hot, cold) = (scale * cooling.from, scale * cooling.to);
        let mut price = Price::new(network.threshold(), scale);
        let first = meter.used(self.proposals);
        loop {
            let used = meter.used(self.proposals);
            if used >= 1.0 {
                return;
            }
            let temperature = hot * (cold / hot).powf((used - first) / (1.0 - first));
            let slot = self.random.random_range(0..self.layout.len());
            coverage.remove(slot);
            for _ in 0..PROPOSALS_PER_VISIT {
                self.proposals += 1;
                let old = self.layout[slot];
                let Some(cell) = self.proposal(old) else { continue };
                let proposed = coverage.utility_with(cell);
                // Metropolis: accepted with probability exp(ΔE / T), E = J_d − price.
                let chance: f64 = self.random.random();
                let worth = utility - price.of(network.connectivity());
                let slack = proposed - (worth + temperature * chance.ln());
                if slack <= 0.0
                    || !network.try_exchange(slot, cell, price.least_connectivity(slack))
                {
                    continue;
                }
                utility = proposed;
                self.layout[slot] = cell;
                self.taken[old.0] = false;
                self.taken[cell.0] = true;
                if utility > best + LEAST_IMPROVEMENT && network.is_feasible() {
                    best = utility;
                    self.best.copy_from_slice(&self.layout);
                    self.history.push((self.proposals, best));
                }
            }
            coverage.insert(slot, self.layout[slot]);
            price.adjust(network.connectivity());
        }
    }

    /// A free cell near the vehicle in `own`, near any other, or anywhere; none where
    /// the draw hits a cell that is not free.
    fn proposal(&mut self, own: CellId) -> Option<CellId> {
        let cell = match self.random.random::<f64>() {
            draw if draw < OWN_NEIGHBOURHOOD => self.near(own),
            draw if draw < 1.0 - ANYWHERE => {
                let other = self.random.random_range(0..self.layout.len());
                self.near(self.layout[other])
            }
            _ => {
                let cells = self.problem.deployable();
                Some(cells[self.random.random_range(0..cells.len())])
            }
        };
        cell.filter(|cell| !self.taken[cell.0])
    }

    /// A cell within reach of another, unless that is off the grid.
    fn near(&mut self, cell: CellId) -> Option<CellId> {
        let grid = self.problem.grid();
        let (column, row) = grid.column_row(cell);
        let column = column as i64 + self.random.random_range(-REACH..=REACH);
        let row = row as i64 + self.random.random_range(-REACH..=REACH);
        let inside =
            (0..grid.columns as i64).contains(&column) && (0..grid.rows as i64).contains(&row);
        inside.then(|| CellId((row * grid.columns as i64 + column) as usize))
    }
}
