//! `sonarfleet train`: policies, with live progress, checkpoints and a curve.

mod logbook;
mod paper;
mod transferable;

use super::Manner;
use crate::args::{PlacementPolicy, TrainCommand};
use anyhow::{Result, ensure};
use sonarfleet_learning::placement::paper::Process;

pub(crate) fn train(command: &TrainCommand, manner: Manner) -> Result<()> {
    let TrainCommand::Placement(args) = command;
    ensure!(
        args.scratch.is_none() || args.method == PlacementPolicy::Policy,
        "--scratch goes with --method policy: the paper's policies begin from nothing anyway"
    );
    match args.method {
        PlacementPolicy::Policy => transferable::train(args, manner),
        PlacementPolicy::SequentialPpo => paper::train(args, Process::Sequential, manner),
        PlacementPolicy::ExchangePpo => paper::train(args, Process::Exchange, manner),
    }
}
