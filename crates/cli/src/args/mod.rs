//! What can be typed: the command line, as clap parses it.

mod bellhop;
mod bench;
mod reproduce;
mod train;

pub(crate) use bellhop::{BellhopArgs, ModelName};
pub(crate) use bench::{BenchAcousticsArgs, BenchCommand, BenchPlacementArgs};
pub(crate) use reproduce::{Figure, ReproduceArgs};
pub(crate) use train::{PlacementPolicy, Preset, Scratch, TrainCommand, TrainPlacementArgs};

use clap::{Args, Parser, Subcommand, ValueEnum};
use sonarfleet::placement::Method;
use sonarfleet_acoustics::environment::Seabed;
use std::path::PathBuf;

/// Where a fleet of listening underwater vehicles should be, and how it gets there.
#[derive(Debug, Parser)]
#[command(
    name = "sonarfleet",
    version,
    after_help = "Examples:\n  \
        sonarfleet run                              the embedded scenario, end to end\n  \
        sonarfleet init mission.toml                a commented scenario to start from\n  \
        sonarfleet check mission.toml               what is wrong with it, in plain words\n  \
        sonarfleet run mission.toml --output out    the closed loop; open out/report.html"
)]
pub(crate) struct Cli {
    /// Print one JSON object on standard output and nothing else there
    #[arg(long, global = true)]
    pub(crate) json: bool,
    /// No progress, no summary: results and errors only
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Threads to use; results do not depend on it [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// One per job.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run the closed loop over all epochs: a run directory, figures and report
    Run(RunArgs),
    /// Write a commented scenario
    Init(InitArgs),
    /// Say in plain words what is wrong with a scenario
    Check(CheckArgs),
    /// Look into ocean files, or make a synthetic ocean
    #[command(subcommand)]
    Ocean(OceanCommand),
    /// Compute the transmission loss from every cell to every cell
    Tl(TlArgs),
    /// Run a case of the BELLHOP family: a drop-in for bellhop.exe
    Bellhop(BellhopArgs),
    /// Place the fleet on a scenario's epoch or on an instance file
    Place(PlaceArgs),
    /// Travel through the currents of a scenario or an instance file
    Route(RouteArgs),
    /// Assign vehicles to posts, given a matrix of costs
    Assign(AssignArgs),
    /// Train the policies that place the fleet
    #[command(subcommand)]
    Train(TrainCommand),
    /// Print the paper's placement results beside ours, and draw its figures
    Reproduce(ReproduceArgs),
    /// Measure how fast and how good we are, beside our peers
    #[command(subcommand)]
    Bench(BenchCommand),
}

/// Whether computed transmission loss is kept.
#[derive(Debug, Args)]
pub(crate) struct CacheArgs {
    /// Neither read nor keep computed transmission loss
    #[arg(
        long,
        help = "Neither read nor keep computed transmission loss [kept in: $SONARFLEET_CACHE, \
            else $XDG_CACHE_HOME/sonarfleet, else ~/.cache/sonarfleet]"
    )]
    pub(crate) no_cache: bool,
}

/// Arguments of `run`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  sonarfleet run\n  sonarfleet run mission.toml --output out\n  \
    sonarfleet run mission.toml --output out --resume    continue a killed run"
)]
pub(crate) struct RunArgs {
    /// Scenario [default: the embedded one]
    pub(crate) scenario: Option<PathBuf>,
    /// Run directory to create [default: the first free sonarfleet-run-1, -2, …]
    #[arg(long, short, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Continue a killed run of the same scenario
    #[arg(long, requires = "output")]
    pub(crate) resume: bool,
    /// Seed of all randomness [default: the scenario's]
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    #[arg(
        long,
        value_name = "M",
        help = format!("Method of placement: {} [default: the scenario's]", methods())
    )]
    pub(crate) method: Option<String>,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

/// Arguments of `init`.
#[derive(Debug, Args)]
pub(crate) struct InitArgs {
    /// File to create
    #[arg(default_value = "scenario.toml")]
    pub(crate) path: PathBuf,
}

/// Arguments of `check`.
#[derive(Debug, Args)]
#[command(after_help = sea_floors())]
pub(crate) struct CheckArgs {
    /// Scenario [default: the embedded one]
    pub(crate) scenario: Option<PathBuf>,
}

/// The sea floors that a scenario may name, with what they are and where from.
fn sea_floors() -> String {
    let lines = Seabed::ALL.map(|seabed| {
        let floor = seabed.half_space();
        format!(
            "  {:<10} {:>4} m/s  {:<5} g/cm³  {:<4} dB per wavelength  {}",
            seabed.name(),
            floor.speed_m_s,
            floor.density_ratio,
            floor.attenuation_db_wavelength,
            seabed.source(),
        )
    });
    format!(
        "Sea floors by name, `seabed.sediment` (speed, density, attenuation):\n{}\n\
         COA: Jensen et al., Computational Ocean Acoustics, doi:10.1007/978-1-4419-8678-8",
        lines.join("\n")
    )
}

/// `ocean …`.
#[derive(Debug, Subcommand)]
pub(crate) enum OceanCommand {
    /// Show what ocean and bathymetry files hold
    Inspect {
        /// NetCDF files
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
    },
    /// Print one water column as CSV
    Profile {
        /// NetCDF files that together hold temperature, salinity and currents
        #[arg(required = true, value_name = "FILE")]
        files: Vec<PathBuf>,
        /// Longitude, degrees east
        #[arg(long, allow_negative_numbers = true, value_name = "DEG")]
        longitude: f64,
        /// Latitude, degrees north
        #[arg(long, allow_negative_numbers = true, value_name = "DEG")]
        latitude: f64,
        /// Time, ISO 8601 [default: the first in the files]
        #[arg(long, value_name = "TIME")]
        time: Option<jiff::Timestamp>,
    },
    /// Write a scenario's synthetic ocean as CMEMS-layout and GEBCO-layout NetCDF
    Synth {
        /// Directory to write into
        directory: PathBuf,
        /// Scenario [default: the embedded one]
        #[arg(long, value_name = "FILE")]
        scenario: Option<PathBuf>,
    },
    /// Print the download commands for the files that a scenario needs
    Request {
        /// Scenario [default: the embedded one]
        scenario: Option<PathBuf>,
    },
}

/// Presets of the transmission-loss table.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum Quality {
    Fast,
    Standard,
    Fine,
}

/// What a table is for.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum LossUse {
    Detection,
    Communication,
}

/// Arguments of `tl`.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "Examples:\n  sonarfleet tl --output tl.nc\n  \
        sonarfleet tl mission.toml --use communication --output links.nc\n  \
        sonarfleet tl mission.toml --epoch 2 --shard 1/4 --output part1.nc\n  \
        sonarfleet tl merge part1.nc part2.nc part3.nc part4.nc --output tl.nc"
)]
pub(crate) struct TlArgs {
    /// Scenario [default: the embedded one]
    pub(crate) scenario: Option<PathBuf>,
    /// Table to write, .nc or .npz
    #[arg(long, short, required = true, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Preset of beams and bearings [default: the scenario's]
    #[arg(long, value_enum)]
    pub(crate) quality: Option<Quality>,
    /// What the table is for: at the sonar's frequency or at the modems'
    #[arg(long = "use", value_enum, default_value = "detection")]
    pub(crate) purpose: LossUse,
    /// Epoch whose ocean is used, from 0
    #[arg(long, default_value_t = 0, value_name = "K")]
    pub(crate) epoch: usize,
    /// Compute only the i-th of n parts of the sources, e.g. 2/8
    #[arg(long, value_name = "I/N", value_parser = parse_shard)]
    pub(crate) shard: Option<Shard>,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
    #[command(subcommand)]
    pub(crate) command: Option<TlCommand>,
}

/// `tl merge`.
#[derive(Debug, Subcommand)]
pub(crate) enum TlCommand {
    /// Put the parts of a sharded table together
    Merge {
        /// All parts, in any order
        #[arg(required = true, value_name = "PART")]
        parts: Vec<PathBuf>,
        /// Table to write, .nc or .npz
        #[arg(long, short, value_name = "FILE")]
        output: PathBuf,
    },
}

/// Part `index` (from 1) of `count`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shard {
    pub(crate) index: usize,
    pub(crate) count: usize,
}

fn parse_shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/').and_then(|(index, count)| {
        Some(Shard { index: index.parse().ok()?, count: count.parse().ok()? })
    });
    match parts {
        Some(shard) if (1..=shard.count).contains(&shard.index) => Ok(shard),
        _ => Err("expected I/N with 1 ≤ I ≤ N, e.g. 2/8".into()),
    }
}

/// Arguments of `place`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  sonarfleet place mission.toml --method annealing\n  \
    sonarfleet place instance.npz --method connected-greedy --json")]
pub(crate) struct PlaceArgs {
    /// Scenario (.toml) or placement instance (.npz)
    pub(crate) input: PathBuf,
    #[arg(
        long,
        value_name = "M",
        help = format!("Method: {} [default: the scenario's; auto for an instance]", methods())
    )]
    pub(crate) method: Option<String>,
    /// Time limit instead of a budget in evaluations; not reproducible
    #[arg(long, value_name = "S", value_parser = positive)]
    pub(crate) seconds: Option<f64>,
    /// Budget in evaluated proposals [default: the scenario's]
    #[arg(long, value_name = "N", conflicts_with = "seconds")]
    pub(crate) samples: Option<u64>,
    /// Seed [default: the scenario's]
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// Number of vehicles [default: the scenario's]
    #[arg(long, value_name = "G")]
    pub(crate) count: Option<usize>,
    /// Required algebraic connectivity τ [default: the scenario's or instance's]
    #[arg(long, value_name = "TAU", value_parser = not_negative)]
    pub(crate) threshold: Option<f64>,
    /// Weights of `policy`, as `train placement` writes them [default: those that ship]
    #[arg(long, value_name = "FILE")]
    pub(crate) weights: Option<PathBuf>,
    /// Epoch of the scenario, from 0
    #[arg(long, default_value_t = 0, value_name = "K")]
    pub(crate) epoch: usize,
    /// Transmission-loss table to use instead of computing one (scenario only)
    #[arg(long, value_name = "FILE")]
    pub(crate) loss: Option<PathBuf>,
    /// The same for the links between vehicles (scenario only)
    #[arg(long, value_name = "FILE")]
    pub(crate) communication_loss: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) cache: CacheArgs,
}

fn methods() -> String {
    Method::ALL.map(Method::name).join(", ")
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && f64::is_finite(value) => Ok(value),
        _ => Err("expected a positive number".into()),
    }
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if value >= 0.0 && f64::is_finite(value) => Ok(value),
        _ => Err("expected a number from 0 up".into()),
    }
}

/// A place as typed: degrees, or kilometres in the region's local frame.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Place {
    /// Longitude and latitude, degrees.
    Degrees(f64, f64),
    /// East and north of the region's south-west corner, km.
    Kilometres(f64, f64),
}

fn parse_place(text: &str) -> Result<Place, String> {
    let (numbers, kilometres) =
        text.strip_suffix("km").map_or((text, false), |rest| (rest.trim_end(), true));
    let pair = numbers
        .split_once(',')
        .and_then(|(x, y)| Some((x.trim().parse::<f64>().ok()?, y.trim().parse::<f64>().ok()?)));
    match pair {
        Some((x, y)) if !(x.is_finite() && y.is_finite()) => Err(format!("{x},{y} is not a place")),
        Some((x, y)) if kilometres => Ok(Place::Kilometres(x, y)),
        Some((longitude, latitude)) if latitude.abs() <= 90.0 => {
            Ok(Place::Degrees(longitude, latitude))
        }
        _ => Err("expected LONGITUDE,LATITUDE in degrees, or EAST,NORTHkm".into()),
    }
}

/// Arguments of `route`.
#[derive(Debug, Args)]
#[command(
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    after_help = "Examples:\n  \
        sonarfleet route mission.toml --from 118.12,21.70 --to 118.30,21.80 --output route.geojson\n  \
        sonarfleet route mission.toml --from 2,10km --to 20,25km --depart 6\n  \
        sonarfleet route currents.npz --json        every pair of an instance file\n  \
        sonarfleet route matrix currents.npz --output matrix.npz"
)]
pub(crate) struct RouteArgs {
    /// Scenario (.toml) or navigation instance (.npz)
    #[arg(required = true)]
    pub(crate) input: Option<PathBuf>,
    /// Start, LONGITUDE,LATITUDE or EAST,NORTHkm [an instance: all its pairs]
    #[arg(long, value_name = "PLACE", value_parser = parse_place, allow_hyphen_values = true, requires = "to")]
    pub(crate) from: Option<Place>,
    /// Goal, LONGITUDE,LATITUDE or EAST,NORTHkm
    #[arg(long, value_name = "PLACE", value_parser = parse_place, allow_hyphen_values = true, requires = "from")]
    pub(crate) to: Option<Place>,
    /// Departure, hours after the scenario's or instance's start
    #[arg(long, default_value_t = 0.0, value_name = "H")]
    pub(crate) depart: f64,
    /// Planner [default: the scenario's]
    #[arg(long, value_name = "P")]
    pub(crate) pilot: Option<String>,
    /// Route to write: .geojson, .kml, .gpx or .csv
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    #[command(subcommand)]
    pub(crate) command: Option<RouteCommand>,
}

/// `route matrix`.
#[derive(Debug, Subcommand)]
pub(crate) enum RouteCommand {
    /// Travel times from every vehicle to every post
    Matrix {
        /// Scenario (.toml: its entry positions and a placement) or navigation instance (.npz)
        input: PathBuf,
        /// Matrix to write, .npz or .nc
        #[arg(long, short, value_name = "FILE")]
        output: Option<PathBuf>,
        /// Departure, hours after the start
        #[arg(long, default_value_t = 0.0, value_name = "H")]
        depart: f64,
        /// Planner [default: the scenario's]
        #[arg(long, value_name = "P")]
        pilot: Option<String>,
        /// Posts of a scenario, as `place --json` prints them [default: a placement is made]
        #[arg(long, value_name = "FILE")]
        posts: Option<PathBuf>,
    },
}

/// What an assignment minimises.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum ObjectiveName {
    Sum,
    Bottleneck,
    Power,
}

/// Arguments of `assign`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  sonarfleet assign costs.csv\n  \
    sonarfleet assign matrix.npz --objective bottleneck --json")]
pub(crate) struct AssignArgs {
    /// Cost matrix: .csv, or .npz with `cost` (or `travel_time_h`); empty or inf = forbidden
    pub(crate) costs: PathBuf,
    /// What is minimised
    #[arg(long, value_enum, default_value = "sum")]
    pub(crate) objective: ObjectiveName,
    /// Exponent of `--objective power`
    #[arg(long, default_value_t = 1.5, value_name = "P", value_parser = positive)]
    pub(crate) exponent: f64,
    /// Algorithm
    #[arg(long, value_enum, default_value = "jonker-volgenant")]
    pub(crate) method: AssignmentMethod,
}

/// Assignment algorithms.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum AssignmentMethod {
    JonkerVolgenant,
}
