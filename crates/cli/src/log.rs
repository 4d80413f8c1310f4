//! Logs: warnings on standard error, and everything in the directory of a run.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use tracing_subscriber::filter::LevelFilter;
use tracing_subscriber::fmt::layer;
use tracing_subscriber::prelude::*;

/// The log of the present run, if there is one.
static RUN_LOG: Mutex<Option<File>> = Mutex::new(None);

/// Starts logging.
pub(crate) fn start() {
    let warnings = layer().without_time().with_writer(io::stderr).with_filter(LevelFilter::WARN);
    let everything = layer().with_ansi(false).with_writer(|| RunLog).with_filter(LevelFilter::INFO);
    tracing_subscriber::registry().with(warnings).with(everything).init();
}

/// Logs into `run.log` of a run directory from here on; a resumed run goes on in it.
pub(crate) fn also_into(directory: &Path) -> io::Result<()> {
    let file = File::options().create(true).append(true).open(directory.join("run.log"))?;
    *RUN_LOG.lock().unwrap_or_else(PoisonError::into_inner) = Some(file);
    Ok(())
}

/// Writes to the log of the present run, or nowhere.
struct RunLog;

impl Write for RunLog {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match RUN_LOG.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            Some(file) => file.write(bytes),
            None => Ok(bytes.len()),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match RUN_LOG.lock().unwrap_or_else(PoisonError::into_inner).as_mut() {
            Some(file) => file.flush(),
            None => Ok(()),
        }
    }
}
