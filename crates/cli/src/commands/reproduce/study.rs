//! What all figures share: the problem, the methods, and trainings that serve several
//! of them.

use super::score::Score;
use super::training::{Course, Trained};
use crate::args::ReproduceArgs;
use crate::commands::problem::ProblemSource;
use crate::commands::{Manner, methods};
use crate::progress::Progress;
use anyhow::{Context, Result};
use sonarfleet::grid::CellId;
use sonarfleet::placement::{Budget, Method, PlacementInput, PlacementProblem};
use std::rc::Rc;
use std::time::Instant;

/// A method to compare with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contestant {
    /// Name of the method.
    pub(super) method: &'static str,
    /// The same in words.
    pub(super) words: &'static str,
    /// Budget.
    pub(super) evaluations: u64,
}

const fn contestant(method: &'static str, words: &'static str, evaluations: u64) -> Contestant {
    Contestant { method, words, evaluations }
}

/// The paper's deployment by chance.
pub(super) const RANDOM: Contestant = contestant("random", "Random layout", 1);
/// It draws as many layouts as it does, whatever the budget.
pub(super) const POLICY: Contestant = contestant("policy", "Policy, no training", 1);
/// Its proposals are changes of a layout, which cost a fraction of an evaluation.
pub(super) const AUTO: Contestant = contestant("auto", "Auto", 1_000_000);
pub(super) const ANNEALING: Contestant = contestant("annealing", "Annealing", 1_000_000);
/// 30 particles and 2000 iterations.
pub(super) const SWARM: Contestant =
    contestant("particle-swarm", "PSO, feasible starts", 30 * 2001);
/// It ends by itself.
pub(super) const SWARM_PAPER: Contestant =
    contestant("particle-swarm-paper", "PSO as the paper ran it", u64::MAX);
/// 500 generations of 100.
pub(super) const GENETIC: Contestant = contestant("genetic", "GA, feasible starts", 501 * 100);
/// It ends by itself.
pub(super) const GENETIC_PAPER: Contestant =
    contestant("genetic-paper", "GA as the paper ran it", u64::MAX);

impl Contestant {
    /// Whether the program knows the method.
    pub(super) fn is_known(&self) -> bool {
        self.method.parse::<Method>().is_ok()
    }
}

/// What a method found with a seed.
#[derive(Debug, Clone)]
pub(super) struct Solved {
    pub(super) cells: Vec<CellId>,
    pub(super) score: Score,
    pub(super) seconds: f64,
}

/// The problem and what is known of it so far.
pub(super) struct Study<'a> {
    source: ProblemSource<'a>,
    manner: Manner,
    /// The problem in words.
    pub(super) name: String,
    pub(super) input: PlacementInput,
    pub(super) problem: PlacementProblem,
    /// Number of runs of every method.
    pub(super) seeds: u64,
    /// Time of a training.
    pub(super) seconds: f64,
    trained: Vec<(Course, Rc<[Trained]>)>,
}

impl<'a> Study<'a> {
    pub(super) fn new(args: &'a ReproduceArgs, manner: Manner) -> Result<Self> {
        let name = args.input.as_ref().map_or_else(
            || "Embedded scenario, epoch 0".to_owned(),
            |path| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
        );
        let source = ProblemSource {
            input: args.input.as_deref(),
            epoch: 0,
            count: None,
            threshold: None,
            loss: None,
            communication_loss: None,
            cache: &args.cache,
        };
        let (input, _) = source.input(manner)?;
        let problem = PlacementProblem::new(&input).with_context(|| name.clone())?;
        let (seeds, seconds) = (args.seeds, args.seconds);
        Ok(Self { source, manner, name, input, problem, seeds, seconds, trained: Vec::new() })
    }

    /// The problem when the ocean and the prior have moved on.
    pub(super) fn next_epoch(&self) -> Result<PlacementProblem> {
        let source = ProblemSource { epoch: 1, ..self.source };
        Ok(source.problem(self.manner)?.0)
    }

    /// The problem for another fleet or another required connectivity.
    pub(super) fn with(&self, vehicles: usize, threshold: f64) -> Result<PlacementProblem> {
        let input =
            PlacementInput { vehicles, connectivity_threshold: threshold, ..self.input.clone() };
        let what = || format!("{} with {vehicles} vehicles and τ = {threshold}", self.name);
        PlacementProblem::new(&input).with_context(what)
    }

    /// What a method finds on a problem, seed by seed; nothing where the program does
    /// not know the method.
    pub(super) fn solve(
        &self,
        contestant: Contestant,
        problem: &PlacementProblem,
    ) -> Result<Vec<Solved>> {
        let Ok(method) = contestant.method.parse::<Method>() else { return Ok(Vec::new()) };
        let solver = methods::solver(method, None)?;
        let budget = Budget::Evaluations(contestant.evaluations);
        let one = |seed| {
            let _bar = self.bar(contestant.words, seed);
            let started = Instant::now();
            let cells = solver.solve(problem, budget, seed).cells;
            let seconds = started.elapsed().as_secs_f64();
            Solved { score: Score::of(problem, &cells), cells, seconds }
        };
        Ok((1..=self.seeds).map(one).collect())
    }

    /// A policy of the paper trained with every seed. Figures share trainings.
    pub(super) fn trained(&mut self, course: Course) -> Result<Rc<[Trained]>> {
        if let Some((_, trained)) = self.trained.iter().find(|(known, _)| *known == course) {
            return Ok(Rc::clone(trained));
        }
        let problem = self.with(course.vehicles, self.problem.connectivity_threshold())?;
        let one = |seed| {
            let _bar = self.bar(&course.words(), seed);
            course.train(&problem, self.seconds, seed)
        };
        let trained: Rc<[Trained]> = (1..=self.seeds).map(one).collect::<Result<_>>()?;
        self.trained.push((course, Rc::clone(&trained)));
        Ok(trained)
    }

    pub(super) fn bar(&self, what: &str, seed: u64) -> Progress {
        let quiet = !self.manner.talkative();
        Progress::new(&format!("{what}, seed {seed} of {}", self.seeds), quiet)
    }
}

/// Their scores.
pub(super) fn scores(solved: &[Solved]) -> Vec<Score> {
    solved.iter().map(|solved| solved.score).collect()
}
