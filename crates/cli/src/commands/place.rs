//! `sonarfleet place`: a layout for a scenario's epoch or an instance file.

use super::Manner;
use super::problem::ProblemSource;
use crate::args::PlaceArgs;
use anyhow::Result;
use serde_json::json;
use sonarfleet::placement::{Budget, Method, Placement, PlacementProblem};
use std::time::Instant;

pub(crate) fn place(args: &PlaceArgs, manner: Manner) -> Result<()> {
    let source = ProblemSource {
        input: Some(&args.input),
        epoch: args.epoch,
        count: args.count,
        threshold: args.threshold,
        loss: args.loss.as_deref(),
        communication_loss: args.communication_loss.as_deref(),
        cache: &args.cache,
    };
    let (problem, defaults) = source.problem(manner)?;
    let method: Method = match &args.method {
        Some(name) => name.parse()?,
        None => defaults.method,
    };
    let budget = match (args.seconds, args.samples) {
        (Some(seconds), _) => Budget::Seconds(seconds),
        (None, Some(evaluations)) => Budget::Evaluations(evaluations),
        (None, None) => Budget::Evaluations(defaults.evaluations),
    };
    let solver = super::methods::solver(method, args.weights.as_deref())?;
    let started = Instant::now();
    let placement = solver.solve(&problem, budget, args.seed.unwrap_or(defaults.seed));
    let seconds = started.elapsed().as_secs_f64();
    if manner.json {
        return print(&placement, seconds);
    }
    say(&problem, &placement, seconds)
}

fn print(placement: &Placement, seconds: f64) -> Result<()> {
    let evaluation = placement.evaluation;
    super::print_json(&json!({
        "method": placement.method,
        "cells": placement.cells,
        "detection_utility": evaluation.detection_utility,
        "algebraic_connectivity": evaluation.algebraic_connectivity,
        "feasible": evaluation.feasible,
        "upper_bound": placement.upper_bound,
        "seconds": seconds,
        "evaluations": placement.evaluations,
        "contributions": placement.contributions,
        "history": placement.history,
    }))
}

fn say(problem: &PlacementProblem, placement: &Placement, seconds: f64) -> Result<()> {
    let evaluation = placement.evaluation;
    let verdict = if evaluation.feasible { "feasible" } else { "INFEASIBLE" };
    for part in &placement.contributions {
        let note = if part.best.feasible { "" } else { ", infeasible" };
        super::say(format_args!(
            "  {}: J_d {:.3}{note}, the best of {}",
            part.by, part.best.detection_utility, part.layouts,
        ))?;
    }
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
