//! Places the fleet of an instance file with every method and prints what each
//! achieves: `place INSTANCE.npz [SECONDS] [SEEDS]`.

use sonarfleet::grid::CellId;
use sonarfleet::placement::annealing::Annealing;
use sonarfleet::placement::coverage::Coverage;
use sonarfleet::placement::greedy::{ConnectedGreedy, Greedy};
use sonarfleet::placement::local_search::LocalSearch;
use sonarfleet::placement::random::RandomSearch;
use sonarfleet::placement::{Budget, PlacementProblem, Solver, instance};
use std::hint::black_box;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let path = arguments.first().ok_or("usage: place INSTANCE.npz [SECONDS] [SEEDS]")?;
    let seconds: f64 = arguments.get(1).map_or(Ok(2.0), |text| text.parse())?;
    let seeds: u64 = arguments.get(2).map_or(Ok(3), |text| text.parse())?;

    let start = Instant::now();
    let problem = PlacementProblem::new(&instance::read(path)?)?;
    println!("{path}: set up in {:.0} ms", start.elapsed().as_secs_f64() * 1e3);
    time_evaluations(&problem);

    let all: [(&dyn Solver, Budget); 5] = [
        (&RandomSearch, Budget::Evaluations(1)),
        (&Greedy, Budget::Seconds(seconds)),
        (&ConnectedGreedy, Budget::Seconds(seconds)),
        (&LocalSearch, Budget::Seconds(seconds)),
        (&Annealing::default(), Budget::Seconds(seconds)),
    ];
    for (solver, budget) in all {
        for seed in 0..seeds {
            let start = Instant::now();
            let placement = solver.solve(&problem, budget, seed);
            let evaluation = placement.evaluation;
            println!(
                "{:>16}  seed {seed}  J_d {:7.4}  λ₂ {:7.4}  feasible {:5}  bound {:.3}  {:5.2} s  {} evaluations",
                solver.name(),
                evaluation.detection_utility,
                evaluation.algebraic_connectivity,
                evaluation.feasible,
                placement.upper_bound,
                start.elapsed().as_secs_f64(),
                placement.evaluations,
            );
        }
    }
    Ok(())
}

/// Prints what a full evaluation and an exchange proposal take.
fn time_evaluations(problem: &PlacementProblem) {
    const REPEATS: u32 = 2000;
    let layout: Vec<CellId> = problem.deployable()[..problem.vehicles()].to_vec();
    let time = |what: &str, run: &mut dyn FnMut()| {
        let start = Instant::now();
        for _ in 0..REPEATS {
            run();
        }
        let each = start.elapsed() / REPEATS;
        println!("{what}: {:.2} µs", each.as_secs_f64() * 1e6);
    };
    time("full evaluation", &mut || drop(black_box(problem.evaluate(black_box(&layout)))));
    time("its λ₂", &mut || drop(black_box(problem.connectivity(black_box(&layout)))));
    let mut coverage = Coverage::new(problem, &layout);
    time("taking a vehicle out and back", &mut || {
        let cell = coverage.remove(7);
        coverage.insert(7, cell);
    });
    let free = problem.deployable()[problem.deployable().len() - 1];
    time("utility of an exchange", &mut || drop(black_box(coverage.utility_with(black_box(free)))));
}
