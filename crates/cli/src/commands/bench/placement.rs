//! `bench placement`: what placement methods achieve on the same problems.

use crate::args::BenchPlacementArgs;
use crate::commands::problem::ProblemSource;
use crate::commands::{self, Manner, methods};
use anyhow::{Context, Result};
use serde_json::json;
use sonarfleet::placement::comparison::{Comparison, Summary};
use sonarfleet::placement::{Budget, Method, PlacementInput, PlacementProblem, Solver};
use std::path::Path;

/// Seconds of a trial where neither time nor evaluations are given.
const DEFAULT_SECONDS: f64 = 2.0;

pub(super) fn bench(args: &BenchPlacementArgs, manner: Manner) -> Result<()> {
    let budget = match (args.seconds, args.samples) {
        (_, Some(evaluations)) => Budget::Evaluations(evaluations),
        (seconds, None) => Budget::Seconds(seconds.unwrap_or(DEFAULT_SECONDS)),
    };
    let solvers = args
        .methods
        .iter()
        .map(|name| methods::solver(name.parse::<Method>()?, args.weights.as_deref()))
        .collect::<Result<Vec<Box<dyn Solver>>>>()?;
    let inputs: Vec<Option<&Path>> = if args.inputs.is_empty() {
        vec![None]
    } else {
        args.inputs.iter().map(|path| Some(path.as_path())).collect()
    };
    let note = note(budget, args.seeds);
    if !manner.json {
        commands::say(format_args!("Medians over the seeds; {note}"))?;
    }
    let mut comparisons = Vec::new();
    for path in inputs {
        for (name, problem) in problems(path, args, manner)? {
            let mut comparison = Comparison::new(name, &problem);
            // Methods take turns, so that a busy machine is none's alone.
            for seed in 1..=args.seeds {
                for solver in &solvers {
                    comparison.run(&problem, solver.as_ref(), budget, seed);
                }
            }
            if !manner.json {
                print(&comparison)?;
            }
            comparisons.push(comparison);
        }
    }
    if let Some(figure) = &args.figure {
        let files =
            sonarfleet_report::write_comparison(&comparisons, &note, figure.with_extension(""))?;
        if manner.talkative() {
            for file in files {
                commands::say(format_args!("{}", file.display()))?;
            }
        }
    }
    if manner.json {
        let seconds = if let Budget::Seconds(seconds) = budget { Some(seconds) } else { None };
        commands::print_json(&json!({
            "samples": args.samples,
            "seconds": seconds,
            "threads": rayon::current_num_threads(),
            "problems": comparisons.iter().map(object).collect::<Vec<_>>(),
        }))?;
    }
    Ok(())
}

/// How the trials were run.
fn note(budget: Budget, seeds: u64) -> String {
    let limit = match budget {
        Budget::Evaluations(evaluations) => format!("at most {evaluations} evaluations"),
        Budget::Seconds(seconds) => format!("at most {seconds} s"),
    };
    let seeds = if seeds == 1 { "seed 1".to_owned() } else { format!("seeds 1 to {seeds}") };
    let (threads, version) = (rayon::current_num_threads(), env!("CARGO_PKG_VERSION"));
    format!("{limit} a trial on {threads} threads · {seeds} · sonarfleet {version}")
}

/// The problems of an input by name, one per threshold.
fn problems(
    path: Option<&Path>,
    args: &BenchPlacementArgs,
    manner: Manner,
) -> Result<Vec<(String, PlacementProblem)>> {
    let source = ProblemSource {
        input: path,
        epoch: args.epoch,
        count: args.count,
        threshold: None,
        loss: None,
        communication_loss: None,
        cache: &args.cache,
    };
    let (input, _) = source.input(manner)?;
    let stem = path.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    let name = stem.unwrap_or_else(|| "embedded".to_owned());
    let thresholds = if args.thresholds.is_empty() {
        vec![input.connectivity_threshold]
    } else {
        args.thresholds.clone()
    };
    thresholds
        .into_iter()
        .map(|connectivity_threshold| {
            let input = PlacementInput { connectivity_threshold, ..input.clone() };
            let problem = PlacementProblem::new(&input).with_context(|| source.name())?;
            Ok((name.clone(), problem))
        })
        .collect()
}

/// A comparison with its summaries.
fn object(comparison: &Comparison) -> serde_json::Value {
    let mut object = json!(comparison);
    object["best_found"] = json!(comparison.best_found());
    object["methods"] = json!(comparison.summaries());
    object
}

fn print(comparison: &Comparison) -> Result<()> {
    let best = comparison.best_found().map_or("none".to_owned(), |best| format!("{best:.3}"));
    commands::say(format_args!(
        "\n{}: {} vehicles, τ = {}; best feasible J_d found {best}, at most {:.3}\n\n\
         {:<22} {:>8} {:>8} {:>8} {:>9} {:>7} {:>11} {:>9}",
        comparison.problem,
        comparison.vehicles,
        comparison.connectivity_threshold,
        comparison.upper_bound,
        "method",
        "J_d",
        "λ₂",
        "R",
        "feasible",
        "gap",
        "evaluations",
        "seconds",
    ))?;
    for summary in comparison.summaries() {
        let Summary { method, trials, feasible_share, .. } = &summary;
        let gap = summary.gap.map_or("–".to_owned(), |gap| format!("{:.1} %", 100.0 * gap));
        let feasible = format!("{:.0}/{trials}", feasible_share * *trials as f64);
        commands::say(format_args!(
            "{method:<22} {:>8.3} {:>8.3} {:>8.3} {feasible:>9} {gap:>7} {:>11.0} {:>9.2}",
            summary.detection_utility,
            summary.algebraic_connectivity,
            summary.reward,
            summary.evaluations,
            summary.seconds,
        ))?;
    }
    Ok(())
}
