//! Everything a finished run leaves in its directory, but pictures.

use super::epoch_file::write_epoch;
use super::{EpochMetrics, EpochRecord, Provenance, RecordError, RunRecord};
use serde::Serialize;
use std::path::Path;

/// Writes the resolved scenario, provenance, numbers and epochs of a run.
///
/// # Errors
/// If a file cannot be written.
pub fn write_run(
    directory: &Path,
    provenance: &Provenance,
    run: &RunRecord,
) -> Result<(), RecordError> {
    let write = |name: &str, contents: &str| {
        let path = directory.join(name);
        crate::replace_file(&path, contents.as_bytes()).map_err(RecordError::io(path))
    };
    write("scenario.toml", &provenance.scenario)?;
    write("run.json", &json(provenance))?;
    write("metrics.jsonl", &lines(run, |epoch| json(&Numbers::of(epoch))))?;
    write("timings.jsonl", &lines(run, |epoch| json(&epoch.seconds)))?;
    for epoch in &run.epochs {
        write_epoch(&directory.join(format!("epoch-{}.nc", epoch.epoch)), run, epoch)?;
    }
    Ok(())
}

/// A line of `metrics.jsonl`.
#[derive(Serialize)]
struct Numbers<'a> {
    epoch: usize,
    time: &'a str,
    #[serde(flatten)]
    metrics: &'a EpochMetrics,
}

impl<'a> Numbers<'a> {
    fn of(record: &'a EpochRecord) -> Self {
        Self { epoch: record.epoch, time: &record.time, metrics: &record.metrics }
    }
}

fn lines(run: &RunRecord, line: impl Fn(&EpochRecord) -> String) -> String {
    run.epochs.iter().map(|epoch| line(epoch) + "\n").collect()
}

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("records hold nothing that JSON cannot say")
}
