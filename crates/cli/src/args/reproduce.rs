use super::{CacheArgs, positive};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// The paper's figures of placement, and what it says of them in words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub(crate) enum Figure {
    /// A random layout and optimised ones
    Fig3,
    /// Training of sequential and exchange PPO
    Fig4,
    /// Reward against the required connectivity
    Fig5,
    /// Utility against executed steps
    Fig6,
    /// A policy for a larger fleet, cut short
    Fig7,
    /// Training that goes on from the last epoch's policy, and from scratch
    Incremental,
}

impl Figure {
    /// The paper's.
    pub(crate) const PAPER: [Self; 5] =
        [Self::Fig3, Self::Fig4, Self::Fig5, Self::Fig6, Self::Fig7];
}

/// Arguments of `reproduce`.
#[derive(Debug, Args)]
#[command(
    after_help = "Prints one table, what | paper | ours, and writes every figure as .svg and .png, and\n\
    reproduce.json with all numbers. Every training takes --seconds: fig3 and fig6 need one per seed (the\n\
    same), fig4 four, fig7 two, of which one is among those of fig4; all figures at the defaults take about\n\
    an hour and ten minutes. What is limited by time is not reproducible to the bit.\n\n\
    Examples:\n  \
    sonarfleet reproduce                                     all figures, on the embedded scenario\n  \
    sonarfleet reproduce fig5 --seeds 5                      no training: a few minutes\n  \
    sonarfleet reproduce fig6 --input instance.npz --seconds 60 --output fig6\n  \
    sonarfleet reproduce fig4 fig7 --seeds 1 --json\n  \
    sonarfleet reproduce incremental --input mission.toml --seconds 120"
)]
pub(crate) struct ReproduceArgs {
    /// Figures [default: those of the paper]
    #[arg(value_enum, value_name = "FIGURE")]
    pub(crate) figures: Vec<Figure>,
    /// Scenario (.toml), whose first epoch is used, or placement instance (.npz) [default: the embedded scenario]
    #[arg(long, value_name = "FILE")]
    pub(crate) input: Option<PathBuf>,
    /// Directory to write into
    #[arg(long, short, default_value = "sonarfleet-reproduce", value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// Runs of every method, with the seeds 1 to N
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) seeds: u64,
    /// Wall-clock time of every training
    #[arg(long, default_value_t = 250.0, value_name = "S", value_parser = positive)]
    pub(crate) seconds: f64,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}
