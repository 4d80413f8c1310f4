use super::CacheArgs;
use super::positive;
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;

/// `train …`.
#[derive(Debug, Subcommand)]
pub(crate) enum TrainCommand {
    /// Train a policy that places the fleet
    Placement(TrainPlacementArgs),
}

/// Policies that place the fleet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlacementPolicy {
    /// One policy for any problem, trained over practice oceans; or fine-tuned on INPUT
    Policy,
    /// The paper's: one vehicle per step, trained on INPUT
    SequentialPpo,
    /// The paper's comparison: exchanges of cells, trained on INPUT
    ExchangePpo,
}

/// Settings of the paper's policies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Preset {
    /// Table 1 of the paper, literally
    Paper,
    /// The same network, better trained
    Ours,
}

/// How `policy` begins without weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Scratch {
    /// Imitates annealed layouts of INPUT first
    Taught,
    /// Has nothing but its reward
    Untaught,
}

/// Arguments of `train placement`.
#[derive(Debug, Args)]
#[command(
    after_help = "Writes checkpoint.bin, metrics.jsonl, timings.jsonl, TensorBoard events, training.png and .svg, and\n\
    the policy as .onnx (and .weights, which `place --weights` takes).\n\nExamples:\n  \
    sonarfleet train placement --output policy                  the policy that ships, as its header says\n  \
    sonarfleet train placement --output policy --resume         goes on where it was stopped\n  \
    sonarfleet train placement instance.npz --method sequential-ppo --preset paper --seconds 250 --output ppo\n  \
    sonarfleet train placement instance.npz --scratch taught --seconds 250 --output alone\n  \
    sonarfleet train placement mission.toml --epoch 1 --from policy/policy.weights --output tuned"
)]
pub(crate) struct TrainPlacementArgs {
    /// Scenario (.toml) or placement instance (.npz) to train on [default for `policy`: practice oceans]
    pub(crate) input: Option<PathBuf>,
    /// Directory to write into
    #[arg(long, short, value_name = "DIR")]
    pub(crate) output: PathBuf,
    /// What to train
    #[arg(long, value_enum, default_value = "policy")]
    pub(crate) method: PlacementPolicy,
    /// Settings of sequential-ppo and exchange-ppo
    #[arg(long, value_enum, default_value = "ours")]
    pub(crate) preset: Preset,
    /// Seed of all randomness
    #[arg(long, default_value_t = 1, value_name = "N")]
    pub(crate) seed: u64,
    /// Go on from the checkpoint in the directory
    #[arg(long)]
    pub(crate) resume: bool,
    #[arg(
        long,
        value_name = "FILE",
        help = "Policy to start from: .weights of `policy`, or the checkpoint.bin of one of the others"
    )]
    pub(crate) from: Option<PathBuf>,
    /// Train `policy` on INPUT alone, from random weights [default: from those that ship]
    #[arg(long, value_enum, value_name = "HOW", requires = "input", conflicts_with = "from")]
    pub(crate) scratch: Option<Scratch>,
    /// Updates of proximal policy optimisation [default: as the settings say]
    #[arg(long, value_name = "N")]
    pub(crate) updates: Option<usize>,
    /// Stop after this time; not reproducible
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) seconds: Option<f64>,
    /// Practice oceans to train over
    #[arg(long, default_value_t = 84, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) oceans: u64,
    /// Where practice oceans are kept [default: beside the cache of transmission loss]
    #[arg(long, value_name = "DIR")]
    pub(crate) ocean_store: Option<PathBuf>,
    /// Epoch of a scenario, from 0
    #[arg(long, default_value_t = 0, value_name = "K")]
    pub(crate) epoch: usize,
    /// Number of vehicles of INPUT [default: its own]
    #[arg(long, value_name = "G")]
    pub(crate) count: Option<usize>,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}
