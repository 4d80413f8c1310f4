//! What the page holds of a record.

use super::pack::Packed;
use serde::Serialize;
use sonarfleet::grid::{CellId, SurveillanceGrid};
use sonarfleet::record::{EpochMetrics, EpochRecord, RouteRecord, RunRecord, TrackPoint};

/// Points of a track, or of a history, that a screen can show.
const MOST_POINTS: usize = 120;

#[derive(Serialize)]
pub(super) struct Report<'a> {
    name: &'a str,
    ocean_source: &'a str,
    version: &'a str,
    /// As text: a script's numbers hold 53 bits only.
    seed: String,
    grid: SurveillanceGrid,
    /// West, east, south, north.
    region_deg: [f64; 4],
    longitude_deg: Vec<f64>,
    latitude_deg: Vec<f64>,
    depth_m: Packed,
    blocked_cells: &'a [CellId],
    fixed_sensors: &'a [CellId],
    fleet_depth_m: f64,
    vehicle_speed_m_s: f64,
    transit_margin_m: f64,
    connectivity_threshold: f64,
    epochs: Vec<Epoch<'a>>,
}

#[derive(Serialize)]
struct Epoch<'a> {
    index: usize,
    time: String,
    start_h: f64,
    duration_h: f64,
    prior: Packed,
    detection: Packed,
    random_detection: Packed,
    loss_db: Packed,
    loss_source: CellId,
    layout: &'a [CellId],
    random_layout: &'a [CellId],
    sound: Sound<'a>,
    current: Current<'a>,
    routes: Vec<Route<'a>>,
    metrics: EpochMetrics,
}

#[derive(Serialize)]
struct Sound<'a> {
    depth_m: &'a [f64],
    east_m: &'a [f64],
    north_m: &'a [f64],
    speed_m_s: Packed,
}

#[derive(Serialize)]
struct Current<'a> {
    east_m: &'a [f64],
    north_m: &'a [f64],
    u_m_s: Packed,
    v_m_s: Packed,
}

#[derive(Serialize)]
struct Route<'a> {
    vehicle: usize,
    post: CellId,
    expected_h: f64,
    /// Hours since the run's start, metres east, metres north.
    track: Vec<[f64; 3]>,
    planned: Vec<[f64; 3]>,
    arrived: bool,
    failure: Option<&'a str>,
}

impl<'a> Report<'a> {
    pub(super) fn new(record: &'a RunRecord, region_deg: [f64; 4]) -> Self {
        let degrees = |values: &[f64]| values.iter().map(|&v| rounded(v, 1e5)).collect();
        Self {
            name: &record.name,
            ocean_source: &record.ocean_source,
            version: &record.version,
            seed: record.seed.to_string(),
            grid: record.grid,
            region_deg,
            longitude_deg: degrees(&record.cell_longitude_deg),
            latitude_deg: degrees(&record.cell_latitude_deg),
            depth_m: single(&record.cell_depth_m),
            blocked_cells: &record.blocked_cells,
            fixed_sensors: &record.fixed_sensors,
            fleet_depth_m: record.fleet_depth_m,
            vehicle_speed_m_s: record.vehicle_speed_m_s,
            transit_margin_m: record.transit_margin_m,
            connectivity_threshold: record.connectivity_threshold,
            epochs: record.epochs.iter().map(Epoch::new).collect(),
        }
    }
}

impl<'a> Epoch<'a> {
    fn new(epoch: &'a EpochRecord) -> Self {
        let sound = &epoch.sound_speed;
        let current = &epoch.current;
        let history = thinned(&epoch.metrics.placement_history).copied().collect();
        Self {
            index: epoch.epoch,
            time: crate::figures::readable_time(&epoch.time),
            start_h: epoch.start_h,
            duration_h: epoch.duration_h,
            prior: double(&epoch.prior),
            detection: double(&epoch.detection_probability),
            random_detection: double(&epoch.random_detection_probability),
            loss_db: single(&epoch.loss_db),
            loss_source: epoch.loss_source,
            layout: &epoch.layout,
            random_layout: &epoch.random_layout,
            sound: Sound {
                depth_m: &sound.depth_m,
                east_m: &sound.east_m,
                north_m: &sound.north_m,
                speed_m_s: single(&sound.speed_m_s),
            },
            current: Current {
                east_m: &current.east_m,
                north_m: &current.north_m,
                u_m_s: single(&current.u_m_s),
                v_m_s: single(&current.v_m_s),
            },
            routes: epoch.routes.iter().map(Route::new).collect(),
            metrics: EpochMetrics { placement_history: history, ..epoch.metrics.clone() },
        }
    }
}

impl<'a> Route<'a> {
    fn new(route: &'a RouteRecord) -> Self {
        let points = |track: &[TrackPoint]| {
            let point = |p: &TrackPoint| {
                let at = p.position;
                [rounded(p.time_h, 1e3), at.east_m.round(), at.north_m.round()]
            };
            thinned(track).map(point).filter(|p| p.iter().all(|v| v.is_finite())).collect()
        };
        Self {
            vehicle: route.vehicle,
            post: route.post,
            expected_h: route.expected_travel_time_h,
            track: points(&route.track),
            planned: points(&route.planned),
            arrived: route.arrived,
            failure: route.failure.as_deref(),
        }
    }
}

/// Every so many points, and the last.
fn thinned<T>(points: &[T]) -> impl Iterator<Item = &T> {
    let stride = points.len().div_ceil(MOST_POINTS).max(1);
    let last = points.len().saturating_sub(1);
    points
        .iter()
        .enumerate()
        .filter(move |(index, _)| index % stride == 0 || *index == last)
        .map(|(_, point)| point)
}

fn rounded(value: f64, scale: f64) -> f64 {
    (value * scale).round() / scale
}

fn double(values: &[f64]) -> Packed {
    Packed::new(values.iter().copied())
}

fn single(values: &[f32]) -> Packed {
    Packed::new(values.iter().map(|&value| f64::from(value)))
}
