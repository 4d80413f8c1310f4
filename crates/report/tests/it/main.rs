//! Figures and the report of made-up records, plausible and degenerate.

mod comparison;
mod figures;
mod report;
mod reproduction;
#[path = "../sample/mod.rs"]
mod sample;
mod training;
mod xml;

use sample::Size;
use sonarfleet::grid::CellId;
use sonarfleet::record::RunRecord;

/// A run small enough to draw many of.
const SMALL: Size = Size { columns: 8, rows: 8, vehicles: 5, epochs: 2 };

/// Records at the edges of what a run can write, with what is odd about each.
fn degenerate() -> Vec<(&'static str, RunRecord)> {
    let small = || sample::record(Size { epochs: 1, ..SMALL });
    let mut records = vec![
        ("one epoch", sample::record(Size { epochs: 1, ..SMALL })),
        ("more epochs than a figure holds", sample::record(Size { epochs: 6, ..SMALL })),
        ("wide region", sample::record(Size { columns: 17, rows: 3, vehicles: 5, epochs: 1 })),
        ("high region", sample::record(Size { columns: 2, rows: 12, vehicles: 5, epochs: 1 })),
        ("one cell", sample::record(Size { columns: 1, rows: 1, vehicles: 1, epochs: 1 })),
    ];
    let mut add = |name, change: &dyn Fn(&mut RunRecord)| {
        let mut record = small();
        change(&mut record);
        records.push((name, record));
    };
    add("no epochs", &|record| record.epochs.clear());
    add("no routes, no layout", &|record| {
        for epoch in &mut record.epochs {
            epoch.routes.clear();
            epoch.layout.clear();
        }
    });
    add("no values anywhere", &|record| {
        record.cell_depth_m.fill(f32::NAN);
        record.cell_longitude_deg.fill(f64::NAN);
        for epoch in &mut record.epochs {
            epoch.prior.fill(f64::NAN);
            epoch.detection_probability.fill(f64::NAN);
            epoch.random_detection_probability.fill(f64::NAN);
            epoch.loss_db.fill(f32::INFINITY);
            epoch.sound_speed.speed_m_s.fill(f32::NAN);
            epoch.current.u_m_s.fill(f32::NAN);
            epoch.current.v_m_s.fill(f32::NAN);
            epoch.metrics.detection_utility = f64::NAN;
            epoch.metrics.upper_bound = f64::INFINITY;
            epoch.metrics.mean_travel_time_h = f64::NAN;
            epoch.metrics.placement_history.clear();
        }
    });
    add("the same value everywhere", &|record| {
        record.cell_depth_m.fill(1000.0);
        for epoch in &mut record.epochs {
            epoch.prior.fill(0.0);
            epoch.loss_db.fill(80.0);
            epoch.sound_speed.speed_m_s.fill(1500.0);
            epoch.current.u_m_s.fill(0.0);
            epoch.current.v_m_s.fill(0.0);
        }
    });
    add("empty fields of sound speed and current", &|record| {
        for epoch in &mut record.epochs {
            epoch.sound_speed.depth_m.clear();
            epoch.sound_speed.speed_m_s.clear();
            epoch.current.north_m.clear();
            epoch.current.u_m_s.clear();
            epoch.current.v_m_s.clear();
        }
    });
    add("every cell blocked, fixed sensors, no margin", &|record| {
        record.blocked_cells = record.grid.cells().collect();
        record.fixed_sensors = vec![CellId(0), CellId(63)];
        record.transit_margin_m = 0.0;
    });
    add("every post unreachable", &|record| {
        for route in record.epochs.iter_mut().flat_map(|epoch| &mut epoch.routes) {
            route.expected_travel_time_h = f64::INFINITY;
            route.track.clear();
            route.planned.clear();
            route.arrived = false;
            route.failure = Some("no way".into());
        }
    });
    records
}
