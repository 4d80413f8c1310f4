//! Step 6: what is known after an epoch, as its record.

use super::stage::Clock;
use super::{Environment, Mission, excerpts};
use crate::grid::{CellId, Position};
use crate::navigation::{Route, TravelTimes};
use crate::placement::random::RandomSearch;
use crate::placement::{Budget, Contribution, Placement, Solver};
use crate::record::{EpochMetrics, EpochRecord, PlacementPart, RouteRecord, RunRecord, TrackPoint};

/// What an epoch decided and what came of it.
pub(super) struct Outcome {
    pub(super) placement: Placement,
    pub(super) travel: TravelTimes,
    /// Post of each vehicle, an index into the placement's cells.
    pub(super) posts: Vec<usize>,
    pub(super) movement: Movement,
}

/// Vehicles on their way during one epoch.
pub(super) struct Movement {
    /// Travelled within the epoch.
    pub(super) travelled: Vec<Route>,
    /// Still to go, for those under way at the end of it.
    pub(super) remaining: Vec<Option<Route>>,
}

impl Mission<'_> {
    /// Step 6: measures the layout, the fleet at the epoch's start and at its end,
    /// and writes the epoch down.
    pub(super) fn update_knowledge(
        &self,
        epoch: usize,
        environment: &Environment,
        outcome: &Outcome,
        [start, end]: [&[Position]; 2],
        clock: Clock<'_>,
    ) -> EpochRecord {
        let (scenario, theatre) = (self.scenario, self.theatre);
        let problem = &environment.problem;
        let plan = &scenario.epochs[epoch];
        let random = RandomSearch.solve(problem, Budget::Evaluations(1), scenario.seed_of(epoch));
        let at_start = problem.evaluate(&self.cells_of(start));
        let at_end = problem.evaluate(&self.cells_of(end));
        let Outcome { placement, travel, posts, movement } = outcome;
        let expected_h: Vec<f64> = posts
            .iter()
            .enumerate()
            .map(|(vehicle, &post)| travel.pair(vehicle, post).hours)
            .collect();
        let reachable: Vec<f64> =
            expected_h.iter().copied().filter(|hours| hours.is_finite()).collect();
        let metrics = EpochMetrics {
            detection_utility: placement.evaluation.detection_utility,
            algebraic_connectivity: placement.evaluation.algebraic_connectivity,
            feasible: placement.evaluation.feasible,
            upper_bound: placement.upper_bound,
            random_detection_utility: random.evaluation.detection_utility,
            random_algebraic_connectivity: random.evaluation.algebraic_connectivity,
            detection_utility_at_start: at_start.detection_utility,
            detection_utility_at_end: at_end.detection_utility,
            algebraic_connectivity_at_end: at_end.algebraic_connectivity,
            mean_travel_time_h: reachable.iter().sum::<f64>() / reachable.len() as f64,
            largest_travel_time_h: reachable.iter().copied().fold(f64::NAN, f64::max),
            arrived: movement.travelled.iter().filter(|route| route.arrived()).count(),
            unreachable: expected_h.len() - reachable.len(),
            transmission_loss: environment.loss.metrics.clone(),
            communication_loss: environment
                .communication_loss
                .as_ref()
                .map(|loss| loss.metrics.clone()),
            evaluations: placement.evaluations,
            placement_history: placement.history.clone(),
            placement_parts: placement.contributions.iter().map(part).collect(),
        };
        let loss_source = self.loss_source();
        EpochRecord {
            epoch,
            time: scenario.instant(plan.start_h).to_string(),
            start_h: plan.start_h,
            duration_h: scenario.epoch_h,
            prior: plan.prior.values().to_vec(),
            detection_probability: problem.network_detection(&placement.cells),
            random_detection_probability: problem.network_detection(&random.cells),
            random_layout: random.cells,
            loss_source,
            loss_db: environment.loss.table.row(loss_source).to_vec(),
            sound_speed: excerpts::sound_speed(
                &environment.state,
                &theatre.bathymetry,
                scenario.sound_speed,
                &scenario.frame,
                &scenario.grid,
            ),
            current: excerpts::current(&theatre.currents, scenario.domain, plan.start_h),
            layout: placement.cells.clone(),
            routes: (0..start.len()).map(|vehicle| route_record(vehicle, outcome)).collect(),
            metrics,
            seconds: clock.seconds,
        }
    }

    /// The record of the run from those of its epochs.
    pub fn run_record(&self, epochs: Vec<EpochRecord>) -> RunRecord {
        let (scenario, theatre) = (self.scenario, self.theatre);
        RunRecord {
            name: scenario.file.name.clone(),
            ocean_source: scenario.ocean.describe(),
            version: env!("CARGO_PKG_VERSION").into(),
            seed: scenario.file.seed,
            grid: scenario.grid,
            cell_longitude_deg: theatre
                .cell_degrees
                .iter()
                .map(|&(longitude, _)| longitude)
                .collect(),
            cell_latitude_deg: theatre.cell_degrees.iter().map(|&(_, latitude)| latitude).collect(),
            cell_depth_m: theatre.cell_depth_m.iter().map(|&depth| depth as f32).collect(),
            blocked_cells: theatre.blocked_cells(),
            fixed_sensors: scenario.fixed_sensors.clone(),
            fleet_depth_m: scenario.fleet_depth_m,
            vehicle_speed_m_s: scenario.vehicle.speed_m_s(),
            transit_margin_m: scenario.transit_margin_m(),
            connectivity_threshold: scenario.connectivity_threshold,
            epochs,
        }
    }

    /// The cells in which vehicles are; those outside the region are in none.
    fn cells_of(&self, fleet: &[Position]) -> Vec<CellId> {
        fleet.iter().filter_map(|&position| self.scenario.grid.cell_at(position)).collect()
    }

    /// The excerpt's source: the middle of the western edge, or the deployable cell
    /// nearest to it (Fig. 3a: "a boundary center").
    fn loss_source(&self) -> CellId {
        let grid = &self.scenario.grid;
        let boundary_centre = Position::new(0.0, 0.5 * grid.height_m());
        grid.cells()
            .filter(|cell| self.theatre.deployable[cell.0])
            .min_by(|&a, &b| {
                let distance_m = |cell| grid.centre(cell).distance_m(boundary_centre);
                distance_m(a).total_cmp(&distance_m(b))
            })
            .expect("a theatre has a deployable cell")
    }
}

fn part(contribution: &Contribution) -> PlacementPart {
    let best = contribution.best;
    PlacementPart {
        by: contribution.by.clone(),
        layouts: contribution.layouts,
        detection_utility: best.detection_utility,
        algebraic_connectivity: best.algebraic_connectivity,
        feasible: best.feasible,
    }
}

/// One vehicle's epoch.
fn route_record(vehicle: usize, outcome: &Outcome) -> RouteRecord {
    let post = outcome.posts[vehicle];
    let travelled = &outcome.movement.travelled[vehicle];
    let planned = outcome.movement.remaining[vehicle].as_ref();
    RouteRecord {
        vehicle,
        post: outcome.placement.cells[post],
        expected_travel_time_h: outcome.travel.pair(vehicle, post).hours,
        track: travelled.track(),
        planned: planned.map_or_else(Vec::<TrackPoint>::new, Route::track),
        arrived: travelled.arrived(),
        failure: travelled.failure().or_else(|| planned.and_then(Route::failure)),
    }
}
