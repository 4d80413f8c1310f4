//! `sonarfleet run`: the closed loop, from a scenario to a report.

use super::Manner;
use crate::args::RunArgs;
use crate::progress::StageBars;
use anyhow::Result;
use serde_json::json;
use sonarfleet::mission::{Event, Mission, Theatre};
use sonarfleet::navigation::{NamedRoute, write_routes};
use sonarfleet::record::{
    Checkpoint, EpochRecord, LossTableMetrics, PlacementPart, Provenance, RunDirectory, RunRecord,
    write_run,
};
use sonarfleet::scenario::Scenario;
use sonarfleet::sonar::transmission_loss::LossCache;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(crate) fn run(args: &RunArgs, manner: Manner) -> Result<()> {
    let started = Instant::now();
    let mut scenario = super::scenario(args.scenario.as_deref())?;
    if let Some(seed) = args.seed {
        scenario.file.seed = seed;
    }
    if let Some(name) = &args.method {
        scenario.method = name.parse()?;
        scenario.file.placement.method.clone_from(name);
    }
    let output = args.output.clone().unwrap_or_else(first_free);
    let directory =
        if args.resume { RunDirectory::resume(&output) } else { RunDirectory::create(&output) }?;
    let cache = super::loss_cache(&args.cache);
    match run_in(&directory, &scenario, cache.as_ref(), manner) {
        Ok(record) => {
            let whole = directory.finish()?;
            conclude(&record, &whole, started.elapsed().as_secs_f64(), manner)
        }
        Err(error) if Checkpoint::exists(directory.path()) => Err(error.context(format!(
            "the epochs done so far are kept in {}; continue with --resume",
            directory.path().display()
        ))),
        Err(error) => {
            directory.discard()?;
            Err(error)
        }
    }
}

/// The first of sonarfleet-run-1, -2, … that is free.
fn first_free() -> PathBuf {
    let mut k = 1;
    loop {
        let path = PathBuf::from(format!("sonarfleet-run-{k}"));
        if !path.exists() && !path.with_extension("partial").exists() {
            return path;
        }
        k += 1;
    }
}

/// Runs all epochs that are not done yet and writes everything down.
fn run_in(
    directory: &RunDirectory,
    scenario: &Scenario,
    loss_cache: Option<&LossCache>,
    manner: Manner,
) -> Result<RunRecord> {
    crate::log::also_into(directory.path())?;
    tracing::info!(version = env!("CARGO_PKG_VERSION"), scenario = scenario.file.name);
    let provenance =
        Provenance::new(scenario.resolved(), scenario.file.seed, scenario.input_files())?;
    let theatre = Theatre::of(scenario)?;
    let solver = super::methods::solver(scenario.method, None)?;
    let planner = scenario.planner();
    let mission = Mission {
        scenario,
        theatre: &theatre,
        solver: solver.as_ref(),
        planner: planner.as_ref(),
        loss_cache,
    };
    let mut state =
        Checkpoint::load(directory.path(), &provenance.fingerprint)?.unwrap_or_else(|| {
            Checkpoint {
                fingerprint: provenance.fingerprint.clone(),
                fleet: scenario.fleet.clone(),
                epochs: Vec::new(),
            }
        });
    for epoch in state.epochs.len()..scenario.epochs.len() {
        let teller = Teller::new(manner, scenario.epochs.len());
        let (record, fleet) =
            mission.run_epoch(epoch, &state.fleet, &|event| teller.tell(event))?;
        state.fleet = fleet;
        state.epochs.push(record);
        state.save(directory.path())?;
    }
    let record = mission.run_record(state.epochs);
    write_run(directory.path(), &provenance, &record)?;
    export_routes(directory.path(), scenario, &record)?;
    sonarfleet_report::write_figures(&record, directory.path().join("figures"))?;
    sonarfleet_report::write_report(&record, directory.path().join("report.html"))?;
    Checkpoint::remove(directory.path())?;
    Ok(record)
}

/// The way of every vehicle over the whole run, in every format.
fn export_routes(directory: &Path, scenario: &Scenario, record: &RunRecord) -> Result<()> {
    let names: Vec<String> = (0..scenario.fleet.len()).map(|k| format!("vehicle {k}")).collect();
    let tracks: Vec<_> = (0..names.len()).map(|vehicle| record.track(vehicle)).collect();
    let statuses: Vec<&str> = (0..names.len()).map(|vehicle| record.status(vehicle)).collect();
    let named: Vec<NamedRoute<'_>> = (0..names.len())
        .map(|k| NamedRoute { name: &names[k], status: statuses[k], points: &tracks[k] })
        .collect();
    for extension in ["geojson", "kml", "gpx", "csv"] {
        let path = directory.join("routes").with_extension(extension);
        write_routes(path, &named, &scenario.frame, scenario.start)?;
    }
    Ok(())
}

/// Tells of an epoch as it goes.
struct Teller {
    manner: Manner,
    epochs: usize,
    bars: StageBars,
}

impl Teller {
    fn new(manner: Manner, epochs: usize) -> Self {
        Self { manner, epochs, bars: StageBars::new(!manner.talkative()) }
    }

    fn tell(&self, event: Event<'_>) {
        match event {
            Event::Finished { stage, seconds } => tracing::info!(%stage, seconds),
            Event::Epoch(record) => tracing::info!("{}", summary(record, self.epochs)),
            _ => {}
        }
        let epochs = self.epochs;
        self.bars.tell(&event, |epoch, stage| format!("epoch {}/{epochs} {stage}", epoch + 1));
        if let Event::Epoch(record) = event
            && self.manner.talkative()
        {
            // A reader that has gone away must not stop the run.
            drop(super::say(summary(record, epochs)));
        }
    }
}

/// An epoch in a few lines.
fn summary(record: &EpochRecord, epochs: usize) -> String {
    let numbers = &record.metrics;
    let verdict = if numbers.feasible { "feasible" } else { "INFEASIBLE" };
    let times: Vec<String> =
        record.seconds.iter().map(|(stage, seconds)| format!("{stage} {seconds:.1} s")).collect();
    format!(
        "epoch {}/{epochs}  {}  J_d {:.2} of at most {:.2}, λ₂ {:.3} ({verdict}); \
         {} of {} vehicles on their posts, mean travel time {:.1} h\n{}  \
         transmission loss: {}\n{}  {}",
        record.epoch + 1,
        record.time,
        numbers.detection_utility,
        numbers.upper_bound,
        numbers.algebraic_connectivity,
        numbers.arrived,
        record.routes.len(),
        numbers.mean_travel_time_h,
        placement_summary(&numbers.placement_parts),
        loss_summary(&numbers.transmission_loss),
        numbers.communication_loss.as_ref().map_or_else(String::new, |loss| {
            format!("  communication loss: {}\n", loss_summary(loss))
        }),
        times.join(", "),
    )
}

/// What each part of the placement method contributed; nothing where it has one part.
fn placement_summary(parts: &[PlacementPart]) -> String {
    let part = |part: &PlacementPart| {
        let note = if part.feasible { "" } else { " (infeasible)" };
        format!("{} {:.2}{note}", part.by, part.detection_utility)
    };
    match parts {
        [] => String::new(),
        parts => {
            let parts: Vec<String> = parts.iter().map(part).collect();
            format!("  placement: J_d of {}\n", parts.join(", "))
        }
    }
}

/// How a table was made, and how far it is from the best.
fn loss_summary(loss: &LossTableMetrics) -> String {
    let difference = if loss.sampled_sources == 0 {
        "not compared with fine settings".to_owned()
    } else {
        format!(
            "median {:.2}, p90 {:.2} dB (over {} sources) from fine settings",
            loss.median_error_db, loss.p90_error_db, loss.sampled_sources
        )
    };
    if loss.model == "file" {
        return format!("from a file, at {} Hz; {difference}", loss.frequency_hz);
    }
    let directions = if loss.both_directions { ", both directions" } else { "" };
    format!(
        "{}, {} Hz, {} beams, {} bearings{directions}, to {:.1} km; {difference}",
        loss.model,
        loss.frequency_hz,
        loss.beams,
        loss.bearings,
        loss.range_m / 1000.0,
    )
}

fn conclude(record: &RunRecord, directory: &Path, seconds: f64, manner: Manner) -> Result<()> {
    if manner.json {
        let epochs: Vec<_> = record.epochs.iter().map(epoch_json).collect();
        super::print_json(&json!({ "directory": directory, "epochs": epochs, "seconds": seconds }))
    } else {
        super::say(format_args!(
            "{:.0} s. Report: {}",
            seconds,
            directory.join("report.html").display()
        ))?;
        Ok(())
    }
}

fn epoch_json(record: &EpochRecord) -> serde_json::Value {
    let seconds: serde_json::Map<String, serde_json::Value> =
        record.seconds.iter().map(|(stage, seconds)| (stage.clone(), json!(seconds))).collect();
    let mut object = json!(record.metrics);
    object["epoch"] = json!(record.epoch);
    object["time"] = json!(record.time);
    object["seconds"] = json!(seconds);
    object
}
