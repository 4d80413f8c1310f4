//! The policy that serves any problem: over practice oceans, or fine-tuned on one.

use super::logbook::Logbook;
use crate::args::{Scratch, TrainPlacementArgs};
use crate::commands::problem::ProblemSource;
use crate::commands::{Manner, cache_directory, print_json, say};
use crate::progress::Progress as Bar;
use anyhow::{Context, Result};
use clap::ValueEnum;
use serde_json::json;
use sonarfleet::curriculum::{OceanStore, PracticeTable, practice_problem};
use sonarfleet::placement::{Budget, PlacementProblem, Solver};
use sonarfleet_learning::files::write_whole;
use sonarfleet_learning::placement::transferable::{
    Network, Practice, Progress, School, Training, TrainingSettings, TransferablePolicy,
};

const KIND: &str = "training/placement/policy";

pub(super) fn train(args: &TrainPlacementArgs, manner: Manner) -> Result<()> {
    let kept: Option<Training> = Logbook::resumed(args, KIND)?;
    let Some(path) = &args.input else {
        let tables = practice_tables(args, manner)?;
        let practice = |index| practice_on(&tables, args.seed, index);
        let defaults = TrainingSettings { seed: args.seed, ..TrainingSettings::default() };
        let settings = settings(args, defaults);
        let training = match (kept, &args.from) {
            (Some(kept), _) => kept,
            (None, Some(from)) => Training::improving(Network::load(from)?, settings),
            (None, None) => Training::new(settings),
        };
        let training = run(args, training, &practice, 1.0, manner)?;
        return finish(args, &training, None, manner);
    };
    let source = ProblemSource {
        input: Some(path),
        epoch: args.epoch,
        count: args.count,
        threshold: None,
        loss: None,
        communication_loss: None,
        cache: &args.cache,
    };
    let (problem, _) = source.problem(manner)?;
    let practice = |_| problem.clone();
    let training = if let Some(kept) = kept { kept } else { begin(args)? };
    let training = run(args, training, &practice, 1.0, manner)?;
    finish(args, &training, Some(&problem), manner)
}

/// A training on one problem.
fn begin(args: &TrainPlacementArgs) -> Result<Training> {
    let with = |defaults| settings(args, defaults);
    Ok(match (args.scratch, &args.from) {
        (Some(Scratch::Taught), _) => Training::new(with(TrainingSettings::one_problem(args.seed))),
        (Some(Scratch::Untaught), _) => {
            Training::new(with(TrainingSettings::one_problem_untaught(args.seed)))
        }
        (None, from) => {
            let network = match from {
                Some(from) => Network::load(from)?,
                None => TransferablePolicy::shipped().network,
            };
            Training::improving(network, with(TrainingSettings::fine_tuning(args.seed)))
        }
    })
}

/// The defaults, but for what the command line says.
fn settings(args: &TrainPlacementArgs, mut defaults: TrainingSettings) -> TrainingSettings {
    if let Some(updates) = args.updates {
        defaults.updates = updates;
    }
    defaults
}

fn practice_tables(args: &TrainPlacementArgs, manner: Manner) -> Result<Vec<PracticeTable>> {
    let directory = match &args.ocean_store {
        Some(directory) => directory.clone(),
        None => cache_directory()
            .context("there is no cache directory: name one with --ocean-store")?
            .join("practice-oceans"),
    };
    let bar = Bar::new("practice oceans", !manner.talkative());
    let store = OceanStore::new(directory);
    let tables = store.tables(args.seed, args.oceans, &|done, of| {
        bar.set(done as usize, of as usize);
    })?;
    Ok(tables)
}

fn practice_on(tables: &[PracticeTable], seed: u64, index: u64) -> PlacementProblem {
    let input = practice_problem(seed, index, tables).expect("practice oceans give problems");
    PlacementProblem::new(&input).expect("practice problems are valid")
}

fn run(
    args: &TrainPlacementArgs,
    mut training: Training,
    practice: &Practice<'_>,
    threshold: f64,
    manner: Manner,
) -> Result<Training> {
    let mut logbook = Logbook::open(args, KIND, training.updates_done(), manner)?;
    let mut school = School::default();
    while !logbook.time_is_up() {
        let Some(progress) = training.step(practice, &mut school) else { break };
        match progress {
            Progress::Taught { done, of } => {
                logbook.show(done as u64, of as u64, "problems solved to imitate".into());
                logbook.keep(&training)?;
            }
            Progress::Imitated { done, of, loss, entropy } => {
                let message = format!("imitation: loss {loss:.3}, entropy {entropy:.2}");
                logbook.show(done as u64, of as u64, message);
                let scalars = [("imitation_loss", loss), ("entropy", entropy)];
                let update = training.updates_done();
                logbook.write(update, training.episodes(), &scalars, || training.clone())?;
            }
            Progress::Improved { done, of, reward, detection_utility, .. } => {
                let Progress::Improved {
                    detected,
                    connectivity,
                    feasible,
                    entropy,
                    approx_kl,
                    clip_fraction,
                    ..
                } = progress
                else {
                    continue;
                };
                let message = format!(
                    "PPO: reward {reward:.2}, J_d {detection_utility:.2}, λ₂/τ {connectivity:.2}, \
                     feasible {feasible:.2}, KL {approx_kl:.4}, entropy {entropy:.2}"
                );
                logbook.show(done as u64, of as u64, message);
                let scalars = [
                    ("reward", reward),
                    ("detection_utility", detection_utility),
                    ("detected_share", detected),
                    ("algebraic_connectivity", connectivity),
                    ("feasible_share", feasible),
                    ("entropy", entropy),
                    ("approx_kl", approx_kl),
                    ("clip_fraction", clip_fraction),
                ];
                let update = training.updates_done();
                logbook.write(update, training.episodes(), &scalars, || training.clone())?;
            }
        }
    }
    logbook.keep(&training)?;
    logbook.close("placement policy", threshold, args.seed)?;
    Ok(training)
}

fn finish(
    args: &TrainPlacementArgs,
    training: &Training,
    problem: Option<&PlacementProblem>,
    manner: Manner,
) -> Result<()> {
    let network = training.network();
    let weights = args.output.join("policy.weights");
    network.save(&weights, &command(args), args.seed)?;
    write_whole(&args.output.join("policy.onnx"), &network.to_onnx())?;
    let placement = problem.map(|problem| {
        TransferablePolicy::new(network).solve(problem, Budget::Evaluations(0), args.seed)
    });
    if manner.json {
        let evaluation = placement.map(|placement| placement.evaluation);
        return print_json(&json!({
            "weights": weights,
            "updates": training.updates_done(),
            "episodes": training.episodes(),
            "evaluation": evaluation,
        }));
    }
    say(format_args!("{} after {} episodes", weights.display(), training.episodes()))?;
    if let Some(placement) = placement {
        let found = placement.evaluation;
        let verdict = if found.feasible { "feasible" } else { "INFEASIBLE" };
        let (utility, lambda) = (found.detection_utility, found.algebraic_connectivity);
        say(format_args!("it places: J_d {utility:.3}, λ₂ {lambda:.4}, {verdict}"))?;
    }
    Ok(())
}

/// The command that makes the same weights again.
fn command(args: &TrainPlacementArgs) -> String {
    let mut words = vec!["sonarfleet train placement".to_owned()];
    if let Some(input) = &args.input {
        let name = input.file_name().unwrap_or(input.as_os_str());
        words.push(name.to_string_lossy().into_owned());
    } else {
        words.push(format!("--oceans {}", args.oceans));
    }
    words.push(format!("--seed {}", args.seed));
    if let Some(how) = args.scratch.and_then(|how| how.to_possible_value()) {
        words.push(format!("--scratch {}", how.get_name()));
    }
    if let Some(updates) = args.updates {
        words.push(format!("--updates {updates}"));
    }
    if let Some(seconds) = args.seconds {
        words.push(format!("--seconds {seconds}"));
    }
    if args.from.is_some() {
        words.push("--from …".into());
    }
    words.join(" ")
}
