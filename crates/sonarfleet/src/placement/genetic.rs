//! A genetic algorithm.

use super::population::{Best, Judgement, Start};
use super::solver::Meter;
use super::{Budget, Placement, PlacementProblem, Solver};
use crate::grid::CellId;
use crate::random::{Stream, stream};
use rand::Rng;
use rand::seq::SliceRandom;
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// A genetic algorithm (Holland 1975; Goldberg 1989) over sets of cells.
///
/// - **Individual**: G distinct deployable cells.
/// - **Selection**: the better one of two drawn from the population, for each parent.
/// - **Crossover**, of a share of the children: cells of both parents stay; the others
///   are drawn from those of one parent only. Children without take after one parent.
/// - **Mutation**, of a share of the children, and of those that would repeat a member
///   of the population: one vehicle moves to a free cell near itself or near another
///   vehicle.
/// - **Succession**: the worst children give way to the elite of their parents'
///   generation.
/// - **Score**: R, Equation (10), under [`SCORING_MULTIPLIER`](super::SCORING_MULTIPLIER).
///
/// Returns the best feasible layout that it saw or, where it saw none, that with the
/// highest R. Children are made and evaluated on all threads, each place among them
/// with its own random stream; every layout counts as one evaluation.
#[derive(Debug, Clone, Copy)]
pub struct Genetic {
    /// Where the population starts.
    pub start: Start,
    /// Members of the population, and children of a generation.
    pub population: NonZeroUsize,
    /// Generations after which it ends, the first included, each of as many evaluations
    /// as there are members; none where only the budget ends it.
    pub generations: Option<u64>,
    /// Probability that a child has two parents.
    pub crossover: f64,
    /// Probability that a child is changed.
    pub mutation: f64,
    /// Share of the population that lives on, from 0 to 1.
    pub elitism: f64,
}

/// Largest distance of a mutation from the cell it looks around, in cells.
const REACH: i64 = 2;

/// Share of the mutations that look around the vehicle itself.
const OWN_NEIGHBOURHOOD: f64 = 0.75;

/// Draws before a mutation is given up: where nearly all cells are taken.
const DRAWS: usize = 50;

/// Mutations before a child is left as one that is there already.
const ATTEMPTS: usize = 5;

impl Genetic {
    /// As the paper ran it: random starts, 500 generations. It does not say how large
    /// its population was.
    pub const PAPER: Self = Self {
        start: Start::Random,
        population: NonZeroUsize::new(100).unwrap(),
        generations: Some(500),
        crossover: 0.8,
        mutation: 0.15,
        elitism: 0.1,
    };
}

impl Default for Genetic {
    /// The paper's algorithm from feasible starts, for as long as the budget lasts.
    fn default() -> Self {
        Self { start: Start::Feasible, generations: None, ..Self::PAPER }
    }
}

impl Solver for Genetic {
    fn name(&self) -> &'static str {
        match self.start {
            Start::Random => "genetic-paper",
            Start::Feasible => "genetic",
        }
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement {
        let meter = Meter::new(budget);
        let size = self.population.get();
        let elite = ((self.elitism * size as f64).round() as usize).min(size);
        let mut streams: Vec<Stream> =
            (0..size as u64).map(|place| stream(seed, "placement/genetic", place)).collect();
        let mut best = Best::default();
        let mut evaluations = 0;
        let mut population: Vec<Individual> = Vec::new();
        for generation in 0..self.generations.unwrap_or(u64::MAX) {
            let count = meter.affordable(evaluations, size);
            if count == 0 {
                break;
            }
            let layouts: Vec<Vec<CellId>> = if generation == 0 {
                self.start.layouts(problem, count, seed)
            } else {
                let child = |random| self.child(problem, &population, random);
                streams[..count].par_iter_mut().map(child).collect()
            };
            let mut children: Vec<Individual> =
                layouts.into_par_iter().map(|cells| Individual::new(problem, cells)).collect();
            for child in &children {
                evaluations += 1;
                best.offer(evaluations, &child.cells, child.judgement);
            }
            population.truncate(elite);
            sort(&mut children);
            children.truncate(size - population.len());
            population.append(&mut children);
            sort(&mut population);
        }
        Placement::new(self.name(), problem, best.cells, evaluations, best.history)
    }
}

impl Genetic {
    fn child(
        &self,
        problem: &PlacementProblem,
        population: &[Individual],
        random: &mut Stream,
    ) -> Vec<CellId> {
        let [one, other] = [(); 2].map(|()| {
            let drawn = [(); 2].map(|()| random.random_range(0..population.len()));
            // The population is sorted.
            &population[drawn[0].min(drawn[1])].cells
        });
        let mut cells = if random.random::<f64>() < self.crossover {
            crossed(one, other, random)
        } else {
            one.clone()
        };
        if random.random::<f64>() < self.mutation {
            mutate(problem, &mut cells, random);
        }
        for _ in 0..ATTEMPTS {
            cells.sort_unstable();
            if population.iter().all(|member| member.cells != cells) {
                break;
            }
            mutate(problem, &mut cells, random);
        }
        cells.sort_unstable();
        cells
    }
}

/// What both have, filled up with what one of them has.
fn crossed(one: &[CellId], other: &[CellId], random: &mut Stream) -> Vec<CellId> {
    let (mut cells, mut single): (Vec<CellId>, Vec<CellId>) =
        one.iter().partition(|cell| other.contains(cell));
    single.extend(other.iter().filter(|cell| !one.contains(cell)));
    let (drawn, _) = single.partial_shuffle(random, one.len() - cells.len());
    cells.extend_from_slice(drawn);
    cells
}

/// Moves one vehicle, if a free cell is found.
fn mutate(problem: &PlacementProblem, cells: &mut [CellId], random: &mut Stream) {
    let grid = problem.grid();
    let (columns, rows) = (grid.columns as i64, grid.rows as i64);
    let slot = random.random_range(0..cells.len());
    for _ in 0..DRAWS {
        let around = if random.random::<f64>() < OWN_NEIGHBOURHOOD {
            cells[slot]
        } else {
            cells[random.random_range(0..cells.len())]
        };
        let (column, row) = grid.column_row(around);
        let column = column as i64 + random.random_range(-REACH..=REACH);
        let row = row as i64 + random.random_range(-REACH..=REACH);
        if !((0..columns).contains(&column) && (0..rows).contains(&row)) {
            continue;
        }
        let cell = CellId((row * columns + column) as usize);
        if !cells.contains(&cell) && problem.deployable().binary_search(&cell).is_ok() {
            cells[slot] = cell;
            return;
        }
    }
}

struct Individual {
    /// Ascending.
    cells: Vec<CellId>,
    judgement: Judgement,
}

impl Individual {
    fn new(problem: &PlacementProblem, mut cells: Vec<CellId>) -> Self {
        cells.sort_unstable();
        let judgement = Judgement::of(problem, &cells);
        Self { cells, judgement }
    }
}

/// The best first; equals stay in their order.
fn sort(individuals: &mut [Individual]) {
    individuals.sort_by(|a, b| b.judgement.score.total_cmp(&a.judgement.score));
}
