//! `bench`: how fast and how good the links of the chain are, beside their peers.

mod acoustics;
mod differences;
mod effort;
mod placement;
mod slices;

use super::Manner;
use crate::args::BenchCommand;
use anyhow::Result;

pub(crate) fn bench(command: &BenchCommand, manner: Manner) -> Result<()> {
    match command {
        BenchCommand::Acoustics(args) => acoustics::bench(args, manner),
        BenchCommand::Placement(args) => placement::bench(args, manner),
    }
}
