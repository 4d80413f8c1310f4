//! `sonarfleet place`: a layout for a scenario's epoch or an instance file.

use super::Manner;
use crate::args::PlaceArgs;
use crate::progress::StageBars;
use anyhow::{Context, Result, bail};
use serde_json::json;
use sonarfleet::mission::{Environment, Theatre, input};
use sonarfleet::placement::instance;
use sonarfleet::placement::{Budget, Method, PlacementInput, PlacementProblem};
use sonarfleet::scenario::PlacementSection;
use std::time::Instant;

pub(crate) fn place(args: &PlaceArgs, manner: Manner) -> Result<()> {
    let instance = args.input.extension().is_some_and(|extension| extension == "npz");
    let (mut problem, defaults) =
        if instance { from_instance(args)? } else { from_scenario(args, manner)? };
    if let Some(count) = args.count {
        problem.vehicles = count;
    }
    let problem =
        PlacementProblem::new(&problem).with_context(|| format!("{}", args.input.display()))?;
    let method: Method = match &args.method {
        Some(name) => name.parse()?,
        None => defaults.method,
    };
    let budget = match (args.seconds, args.samples) {
        (Some(seconds), _) => Budget::Seconds(seconds),
        (None, Some(evaluations)) => Budget::Evaluations(evaluations),
        (None, None) => Budget::Evaluations(defaults.evaluations),
    };
    let started = Instant::now();
    let placement = method.solver().solve(&problem, budget, args.seed.unwrap_or(defaults.seed));
    let seconds = started.elapsed().as_secs_f64();
    let evaluation = placement.evaluation;
    if manner.json {
        return super::print_json(&json!({
            "method": placement.method,
            "cells": placement.cells,
            "detection_utility": evaluation.detection_utility,
            "algebraic_connectivity": evaluation.algebraic_connectivity,
            "feasible": evaluation.feasible,
            "upper_bound": placement.upper_bound,
            "seconds": seconds,
            "evaluations": placement.evaluations,
            "history": placement.history,
        }));
    }
    let verdict = if evaluation.feasible { "feasible" } else { "INFEASIBLE" };
    super::say(format_args!(
        "{}: J_d {:.3} (at most {:.3}), λ₂ {:.4} against {:.4}: {verdict}; {} proposals in {seconds:.2} s",
        placement.method,
        evaluation.detection_utility,
        placement.upper_bound,
        evaluation.algebraic_connectivity,
        problem.connectivity_threshold(),
        placement.evaluations,
    ))?;
    let cells: Vec<String> = placement.cells.iter().map(|cell| cell.0.to_string()).collect();
    super::say(format_args!("cells {}", cells.join(" ")))?;
    Ok(())
}

/// What holds where the command line says nothing.
struct Defaults {
    method: Method,
    evaluations: u64,
    seed: u64,
}

fn from_instance(args: &PlaceArgs) -> Result<(PlacementInput, Defaults)> {
    if args.loss.is_some() || args.communication_loss.is_some() {
        bail!("tables go with a scenario; {} holds its own", args.input.display());
    }
    let section = PlacementSection::default();
    let defaults =
        Defaults { method: section.method.parse()?, evaluations: section.evaluations, seed: 1 };
    Ok((instance::read(&args.input)?, defaults))
}

fn from_scenario(args: &PlaceArgs, manner: Manner) -> Result<(PlacementInput, Defaults)> {
    let mut scenario = super::scenario(Some(&args.input))?;
    super::check_epoch(&scenario, args.epoch)?;
    if let Some(path) = &args.loss {
        scenario.epochs[args.epoch].loss_file = Some(path.clone());
    }
    if let Some(path) = &args.communication_loss {
        scenario.epochs[args.epoch].communication_loss_file = Some(path.clone());
    }
    let theatre = Theatre::of(&scenario)?;
    let cache = super::loss_cache(&args.cache);
    let bars = StageBars::new(!manner.talkative());
    let environment = Environment::at(&scenario, &theatre, args.epoch, cache.as_ref(), &|event| {
        bars.tell(&event, |_, stage| stage.to_string());
    })?;
    let defaults = Defaults {
        method: scenario.method,
        evaluations: scenario.file.placement.evaluations,
        seed: scenario.seed_of(args.epoch),
    };
    let communication = environment.communication_loss.as_ref().map(|loss| &loss.table);
    let input = input(&scenario, &theatre, args.epoch, &environment.loss.table, communication);
    Ok((input, defaults))
}
