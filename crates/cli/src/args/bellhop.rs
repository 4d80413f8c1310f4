use super::positive;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Propagation models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ModelName {
    /// Our own beam tracer, on all cores
    Native,
    #[value(help = "The program $SONARFLEET_BELLHOP, else bellhop.exe or bellhop on the path")]
    Bellhop,
}

/// Arguments of `bellhop`.
#[derive(Debug, Args)]
#[command(after_help = "Writes CASE.shd (fields), CASE.arr (arrivals) or CASE.ray (rays), as the \
    run type asks, and CASE.prt.\n\nExamples:\n  \
    sonarfleet bellhop munk.env                          writes munk.shd\n  \
    sonarfleet bellhop munk --output out                 writes out/munk.shd\n  \
    sonarfleet bellhop munk --compare theirs/munk.shd    and says how far they are apart\n  \
    sonarfleet bellhop munk --model bellhop --output theirs")]
pub(crate) struct BellhopArgs {
    /// Case: CASE.env, with or without the ending, and the files beside it
    #[arg(value_name = "CASE")]
    pub(crate) case: PathBuf,
    /// Directory to write into [default: that of the case]
    #[arg(long, short, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// What computes the field
    #[arg(long, value_enum, default_value = "native")]
    pub(crate) model: ModelName,
    /// Field (.shd) of the same case to compare with: percentiles of the difference in dB
    #[arg(long, value_name = "FILE")]
    pub(crate) compare: Option<PathBuf>,
    /// Seconds after which the external program is killed
    #[arg(long, default_value_t = 3600.0, value_name = "S", value_parser = positive)]
    pub(crate) timeout: f64,
}
