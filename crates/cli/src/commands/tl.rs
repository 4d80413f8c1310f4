//! `sonarfleet tl`: transmission loss from every cell to every cell, whole or in shards.

use super::Manner;
use crate::args::{LossUse as LossUseName, Quality as QualityName, Shard, TlArgs, TlCommand};
use crate::progress::Progress;
use anyhow::{Context, Result, ensure};
use serde_json::json;
use sonarfleet::grid::CellId;
use sonarfleet::mission::{Acoustics, Theatre};
use sonarfleet::scenario::LossUse;
use sonarfleet::sonar::loss_file::{LossRows, read_rows};
use sonarfleet::sonar::transmission_loss::Quality;
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(crate) fn tl(args: &TlArgs, manner: Manner) -> Result<()> {
    match (&args.command, &args.output) {
        (Some(TlCommand::Merge { parts, output }), _) => merge(parts, output, manner),
        (None, output) => {
            let output = output.as_deref().context("--output says which table to write")?;
            compute(args, output, manner)
        }
    }
}

fn compute(args: &TlArgs, output: &Path, manner: Manner) -> Result<()> {
    let mut scenario = super::scenario(args.scenario.as_deref())?;
    if let Some(quality) = args.quality {
        scenario.quality = match quality {
            QualityName::Fast => Quality::Fast,
            QualityName::Standard => Quality::Standard,
            QualityName::Fine => Quality::Fine,
        };
    }
    super::check_epoch(&scenario, args.epoch)?;
    let theatre = Theatre::of(&scenario)?;
    let snapshot = scenario.instant(scenario.epochs[args.epoch].snapshot_h);
    let state = theatre.forecast.at(snapshot)?;
    let purpose = match args.purpose {
        LossUseName::Detection => LossUse::Detection,
        LossUseName::Communication => LossUse::Communication,
    };
    let acoustics = Acoustics::of(&scenario, &theatre, &state, purpose)?;
    let sources = sources(scenario.grid.cell_count(), args.shard);
    let bar = Progress::new("transmission loss", !manner.talkative());
    let cache = super::loss_cache(&args.cache);
    let started = Instant::now();
    let computed = acoustics.rows(&scenario, &sources, cache.as_ref(), &|done, total| {
        bar.set(done, total);
    })?;
    let work = Work { from_cache: computed.from_cache, seconds: started.elapsed().as_secs_f64() };
    drop(bar);
    let rows = LossRows::new(
        acoustics.description(&scenario, &state),
        theatre.cell_degrees.clone(),
        sources,
        computed.rows.concat(),
    );
    rows.write(output)?;
    tell(&rows, output, Some(work), manner)
}

/// What it took to compute rows.
struct Work {
    from_cache: usize,
    seconds: f64,
}

/// The sources of a shard: every n-th, so that shards take equally long.
fn sources(cells: usize, shard: Option<Shard>) -> Vec<CellId> {
    let Shard { index, count } = shard.unwrap_or(Shard { index: 1, count: 1 });
    (index - 1..cells).step_by(count).map(CellId).collect()
}

fn merge(parts: &[PathBuf], output: &Path, manner: Manner) -> Result<()> {
    let parts = parts
        .iter()
        .map(|path| Ok((path.clone(), read_rows(path)?)))
        .collect::<Result<Vec<_>>>()?;
    let whole = LossRows::merge(&parts)?;
    whole.write(output)?;
    tell(&whole, output, None, manner)
}

fn tell(rows: &LossRows, output: &Path, work: Option<Work>, manner: Manner) -> Result<()> {
    ensure!(!rows.sources.is_empty(), "the shard holds no sources");
    let about = &rows.description;
    let mut losses = rows.loss_db.clone();
    losses.sort_by(f32::total_cmp);
    let median_db = losses[losses.len() / 2];
    if manner.json {
        return super::print_json(&json!({
            "output": output,
            "sources": rows.sources.len(),
            "targets": rows.cell_degrees.len(),
            "frequency_hz": about.frequency_hz,
            "directions": about.directions,
            "median_loss_db": median_db,
            "model": about.model,
            "quality": about.quality,
            "beams": about.beams,
            "bearings": about.bearings,
            "fingerprint": about.fingerprint,
            "sources_from_cache": work.as_ref().map(|work| work.from_cache),
            "seconds": work.map(|work| work.seconds),
        }));
    }
    if !manner.quiet {
        let time = match work {
            None => String::new(),
            Some(Work { from_cache: 0, seconds }) => format!(" in {seconds:.1} s"),
            Some(Work { from_cache, seconds }) => {
                format!(" in {seconds:.1} s, {from_cache} rows of them from the cache")
            }
        };
        super::say(format_args!(
            "{}: {} × {} losses at {} Hz{time} ({}: {} beams, {} bearings), median {median_db:.1} dB",
            output.display(),
            rows.sources.len(),
            rows.cell_degrees.len(),
            about.frequency_hz,
            about.quality,
            about.beams,
            about.bearings,
        ))?;
    }
    Ok(())
}
