//! Particle swarm optimisation.

use super::population::{Best, Judgement, Start};
use super::solver::Meter;
use super::{Budget, Placement, PlacementProblem, Solver};
use crate::grid::CellId;
use crate::random::{Stream, stream};
use rand::Rng;
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Particle swarm optimisation with a global best (Kennedy & Eberhart 1995,
/// doi:10.1109/ICNN.1995.488968; with inertia, Shi & Eberhart 1998,
/// doi:10.1109/ICEC.1998.699146) over continuous positions of the vehicles.
///
/// - **State** of a particle: 2G coordinates in cells, (column, row) of each vehicle
///   within [0, columns] × [0, rows]; as many velocities, in cells per iteration; and
///   the position at which it scored best.
/// - **Decoding**: vehicle by vehicle, the cell around its coordinates; where that is
///   taken or not deployable, the nearest cell that is free, to whose centre the
///   vehicle then moves.
/// - **Move**: v ← w·v + c₁·u₁·(own best − x) + c₂·u₂·(swarm's best − x), x ← x + v, with
///   u₁, u₂ uniform within [0, 1) for each coordinate. At the edge of the grid a vehicle
///   stops.
/// - **Score**: R, Equation (10), under [`SCORING_MULTIPLIER`](super::SCORING_MULTIPLIER).
/// - **Start**: vehicles at their cells' centres, velocities uniform within ±½.
///
/// Returns the best feasible layout that it saw or, where it saw none, that with the
/// highest R. Particles are evaluated on all threads, each with its own random
/// stream; every layout counts as one evaluation.
#[derive(Debug, Clone, Copy)]
pub struct ParticleSwarm {
    /// Where the particles start.
    pub start: Start,
    /// Number of particles.
    pub particles: NonZeroUsize,
    /// Iterations after which it ends, each of as many evaluations as there are
    /// particles; none where only the budget ends it.
    pub iterations: Option<u64>,
    /// Share of its velocity that a vehicle keeps, w.
    pub inertia: f64,
    /// Pull towards the particle's own best position, c₁.
    pub cognitive: f64,
    /// Pull towards the swarm's best position, c₂.
    pub social: f64,
}

impl ParticleSwarm {
    /// As the paper ran it: random starts, 2000 iterations.
    pub const PAPER: Self = Self {
        start: Start::Random,
        particles: NonZeroUsize::new(30).unwrap(),
        iterations: Some(2000),
        inertia: 0.9,
        cognitive: 0.5,
        social: 0.3,
    };
}

impl Default for ParticleSwarm {
    /// The paper's swarm from feasible starts, for as long as the budget lasts.
    fn default() -> Self {
        Self { start: Start::Feasible, iterations: None, ..Self::PAPER }
    }
}

impl Solver for ParticleSwarm {
    fn name(&self) -> &'static str {
        match self.start {
            Start::Random => "particle-swarm-paper",
            Start::Feasible => "particle-swarm",
        }
    }

    fn solve(&self, problem: &PlacementProblem, budget: Budget, seed: u64) -> Placement {
        let meter = Meter::new(budget);
        let decoder = Decoder::new(problem);
        let layouts = self.start.layouts(problem, self.particles.get(), seed);
        let mut swarm: Vec<Particle> = layouts
            .iter()
            .zip(0..)
            .map(|(layout, index)| {
                let random = stream(seed, "placement/particle-swarm", index);
                Particle::new(problem, layout, random)
            })
            .collect();
        let mut leader = swarm[0].position.clone();
        let mut highest = f64::NEG_INFINITY;
        let mut best = Best::default();
        let mut evaluations = 0;
        for iteration in 0..self.iterations.unwrap_or(u64::MAX) {
            let count = meter.affordable(evaluations, swarm.len());
            if count == 0 {
                break;
            }
            let moving = &mut swarm[..count];
            let found: Vec<(Vec<CellId>, Judgement)> = moving
                .par_iter_mut()
                .map(|particle| {
                    if iteration > 0 {
                        self.advance(particle, &leader, decoder.size);
                    }
                    let layout = decoder.layout(&mut particle.position);
                    let judgement = Judgement::of(problem, &layout);
                    particle.remember(judgement.score);
                    (layout, judgement)
                })
                .collect();
            for (particle, (layout, judgement)) in moving.iter().zip(found) {
                evaluations += 1;
                best.offer(evaluations, &layout, judgement);
                if judgement.score > highest {
                    highest = judgement.score;
                    leader.copy_from_slice(&particle.position);
                }
            }
        }
        Placement::new(self.name(), problem, best.cells, evaluations, best.history)
    }
}

impl ParticleSwarm {
    fn advance(&self, particle: &mut Particle, leader: &[f64], size: [f64; 2]) {
        let Particle { random, position, velocity, best_position, .. } = particle;
        for (k, (x, v)) in position.iter_mut().zip(velocity).enumerate() {
            let (own, common): (f64, f64) = (random.random(), random.random());
            *v = self.inertia * *v
                + self.cognitive * own * (best_position[k] - *x)
                + self.social * common * (leader[k] - *x);
            *x += *v;
            if !(0.0..=size[k % 2]).contains(x) {
                *x = x.clamp(0.0, size[k % 2]);
                *v = 0.0;
            }
        }
    }
}

struct Particle {
    random: Stream,
    /// Column and row of one vehicle after the other.
    position: Vec<f64>,
    velocity: Vec<f64>,
    best_position: Vec<f64>,
    best_score: f64,
}

impl Particle {
    fn new(problem: &PlacementProblem, layout: &[CellId], mut random: Stream) -> Self {
        let centre = |cell: &CellId| {
            let (column, row) = problem.grid().column_row(*cell);
            [column as f64 + 0.5, row as f64 + 0.5]
        };
        let position: Vec<f64> = layout.iter().flat_map(centre).collect();
        let velocity = position.iter().map(|_| random.random::<f64>() - 0.5).collect();
        let best_position = position.clone();
        Self { random, position, velocity, best_position, best_score: f64::NEG_INFINITY }
    }

    /// Remembers the position where it is the best so far.
    fn remember(&mut self, score: f64) {
        if score > self.best_score {
            self.best_score = score;
            self.best_position.copy_from_slice(&self.position);
        }
    }
}

/// Turns coordinates into layouts.
struct Decoder {
    /// Columns and rows.
    size: [f64; 2],
    columns: i64,
    rows: i64,
    deployable: Vec<bool>,
    /// Steps in columns and rows, the shortest first.
    steps: Vec<(i64, i64)>,
}

impl Decoder {
    fn new(problem: &PlacementProblem) -> Self {
        let grid = problem.grid();
        let mut deployable = vec![false; grid.cell_count()];
        for cell in problem.deployable() {
            deployable[cell.0] = true;
        }
        let (columns, rows) = (grid.columns as i64, grid.rows as i64);
        let mut steps: Vec<(i64, i64)> =
            (1 - rows..rows).flat_map(|y| (1 - columns..columns).map(move |x| (x, y))).collect();
        let length_m = |&(x, y): &(i64, i64)| {
            (x as f64 * grid.cell_width_m).hypot(y as f64 * grid.cell_height_m)
        };
        steps.sort_by(|a, b| length_m(a).total_cmp(&length_m(b)));
        let size = [grid.columns as f64, grid.rows as f64];
        Self { size, columns, rows, deployable, steps }
    }

    /// The layout of a position; vehicles that do not get the cell around them move to
    /// the centre of the one they get.
    fn layout(&self, position: &mut [f64]) -> Vec<CellId> {
        let mut free = self.deployable.clone();
        let mut place = |at: &mut [f64]| {
            // What stands on the far edge belongs to the last cell.
            let column = (at[0] as i64).min(self.columns - 1);
            let row = (at[1] as i64).min(self.rows - 1);
            let &(east, north) = self
                .steps
                .iter()
                .find(|(east, north)| {
                    self.cell(column + east, row + north).is_some_and(|cell| free[cell.0])
                })
                .expect("a problem has at least as many deployable cells as vehicles");
            let (column, row) = (column + east, row + north);
            if (east, north) != (0, 0) {
                at.copy_from_slice(&[column as f64 + 0.5, row as f64 + 0.5]);
            }
            let cell = CellId((row * self.columns + column) as usize);
            free[cell.0] = false;
            cell
        };
        position.chunks_exact_mut(2).map(&mut place).collect()
    }

    fn cell(&self, column: i64, row: i64) -> Option<CellId> {
        let inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&row);
        inside.then(|| CellId((row * self.columns + column) as usize))
    }
}
