//! A made-up but plausible run, for tests and for the example that draws one:
//! a corridor prior that turns, an eddy and a front, a sloping sea bed, vehicles
//! that enter in the west and cannot all arrive at once.

mod comparison;
mod training;

pub(crate) use comparison::{chart, layouts, scores};
pub(crate) use training::training;

use sonarfleet::grid::{CellId, Position, SurveillanceGrid};
use sonarfleet::record::{
    CurrentRecord, EpochMetrics, EpochRecord, LossTableMetrics, PlacementPart, RouteRecord,
    RunRecord, SoundSpeedRecord, TrackPoint,
};

const EPOCH_H: f64 = 6.0;
const VEHICLE_SPEED_M_S: f64 = 0.23;
const MARGIN_M: f64 = 10_000.0;
const SECONDS_PER_HOUR: f64 = 3600.0;

/// The size of a made-up run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Size {
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    pub(crate) vehicles: usize,
    pub(crate) epochs: usize,
}

/// The size of the embedded scenario.
pub(crate) const FULL: Size = Size { columns: 30, rows: 30, vehicles: 40, epochs: 4 };

/// A made-up run.
pub(crate) fn record(size: Size) -> RunRecord {
    let grid = SurveillanceGrid {
        columns: size.columns,
        rows: size.rows,
        cell_width_m: 1034.0,
        cell_height_m: 1033.0,
    };
    let centres = || grid.cells().map(|cell| grid.centre(cell));
    let depth = |p: Position| {
        let (x, y) = (p.east_m / 31_000.0, p.north_m / 31_000.0);
        1150.0 + 700.0 * x + 180.0 * (3.0 * y + 1.0).sin() - 330.0 * bump(x, y, 0.35, 0.7, 0.12)
    };
    let blocked: Vec<CellId> = grid
        .cells()
        .filter(|&cell| {
            let p = grid.centre(cell);
            (p.east_m - 25_500.0).abs() < 2000.0 && (p.north_m - 5000.0).abs() < 1600.0
        })
        .collect();
    let mut starts: Vec<Position> = (0..size.vehicles)
        .map(|k| {
            let along = (k as f64 + 0.5) / size.vehicles as f64;
            Position::new(0.02 * grid.width_m(), along * grid.height_m())
        })
        .collect();
    let epochs = (0..size.epochs).map(|k| epoch(k, grid, size, &depth, &blocked, &mut starts));
    let epochs = epochs.collect();
    RunRecord {
        name: "South China Sea slope, sample".into(),
        ocean_source: "synthetic ocean, not an observation".into(),
        version: "0.1.0".into(),
        seed: 20_251_009,
        grid,
        cell_longitude_deg: centres().map(|p| 118.1 + 0.3 * p.east_m / grid.width_m()).collect(),
        cell_latitude_deg: centres().map(|p| 21.6 + 0.28 * p.north_m / grid.height_m()).collect(),
        cell_depth_m: centres().map(|p| depth(p) as f32).collect(),
        blocked_cells: blocked,
        fixed_sensors: vec![],
        fleet_depth_m: 200.0,
        vehicle_speed_m_s: VEHICLE_SPEED_M_S,
        transit_margin_m: MARGIN_M,
        connectivity_threshold: 0.95,
        epochs,
    }
}

fn bump(x: f64, y: f64, x0: f64, y0: f64, width: f64) -> f64 {
    (-((x - x0).powi(2) + (y - y0).powi(2)) / (2.0 * width * width)).exp()
}

/// Current of an eddy that drifts east and a tide that turns, m/s.
fn current(p: Position, time_h: f64) -> [f64; 2] {
    let centre = [14_000.0 + 350.0 * time_h, 17_000.0];
    let (dx, dy) = ((p.east_m - centre[0]) / 9000.0, (p.north_m - centre[1]) / 9000.0);
    let swirl = 0.15 * (0.5 - 0.5 * (dx * dx + dy * dy)).exp();
    let phase = time_h / 33.0 * std::f64::consts::TAU;
    [-swirl * dy + 0.05 * phase.cos() + 0.03, swirl * dx - 0.05 * phase.sin()]
}

fn placement_parts(best: f64) -> Vec<PlacementPart> {
    [("connected-greedy", 1, 0.86), ("policy", 64, 0.97), ("annealing", 8, 1.0)]
        .map(|(by, layouts, share)| PlacementPart {
            by: by.into(),
            layouts,
            detection_utility: share * best,
            algebraic_connectivity: 0.96,
            feasible: true,
        })
        .to_vec()
}

fn epoch(
    index: usize,
    grid: SurveillanceGrid,
    size: Size,
    depth: &dyn Fn(Position) -> f64,
    blocked: &[CellId],
    starts: &mut [Position],
) -> EpochRecord {
    let start_h = index as f64 * EPOCH_H;
    let prior: Vec<f64> = grid.cells().map(|cell| corridor(grid, cell, index)).collect();
    let layout = chosen(grid, &prior, blocked, size.vehicles);
    let random_layout: Vec<CellId> = (0..size.vehicles)
        .map(|k| {
            let scattered = ((k * 31 + index * 7 + 1) as f64 * 12.9898).sin().abs() * 43_758.545;
            CellId((scattered.fract() * grid.cell_count() as f64) as usize)
        })
        .collect();
    let detected = |layout: &[CellId]| -> Vec<f64> {
        let miss = |cell: CellId, sensor: &CellId| {
            let distance = grid.centre(cell).distance_m(grid.centre(*sensor));
            1.0 - 0.9 / (1.0 + (distance / 1500.0).powi(4))
        };
        grid.cells()
            .map(|cell| 1.0 - layout.iter().map(|sensor| miss(cell, sensor)).product::<f64>())
            .collect()
    };
    let utility = |detection: &[f64]| -> f64 {
        prior.iter().zip(detection).map(|(prior, detected)| prior * detected).sum()
    };
    let detection_probability = detected(&layout);
    let random_detection_probability = detected(&random_layout);
    let cell_of = |p: &Position| grid.cell_at(*p);
    let at_start: Vec<CellId> = starts.iter().filter_map(cell_of).collect();
    let routes: Vec<RouteRecord> = starts
        .iter_mut()
        .enumerate()
        .map(|(vehicle, start)| {
            route(vehicle, start, layout[vehicle], grid, start_h, size.vehicles)
        })
        .collect();
    let at_end: Vec<CellId> = starts.iter().filter_map(cell_of).collect();
    let reachable = || routes.iter().map(|r| r.expected_travel_time_h).filter(|t| t.is_finite());
    let source = CellId((grid.rows - 1) * grid.columns + grid.columns / 2);
    let best = utility(&detection_probability);
    let lambda = 0.951 + 0.004 * index as f64;
    let metrics = EpochMetrics {
        detection_utility: best,
        algebraic_connectivity: lambda,
        feasible: true,
        upper_bound: best * 1.038,
        random_detection_utility: utility(&random_detection_probability),
        random_algebraic_connectivity: 0.021,
        detection_utility_at_start: utility(&detected(&at_start)),
        detection_utility_at_end: utility(&detected(&at_end)),
        algebraic_connectivity_at_end: 0.31 + 0.1 * index as f64,
        mean_travel_time_h: reachable().sum::<f64>() / reachable().count().max(1) as f64,
        largest_travel_time_h: reachable().fold(0.0, f64::max),
        arrived: routes.iter().filter(|r| r.arrived).count(),
        unreachable: routes.iter().filter(|r| r.failure.is_some()).count(),
        communication_loss: None,
        transmission_loss: LossTableMetrics {
            model: "native".into(),
            frequency_hz: 1000.0,
            both_directions: false,
            beams: 161,
            bearings: 72,
            range_m: 12_000.0,
            sampled_sources: 8,
            median_error_db: 0.21,
            p90_error_db: 0.83,
        },
        evaluations: 200_000,
        placement_history: (0..40)
            .map(|k| (1 + 5000 * k, best * (1.0 - 0.45 * (-(k as f64) / 6.0).exp())))
            .collect(),
        placement_parts: placement_parts(best),
    };
    EpochRecord {
        epoch: index,
        seconds: [("ocean", 0.4), ("transmission loss", 21.7), ("placement", 3.9)]
            .into_iter()
            .chain([("travel times", 6.2), ("assignment", 0.01), ("execution", 0.3)])
            .map(|(stage, seconds)| (stage.to_owned(), seconds))
            .collect(),
        time: format!("2025-10-{:02}T{:02}:00:00Z", 9 + index / 4, index * 6 % 24),
        start_h,
        duration_h: EPOCH_H,
        loss_db: grid.cells().map(|cell| loss_db(grid, source, cell, depth)).collect(),
        prior,
        detection_probability,
        random_detection_probability,
        random_layout,
        loss_source: source,
        sound_speed: sound_speed(grid, start_h, depth),
        current: current_record(grid, start_h),
        layout,
        routes,
        metrics,
    }
}

/// The paper's corridor, turning from epoch to epoch.
fn corridor(grid: SurveillanceGrid, cell: CellId, epoch: usize) -> f64 {
    let p = grid.centre(cell);
    let (x, y) = (10.0 * p.east_m / grid.width_m(), 10.0 * p.north_m / grid.height_m());
    let turn = -1.107 + 0.28 * epoch as f64;
    let (dx, dy) = (x - 4.0 - 0.5 * epoch as f64, y - 5.0);
    let along = dx * turn.cos() + dy * turn.sin();
    let across = -dx * turn.sin() + dy * turn.cos();
    0.62 * (-(across / 0.9).powi(2) / 2.0 - (along / 3.1).powi(2) / 2.0).exp()
}

/// Cells of high prior that keep a distance from each other.
fn chosen(grid: SurveillanceGrid, prior: &[f64], blocked: &[CellId], count: usize) -> Vec<CellId> {
    let mut order: Vec<CellId> = grid.cells().filter(|cell| !blocked.contains(cell)).collect();
    order.sort_by(|a, b| prior[b.0].total_cmp(&prior[a.0]));
    let mut layout: Vec<CellId> = Vec::new();
    for distance_m in [2500.0, 1500.0, 0.0] {
        for &cell in &order {
            let apart = |other: &CellId| {
                grid.centre(cell).distance_m(grid.centre(*other)) > distance_m && *other != cell
            };
            if layout.len() < count && layout.iter().all(apart) {
                layout.push(cell);
            }
        }
    }
    layout.sort_by_key(|cell| cell.0 / grid.columns);
    layout
}

/// Steers towards the post through the current; leaves the vehicle where the epoch ends.
fn route(
    vehicle: usize,
    start: &mut Position,
    post: CellId,
    grid: SurveillanceGrid,
    start_h: f64,
    vehicles: usize,
) -> RouteRecord {
    const STEP_H: f64 = 0.25;
    let goal = grid.centre(post);
    if vehicle + 1 == vehicles && start_h > 0.0 {
        let here = TrackPoint { time_h: start_h, position: *start };
        return RouteRecord {
            vehicle,
            post,
            expected_travel_time_h: f64::INFINITY,
            track: vec![here],
            planned: vec![],
            arrived: false,
            failure: Some("the current is faster than the vehicle on every way to the post".into()),
        };
    }
    let (mut p, mut time_h) = (*start, start_h);
    let mut points = vec![TrackPoint { time_h, position: p }];
    while p.distance_m(goal) > 400.0 && time_h < start_h + 90.0 {
        let [u, v] = current(p, time_h);
        let length = p.distance_m(goal);
        let ahead = [(goal.east_m - p.east_m) / length, (goal.north_m - p.north_m) / length];
        // Half of the drift across the line to the post is steered against.
        let drift = 0.5 * (-u * ahead[1] + v * ahead[0]);
        let onward = (VEHICLE_SPEED_M_S.powi(2) - drift.powi(2)).max(0.0).sqrt();
        let step = STEP_H * SECONDS_PER_HOUR;
        p.east_m += (u + onward * ahead[0] + drift * ahead[1]) * step;
        p.north_m += (v + onward * ahead[1] - drift * ahead[0]) * step;
        time_h += STEP_H;
        points.push(TrackPoint { time_h, position: p });
    }
    let end_h = start_h + EPOCH_H;
    let inside = points.iter().filter(|point| point.time_h <= end_h).count();
    let arrived = inside == points.len();
    let planned = if arrived { vec![] } else { points[inside - 1..].to_vec() };
    let expected_travel_time_h = points[points.len() - 1].time_h - start_h;
    points.truncate(inside);
    *start = points[inside - 1].position;
    RouteRecord {
        vehicle,
        post,
        expected_travel_time_h,
        track: points,
        planned,
        arrived,
        failure: None,
    }
}

fn loss_db(
    grid: SurveillanceGrid,
    source: CellId,
    cell: CellId,
    depth: &dyn Fn(Position) -> f64,
) -> f32 {
    let (from, to) = (grid.centre(source), grid.centre(cell));
    let range_m = from.distance_m(to).max(200.0);
    let bearing = (to.north_m - from.north_m).atan2(to.east_m - from.east_m);
    let zones = 4.0 * (range_m / 2600.0 + 0.4 * (2.0 * bearing).sin()).sin();
    let shelf = (1400.0 - depth(to)).max(0.0) * 0.012;
    (20.0 * range_m.log10() + 0.0004 * range_m + zones + shelf) as f32
}

fn sound_speed(
    grid: SurveillanceGrid,
    time_h: f64,
    depth: &dyn Fn(Position) -> f64,
) -> SoundSpeedRecord {
    let depth_m: Vec<f64> =
        vec![0., 10., 25., 50., 75., 100., 150., 200., 250., 300., 400., 500., 600., 800., 1000.]
            .into_iter()
            .chain([1200., 1400., 1600., 1800., 2000., 2200.])
            .collect();
    let axis =
        |length: f64| -> Vec<f64> { (0..=30).map(|k| f64::from(k) / 30.0 * length).collect() };
    let (east_m, north_m) = (axis(grid.width_m()), axis(grid.height_m()));
    let mut speed_m_s = Vec::new();
    for &z in &depth_m {
        for &north in &north_m {
            for &east in &east_m {
                let p = Position::new(east, north);
                let centre = [14_000.0 + 350.0 * time_h, 17_000.0];
                let r2 =
                    ((east - centre[0]).powi(2) + (north - centre[1]).powi(2)) / 9000.0_f64.powi(2);
                let lift = 55.0 * (-r2).exp() + 20.0 * ((north - east * 0.4) / 6000.0).tanh();
                let z_eff = (z + lift * (z / 120.0).min(1.0)).max(0.0);
                let temperature = 4.0 + 24.0 / (1.0 + (z_eff / 190.0).powf(1.5));
                let speed = 1449.2 + 4.6 * temperature - 0.055 * temperature.powi(2)
                    + 0.00029 * temperature.powi(3)
                    + 0.016 * z
                    - 1.0;
                let below = z > depth(p) + 120.0;
                speed_m_s.push(if below { f32::NAN } else { speed as f32 });
            }
        }
    }
    SoundSpeedRecord { depth_m, east_m, north_m, speed_m_s }
}

fn current_record(grid: SurveillanceGrid, time_h: f64) -> CurrentRecord {
    let axis = |length: f64| -> Vec<f64> {
        let count = ((length + 2.0 * MARGIN_M) / 1500.0) as usize;
        (0..=count)
            .map(|k| -MARGIN_M + k as f64 / count as f64 * (length + 2.0 * MARGIN_M))
            .collect()
    };
    let (east_m, north_m) = (axis(grid.width_m()), axis(grid.height_m()));
    let velocities: Vec<[f64; 2]> = north_m
        .iter()
        .flat_map(|&north| east_m.iter().map(move |&east| Position::new(east, north)))
        .map(|p| current(p, time_h))
        .collect();
    let component = |axis: usize| velocities.iter().map(|v| v[axis] as f32).collect();
    CurrentRecord { u_m_s: component(0), v_m_s: component(1), east_m, north_m }
}
