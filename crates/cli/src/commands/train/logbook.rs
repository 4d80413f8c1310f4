//! What every training writes and shows.

use crate::args::TrainPlacementArgs;
use crate::commands::Manner;
use anyhow::{Result, bail};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::{Serialize, de::DeserializeOwned};
use sonarfleet::record::TrainingRecord;
use sonarfleet_learning::files::checkpoint;
use sonarfleet_learning::files::metrics::{TrainingLog, training_run};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Updates between two checkpoints.
const UPDATES_PER_CHECKPOINT: u64 = 20;

/// The folder of a training: its log, its checkpoint, its curve.
pub(super) struct Logbook {
    folder: PathBuf,
    kind: &'static str,
    log: TrainingLog,
    bar: ProgressBar,
    limit: Option<Duration>,
    started: Instant,
    last: Instant,
}

impl Logbook {
    /// The state to go on from, if that was asked for.
    pub(super) fn resumed<S: DeserializeOwned>(
        args: &TrainPlacementArgs,
        kind: &str,
    ) -> Result<Option<S>> {
        let path = checkpoint_path(&args.output);
        if args.resume {
            return Ok(Some(checkpoint::load(&path, kind)?));
        }
        if path.exists() {
            bail!("{} exists: --resume goes on from it", path.display());
        }
        Ok(None)
    }

    /// Opens the folder of a training of which so many updates are done.
    pub(super) fn open(
        args: &TrainPlacementArgs,
        kind: &'static str,
        done: u64,
        manner: Manner,
    ) -> Result<Self> {
        let target = if manner.talkative() {
            ProgressDrawTarget::stderr()
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(None, target);
        let style = ProgressStyle::with_template("{msg} [{bar:24}] {pos}/{len} ETA {eta}");
        bar.set_style(style.expect("the template is a constant"));
        let log = TrainingLog::open(&args.output, done)?;
        let limit = args.seconds.map(Duration::from_secs_f64);
        let (folder, now) = (args.output.clone(), Instant::now());
        Ok(Self { folder, kind, log, bar, limit, started: now, last: now })
    }

    /// Shows how far a stage is.
    pub(super) fn show(&self, done: u64, of: u64, message: String) {
        self.bar.set_length(of);
        self.bar.set_position(done);
        self.bar.set_message(message);
    }

    /// Writes an update down, and now and then what training goes on from.
    pub(super) fn write<S: Serialize>(
        &mut self,
        update: u64,
        step: u64,
        scalars: &[(&str, f64)],
        state: impl FnOnce() -> S,
    ) -> Result<()> {
        let seconds = self.last.elapsed().as_secs_f64();
        self.last = Instant::now();
        self.log.write(update, step, scalars, &[("update", seconds)])?;
        if update.is_multiple_of(UPDATES_PER_CHECKPOINT) {
            self.keep(&state())?;
        }
        Ok(())
    }

    /// Writes a checkpoint.
    pub(super) fn keep<S: Serialize>(&self, state: &S) -> Result<()> {
        Ok(checkpoint::save(&checkpoint_path(&self.folder), self.kind, state)?)
    }

    /// Whether the time is up.
    pub(super) fn time_is_up(&self) -> bool {
        self.limit.is_some_and(|limit| self.started.elapsed() >= limit)
    }

    /// The used share of the time, where it is limited.
    pub(super) fn used(&self) -> Option<f64> {
        self.limit.map(|limit| self.started.elapsed().as_secs_f64() / limit.as_secs_f64())
    }

    /// Draws the curve and ends.
    pub(super) fn close(self, name: &str, threshold: f64, seed: u64) -> Result<()> {
        self.bar.finish_and_clear();
        let record = TrainingRecord {
            name: name.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            connectivity_threshold: threshold,
            runs: vec![training_run(&self.folder, seed)?],
        };
        sonarfleet_report::write_training(&record, self.folder.join("training"))?;
        Ok(())
    }
}

fn checkpoint_path(folder: &Path) -> PathBuf {
    folder.join("checkpoint.bin")
}
