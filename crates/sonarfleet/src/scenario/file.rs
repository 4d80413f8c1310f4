//! What a scenario file may say: the typed, unchecked form. Every key has the
//! embedded scenario's value as its default, so a file says only what it changes.

use super::ScenarioError;
use crate::sonar::prior::LineCorridor;
use crate::sonar::transmission_loss::Directions;
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A scenario as written in TOML.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ScenarioFile {
    /// Name of the scenario, shown in reports.
    pub name: String,
    /// Seed of all randomness.
    pub seed: u64,
    /// Region and grid.
    pub region: RegionSection,
    /// Where the ocean comes from.
    pub ocean: OceanSection,
    /// Time span and epochs.
    pub time: TimeSection,
    /// Vehicles and sensors.
    pub fleet: FleetSection,
    /// Passive sonar.
    pub sonar: SonarSection,
    /// Acoustic links.
    pub communications: CommunicationsSection,
    /// Seabed.
    pub seabed: SeabedSection,
    /// Where vehicles may be placed.
    pub deployable: DeployableSection,
    /// How the transmission-loss table is made.
    pub transmission_loss: TransmissionLossSection,
    /// Target prior of each epoch; the last one holds for all later epochs.
    pub prior: Vec<PriorSection>,
    /// Placement solver.
    pub placement: PlacementSection,
    /// Travel times and routes.
    pub navigation: NavigationSection,
    /// Assignment of vehicles to posts.
    pub assignment: AssignmentSection,
}

impl ScenarioFile {
    /// Reads a scenario file.
    ///
    /// # Errors
    /// If the file cannot be read, is not TOML, or has unknown keys.
    pub fn read(path: &Path) -> Result<Self, ScenarioError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| ScenarioError::Read { path: path.to_owned(), source })?;
        Self::parse(&text, &path.display().to_string())
    }

    /// Parses a scenario's text; `origin` names it in errors.
    ///
    /// # Errors
    /// If it is not TOML, or has unknown keys.
    pub fn parse(text: &str, origin: &str) -> Result<Self, ScenarioError> {
        toml::from_str(text).map_err(|error| ScenarioError::Parse {
            origin: origin.to_owned(),
            message: error.to_string(),
        })
    }
}

impl Default for ScenarioFile {
    fn default() -> Self {
        Self {
            name: "South China Sea slope".into(),
            seed: 1,
            region: RegionSection::default(),
            ocean: OceanSection::default(),
            time: TimeSection::default(),
            fleet: FleetSection::default(),
            sonar: SonarSection::default(),
            communications: CommunicationsSection::default(),
            seabed: SeabedSection::default(),
            deployable: DeployableSection::default(),
            transmission_loss: TransmissionLossSection::default(),
            prior: PriorSection::moving_corridor(),
            placement: PlacementSection::default(),
            navigation: NavigationSection::default(),
            assignment: AssignmentSection::default(),
        }
    }
}

/// `[region]`: a longitude–latitude box and how it is cut into cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RegionSection {
    /// Western edge, degrees east.
    pub west_deg: f64,
    /// Eastern edge, degrees east.
    pub east_deg: f64,
    /// Southern edge, degrees north.
    pub south_deg: f64,
    /// Northern edge, degrees north.
    pub north_deg: f64,
    /// Cells from west to east.
    pub columns: usize,
    /// Cells from south to north.
    pub rows: usize,
}

impl Default for RegionSection {
    fn default() -> Self {
        Self {
            west_deg: 118.1,
            east_deg: 118.4,
            south_deg: 21.60,
            north_deg: 21.88,
            columns: 30,
            rows: 30,
        }
    }
}

/// `[ocean]`: the synthetic ocean, or files.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OceanSection {
    /// `synthetic` or `files`.
    pub source: OceanKind,
    /// Files with temperature, salinity and currents, in any split, relative to the scenario.
    pub files: Vec<PathBuf>,
    /// File with the water depth, relative to the scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bathymetry: Option<PathBuf>,
    /// Equation for the speed of sound.
    pub sound_speed: SoundSpeedName,
}

impl Default for OceanSection {
    fn default() -> Self {
        Self {
            source: OceanKind::Synthetic,
            files: Vec::new(),
            bathymetry: None,
            sound_speed: SoundSpeedName::Mackenzie,
        }
    }
}

/// Where the ocean comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OceanKind {
    /// The built-in synthetic South China Sea.
    Synthetic,
    /// NetCDF files named in the scenario.
    Files,
}

/// Sound-speed equations by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SoundSpeedName {
    /// Mackenzie (1981), the paper's.
    Mackenzie,
    /// Del Grosso (1974).
    DelGrosso,
    /// Chen and Millero (1977), UNESCO.
    ChenMillero,
}

/// `[time]`: when the epochs are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TimeSection {
    /// Start of the first epoch, ISO 8601 with offset, e.g. "2025-10-09T00:00:00Z".
    pub start: Timestamp,
    /// Number of epochs.
    pub epochs: usize,
    /// Length of an epoch, hours.
    pub epoch_h: f64,
    /// Hours after the start whose ocean state each epoch's acoustics uses; empty: the epochs' starts.
    pub snapshot_h: Vec<f64>,
}

impl Default for TimeSection {
    fn default() -> Self {
        Self {
            start: Timestamp::constant(1_759_968_000, 0), // 2025-10-09T00:00:00Z
            epochs: 4,
            epoch_h: 6.0,
            snapshot_h: Vec::new(),
        }
    }
}

/// `[fleet]`: vehicles, where they start, and sensors that stay.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct FleetSection {
    /// Number of vehicles, G.
    pub vehicles: usize,
    /// Depth of vehicles and targets, metres.
    pub depth_m: f64,
    /// Speed through the water, m/s.
    pub speed_m_s: f64,
    /// A post counts as reached within this distance, metres.
    pub arrival_radius_m: f64,
    /// The vehicles start evenly spaced on this line, [[east, north], [east, north]] in km from the
    /// region's south-west corner.
    pub entry_line_km: [[f64; 2]; 2],
    /// Starting positions [longitude, latitude] in degrees, one per vehicle; replaces the line.
    pub positions_deg: Vec<[f64; 2]>,
    /// Sensors already there that listen and relay, [longitude, latitude] in degrees.
    pub fixed_sensors_deg: Vec<[f64; 2]>,
}

impl Default for FleetSection {
    fn default() -> Self {
        Self {
            vehicles: 40,
            depth_m: 200.0,
            speed_m_s: 0.23,
            arrival_radius_m: 500.0,
            entry_line_km: [[0.5, 3.0], [0.5, 28.0]],
            positions_deg: Vec::new(),
            fixed_sensors_deg: Vec::new(),
        }
    }
}

/// `[sonar]`: Eqs. (3) and (4) of the paper.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SonarSection {
    /// Frequency of what is listened for, Hz.
    pub frequency_hz: f64,
    /// Source level of the target, dB re 1 µPa at 1 m.
    pub source_level_db: f64,
    /// Ambient noise level, dB re 1 µPa.
    pub noise_level_db: f64,
    /// Directivity index, dB.
    pub directivity_index_db: f64,
    /// Probability of a false alarm.
    pub false_alarm_probability: f64,
    /// Signal excess that detection needs beyond the model's, dB.
    pub detection_threshold_db: f64,
    /// How the signal-to-noise ratio becomes a probability.
    pub detection: DetectionSection,
}

impl Default for SonarSection {
    fn default() -> Self {
        Self {
            frequency_hz: 1000.0,
            source_level_db: 154.0,
            noise_level_db: 63.0,
            directivity_index_db: 0.0,
            false_alarm_probability: 1e-3,
            detection_threshold_db: 0.0,
            detection: DetectionSection::default(),
        }
    }
}

/// `[sonar.detection]`: the detection model.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, tag = "model", rename_all = "kebab-case")]
pub enum DetectionSection {
    /// The paper's: a shift of the mean in Gaussian noise.
    #[default]
    MeanShift,
    /// Detected if the signal-to-noise ratio is at least the threshold.
    Threshold,
    /// An energy detector on a fluctuating (Rayleigh) signal.
    RayleighEnergy,
    /// A measured curve.
    Table {
        /// Signal-to-noise ratios, dB, ascending.
        snr_db: Vec<f64>,
        /// Detection probability at each.
        probability: Vec<f64>,
    },
}

/// `[communications]`: Eqs. (7)–(9) and the connectivity constraint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CommunicationsSection {
    /// Frequency of the modems, Hz; absent: the sonar's, so that one table of
    /// transmission loss serves both.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frequency_hz: Option<f64>,
    /// Source level of the modems, dB re 1 µPa at 1 m.
    pub source_level_db: f64,
    /// Noise level at the modems, dB re 1 µPa.
    pub noise_level_db: f64,
    /// Packet length, bits.
    pub packet_bits: u32,
    /// Required algebraic connectivity, τ.
    pub connectivity_threshold: f64,
    /// How the signal-to-noise ratio becomes packet success.
    pub link: LinkSection,
}

impl Default for CommunicationsSection {
    fn default() -> Self {
        Self {
            frequency_hz: None,
            source_level_db: 145.0,
            noise_level_db: 63.0,
            packet_bits: 256,
            connectivity_threshold: 0.95,
            link: LinkSection::default(),
        }
    }
}

/// `[communications.link]`: the link model.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, tag = "model", rename_all = "kebab-case")]
pub enum LinkSection {
    /// Coherent BPSK in white Gaussian noise.
    #[default]
    CoherentBpsk,
    /// Non-coherent FSK under Rayleigh fading.
    NoncoherentFskRayleigh,
    /// A measured curve of packet success.
    Table {
        /// Signal-to-noise ratios, dB, ascending.
        snr_db: Vec<f64>,
        /// Packet success probability at each.
        probability: Vec<f64>,
    },
}

/// `[seabed]`: a sediment by name, or the acoustic parameters of a fluid half-space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SeabedSection {
    /// A sediment of the library, e.g. "clay".
    pub sediment: String,
    /// Measured parameters; they replace the sediment's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub half_space: Option<HalfSpaceSection>,
}

impl Default for SeabedSection {
    fn default() -> Self {
        Self { sediment: "clay".into(), half_space: None }
    }
}

/// `[seabed.half_space]`: a fluid half-space.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HalfSpaceSection {
    /// Speed of sound, m/s.
    pub sound_speed_m_s: f64,
    /// Density, g/cm³.
    pub density_g_cm3: f64,
    /// Attenuation, dB per wavelength.
    pub attenuation_db_per_wavelength: f64,
}

/// `[deployable]`: where vehicles may be placed. Land and water shallower than the
/// fleet's depth are always excluded.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct DeployableSection {
    /// `GeoJSON` file with polygons that vehicles must not be placed in, relative to the scenario.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exclusions: Option<PathBuf>,
}

/// `[transmission_loss]`: computed, or one file per epoch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct TransmissionLossSection {
    /// What follows sound.
    pub model: ModelName,
    /// Preset of beams and bearings.
    pub quality: QualityName,
    /// Largest range of a slice, km; absent: to the region's edge.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub maximum_range_km: Option<f64>,
    /// Whether a loss is that of one direction or the mean of both.
    pub directions: Directions,
    /// Tables (`.nc` or `.npz`), one per epoch, relative to the scenario; empty: computed.
    pub files: Vec<PathBuf>,
    /// Tables for the links between vehicles, likewise; empty: those of detection at the
    /// same frequency, or else computed.
    pub communication_files: Vec<PathBuf>,
    /// Sources recomputed at `fine` settings to estimate the error of a table; 0: none.
    pub error_sample: usize,
}

impl Default for TransmissionLossSection {
    fn default() -> Self {
        Self {
            model: ModelName::Native,
            quality: QualityName::Fast,
            maximum_range_km: None,
            directions: Directions::One,
            files: Vec::new(),
            communication_files: Vec::new(),
            error_sample: 4,
        }
    }
}

/// Propagation models by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ModelName {
    /// This program's own.
    Native,
    /// An external program of the BELLHOP family.
    Bellhop,
}

/// Presets of the transmission-loss table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum QualityName {
    /// Fewest beams and bearings.
    Fast,
    /// The default.
    Standard,
    /// Reference settings.
    Fine,
}

/// `[[prior]]`: the target prior of one epoch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "shape", rename_all = "kebab-case")]
pub enum PriorSection {
    /// A line with Gaussian decay across and along it (Fig. 3b).
    Corridor(LineCorridor),
    /// A sum of Gaussian blobs.
    Blobs {
        /// The blobs.
        blobs: Vec<BlobSection>,
    },
    /// An array `prior` [row, column] in an `.npz` file, relative to the scenario.
    File {
        /// Path of the file.
        path: PathBuf,
    },
}

impl PriorSection {
    /// The paper's corridor (Fig. 3b), then moving and turning over three more epochs (Fig. 9).
    fn moving_corridor() -> Vec<Self> {
        [(-2.0, 13.0), (-1.4, 11.0), (-1.0, 10.0), (-0.6, 8.8)]
            .map(|(slope, intercept)| {
                Self::Corridor(LineCorridor { slope, intercept, ..LineCorridor::default() })
            })
            .to_vec()
    }
}

/// A blob of the prior.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlobSection {
    /// Centre, [east, north] of the region's south-west corner, km.
    pub centre_km: [f64; 2],
    /// Standard deviation, km.
    pub width_km: f64,
    /// Expected number of targets in it.
    pub total: f64,
}

/// `[placement]`: solver and budget.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlacementSection {
    /// Name of the solver.
    pub method: String,
    /// Budget, in evaluated proposals: reproducible to the bit.
    pub evaluations: u64,
}

impl Default for PlacementSection {
    fn default() -> Self {
        Self { method: "auto".into(), evaluations: 4_000_000 }
    }
}

/// `[navigation]`: planner and its resolution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct NavigationSection {
    /// The planner.
    pub planner: PlannerName,
    /// How far beyond the region vehicles may transit, km.
    pub transit_margin_km: f64,
    /// Time between heading commands, hours.
    pub command_interval_h: f64,
    /// Longest travel time considered, hours.
    pub horizon_h: f64,
    /// Grid spacing of the time-optimal solve, metres.
    pub spacing_m: f64,
    /// Time step of the time-optimal solve, hours.
    pub step_h: f64,
    /// Number of headings.
    pub headings: usize,
}

impl Default for NavigationSection {
    fn default() -> Self {
        Self {
            planner: PlannerName::TimeOptimal,
            transit_margin_km: 10.0,
            command_interval_h: 1.0,
            horizon_h: 120.0,
            spacing_m: 515.0,
            step_h: 1.0,
            headings: 32,
        }
    }
}

/// Planners by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlannerName {
    /// The time-optimal value function.
    TimeOptimal,
    /// Crab-angle compensation on the straight line.
    Crab,
}

/// `[assignment]`: what is minimised.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AssignmentSection {
    /// The objective.
    pub objective: ObjectiveName,
    /// Exponent of the objective `power`.
    pub exponent: f64,
}

impl Default for AssignmentSection {
    fn default() -> Self {
        Self { objective: ObjectiveName::Sum, exponent: 1.5 }
    }
}

/// Assignment objectives by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ObjectiveName {
    /// The sum of all travel times.
    Sum,
    /// The longest travel time, then the sum.
    Bottleneck,
    /// The sum of a power of the travel times.
    Power,
}
