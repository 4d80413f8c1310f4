//! Scenarios: what was typed ([`ScenarioFile`]) and what was checked ([`Scenario`]).

mod check;
mod error;
mod exclusions;
mod file;

pub use error::ScenarioError;
pub use exclusions::Exclusions;
pub use file::{
    AssignmentSection, BlobSection, CommunicationsSection, DeployableSection, DetectionSection,
    FleetSection, HalfSpaceSection, LinkSection, ModelName, NavigationSection, ObjectiveName,
    OceanKind, OceanSection, PlacementSection, PlannerName, PriorSection, QualityName,
    RegionSection, ScenarioFile, SeabedSection, SonarSection, SoundSpeedName, TimeSection,
    TransmissionLossSection,
};

use crate::assignment::AssignmentObjective;
use crate::grid::{CellId, Position, SurveillanceGrid};
use crate::navigation::{Crab, Planner, TimeOptimal, TransitDomain, Vehicle};
use crate::placement::Method;
use crate::sonar::detection::PassiveSonar;
use crate::sonar::link::Modem;
use crate::sonar::prior::TargetPrior;
use crate::sonar::transmission_loss::{Directions, Quality, TableModel};
use jiff::{SignedDuration, Timestamp};
use sonarfleet_acoustics::environment::FluidHalfSpace;
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::synthetic::SyntheticOcean;
use sonarfleet_ocean::{LocalFrame, Region};
use std::path::{Path, PathBuf};

/// The default scenario, commented, as `sonarfleet init` writes it.
pub const EMBEDDED: &str = include_str!("embedded.toml");

/// A scenario that can be run: checked, with units and frames resolved.
#[derive(Debug, Clone)]
pub struct Scenario {
    /// What was typed, every default filled in.
    pub file: ScenarioFile,
    /// What the paths in it are relative to.
    pub home: PathBuf,
    /// The region's local frame.
    pub frame: LocalFrame,
    /// The surveillance grid in that frame.
    pub grid: SurveillanceGrid,
    /// Where the ocean comes from.
    pub ocean: OceanSource,
    /// Equation for the speed of sound.
    pub sound_speed: SoundSpeedEquation,
    /// Start of the first epoch.
    pub start: Timestamp,
    /// Length of an epoch, hours.
    pub epoch_h: f64,
    /// The epochs, in order.
    pub epochs: Vec<EpochPlan>,
    /// Where the vehicles start.
    pub fleet: Vec<Position>,
    /// Depth of vehicles and targets, metres.
    pub fleet_depth_m: f64,
    /// Cells with sensors that stay.
    pub fixed_sensors: Vec<CellId>,
    /// What moves.
    pub vehicle: Vehicle,
    /// Where vehicles may transit.
    pub domain: TransitDomain,
    /// Where vehicles may not be placed.
    pub exclusions: Exclusions,
    /// The passive sonar.
    pub sonar: PassiveSonar,
    /// The acoustic modems.
    pub modem: Modem,
    /// Required algebraic connectivity, τ.
    pub connectivity_threshold: f64,
    /// The seabed.
    pub seabed: FluidHalfSpace,
    /// Frequency of detection, Hz.
    pub frequency_hz: f64,
    /// Frequency of the links between vehicles, Hz.
    pub communication_frequency_hz: f64,
    /// Largest range at which sound is followed, metres; none: to the region's edge.
    pub maximum_range_m: Option<f64>,
    /// How much work goes into the transmission-loss table.
    pub quality: Quality,
    /// What follows sound.
    pub loss_model: TableModel,
    /// Whether a loss is that of one direction or the mean of both.
    pub directions: Directions,
    /// Placement solver.
    pub method: Method,
    /// Travel planner.
    pub planner: PlannerName,
    /// Resolution and horizon of planning.
    pub time_optimal: TimeOptimal,
    /// What an assignment minimises.
    pub objective: AssignmentObjective,
}

/// Where the ocean comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum OceanSource {
    /// The built-in synthetic South China Sea.
    Synthetic(SyntheticOcean),
    /// NetCDF files.
    Files {
        /// Temperature, salinity and currents, in any split.
        states: Vec<PathBuf>,
        /// Water depth.
        bathymetry: PathBuf,
    },
}

impl OceanSource {
    /// The source in words.
    pub fn describe(&self) -> String {
        match self {
            Self::Synthetic(_) => "synthetic South China Sea (not an observation)".into(),
            Self::Files { states, bathymetry } => {
                let names: Vec<_> = states
                    .iter()
                    .chain([bathymetry])
                    .map(|path| path.file_name().unwrap_or_default().to_string_lossy())
                    .collect();
                names.join(", ")
            }
        }
    }
}

/// One epoch as planned.
#[derive(Debug, Clone, PartialEq)]
pub struct EpochPlan {
    /// Hours from the run's start to the epoch's.
    pub start_h: f64,
    /// Hours from the run's start to the ocean state that the acoustics uses.
    pub snapshot_h: f64,
    /// Target prior.
    pub prior: TargetPrior,
    /// Transmission-loss table made elsewhere.
    pub loss_file: Option<PathBuf>,
    /// Table for the links between vehicles made elsewhere.
    pub communication_loss_file: Option<PathBuf>,
}

impl EpochPlan {
    /// The table made elsewhere for a purpose.
    pub fn file_of(&self, purpose: LossUse) -> Option<&Path> {
        match purpose {
            LossUse::Detection => self.loss_file.as_deref(),
            LossUse::Communication => self.communication_loss_file.as_deref(),
        }
    }
}

/// What a table of transmission loss is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LossUse {
    /// Whether a target is heard.
    Detection,
    /// Whether vehicles hear each other.
    Communication,
}

impl PlannerName {
    /// The planner of that name, with a resolution and horizon.
    pub fn planner(self, time_optimal: TimeOptimal) -> Box<dyn Planner> {
        match self {
            Self::TimeOptimal => Box::new(time_optimal),
            Self::Crab => Box::new(Crab { horizon_h: time_optimal.horizon_h }),
        }
    }
}

impl Scenario {
    /// The embedded scenario.
    ///
    /// # Panics
    /// Never: the embedded text is valid, which a test asserts.
    pub fn embedded() -> Self {
        let origin = "embedded scenario";
        ScenarioFile::parse(EMBEDDED, origin)
            .and_then(|file| Self::check(file, origin, Path::new("")))
            .expect("the embedded scenario is valid")
    }

    /// Reads and checks a scenario file.
    ///
    /// # Errors
    /// If the file cannot be read, is not TOML, has unknown keys or impossible values.
    pub fn read(path: &Path) -> Result<Self, ScenarioError> {
        let home = path.parent().unwrap_or(Path::new(""));
        Self::check(ScenarioFile::read(path)?, &path.display().to_string(), home)
    }

    /// Checks a scenario. `origin` names it in errors, `home` is the directory that its
    /// paths are relative to.
    ///
    /// # Errors
    /// If a value is impossible or a file it names is not there.
    pub fn check(file: ScenarioFile, origin: &str, home: &Path) -> Result<Self, ScenarioError> {
        check::check(file, origin, home)
    }

    /// The travel planner.
    pub fn planner(&self) -> Box<dyn Planner> {
        self.planner.planner(self.time_optimal)
    }

    /// Frequency at which sound is followed for a purpose, Hz.
    pub const fn loss_frequency_hz(&self, purpose: LossUse) -> f64 {
        match purpose {
            LossUse::Detection => self.frequency_hz,
            LossUse::Communication => self.communication_frequency_hz,
        }
    }

    /// Whether the links between vehicles have a table of their own in an epoch: at
    /// another frequency than detection's, or from a file.
    pub fn has_communication_table(&self, epoch: usize) -> bool {
        self.communication_frequency_hz.to_bits() != self.frequency_hz.to_bits()
            || self.epochs[epoch].communication_loss_file.is_some()
    }

    /// Seed of the random choices of one epoch.
    pub const fn seed_of(&self, epoch: usize) -> u64 {
        self.file.seed.wrapping_add(epoch as u64)
    }

    /// The scenario with every default filled in and every path resolved, TOML.
    ///
    /// # Panics
    /// Never: what was read from TOML can be written as TOML.
    pub fn resolved(&self) -> String {
        let mut file = self.file.clone();
        let here = |path: &mut PathBuf| *path = self.home.join(&*path);
        file.ocean.files.iter_mut().for_each(here);
        file.ocean.bathymetry.iter_mut().for_each(here);
        file.deployable.exclusions.iter_mut().for_each(here);
        file.transmission_loss.files.iter_mut().for_each(here);
        file.transmission_loss.communication_files.iter_mut().for_each(here);
        for prior in &mut file.prior {
            if let PriorSection::File { path } = prior {
                here(path);
            }
        }
        toml::to_string(&file).expect("what was read from TOML can be written as TOML")
    }

    /// Every file that a run of the scenario reads.
    pub fn input_files(&self) -> Vec<PathBuf> {
        let mut files: Vec<PathBuf> = self.file.transmission_loss.files.clone();
        files.extend(self.file.transmission_loss.communication_files.iter().cloned());
        files.extend(self.file.ocean.files.iter().cloned());
        files.extend(self.file.ocean.bathymetry.iter().cloned());
        files.extend(self.file.deployable.exclusions.iter().cloned());
        files.extend(self.file.prior.iter().filter_map(|prior| match prior {
            PriorSection::File { path } => Some(path.clone()),
            _ => None,
        }));
        files.iter().map(|path| self.home.join(path)).collect()
    }

    /// How far beyond the region vehicles may transit, metres.
    pub fn transit_margin_m(&self) -> f64 {
        -self.domain.south_west().east_m
    }

    /// The region.
    pub fn region(&self) -> Region {
        self.frame.region()
    }

    /// The instant `hours` after the start of the run.
    pub fn instant(&self, hours: f64) -> Timestamp {
        self.start + SignedDuration::from_secs((hours * 3600.0).round() as i64)
    }
}
