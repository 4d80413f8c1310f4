//! `sonarfleet reproduce`: the paper's figures of placement beside ours.

mod fig3;
mod fig4;
mod fig5;
mod fig6;
mod fig7;
mod incremental;
mod score;
mod study;
mod training;

use super::{Manner, print_json, say};
use crate::args::{Figure, ReproduceArgs};
use anyhow::{Context, Result};
use serde::Serialize;
use serde_json::{Map, Value};
use sonarfleet::placement::SCORING_MULTIPLIER;
use std::path::Path;
use study::Study;

/// A line of the table.
#[derive(Debug, Serialize)]
struct Row {
    figure: &'static str,
    what: String,
    /// As the paper prints it.
    paper: &'static str,
    ours: String,
}

/// What came of a figure.
struct Outcome {
    rows: Vec<Row>,
    /// Its numbers, as it was drawn from them.
    record: Value,
}

/// All that `reproduce.json` holds.
#[derive(Serialize)]
struct Findings {
    version: &'static str,
    problem: String,
    vehicles: usize,
    connectivity_threshold: f64,
    /// Of the shortfall of λ₂ in R.
    multiplier: f64,
    seeds: u64,
    seconds_per_training: f64,
    table: Vec<Row>,
    figures: Map<String, Value>,
}

pub(crate) fn reproduce(args: &ReproduceArgs, manner: Manner) -> Result<()> {
    let mut figures =
        if args.figures.is_empty() { Figure::PAPER.to_vec() } else { args.figures.clone() };
    figures.sort_unstable();
    figures.dedup();
    let mut study = Study::new(args, manner)?;
    let mut findings = Findings {
        version: env!("CARGO_PKG_VERSION"),
        problem: study.name.clone(),
        vehicles: study.problem.vehicles(),
        connectivity_threshold: study.problem.connectivity_threshold(),
        multiplier: SCORING_MULTIPLIER,
        seeds: args.seeds,
        seconds_per_training: args.seconds,
        table: Vec::new(),
        figures: Map::new(),
    };
    // What cannot be written is to be known before hours of training.
    std::fs::create_dir_all(&args.output)
        .with_context(|| format!("cannot make {}", args.output.display()))?;
    findings.save(&args.output)?;
    for figure in figures {
        let (name, draw): (_, fn(&mut Study<'_>, &Path) -> Result<Outcome>) = match figure {
            Figure::Fig3 => ("fig3", fig3::fig3),
            Figure::Fig4 => ("fig4", fig4::fig4),
            Figure::Fig5 => ("fig5", fig5::fig5),
            Figure::Fig6 => ("fig6", fig6::fig6),
            Figure::Fig7 => ("fig7", fig7::fig7),
            Figure::Incremental => ("incremental", incremental::incremental),
        };
        let outcome = draw(&mut study, &args.output.join(name))?;
        findings.table.extend(outcome.rows);
        findings.figures.insert(name.into(), outcome.record);
        findings.save(&args.output)?;
    }
    if manner.json {
        return print_json(&findings);
    }
    findings.print()
}

impl Findings {
    fn save(&self, directory: &Path) -> Result<()> {
        let path = directory.join("reproduce.json");
        let text = serde_json::to_string_pretty(self)?;
        sonarfleet::replace_file(&path, text.as_bytes())
            .with_context(|| format!("cannot write {}", path.display()))
    }

    fn print(&self) -> Result<()> {
        say(format_args!(
            "{}: {} vehicles, τ = {}; R = J_d − {}·(τ − λ₂)₊; medians over {} seed{}, {} s per training\n",
            self.problem,
            self.vehicles,
            self.connectivity_threshold,
            self.multiplier,
            self.seeds,
            if self.seeds == 1 { "" } else { "s" },
            self.seconds_per_training,
        ))?;
        say("| what | paper | ours |\n|---|---|---|")?;
        for Row { figure, what, paper, ours } in &self.table {
            say(format_args!("| {figure}: {what} | {paper} | {ours} |"))?;
        }
        Ok(())
    }
}
