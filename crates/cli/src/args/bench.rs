use clap::{Args, Subcommand};
use std::path::PathBuf;

/// `bench …`.
#[derive(Debug, Subcommand)]
pub(crate) enum BenchCommand {
    /// Transmission loss beside a real BELLHOP, over a firm and a muddy bottom
    Acoustics(BenchAcousticsArgs),
}

/// Arguments of `bench acoustics`.
#[derive(Debug, Args)]
#[command(
    after_help = "BELLHOP is looked for in $SONARFLEET_BELLHOP, then as bellhop.exe on the path.\n\n\
        Example:\n  SONARFLEET_BELLHOP=/opt/bellhop.exe sonarfleet bench acoustics --json"
)]
pub(crate) struct BenchAcousticsArgs {
    /// Scenario whose first epoch is used [default: the embedded one]
    pub(crate) scenario: Option<PathBuf>,
    /// Slices on which both programs take turns
    #[arg(long, default_value_t = 24, value_name = "N", value_parser = at_least_one)]
    pub(crate) slices: usize,
    /// Sources whose rows are timed
    #[arg(long, default_value_t = 120, value_name = "N", value_parser = at_least_one)]
    pub(crate) sources: usize,
    /// Sources whose rows are compared with the quality `fine`
    #[arg(long, default_value_t = 12, value_name = "N", value_parser = at_least_one)]
    pub(crate) compared: usize,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count) if count > 0 => Ok(count),
        _ => Err("expected a number from 1 up".into()),
    }
}
