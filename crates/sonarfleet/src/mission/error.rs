//! What can stop a run.

use crate::assignment::AssignmentError;
use crate::navigation::NavigationError;
use crate::placement::PlacementError;
use crate::sonar::loss_file::LossFileError;
use crate::sonar::section::WatersError;
use crate::sonar::transmission_loss::TransmissionLossError;
use sonarfleet_ocean::OceanError;
use std::path::PathBuf;
use thiserror::Error;

/// Why a run cannot start or go on.
#[derive(Debug, Error)]
pub enum MissionError {
    /// The ocean does not hold what is needed.
    #[error(transparent)]
    Ocean(#[from] OceanError),
    /// Transmission loss cannot be computed.
    #[error(transparent)]
    TransmissionLoss(#[from] TransmissionLossError),
    /// There is no placement problem.
    #[error(transparent)]
    Placement(#[from] PlacementError),
    /// Travel cannot be planned.
    #[error(transparent)]
    Navigation(#[from] NavigationError),
    /// Vehicles cannot be assigned to posts.
    #[error(transparent)]
    Assignment(#[from] AssignmentError),
    /// No cell can hold a vehicle.
    #[error(
        "none of the {cells} cells of the region can hold a vehicle: all are land, shallower than \
         the fleet's depth of {depth_m} m, without ocean data at that depth, or excluded"
    )]
    NowhereToBe {
        /// Cells of the region.
        cells: usize,
        /// Depth of the fleet, metres.
        depth_m: f64,
    },
    /// The bathymetry does not cover the region.
    #[error(
        "{}: no water depth at {longitude_deg:.4}° E, {latitude_deg:.4}° N, which is inside the \
         region; the file covers {span}",
        path.display()
    )]
    BathymetryTooSmall {
        /// The bathymetry file.
        path: PathBuf,
        /// A point of the region without depth, degrees east.
        longitude_deg: f64,
        /// Its latitude, degrees north.
        latitude_deg: f64,
        /// What the file covers, in words.
        span: String,
    },
    /// A transmission-loss file does not fit the scenario.
    #[error(transparent)]
    LossFile(#[from] LossFileError),
    /// There is no water to send sound through.
    #[error(transparent)]
    Waters(#[from] WatersError),
}
