//! From what was typed to what holds.

mod checker;
mod fleet;
mod listening;
mod planning;
mod water;

use super::{Scenario, ScenarioError, ScenarioFile};
use checker::Checker;
use sonarfleet_ocean::LocalFrame;
use std::path::Path;

const M_PER_KM: f64 = 1000.0;

/// Checks a scenario; `origin` names it in errors, paths are relative to `home`.
pub(super) fn check(
    file: ScenarioFile,
    origin: &str,
    home: &Path,
) -> Result<Scenario, ScenarioError> {
    let checker = Checker { origin, home };
    let region = water::region(&checker, &file.region)?;
    let frame = LocalFrame::new(region);
    let grid = water::grid(&checker, &file.region, &frame)?;
    let domain = planning::domain(&checker, &file.navigation, &grid)?;
    let place = fleet::Place { frame: &frame, grid: &grid, domain: &domain };
    let (frequency_hz, communication_frequency_hz) =
        listening::frequencies_hz(&checker, &file.sonar, &file.communications)?;
    Ok(Scenario {
        ocean: water::ocean(&checker, &file, region)?,
        sound_speed: water::sound_speed(file.ocean.sound_speed),
        seabed: water::seabed(&checker, &file.seabed)?,
        start: file.time.start,
        epoch_h: file.time.epoch_h,
        epochs: planning::epochs(&checker, &file, &grid)?,
        fleet: fleet::positions(&checker, &file.fleet, place)?,
        fleet_depth_m: checker.within("fleet.depth_m", file.fleet.depth_m, (1.0, 6000.0), "m")?,
        fixed_sensors: fleet::fixed_sensors(&checker, &file.fleet, place)?,
        vehicle: fleet::vehicle(&checker, &file)?,
        exclusions: fleet::exclusions(&checker, &file.deployable)?,
        sonar: listening::sonar(&checker, &file.sonar)?,
        modem: listening::modem(&checker, &file.communications)?,
        connectivity_threshold: checker.within(
            "communications.connectivity_threshold",
            file.communications.connectivity_threshold,
            (0.0, file.fleet.vehicles as f64),
            "(τ; at most the number of vehicles)",
        )?,
        frequency_hz,
        communication_frequency_hz,
        maximum_range_m: planning::maximum_range_m(&checker, &file.transmission_loss)?,
        quality: planning::quality(file.transmission_loss.quality),
        loss_model: planning::loss_model(&checker, file.transmission_loss.model)?,
        directions: file.transmission_loss.directions,
        method: planning::method(&checker, &file.placement)?,
        planner: file.navigation.planner,
        time_optimal: planning::time_optimal(&checker, &file.navigation)?,
        objective: planning::objective(&checker, &file.assignment)?,
        home: home.to_owned(),
        domain,
        frame,
        grid,
        file,
    })
}
