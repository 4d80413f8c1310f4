//! One file per command: each reads what was typed, makes one call, and prints.

pub(crate) mod assign;
pub(crate) mod bellhop;
pub(crate) mod bench;
pub(crate) mod check;
pub(crate) mod init;
pub(crate) mod ocean;
pub(crate) mod place;
pub(crate) mod reproduce;
pub(crate) mod route;
pub(crate) mod run;
pub(crate) mod tl;
pub(crate) mod train;

mod methods;
mod problem;

use crate::args::CacheArgs;
use anyhow::{Result, ensure};
use serde::Serialize;
use sonarfleet::scenario::Scenario;
use sonarfleet::sonar::transmission_loss::LossCache;
use sonarfleet::sonar::transmission_loss::TableModel;
use sonarfleet_acoustics::bellhop::abandon_all;
use std::fmt::Display;
use std::io::Write;
use std::path::{Path, PathBuf};

/// How to speak to the user.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Manner {
    /// One JSON object on standard output.
    pub(crate) json: bool,
    /// Results and errors only.
    pub(crate) quiet: bool,
}

impl Manner {
    /// Whether progress and summaries are wanted.
    pub(crate) const fn talkative(self) -> bool {
        !self.json && !self.quiet
    }
}

/// The scenario of a path, or the embedded one.
fn scenario(path: Option<&Path>) -> Result<Scenario> {
    let scenario = match path {
        Some(path) => Scenario::read(path)?,
        None => Scenario::embedded(),
    };
    if matches!(scenario.loss_model, TableModel::Bellhop(_)) {
        abandon_programs_on_interrupt()?;
    }
    Ok(scenario)
}

/// At an interrupt, external programs end with us, and their directories go.
fn abandon_programs_on_interrupt() -> Result<()> {
    let handler = || {
        abandon_all();
        std::process::exit(130);
    };
    match ctrlc::set_handler(handler) {
        Ok(()) | Err(ctrlc::Error::MultipleHandlers) => Ok(()),
        Err(error) => Err(error.into()),
    }
}

/// Where computed transmission loss is kept, if it is.
fn loss_cache(args: &CacheArgs) -> Option<LossCache> {
    if args.no_cache {
        return None;
    }
    Some(LossCache::new(cache_directory()?.join("transmission-loss")))
}

/// Where results that took long are kept.
fn cache_directory() -> Option<PathBuf> {
    let named = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    let own = named("SONARFLEET_CACHE").map(PathBuf::from);
    // The XDG specification has relative paths ignored.
    let xdg = || named("XDG_CACHE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
    let home = || std::env::home_dir().map(|home| home.join(".cache"));
    own.or_else(|| Some(xdg().or_else(home)?.join("sonarfleet")))
}

/// Prints a line of results. Unlike `println!` it does not panic where nobody reads.
fn say(line: impl Display) -> Result<()> {
    Ok(writeln!(std::io::stdout().lock(), "{line}")?)
}

/// Prints one JSON object.
fn print_json(object: &impl Serialize) -> Result<()> {
    say(serde_json::to_string_pretty(object)?)
}

/// Refuses an epoch that the scenario does not have.
fn check_epoch(scenario: &Scenario, epoch: usize) -> Result<()> {
    let last = scenario.epochs.len() - 1;
    ensure!(epoch <= last, "--epoch {epoch}: the scenario has epochs 0 to {last}");
    Ok(())
}
