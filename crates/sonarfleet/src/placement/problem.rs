//! The placement problem: which cells to choose so that most targets are heard
//! while the vehicles hear each other.

use super::{Evaluation, PlacementError};
use crate::grid::{CellId, SurveillanceGrid};
use crate::sonar::connectivity::algebraic_connectivity;
use crate::sonar::detection::PassiveSonar;
use crate::sonar::link::Modem;
use crate::sonar::objective::{detection_utility, network_detection_probability};
use crate::sonar::prior::TargetPrior;

/// What a placement problem is made of.
#[derive(Debug, Clone)]
pub struct PlacementInput {
    /// The cells to choose from.
    pub grid: SurveillanceGrid,
    /// Where targets are expected.
    pub prior: TargetPrior,
    /// Transmission loss at the target's frequency, [sonar cell, target cell],
    /// dB; +∞ where nothing arrives.
    pub detection_loss_db: Vec<f32>,
    /// Transmission loss at the modem's frequency, [transmitter cell, receiver
    /// cell], dB; none where it is the same table.
    pub communication_loss_db: Option<Vec<f32>>,
    /// Target, noise and detector.
    pub sonar: PassiveSonar,
    /// Modem, noise and link.
    pub modem: Modem,
    /// Number of vehicles to place, G; one per cell.
    pub vehicles: usize,
    /// Required algebraic connectivity τ, at least 0.
    pub connectivity_threshold: f64,
    /// Whether a vehicle may be placed in a cell, [row, column]; none where
    /// everywhere.
    pub deployable: Option<Vec<bool>>,
    /// Sensors that are there already: they listen and relay, in coverage and in
    /// the communication graph, but are not moved; nothing is placed in their cells.
    pub fixed_sensors: Vec<CellId>,
}

/// A checked placement problem with its tables of detection probabilities and
/// link weights.
#[derive(Debug, Clone)]
pub struct PlacementProblem {
    grid: SurveillanceGrid,
    prior: TargetPrior,
    vehicles: usize,
    connectivity_threshold: f64,
    deployable: Vec<CellId>,
    fixed_sensors: Vec<CellId>,
    /// [sonar, target]
    detection: Vec<f64>,
    /// [cell, cell], symmetric, zero diagonal
    links: Vec<f64>,
    search: SearchTable,
}

/// Probabilities of *not* detecting, for the targets that count, in single
/// precision: what the inner loops of the solvers stream through.
///
/// Rows are dense. With a detector whose probability never falls below its
/// false-alarm probability, distant cells add up: with 40 vehicles on 30 × 30
/// cells, leaving out probabilities below 0.01 lowered `J_d` of random and of
/// compact layouts by a tenth to a third.
/// Range limits what is looked at on the targets' side: cells whose share of the
/// prior is below [`NEGLIGIBLE_SHARE`] are left out.
#[derive(Debug, Clone)]
struct SearchTable {
    /// The targets that count.
    targets: Vec<CellId>,
    /// Targets per row, filled up with targets of weight 0 to a whole number of [`LANES`].
    width: usize,
    /// [sonar, target]
    miss: Vec<f32>,
    /// Prior times what the fixed sensors miss.
    residual: Vec<f32>,
    /// What the vehicles can add to the utility of the fixed sensors, at most.
    total: f64,
    /// `J_d` of the fixed sensors alone.
    fixed_utility: f64,
}

/// Values that the inner loops take at a time.
pub(super) const LANES: usize = 16;

/// Cells with a smaller share of the prior are left out while searching; all of
/// them together weigh less than the rounding of single precision.
const NEGLIGIBLE_SHARE: f64 = 1e-12;

impl PlacementProblem {
    /// Checks the parts and computes the tables.
    ///
    /// # Errors
    /// Where a table, the prior or the mask does not fit the grid, a loss is NaN,
    /// a level is not finite, τ is negative, a fixed sensor is misplaced, or there
    /// are no vehicles or fewer deployable cells than vehicles.
    pub fn new(input: &PlacementInput) -> Result<Self, PlacementError> {
        let grid = input.grid;
        let cells = grid.cell_count();
        input.sonar.check(cells)?;
        input.modem.check(cells)?;
        check_size(grid, "prior", input.prior.values().len(), cells)?;
        check_losses(grid, "detection_loss_db", &input.detection_loss_db)?;
        if let Some(losses_db) = &input.communication_loss_db {
            check_losses(grid, "communication_loss_db", losses_db)?;
        }
        if let Some(deployable) = &input.deployable {
            check_size(grid, "deployable", deployable.len(), cells)?;
        }
        let found = input.connectivity_threshold;
        if !(found.is_finite() && found >= 0.0) {
            return Err(PlacementError::BadThreshold { found });
        }
        check_fixed_sensors(&input.fixed_sensors, cells)?;
        let deployable: Vec<CellId> = grid
            .cells()
            .filter(|cell| input.deployable.as_ref().is_none_or(|mask| mask[cell.0]))
            .filter(|cell| !input.fixed_sensors.contains(cell))
            .collect();
        if input.vehicles == 0 {
            return Err(PlacementError::NoVehicles);
        }
        if deployable.len() < input.vehicles {
            let (vehicles, deployable) = (input.vehicles, deployable.len());
            return Err(PlacementError::TooFewCells { vehicles, deployable });
        }

        let detection: Vec<f64> = grid
            .cells()
            .zip(input.detection_loss_db.chunks_exact(cells))
            .flat_map(|(cell, losses_db)| input.sonar.detection_probabilities(cell, losses_db))
            .collect();
        let communication = input.communication_loss_db.as_ref();
        let links =
            input.modem.link_weights(cells, communication.unwrap_or(&input.detection_loss_db));
        let search = SearchTable::new(input, &detection);
        Ok(Self {
            grid,
            prior: input.prior.clone(),
            vehicles: input.vehicles,
            connectivity_threshold: input.connectivity_threshold,
            deployable,
            fixed_sensors: input.fixed_sensors.clone(),
            detection,
            links,
            search,
        })
    }

    /// The grid.
    pub const fn grid(&self) -> &SurveillanceGrid {
        &self.grid
    }

    /// Where targets are expected.
    pub const fn prior(&self) -> &TargetPrior {
        &self.prior
    }

    /// Number of vehicles to place, G.
    pub const fn vehicles(&self) -> usize {
        self.vehicles
    }

    /// Required algebraic connectivity τ.
    pub const fn connectivity_threshold(&self) -> f64 {
        self.connectivity_threshold
    }

    /// Cells where a vehicle may be placed, ascending; those of fixed sensors are not.
    pub fn deployable(&self) -> &[CellId] {
        &self.deployable
    }

    /// Sensors that are there already.
    pub fn fixed_sensors(&self) -> &[CellId] {
        &self.fixed_sensors
    }

    /// Probabilities with which a sonar in `cell` detects a target in each cell.
    pub fn detection(&self, cell: CellId) -> &[f64] {
        let cells = self.grid.cell_count();
        &self.detection[cell.0 * cells..(cell.0 + 1) * cells]
    }

    /// Weights of the links between `cell` and every cell, itself with 0.
    pub fn links(&self, cell: CellId) -> &[f64] {
        let cells = self.grid.cell_count();
        &self.links[cell.0 * cells..(cell.0 + 1) * cells]
    }

    /// Weight of the link between two cells, min(`p_pq`, `p_qp`).
    pub fn link(&self, p: CellId, q: CellId) -> f64 {
        self.links[p.0 * self.grid.cell_count() + q.0]
    }

    /// Network detection probability `P_net` of a layout together with the fixed
    /// sensors, [row, column].
    pub fn network_detection(&self, layout: &[CellId]) -> Vec<f64> {
        let mut miss = vec![1.0; self.grid.cell_count()];
        for &cell in self.fixed_sensors.iter().chain(layout) {
            for (miss, p_d) in miss.iter_mut().zip(self.detection(cell)) {
                *miss *= 1.0 - p_d;
            }
        }
        miss.into_iter().map(|miss| network_detection_probability([1.0 - miss])).collect()
    }

    /// Full evaluation of a layout (of any number of vehicles).
    pub fn evaluate(&self, layout: &[CellId]) -> Evaluation {
        let utility = detection_utility(self.prior.values(), &self.network_detection(layout));
        let connectivity = self.connectivity(layout);
        Evaluation {
            detection_utility: utility,
            algebraic_connectivity: connectivity,
            feasible: connectivity >= self.connectivity_threshold,
        }
    }

    /// λ₂ of a layout together with the fixed sensors.
    pub fn connectivity(&self, layout: &[CellId]) -> f64 {
        let stations: Vec<CellId> = self.fixed_sensors.iter().chain(layout).copied().collect();
        let mut weights = Vec::with_capacity(stations.len() * stations.len());
        for &p in &stations {
            weights.extend(stations.iter().map(|&q| self.link(p, q)));
        }
        algebraic_connectivity(&weights, stations.len())
    }

    /// The targets that count, in the order of the rows of [`Self::miss`].
    pub(super) fn targets(&self) -> &[CellId] {
        &self.search.targets
    }

    /// Probabilities that a sonar in `cell` misses each target that counts.
    pub(super) fn miss(&self, cell: CellId) -> &[f32] {
        let width = self.search.width;
        &self.search.miss[cell.0 * width..(cell.0 + 1) * width]
    }

    /// Prior of the targets that count times what the fixed sensors miss of them.
    pub(super) fn initial_residual(&self) -> &[f32] {
        &self.search.residual
    }

    /// `J_d` of a residual (prior times what all sensors miss, summed).
    pub(super) fn utility_of_residual(&self, residual: f32) -> f64 {
        self.search.fixed_utility + (self.search.total - f64::from(residual))
    }
}

impl SearchTable {
    fn new(input: &PlacementInput, detection: &[f64]) -> Self {
        let cells = input.grid.cell_count();
        let prior = input.prior.values();
        let least = NEGLIGIBLE_SHARE * input.prior.total();
        let targets: Vec<CellId> =
            input.grid.cells().filter(|target| prior[target.0] > least).collect();
        let width = targets.len().next_multiple_of(LANES);
        let mut miss = vec![0.0; cells * width];
        for (row, probabilities) in miss.chunks_exact_mut(width).zip(detection.chunks_exact(cells))
        {
            for (miss, &target) in row.iter_mut().zip(&targets) {
                *miss = (1.0 - probabilities[target.0]) as f32;
            }
        }
        let missed_by_fixed: Vec<f64> = targets
            .iter()
            .map(|target| {
                let fixed = input.fixed_sensors.iter();
                prior[target.0]
                    * fixed.map(|cell| 1.0 - detection[cell.0 * cells + target.0]).product::<f64>()
            })
            .collect();
        let total: f64 = missed_by_fixed.iter().sum();
        let mut residual = vec![0.0; width];
        for (residual, missed) in residual.iter_mut().zip(&missed_by_fixed) {
            *residual = *missed as f32;
        }
        let expected: f64 = targets.iter().map(|target| prior[target.0]).sum();
        Self { targets, width, miss, residual, total, fixed_utility: expected - total }
    }
}

fn check_size(
    grid: SurveillanceGrid,
    name: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), PlacementError> {
    let SurveillanceGrid { columns, rows, .. } = grid;
    if found == expected {
        Ok(())
    } else {
        Err(PlacementError::WrongSize { name, found, expected, columns, rows })
    }
}

fn check_losses(
    grid: SurveillanceGrid,
    name: &'static str,
    losses_db: &[f32],
) -> Result<(), PlacementError> {
    let cells = grid.cell_count();
    check_size(grid, name, losses_db.len(), cells * cells)?;
    match losses_db.iter().position(|loss| loss.is_nan() || *loss == f32::NEG_INFINITY) {
        Some(at) => Err(PlacementError::BadLoss {
            name,
            from: CellId(at / cells),
            to: CellId(at % cells),
            found: losses_db[at],
        }),
        None => Ok(()),
    }
}

fn check_fixed_sensors(sensors: &[CellId], cells: usize) -> Result<(), PlacementError> {
    for (index, &cell) in sensors.iter().enumerate() {
        let reason = if cell.0 >= cells {
            "it lies outside the grid"
        } else if sensors[..index].contains(&cell) {
            "another one is in the same cell"
        } else {
            continue;
        };
        return Err(PlacementError::BadFixedSensor { index, cell, reason });
    }
    Ok(())
}
