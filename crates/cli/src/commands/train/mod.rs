//! `sonarfleet train`: policies, with live progress, checkpoints and a curve.

mod logbook;
mod paper;
mod transferable;

use super::Manner;
use crate::args::{PlacementPolicy, TrainCommand};
use anyhow::Result;
use sonarfleet_learning::placement::paper::Process;

pub(crate) fn train(command: &TrainCommand, manner: Manner) -> Result<()> {
    let TrainCommand::Placement(args) = command;
    match args.method {
        PlacementPolicy::Policy => transferable::train(args, manner),
        PlacementPolicy::SequentialPpo => paper::train(args, Process::Sequential, manner),
        PlacementPolicy::ExchangePpo => paper::train(args, Process::Exchange, manner),
    }
}
