//! Scenarios: what was typed ([`ScenarioFile`]) and what was checked ([`Scenario`]).

mod check;
mod error;
mod exclusions;
mod file;

pub use error::ScenarioError;
pub use exclusions::Exclusions;
pub use file::{
    AssignmentSection, BlobSection, CommunicationsSection, DeployableSection, DetectionSection,
    FleetSection, HalfSpaceSection, LinkSection, NavigationSection, ObjectiveName, OceanKind,
    OceanSection, PlacementSection, PlannerName, PriorSection, QualityName, RegionSection,
    ScenarioFile, SeabedSection, SonarSection, SoundSpeedName, TimeSection,
    TransmissionLossSection,
};

use crate::assignment::Objective;
use crate::grid::{CellId, Position, SurveillanceGrid};
use crate::navigation::{TransitDomain, Vehicle};
use crate::placement::Method;
use crate::sonar::detection::PassiveSonar;
use crate::sonar::link::Modem;
use crate::sonar::prior::TargetPrior;
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
    /// Frequency of detection and communication, Hz.
    pub frequency_hz: f64,
    /// Largest range at which sound is followed, metres; none: to the region's edge.
    pub maximum_range_m: Option<f64>,
    /// Placement solver.
    pub method: Method,
    /// Travel planner.
    pub planner: PlannerSettings,
    /// What an assignment minimises.
    pub objective: Objective,
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
}

/// Which planner, and its resolution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PlannerSettings {
    /// The time-optimal value function.
    TimeOptimal(crate::navigation::TimeOptimal),
    /// Crab-angle compensation on the straight line.
    Crab(crate::navigation::Crab),
}

impl PlannerSettings {
    /// The planner behind its contract.
    pub fn planner(&self) -> &dyn crate::navigation::Planner {
        match self {
            Self::TimeOptimal(planner) => planner,
            Self::Crab(planner) => planner,
        }
    }
}

impl Scenario {
    /// The embedded scenario.
    ///
    /// # Panics
    /// Never: the embedded text is valid, which a test asserts.
    pub fn embedded() -> Self {
        Self::parse(EMBEDDED, "embedded scenario", Path::new(""))
            .expect("the embedded scenario is valid")
    }

    /// Reads and checks a scenario file.
    ///
    /// # Errors
    /// If the file cannot be read, is not TOML, has unknown keys or impossible values.
    pub fn read(path: &Path) -> Result<Self, ScenarioError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| ScenarioError::Read { path: path.to_owned(), source })?;
        let home = path.parent().unwrap_or(Path::new(""));
        Self::parse(&text, &path.display().to_string(), home)
    }

    /// Checks a scenario's text. `origin` names it in errors, `home` is the directory
    /// that its paths are relative to.
    ///
    /// # Errors
    /// As for [`Scenario::read`].
    pub fn parse(text: &str, origin: &str, home: &Path) -> Result<Self, ScenarioError> {
        let file: ScenarioFile = toml::from_str(text).map_err(|error| ScenarioError::Parse {
            origin: origin.to_owned(),
            message: error.to_string(),
        })?;
        check::check(file, origin, home)
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
