//! Connectivity of a layout while it changes.

use super::problem::PlacementProblem;
use crate::grid::CellId;
use crate::sonar::connectivity::ConnectivityTest;

/// The communication graph of a layout, whose exchanges are refused where they would
/// bring its λ₂ below what the caller asks for.
///
/// Most proposals are refused by two upper bounds on λ₂ that cost as much as
/// reading the candidate's links: n/(n−1) times the smallest degree, and the
/// Rayleigh quotient of the present Fiedler vector with its value at the candidate
/// chosen best. The rest are decided by a Cholesky factorisation, whose factor then
/// warm-starts the next Fiedler vector.
#[derive(Debug, Clone)]
pub struct Network<'p> {
    problem: &'p PlacementProblem,
    /// Fixed sensors, then the vehicles in order of their slots.
    stations: Vec<CellId>,
    /// [station, station]
    weights: Vec<f64>,
    degrees: Vec<f64>,
    test: ConnectivityTest,
    fiedler: Fiedler,
    /// Links of the candidate to the stations; degrees after the exchange.
    candidate: Vec<f64>,
    new_degrees: Vec<f64>,
    old_row: Vec<f64>,
}

/// The Fiedler vector and the energy Σ w·(vᵢ − vⱼ)² of each station's links.
#[derive(Debug, Clone)]
struct Fiedler {
    vector: Vec<f64>,
    energies: Vec<f64>,
    energy: f64,
}

/// Feasible layouts are held to a threshold so much above τ that rounding cannot leave
/// them below it.
const MARGIN: f64 = 1e-9;

impl<'p> Network<'p> {
    /// The graph of a layout together with the fixed sensors; none where its λ₂
    /// does not reach the threshold.
    pub fn new(problem: &'p PlacementProblem, layout: &[CellId]) -> Option<Self> {
        let stations: Vec<CellId> = problem.fixed_sensors().iter().chain(layout).copied().collect();
        let n = stations.len();
        let mut weights = Vec::with_capacity(n * n);
        for &p in &stations {
            weights.extend(stations.iter().map(|&q| problem.link(p, q)));
        }
        let degrees = weights.chunks_exact(n).map(|row| row.iter().sum()).collect();
        // Any vector that is not constant leads to Fiedler's.
        let vector = (0..n).map(|i| i as f64).collect();
        let mut network = Self {
            problem,
            stations,
            weights,
            degrees,
            test: ConnectivityTest::default(),
            fiedler: Fiedler { vector, energies: vec![0.0; n], energy: 0.0 },
            candidate: vec![0.0; n],
            new_degrees: vec![0.0; n],
            old_row: vec![0.0; n],
        };
        network.is_feasible().then(|| {
            network.sharpen();
            network
        })
    }

    /// The threshold τ, and a little more for rounding.
    pub fn threshold(&self) -> f64 {
        self.problem.connectivity_threshold() + MARGIN
    }

    /// λ₂ as the present Fiedler vector has it, a hair too high; ∞ for a lone vehicle.
    pub fn connectivity(&self) -> f64 {
        if self.stations.len() == 1 { f64::INFINITY } else { self.fiedler.energy }
    }

    /// Whether λ₂ reaches the threshold, to the last digit.
    pub fn is_feasible(&mut self) -> bool {
        self.passes(self.threshold())
    }

    /// Moves the vehicle in `slot` to `cell`, if λ₂ then exceeds `least`; says
    /// whether it did.
    ///
    /// # Panics
    /// Where there is no such slot.
    pub fn try_exchange(&mut self, slot: usize, cell: CellId, least: f64) -> bool {
        let n = self.stations.len();
        if n == 1 {
            self.stations[0] = cell;
            return true;
        }
        let at = self.problem.fixed_sensors().len() + slot;
        for (link, &station) in self.candidate.iter_mut().zip(&self.stations) {
            *link = self.problem.link(cell, station);
        }
        self.candidate[at] = 0.0;
        if !self.degrees_allow(at, least) || !self.fiedler_allows(at, least) {
            return false;
        }

        self.old_row.copy_from_slice(&self.weights[at * n..(at + 1) * n]);
        self.exchange_links(at);
        std::mem::swap(&mut self.degrees, &mut self.new_degrees);
        if self.passes(least) {
            self.stations[at] = cell;
            self.sharpen();
            true
        } else {
            std::mem::swap(&mut self.degrees, &mut self.new_degrees);
            std::mem::swap(&mut self.candidate, &mut self.old_row);
            self.exchange_links(at);
            false
        }
    }

    /// Writes the candidate's links into row and column `at`.
    fn exchange_links(&mut self, at: usize) {
        let n = self.stations.len();
        self.weights[at * n..(at + 1) * n].copy_from_slice(&self.candidate);
        for (row, &link) in self.weights.chunks_exact_mut(n).zip(&self.candidate) {
            row[at] = link;
        }
    }

    /// Whether λ₂ ≤ n/(n−1) · smallest degree (Fiedler 1973) leaves `least`
    /// within reach; computes the degrees after the exchange.
    fn degrees_allow(&mut self, at: usize, least: f64) -> bool {
        let n = self.stations.len();
        let least = least * (n - 1) as f64 / n as f64;
        let old_row = &self.weights[at * n..(at + 1) * n];
        let mut smallest = f64::INFINITY;
        for (((new, old), link), old_link) in
            self.new_degrees.iter_mut().zip(&self.degrees).zip(&self.candidate).zip(old_row)
        {
            *new = old - old_link + link;
            smallest = smallest.min(*new);
        }
        // The sum afresh, so that no rounding builds up in it.
        let degree: f64 = self.candidate.iter().sum();
        self.new_degrees[at] = degree;
        smallest.min(degree) >= least
    }

    /// Whether the Rayleigh quotient of the old Fiedler vector, with its best value
    /// at the candidate, leaves `least` within reach.
    fn fiedler_allows(&self, at: usize, least: f64) -> bool {
        let n = self.stations.len() as f64;
        let Fiedler { vector, energies, energy } = &self.fiedler;
        let (mut first, mut second) = (0.0, 0.0);
        for (link, value) in self.candidate.iter().zip(vector) {
            first += link * value;
            second += link * value * value;
        }
        let degree = self.new_degrees[at];
        let best = first / degree;
        let numerator = energy - energies[at] + (second - first * best);
        // The vector has length 1 and sums to 0.
        let change = best - vector[at];
        let squares = 1.0 - vector[at] * vector[at] + best * best;
        numerator >= least * (squares - change * change / n)
    }

    fn passes(&mut self, least: f64) -> bool {
        self.stations.len() == 1 || self.test.exceeds(&self.weights, &self.degrees, least)
    }

    /// Brings the Fiedler vector up to date with the factor of the graph that
    /// has just passed.
    fn sharpen(&mut self) {
        const STEPS: usize = 2;
        let n = self.stations.len();
        if n == 1 {
            return;
        }
        let Fiedler { vector, energies, energy } = &mut self.fiedler;
        for _ in 0..STEPS {
            self.test.sharpen(vector);
        }
        for ((own, row), value) in
            energies.iter_mut().zip(self.weights.chunks_exact(n)).zip(vector.iter())
        {
            *own = row
                .iter()
                .zip(vector.iter())
                .map(|(link, other)| link * (value - other) * (value - other))
                .sum();
        }
        *energy = 0.5 * energies.iter().sum::<f64>();
    }
}
