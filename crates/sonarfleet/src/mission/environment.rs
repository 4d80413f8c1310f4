//! Step 1: the environment of an epoch.

use super::loss::{EpochLoss, LossTask};
use super::stage::Clock;
use super::{MissionError, Observer, Stage, Theatre};
use crate::placement::{PlacementInput, PlacementProblem};
use crate::scenario::{LossUse, Scenario};
use crate::sonar::transmission_loss::{LossCache, TransmissionLossTable};
use sonarfleet_ocean::OceanState;

/// What an epoch's decisions are made on.
#[derive(Debug)]
pub struct Environment {
    /// The ocean at the epoch's snapshot.
    pub state: OceanState,
    /// Transmission loss between all cells, at the frequency of detection.
    pub loss: EpochLoss,
    /// The same for the links between vehicles, where it is another table.
    pub communication_loss: Option<EpochLoss>,
    /// The placement problem that follows.
    pub problem: PlacementProblem,
}

impl Environment {
    /// The environment of an epoch: its ocean state, its own transmission-loss tables
    /// (from files if the scenario names some), its prior.
    ///
    /// # Errors
    /// If the ocean does not hold what is needed, a file does not fit, or no
    /// placement problem follows.
    pub fn at(
        scenario: &Scenario,
        theatre: &Theatre,
        epoch: usize,
        cache: Option<&LossCache>,
        observer: &Observer<'_>,
    ) -> Result<Self, MissionError> {
        Self::timed(scenario, theatre, epoch, cache, &mut Clock::new(epoch, observer))
    }

    /// The environment of an epoch, its stages timed by a clock.
    pub(super) fn timed(
        scenario: &Scenario,
        theatre: &Theatre,
        epoch: usize,
        cache: Option<&LossCache>,
        clock: &mut Clock<'_>,
    ) -> Result<Self, MissionError> {
        let state = theatre.forecast.at(scenario.instant(scenario.epochs[epoch].snapshot_h))?;
        let mut table = |stage, purpose| {
            let task = LossTask { scenario, theatre, state: &state, purpose, cache };
            clock.time(stage, |progress| task.table(epoch, progress))
        };
        let loss = table(Stage::TransmissionLoss, LossUse::Detection)?;
        let communication_loss = scenario
            .has_communication_table(epoch)
            .then(|| table(Stage::CommunicationLoss, LossUse::Communication))
            .transpose()?;
        let communication = communication_loss.as_ref().map(|loss| &loss.table);
        let input = input(scenario, theatre, epoch, &loss.table, communication);
        let problem = PlacementProblem::new(&input)?;
        Ok(Self { state, loss, communication_loss, problem })
    }

    /// Estimates the errors of the tables.
    ///
    /// # Errors
    /// As of computing a table.
    pub(super) fn estimate_loss_error(
        &mut self,
        scenario: &Scenario,
        theatre: &Theatre,
        cache: Option<&LossCache>,
        clock: &mut Clock<'_>,
    ) -> Result<(), MissionError> {
        let Self { state, loss, communication_loss, .. } = self;
        let task = |purpose| LossTask { scenario, theatre, state, purpose, cache };
        clock.time(Stage::LossError, |progress| {
            task(LossUse::Detection).estimate_error(loss, progress)
        })?;
        let Some(loss) = communication_loss else { return Ok(()) };
        clock.time(Stage::CommunicationLossError, |progress| {
            task(LossUse::Communication).estimate_error(loss, progress)
        })
    }
}

/// The placement problem of an epoch, given its transmission loss, and that of the
/// links where it is another.
pub fn input(
    scenario: &Scenario,
    theatre: &Theatre,
    epoch: usize,
    loss: &TransmissionLossTable,
    communication_loss: Option<&TransmissionLossTable>,
) -> PlacementInput {
    PlacementInput {
        grid: scenario.grid,
        prior: scenario.epochs[epoch].prior.clone(),
        detection_loss_db: loss.loss_db.clone(),
        communication_loss_db: communication_loss.map(|loss| loss.loss_db.clone()),
        sonar: scenario.sonar.clone(),
        modem: scenario.modem.clone(),
        vehicles: scenario.fleet.len(),
        connectivity_threshold: scenario.connectivity_threshold,
        deployable: Some(theatre.deployable.clone()),
        fixed_sensors: scenario.fixed_sensors.clone(),
    }
}
