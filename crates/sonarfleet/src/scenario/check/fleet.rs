//! Vehicles, sensors that stay, and where nothing may be placed.

use super::{Checker, M_PER_KM};
use crate::grid::{CellId, Position, SurveillanceGrid};
use crate::navigation::{TransitDomain, Vehicle};
use crate::scenario::{DeployableSection, Exclusions, FleetSection, ScenarioError, ScenarioFile};
use sonarfleet_ocean::LocalFrame;

/// What positions are checked against.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub(super) frame: &'a LocalFrame,
    pub(super) grid: &'a SurveillanceGrid,
    pub(super) domain: &'a TransitDomain,
}

/// Where the vehicles start: the list if there is one, else evenly along the line.
pub(super) fn positions(
    checker: &Checker<'_>,
    section: &FleetSection,
    place: Place<'_>,
) -> Result<Vec<Position>, ScenarioError> {
    let count = checker.count("fleet.vehicles", section.vehicles, (1, place.grid.cell_count()))?;
    let (key, positions) = if section.positions_deg.is_empty() {
        ("fleet.entry_line_km", along(section.entry_line_km, count))
    } else if section.positions_deg.len() == count {
        let local = |&degrees: &[f64; 2]| local(degrees, place.frame);
        ("fleet.positions_deg", section.positions_deg.iter().map(local).collect())
    } else {
        let found = format!("{} positions", section.positions_deg.len());
        let expected = format!("{count}, one per vehicle");
        return Err(checker.wrong("fleet.positions_deg", found, expected));
    };
    match positions.iter().find(|&&position| !place.domain.contains(position)) {
        None => Ok(positions),
        Some(outside) => {
            let found = format!(
                "{:.2} km east, {:.2} km north for a vehicle",
                outside.east_m / M_PER_KM,
                outside.north_m / M_PER_KM
            );
            Err(checker.wrong(key, found, "inside the region and its transit margin"))
        }
    }
}

fn along([from, to]: [[f64; 2]; 2], count: usize) -> Vec<Position> {
    let point = |k: usize| {
        let part = if count > 1 { k as f64 / (count - 1) as f64 } else { 0.5 };
        let between = |axis: usize| (from[axis] + (to[axis] - from[axis]) * part) * M_PER_KM;
        Position::new(between(0), between(1))
    };
    (0..count).map(point).collect()
}

fn local([longitude_deg, latitude_deg]: [f64; 2], frame: &LocalFrame) -> Position {
    let (east_m, north_m) = frame.to_local(longitude_deg, latitude_deg);
    Position::new(east_m, north_m)
}

pub(super) fn fixed_sensors(
    checker: &Checker<'_>,
    section: &FleetSection,
    place: Place<'_>,
) -> Result<Vec<CellId>, ScenarioError> {
    let cell = |&degrees: &[f64; 2]| {
        place.grid.cell_at(local(degrees, place.frame)).ok_or_else(|| {
            let found = format!("{}° E, {}° N", degrees[0], degrees[1]);
            checker.wrong("fleet.fixed_sensors_deg", found, "positions inside the region")
        })
    };
    section.fixed_sensors_deg.iter().map(cell).collect()
}

pub(super) fn vehicle(
    checker: &Checker<'_>,
    file: &ScenarioFile,
) -> Result<Vehicle, ScenarioError> {
    let speed_m_s = checker.within("fleet.speed_m_s", file.fleet.speed_m_s, (0.01, 10.0), "m/s")?;
    let arrival_radius_m = checker.within(
        "fleet.arrival_radius_m",
        file.fleet.arrival_radius_m,
        (1.0, 5000.0),
        "m",
    )?;
    let command_interval_h = checker.within(
        "navigation.command_interval_h",
        file.navigation.command_interval_h,
        (0.01, 24.0),
        "h",
    )?;
    Vehicle::new(speed_m_s, arrival_radius_m, command_interval_h)
        .map_err(|error| checker.wrong("fleet.speed_m_s", speed_m_s, error))
}

pub(super) fn exclusions(
    checker: &Checker<'_>,
    section: &DeployableSection,
) -> Result<Exclusions, ScenarioError> {
    let Some(path) = &section.exclusions else { return Ok(Exclusions::default()) };
    let key = "deployable.exclusions";
    let path = checker.existing(key, path)?;
    let text = std::fs::read_to_string(&path).map_err(|error| checker.file(key, &path, error))?;
    Exclusions::parse(&text).map_err(|reason| checker.file(key, &path, reason))
}
