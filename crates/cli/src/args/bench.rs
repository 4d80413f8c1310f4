use super::{CacheArgs, methods, not_negative, positive};
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// `bench …`.
#[derive(Debug, Subcommand)]
pub(crate) enum BenchCommand {
    /// Transmission loss beside a real BELLHOP, over a firm and a muddy bottom
    Acoustics(BenchAcousticsArgs),
    /// Placement methods side by side: what each achieves in the same time
    Placement(BenchPlacementArgs),
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

/// Arguments of `bench placement`.
#[derive(Debug, Args)]
#[command(
    after_help = "The table shows medians over the seeds: J_d, λ₂, and R = J_d − 30·max(0, τ − λ₂), of feasible\n\
        and infeasible layouts alike; the gap is that of the feasible ones to the upper bound.\n\n\
        Examples:\n  sonarfleet bench placement\n  \
        sonarfleet bench placement *.npz --method annealing,genetic --seconds 10 --figure methods.svg\n  \
        sonarfleet bench placement a.npz --method particle-swarm-paper --samples 60000 --threshold 0.93,0.95,0.97"
)]
pub(crate) struct BenchPlacementArgs {
    /// Placement instances (.npz) or scenarios (.toml) [default: the embedded scenario]
    #[arg(value_name = "INPUT")]
    pub(crate) inputs: Vec<PathBuf>,
    #[arg(
        long = "method",
        value_name = "M",
        value_delimiter = ',',
        default_value = "connected-greedy,local-search,annealing,particle-swarm,genetic,policy,auto",
        help = format!("Methods, repeated or with commas between: {}", methods())
    )]
    pub(crate) methods: Vec<String>,
    /// Seeds, from 1 on
    #[arg(long, default_value_t = 3, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) seeds: u64,
    /// Time limit of a trial; not reproducible [default: 2]
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) seconds: Option<f64>,
    /// Budget of a trial in evaluated proposals instead
    #[arg(long, value_name = "N", conflicts_with = "seconds")]
    pub(crate) samples: Option<u64>,
    /// Required algebraic connectivities τ, repeated or with commas between [default: the input's]
    #[arg(long = "threshold", value_name = "TAU", value_delimiter = ',', value_parser = not_negative)]
    pub(crate) thresholds: Vec<f64>,
    /// Number of vehicles [default: the input's]
    #[arg(long, value_name = "G")]
    pub(crate) count: Option<usize>,
    /// Epoch of a scenario, from 0
    #[arg(long, default_value_t = 0, value_name = "K")]
    pub(crate) epoch: usize,
    /// Weights of `policy`, as `train placement` writes them [default: those that ship]
    #[arg(long, value_name = "FILE")]
    pub(crate) weights: Option<PathBuf>,
    /// Figure to write, as .svg and .png
    #[arg(long, value_name = "FILE")]
    pub(crate) figure: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(count) if count > 0 => Ok(count),
        _ => Err("expected a number from 1 up".into()),
    }
}
