//! Step 1: the environment of an epoch.

use super::{MissionError, Theatre};
use crate::placement::{PlacementInput, PlacementProblem};
use crate::record::LossTableMetrics;
use crate::scenario::Scenario;
use crate::sonar::transmission_loss::TransmissionLossTable;
use sonarfleet_ocean::OceanState;

/// What an epoch's decisions are made on.
#[derive(Debug)]
pub struct Environment {
    /// The ocean at the epoch's snapshot.
    pub state: OceanState,
    /// Transmission loss between all cells.
    pub loss: TransmissionLossTable,
    /// How the table was made.
    pub loss_metrics: LossTableMetrics,
    /// The placement problem that follows.
    pub problem: PlacementProblem,
}
