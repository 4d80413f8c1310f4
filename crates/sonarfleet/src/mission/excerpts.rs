//! The parts of an epoch's environment that figures show.

use crate::grid::{Position, SurveillanceGrid, evenly};
use crate::navigation::{CurrentField, TransitDomain};
use crate::record::{CurrentRecord, SoundSpeedRecord};
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::{Bathymetry, LocalFrame, OceanState};

/// Most distance between points of the sound-speed excerpt, metres.
const SOUND_SPEED_SPACING_M: f64 = 1500.0;
/// Most distance between points of the current excerpt, metres.
const CURRENT_SPACING_M: f64 = 2000.0;

/// The sound-speed field over the region, NaN deeper than the first level below
/// the sea floor and where the ocean model has no water.
pub(super) fn sound_speed(
    state: &OceanState,
    bathymetry: &Bathymetry,
    equation: SoundSpeedEquation,
    frame: &LocalFrame,
    grid: &SurveillanceGrid,
) -> SoundSpeedRecord {
    let east_m = evenly(0.0, grid.width_m(), SOUND_SPEED_SPACING_M);
    let north_m = evenly(0.0, grid.height_m(), SOUND_SPEED_SPACING_M);
    let points = east_m.len() * north_m.len();
    let mut deepest_m = f64::NEG_INFINITY;
    let mut columns = Vec::with_capacity(points);
    for &north in &north_m {
        for &east in &east_m {
            let (longitude, latitude) = frame.to_geographic(east, north);
            let floor_m = bathymetry.depth_m(longitude, latitude).unwrap_or(f64::NEG_INFINITY);
            deepest_m = floor_m.max(deepest_m);
            columns.push((floor_m, latitude, state.column(longitude, latitude)));
        }
    }
    let levels = &state.grid.depth_m;
    // One level below the floor, so that fields can be drawn down to it.
    let shown = (levels.partition_point(|&depth| depth <= deepest_m) + 1).min(levels.len());
    let depth_m = levels[..shown].to_vec();
    let speed = |level: usize, point: usize| match &columns[point] {
        (floor_m, latitude, Some(column)) if level == 0 || depth_m[level - 1] <= *floor_m => {
            equation.speed_m_s(
                column.temperature_c[level],
                column.salinity_psu[level],
                depth_m[level],
                *latitude,
            ) as f32
        }
        _ => f32::NAN,
    };
    let speed_m_s = (0..shown * points).map(|k| speed(k / points, k % points)).collect();
    SoundSpeedRecord { depth_m, east_m, north_m, speed_m_s }
}

/// The current over the transit domain at a time, NaN on land.
pub(super) fn current(field: &CurrentField, domain: TransitDomain, time_h: f64) -> CurrentRecord {
    let (south_west, north_east) = (domain.south_west(), domain.north_east());
    let east_m = evenly(south_west.east_m, north_east.east_m, CURRENT_SPACING_M);
    let north_m = evenly(south_west.north_m, north_east.north_m, CURRENT_SPACING_M);
    let (mut u_m_s, mut v_m_s) = (Vec::new(), Vec::new());
    for &north in &north_m {
        for &east in &east_m {
            let point = Position::new(east, north);
            let [u, v] = if field.is_land(point) {
                [f64::NAN; 2]
            } else {
                field.velocity_m_s(point, time_h)
            };
            u_m_s.push(u as f32);
            v_m_s.push(v as f32);
        }
    }
    CurrentRecord { east_m, north_m, u_m_s, v_m_s }
}
