//! Navigation instances: currents, a fleet, posts and pairs in one `.npz` archive.

use super::{CurrentField, NavigationError, TransitDomain, Vehicle};
use crate::grid::Position;
use crate::npz::{Archive, NpzError};
use serde::Deserialize;
use std::path::Path;

const METRES_PER_KM: f64 = 1000.0;

/// Side of the region of an instance that does not say it: 30 cells of 1.03 km.
const REGION_SIDE_KM: f64 = 30.9;

/// A planning problem as read from a file.
///
/// Keys: `u`, `v` [time, y, x] m/s (NaN: land); `xs_km`, `ys_km`, `times_h`, the
/// coordinates of the nodes; `params`, UTF-8 JSON with `auv_speed_m_s`,
/// `goal_radius_km`, `transit_margin_km`, `horizon_h` and, where the region is not
/// [0, 30.9]² km, `region_km`: [width, height]. Each of these groups may be absent:
/// `u_fc`, `v_fc`, a forecast of the current; `starts40`, `goals40` [count, 2] km,
/// the fleet and its posts; `pair_start`, `pair_goal` [count, 2] km and
/// `pair_t0` \[count\] h, single trips; `lon0`, `lat0`, degrees, where x = y = 0.
#[derive(Debug, Clone)]
pub struct NavigationInstance {
    /// The current.
    pub currents: CurrentField,
    /// A forecast of it.
    pub forecast: Option<CurrentField>,
    /// Speed of the vehicles through the water, m/s.
    pub speed_m_s: f64,
    /// Distance from a goal at which a vehicle has arrived, m.
    pub arrival_radius_m: f64,
    /// Where transit is allowed.
    pub domain: TransitDomain,
    /// Longest travel considered, hours.
    pub horizon_h: f64,
    /// Positions of the fleet.
    pub starts: Vec<Position>,
    /// Its posts.
    pub goals: Vec<Position>,
    /// Single trips.
    pub trips: Vec<Trip>,
    /// Longitude and latitude of x = y = 0, degrees.
    pub origin_deg: Option<(f64, f64)>,
}

/// One vehicle, one goal, one departure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trip {
    /// From where.
    pub start: Position,
    /// To where.
    pub goal: Position,
    /// Hours since the run's start.
    pub departure_h: f64,
}

#[derive(Deserialize)]
struct Parameters {
    auv_speed_m_s: f64,
    goal_radius_km: f64,
    transit_margin_km: f64,
    horizon_h: f64,
    region_km: Option<[f64; 2]>,
}

impl NavigationInstance {
    /// Reads an instance.
    ///
    /// # Errors
    /// An archive that cannot be read, an array that is missing or of another shape,
    /// parameters or currents that are not what they should be.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, NavigationError> {
        let archive = Archive::open(path)?;
        let parameters: Parameters =
            serde_json::from_slice(&archive.bytes("params")?).map_err(|source| {
                let path = archive.path().to_path_buf();
                NavigationError::InstanceParameters { path, source }
            })?;
        let [width_km, height_km] = parameters.region_km.unwrap_or([REGION_SIDE_KM; 2]);
        let domain = TransitDomain::around_region(
            width_km * METRES_PER_KM,
            height_km * METRES_PER_KM,
            parameters.transit_margin_km * METRES_PER_KM,
        )?;
        super::vehicle::positive("`horizon_h` of the instance", parameters.horizon_h)?;

        let forecast =
            if archive.contains("u_fc") { Some(currents(&archive, "u_fc", "v_fc")?) } else { None };
        let (starts, goals) = if archive.contains("starts40") {
            (positions(&archive, "starts40")?, positions(&archive, "goals40")?)
        } else {
            (Vec::new(), Vec::new())
        };
        let origin_deg = if archive.contains("lon0") {
            Some((scalar(&archive, "lon0")?, scalar(&archive, "lat0")?))
        } else {
            None
        };
        Ok(Self {
            currents: currents(&archive, "u", "v")?,
            forecast,
            speed_m_s: parameters.auv_speed_m_s,
            arrival_radius_m: parameters.goal_radius_km * METRES_PER_KM,
            domain,
            horizon_h: parameters.horizon_h,
            starts,
            goals,
            trips: trips(&archive)?,
            origin_deg,
        })
    }

    /// The instance's vehicle, given the time between two commands (hours).
    ///
    /// # Errors
    /// As [`Vehicle::new`].
    pub fn vehicle(&self, command_interval_h: f64) -> Result<Vehicle, NavigationError> {
        Vehicle::new(self.speed_m_s, self.arrival_radius_m, command_interval_h)
    }
}

fn currents(archive: &Archive, u: &str, v: &str) -> Result<CurrentField, NavigationError> {
    let axis = |key: &str, scale: f64| -> Result<Vec<f64>, NpzError> {
        let array = archive.f64s(key)?;
        if array.shape.len() != 1 {
            return Err(archive.wrong_shape(key, array.shape, "[nodes]".to_owned()));
        }
        Ok(array.values.iter().map(|value| value * scale).collect())
    };
    let east_m = axis("xs_km", METRES_PER_KM)?;
    let north_m = axis("ys_km", METRES_PER_KM)?;
    let time_h = axis("times_h", 1.0)?;
    let shape = [time_h.len(), north_m.len(), east_m.len()];
    let eastward = archive.f64s_of_shape(u, &shape)?;
    let northward = archive.f64s_of_shape(v, &shape)?;
    CurrentField::new(east_m, north_m, time_h, &eastward.values, &northward.values)
}

fn positions(archive: &Archive, key: &str) -> Result<Vec<Position>, NpzError> {
    let array = archive.f64s(key)?;
    if array.shape.len() != 2 || array.shape[1] != 2 {
        return Err(archive.wrong_shape(key, array.shape, "[count, 2]".to_owned()));
    }
    let position = |pair: &[f64]| Position::new(pair[0] * METRES_PER_KM, pair[1] * METRES_PER_KM);
    Ok(array.values.chunks_exact(2).map(position).collect())
}

fn scalar(archive: &Archive, key: &str) -> Result<f64, NpzError> {
    let array = archive.f64s(key)?;
    match array.values[..] {
        [value] => Ok(value),
        _ => Err(archive.wrong_shape(key, array.shape, "one number".to_owned())),
    }
}

fn trips(archive: &Archive) -> Result<Vec<Trip>, NpzError> {
    if !archive.contains("pair_start") {
        return Ok(Vec::new());
    }
    let starts = positions(archive, "pair_start")?;
    let goals = positions(archive, "pair_goal")?;
    if goals.len() != starts.len() {
        let found = vec![goals.len(), 2];
        return Err(archive.wrong_shape("pair_goal", found, format!("[{}, 2]", starts.len())));
    }
    let departures = archive.f64s_of_shape("pair_t0", &[starts.len()])?;
    let ends = starts.into_iter().zip(goals);
    let trip = |((start, goal), departure_h)| Trip { start, goal, departure_h };
    Ok(ends.zip(departures.values).map(trip).collect())
}
