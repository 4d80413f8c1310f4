//! Placement instances in `.npz` files: `tl` [cell, cell] in dB, `prior`
//! [row, column], and `params`, a JSON object stored as bytes.

use super::{PlacementError, PlacementInput};
use crate::grid::SurveillanceGrid;
use crate::npz::Archive;
use crate::sonar::SonarError;
use crate::sonar::detection::{DetectionModel, FalseAlarmProbability, PassiveSonar};
use crate::sonar::link::{LinkModel, Modem};
use crate::sonar::noise::NoiseLevel;
use crate::sonar::prior::TargetPrior;
use serde::Deserialize;
use std::path::Path;

/// The keys of `params` that the problem needs; further ones are notes.
#[derive(Debug, Deserialize)]
struct Parameters {
    nx: usize,
    ny: usize,
    cell_km: f64,
    #[serde(rename = "G")]
    vehicles: usize,
    #[serde(rename = "SL")]
    source_level_db: f64,
    #[serde(rename = "NL")]
    noise_level_db: f64,
    #[serde(rename = "DI", default)]
    directivity_index_db: f64,
    #[serde(rename = "P_FA")]
    false_alarm_probability: f64,
    #[serde(rename = "SLc")]
    modem_source_level_db: f64,
    #[serde(rename = "NLc")]
    modem_noise_level_db: f64,
    packet_bits: u32,
    tau: f64,
}

/// Reads an instance: the paper's detector, Eq. (4), and its link, Eqs. (8)
/// and (9), on one table of transmission losses for both.
///
/// `params` holds `nx`, `ny` (columns and rows), `cell_km`, `G` (vehicles), `SL`,
/// `NL`, `DI` (0 if left out), `SLc`, `NLc` in dB, `P_FA`, `packet_bits`, and `tau`.
///
/// # Errors
/// Where the file cannot be read, an array is missing or has another shape, a
/// parameter is missing, of another type or out of range.
pub fn read(path: impl AsRef<Path>) -> Result<PlacementInput, PlacementError> {
    let archive = Archive::open(&path)?;
    let parameters: Parameters = serde_json::from_slice(&archive.bytes("params")?)
        .map_err(|source| PlacementError::Parameters { path: path.as_ref().into(), source })?;
    let Parameters { nx, ny, .. } = parameters;
    let prior = archive.f64s_of_shape("prior", &[ny, nx])?;
    // The prior's shape is now known to be real, so that this cannot overflow.
    let cells = nx * ny;
    let losses_db = archive.f64s_of_shape("tl", &[cells, cells])?;
    let cell_m = 1000.0 * parameters.cell_km;
    if !(cell_m.is_finite() && cell_m > 0.0) {
        let (name, found, expected) = ("cell_km", parameters.cell_km, "a positive number");
        return Err(SonarError::OutOfRange { name, found, expected }.into());
    }
    Ok(PlacementInput {
        grid: SurveillanceGrid {
            columns: nx,
            rows: ny,
            cell_width_m: cell_m,
            cell_height_m: cell_m,
        },
        prior: TargetPrior::new(prior.values)?,
        detection_loss_db: losses_db.values.iter().map(|&loss_db| loss_db as f32).collect(),
        communication_loss_db: None,
        sonar: PassiveSonar {
            source_level_db: parameters.source_level_db,
            noise_level_db: NoiseLevel::Uniform(parameters.noise_level_db),
            directivity_index_db: parameters.directivity_index_db,
            detection_threshold_db: 0.0,
            model: DetectionModel::MeanShift(FalseAlarmProbability::new(
                parameters.false_alarm_probability,
            )?),
        },
        modem: Modem {
            source_level_db: parameters.modem_source_level_db,
            noise_level_db: NoiseLevel::Uniform(parameters.modem_noise_level_db),
            model: LinkModel::CoherentBpsk { packet_bits: parameters.packet_bits },
        },
        vehicles: parameters.vehicles,
        connectivity_threshold: parameters.tau,
        deployable: None,
        fixed_sensors: Vec::new(),
    })
}
