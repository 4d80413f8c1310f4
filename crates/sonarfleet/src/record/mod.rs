//! What a run writes down: plain data, one [`EpochRecord`] per epoch, from which
//! every figure and the report are drawn.

mod checkpoint;
mod comparison;
mod directory;
mod epoch_file;
mod error;
mod provenance;
mod training;
mod write;

pub use checkpoint::Checkpoint;
pub use comparison::{
    ChartRecord, LayoutRecord, LayoutsRecord, PanelRecord, ScoreRecord, ScoresRecord, SeriesRecord,
};
pub use directory::RunDirectory;
pub use epoch_file::write_epoch;
pub use error::RecordError;
pub use provenance::{InputFile, Provenance};
pub use training::{TrainingPoint, TrainingRecord, TrainingRun, median};
pub use write::write_run;

use crate::grid::{CellId, Position, SurveillanceGrid};
use serde::{Deserialize, Serialize};

/// A whole run, as figures and the report see it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunRecord {
    /// Name of the scenario.
    pub name: String,
    /// Where the ocean comes from, in words ("synthetic South China Sea", or the files).
    pub ocean_source: String,
    /// Version of the program that made the run.
    pub version: String,
    /// Seed of all randomness.
    pub seed: u64,
    /// The surveillance grid.
    pub grid: SurveillanceGrid,
    /// Longitudes of the cells' centres, [row, column], degrees east.
    pub cell_longitude_deg: Vec<f64>,
    /// Latitudes of the cells' centres, [row, column], degrees north.
    pub cell_latitude_deg: Vec<f64>,
    /// Water depth at the cells' centres, [row, column], metres, positive down.
    pub cell_depth_m: Vec<f32>,
    /// Cells where no vehicle may be placed (land, exclusion polygons).
    pub blocked_cells: Vec<CellId>,
    /// Sensors that were there before the fleet.
    pub fixed_sensors: Vec<CellId>,
    /// Depth of vehicles and targets, metres.
    pub fleet_depth_m: f64,
    /// Speed of the vehicles through the water, m/s.
    pub vehicle_speed_m_s: f64,
    /// How far beyond the region vehicles may transit, metres.
    pub transit_margin_m: f64,
    /// Required algebraic connectivity, τ.
    pub connectivity_threshold: f64,
    /// One record per epoch.
    pub epochs: Vec<EpochRecord>,
}

impl RunRecord {
    /// Where a vehicle went over all epochs.
    pub fn track(&self, vehicle: usize) -> Vec<TrackPoint> {
        let mut track: Vec<TrackPoint> = Vec::new();
        for epoch in &self.epochs {
            let points = &epoch.routes[vehicle].track;
            // An epoch starts where the one before ended.
            let from = points.partition_point(|point| {
                track.last().is_some_and(|last| point.time_h <= last.time_h)
            });
            track.extend(&points[from..]);
        }
        track
    }

    /// How a vehicle stands at the end of the run, in words.
    pub fn status(&self, vehicle: usize) -> &str {
        match self.epochs.last().map(|epoch| &epoch.routes[vehicle]) {
            None => "not under way",
            Some(RouteRecord { arrived: true, .. }) => "on its post",
            Some(RouteRecord { failure: Some(reason), .. }) => reason,
            Some(_) => "under way",
        }
    }
}

/// One placement–reconfiguration cycle (section 5.4 of the paper).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EpochRecord {
    /// Number of the epoch, from 0.
    pub epoch: usize,
    /// Start of the epoch, ISO 8601, UTC.
    pub time: String,
    /// Hours from the run's start to the epoch's.
    pub start_h: f64,
    /// Length of the epoch, hours.
    pub duration_h: f64,
    /// Target prior `P_T`, [row, column].
    pub prior: Vec<f64>,
    /// Network detection probability `P_net` of the target layout, [row, column].
    pub detection_probability: Vec<f64>,
    /// `P_net` of a random layout of the same size, for comparison, [row, column].
    pub random_detection_probability: Vec<f64>,
    /// The random layout.
    pub random_layout: Vec<CellId>,
    /// Source cell of the transmission-loss excerpt.
    pub loss_source: CellId,
    /// Transmission loss from `loss_source` to every cell, [row, column], dB.
    pub loss_db: Vec<f32>,
    /// The sound-speed field over the region.
    pub sound_speed: SoundSpeedRecord,
    /// The current at the fleet's depth at the start of the epoch.
    pub current: CurrentRecord,
    /// The target layout, one cell per post.
    pub layout: Vec<CellId>,
    /// One per vehicle: where it went.
    pub routes: Vec<RouteRecord>,
    /// The numbers of the epoch.
    pub metrics: EpochMetrics,
    /// Wall-clock seconds by stage, in order.
    pub seconds: Vec<(String, f64)>,
}

/// Sound speed over the region on a regular grid of points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SoundSpeedRecord {
    /// Depths of the levels, metres, ascending.
    pub depth_m: Vec<f64>,
    /// Eastward coordinates of the points, metres, ascending.
    pub east_m: Vec<f64>,
    /// Northward coordinates of the points, metres, ascending.
    pub north_m: Vec<f64>,
    /// Sound speed, [depth, north, east], m/s; NaN deeper than the first level below the
    /// bottom.
    pub speed_m_s: Vec<f32>,
}

/// Horizontal current on a regular grid of points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurrentRecord {
    /// Eastward coordinates of the points, metres, ascending.
    pub east_m: Vec<f64>,
    /// Northward coordinates of the points, metres, ascending.
    pub north_m: Vec<f64>,
    /// Eastward current, [north, east], m/s; NaN on land.
    pub u_m_s: Vec<f32>,
    /// Northward current, [north, east], m/s; NaN on land.
    pub v_m_s: Vec<f32>,
}

/// What one vehicle did during an epoch.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RouteRecord {
    /// Index of the vehicle in the fleet.
    pub vehicle: usize,
    /// The cell it was sent to.
    pub post: CellId,
    /// Time to the post expected at the start of the epoch, hours; infinite if unreachable.
    pub expected_travel_time_h: f64,
    /// Points travelled within the epoch, with hours since the run's start.
    pub track: Vec<TrackPoint>,
    /// The rest of the planned route, beyond the end of the epoch; empty once arrived.
    pub planned: Vec<TrackPoint>,
    /// Whether the vehicle was on its post at the end of the epoch.
    pub arrived: bool,
    /// Why it cannot reach its post, if it cannot.
    pub failure: Option<String>,
}

/// A point of a track.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TrackPoint {
    /// Hours since the start of the run.
    pub time_h: f64,
    /// Where the vehicle was.
    pub position: Position,
}

/// The numbers of one epoch. Wall-clock times are kept apart from results, which
/// are reproducible to the bit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EpochMetrics {
    /// `J_d` of the target layout.
    pub detection_utility: f64,
    /// λ₂ of the target layout.
    pub algebraic_connectivity: f64,
    /// Whether λ₂ ≥ τ.
    pub feasible: bool,
    /// An upper bound on the feasible `J_d`.
    pub upper_bound: f64,
    /// `J_d` of a random layout.
    pub random_detection_utility: f64,
    /// λ₂ of the random layout.
    pub random_algebraic_connectivity: f64,
    /// `J_d` from the cells in which the vehicles are when the epoch starts.
    pub detection_utility_at_start: f64,
    /// `J_d` from the cells in which the vehicles are when the epoch ends.
    pub detection_utility_at_end: f64,
    /// λ₂ of the vehicles where they are when the epoch ends.
    pub algebraic_connectivity_at_end: f64,
    /// Mean expected travel time of the assignment, hours, over reachable posts.
    pub mean_travel_time_h: f64,
    /// Largest expected travel time of the assignment, hours, over reachable posts.
    pub largest_travel_time_h: f64,
    /// Vehicles on their posts at the end of the epoch.
    pub arrived: usize,
    /// Vehicles whose post cannot be reached.
    pub unreachable: usize,
    /// How the transmission-loss table was made, and its error estimate.
    pub transmission_loss: LossTableMetrics,
    /// The same of the table for the links; none if they share that of detection.
    pub communication_loss: Option<LossTableMetrics>,
    /// Placement proposals evaluated.
    pub evaluations: u64,
    /// Best feasible `J_d` against evaluations.
    pub placement_history: Vec<(u64, f64)>,
    /// What each part of a placement method of several parts reached, in their order.
    pub placement_parts: Vec<PlacementPart>,
}

/// What one part of a placement method reached.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlacementPart {
    /// Name of the part.
    pub by: String,
    /// Layouts it gave or worked on.
    pub layouts: u64,
    /// `J_d` of the best of them.
    pub detection_utility: f64,
    /// λ₂ of it.
    pub algebraic_connectivity: f64,
    /// Whether that reaches the threshold.
    pub feasible: bool,
}

/// How the transmission-loss table of an epoch was made, and how far it is from
/// `fine` settings on a sample of sources.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LossTableMetrics {
    /// What followed sound: a propagation model, or "file" where it is not known.
    pub model: String,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Whether every loss is the mean of both directions.
    pub both_directions: bool,
    /// Beams per slice.
    pub beams: usize,
    /// Bearings per source.
    pub bearings: usize,
    /// Largest range of a slice, metres.
    pub range_m: f64,
    /// Sources of the sample that was recomputed at `fine` settings.
    pub sampled_sources: usize,
    /// Median absolute difference from `fine`, dB; NaN if not sampled.
    pub median_error_db: f64,
    /// 90th percentile of the absolute difference from `fine`, dB; NaN if not sampled.
    pub p90_error_db: f64,
}

impl LossTableMetrics {
    /// Of a table that was made elsewhere: nothing is known but the frequency, Hz, for
    /// which it is used.
    pub fn from_file(frequency_hz: f64) -> Self {
        Self {
            model: "file".into(),
            frequency_hz,
            both_directions: false,
            beams: 0,
            bearings: 0,
            range_m: f64::NAN,
            sampled_sources: 0,
            median_error_db: f64::NAN,
            p90_error_db: f64::NAN,
        }
    }
}
