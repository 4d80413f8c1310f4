//! A placement problem from what was typed: a scenario's epoch or an instance file.

use super::Manner;
use crate::args::CacheArgs;
use crate::progress::StageBars;
use anyhow::{Context, Result, bail};
use sonarfleet::mission::{Environment, Theatre, input};
use sonarfleet::placement::{Method, PlacementInput, PlacementProblem, instance};
use sonarfleet::scenario::{PlacementSection, Scenario};
use std::path::Path;

/// Where a problem comes from.
pub(super) struct ProblemSource<'a> {
    /// Scenario or instance; none for the embedded scenario.
    pub(super) input: Option<&'a Path>,
    /// Epoch of a scenario.
    pub(super) epoch: usize,
    /// Vehicles, if not the input's own.
    pub(super) count: Option<usize>,
    /// Required connectivity, if not the input's own.
    pub(super) threshold: Option<f64>,
    /// Tables instead of those of a scenario.
    pub(super) loss: Option<&'a Path>,
    pub(super) communication_loss: Option<&'a Path>,
    pub(super) cache: &'a CacheArgs,
}

/// What holds where the command line says nothing.
pub(super) struct Defaults {
    pub(super) method: Method,
    pub(super) evaluations: u64,
    pub(super) seed: u64,
}

impl ProblemSource<'_> {
    /// The problem, and what its source says of solving it.
    pub(super) fn problem(&self, manner: Manner) -> Result<(PlacementProblem, Defaults)> {
        let (input, defaults) = self.input(manner)?;
        let problem = PlacementProblem::new(&input).with_context(|| self.name())?;
        Ok((problem, defaults))
    }

    /// What the problem is made of.
    pub(super) fn input(&self, manner: Manner) -> Result<(PlacementInput, Defaults)> {
        let instance = self.input.filter(|path| path.extension().is_some_and(|e| e == "npz"));
        let (mut input, defaults) = match instance {
            Some(path) => self.of_instance(path)?,
            None => self.of_scenario(manner)?,
        };
        if let Some(count) = self.count {
            input.vehicles = count;
        }
        if let Some(threshold) = self.threshold {
            input.connectivity_threshold = threshold;
        }
        Ok((input, defaults))
    }

    /// Where it comes from, in words.
    pub(super) fn name(&self) -> String {
        self.input.map_or_else(|| "the embedded scenario".into(), |path| path.display().to_string())
    }

    fn of_instance(&self, path: &Path) -> Result<(PlacementInput, Defaults)> {
        if self.loss.is_some() || self.communication_loss.is_some() {
            bail!("tables go with a scenario; {} holds its own", path.display());
        }
        if self.epoch > 0 {
            bail!(
                "epoch {}: {} is an instance, which has epoch 0 only",
                self.epoch,
                path.display()
            );
        }
        let section = PlacementSection::default();
        let defaults =
            Defaults { method: section.method.parse()?, evaluations: section.evaluations, seed: 1 };
        Ok((instance::read(path)?, defaults))
    }

    fn of_scenario(&self, manner: Manner) -> Result<(PlacementInput, Defaults)> {
        let mut scenario = super::scenario(self.input)?;
        super::check_epoch(&scenario, self.epoch)?;
        if let Some(path) = self.loss {
            scenario.epochs[self.epoch].loss_file = Some(path.to_owned());
        }
        if let Some(path) = self.communication_loss {
            scenario.epochs[self.epoch].communication_loss_file = Some(path.to_owned());
        }
        of_epoch(&scenario, self.epoch, self.cache, manner)
    }
}

/// The problem of a scenario's epoch, and what the scenario says of solving it.
fn of_epoch(
    scenario: &Scenario,
    epoch: usize,
    cache: &CacheArgs,
    manner: Manner,
) -> Result<(PlacementInput, Defaults)> {
    let theatre = Theatre::of(scenario)?;
    let cache = super::loss_cache(cache);
    let bars = StageBars::new(!manner.talkative());
    let environment = Environment::at(scenario, &theatre, epoch, cache.as_ref(), &|event| {
        bars.tell(&event, |_, stage| stage.to_string());
    })?;
    let defaults = Defaults {
        method: scenario.method,
        evaluations: scenario.file.placement.evaluations,
        seed: scenario.seed_of(epoch),
    };
    let communication = environment.communication_loss.as_ref().map(|loss| &loss.table);
    let loss = &environment.loss.table;
    Ok((input(scenario, &theatre, epoch, loss, communication), defaults))
}
