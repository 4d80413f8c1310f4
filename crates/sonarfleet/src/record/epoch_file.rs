//! `epoch-K.nc`: one epoch as CF-NetCDF, for xarray, MATLAB and whoever else.

use super::{EpochRecord, RecordError, RunRecord, TrackPoint};
use crate::grid::CellId;
use sonarfleet_ocean::io::{Attribute, Dataset, Values};
use std::path::Path;

/// Writes one epoch of a run.
///
/// # Errors
/// If the file cannot be written.
pub fn write_epoch(path: &Path, run: &RunRecord, epoch: &EpochRecord) -> Result<(), RecordError> {
    let mut file = Dataset::new(format!("{}: epoch {} of a sonarfleet run", run.name, epoch.epoch));
    attributes(&mut file, run, epoch);
    cells(&mut file, run, epoch);
    sound_speed(&mut file, epoch);
    currents(&mut file, epoch);
    fleet(&mut file, epoch);
    Ok(file.write(path)?)
}

fn attributes(file: &mut Dataset, run: &RunRecord, epoch: &EpochRecord) {
    let numbers = &epoch.metrics;
    let links = numbers.communication_loss.as_ref().unwrap_or(&numbers.transmission_loss);
    for (name, value) in [("source", &run.ocean_source), ("time", &epoch.time)] {
        file.add_attribute(Attribute::text(name, value));
    }
    file.add_attribute(Attribute::text("history", format!("sonarfleet {}", run.version)));
    for (name, value) in [
        ("sonarfleet_format", crate::FILE_FORMAT),
        ("seed", run.seed as f64),
        ("start_h", epoch.start_h),
        ("duration_h", epoch.duration_h),
        ("fleet_depth_m", run.fleet_depth_m),
        ("connectivity_threshold", run.connectivity_threshold),
        ("detection_utility", numbers.detection_utility),
        ("algebraic_connectivity", numbers.algebraic_connectivity),
        ("upper_bound", numbers.upper_bound),
        ("detection_utility_at_start", numbers.detection_utility_at_start),
        ("detection_utility_at_end", numbers.detection_utility_at_end),
        ("frequency_hz", numbers.transmission_loss.frequency_hz),
        ("communication_frequency_hz", links.frequency_hz),
        ("transmission_loss_source_cell", epoch.loss_source.0 as f64),
    ] {
        file.add_attribute(Attribute::number(name, value));
    }
}

fn cells(file: &mut Dataset, run: &RunRecord, epoch: &EpochRecord) {
    let grid = &run.grid;
    let centres = |count: usize, step_m: f64| {
        Values::F64((0..count).map(|k| (k as f64 + 0.5) * step_m).collect())
    };
    let from = |edge: &str| {
        [
            Attribute::text("units", "m"),
            Attribute::text("long_name", format!("distance from the region's {edge} edge")),
        ]
    };
    file.add_coordinate("north", centres(grid.rows, grid.cell_height_m), &from("southern"));
    file.add_coordinate("east", centres(grid.columns, grid.cell_width_m), &from("western"));
    let mut add = |name: &str, values: Values, unit: &str, long_name: &str| {
        let attributes = [Attribute::text("units", unit), Attribute::text("long_name", long_name)];
        file.add_variable(name, &["north", "east"], values, &attributes);
    };
    let f64s = |values: &[f64]| Values::F64(values.to_vec());
    add("longitude", f64s(&run.cell_longitude_deg), "degrees_east", "longitude of the cell");
    add("latitude", f64s(&run.cell_latitude_deg), "degrees_north", "latitude of the cell");
    add("water_depth", Values::F32(run.cell_depth_m.clone()), "m", "depth of the sea floor");
    add("prior", f64s(&epoch.prior), "1", "expected number of targets in the cell");
    add(
        "detection_probability",
        f64s(&epoch.detection_probability),
        "1",
        "probability that the target layout detects a target in the cell",
    );
    add(
        "transmission_loss",
        Values::F32(epoch.loss_db.clone()),
        "dB",
        "transmission loss from transmission_loss_source_cell",
    );
}

fn sound_speed(file: &mut Dataset, epoch: &EpochRecord) {
    let record = &epoch.sound_speed;
    let metres = [Attribute::text("units", "m")];
    let down = [Attribute::text("units", "m"), Attribute::text("positive", "down")];
    file.add_coordinate("depth", Values::F64(record.depth_m.clone()), &down);
    file.add_coordinate("sound_speed_north", Values::F64(record.north_m.clone()), &metres);
    file.add_coordinate("sound_speed_east", Values::F64(record.east_m.clone()), &metres);
    file.add_variable(
        "sound_speed",
        &["depth", "sound_speed_north", "sound_speed_east"],
        Values::F32(record.speed_m_s.clone()),
        &[
            Attribute::text("units", "m s-1"),
            Attribute::text("standard_name", "speed_of_sound_in_sea_water"),
        ],
    );
}

fn currents(file: &mut Dataset, epoch: &EpochRecord) {
    let record = &epoch.current;
    let metres = [Attribute::text("units", "m")];
    file.add_coordinate("current_north", Values::F64(record.north_m.clone()), &metres);
    file.add_coordinate("current_east", Values::F64(record.east_m.clone()), &metres);
    for (name, values, standard_name) in [
        ("u", &record.u_m_s, "eastward_sea_water_velocity"),
        ("v", &record.v_m_s, "northward_sea_water_velocity"),
    ] {
        file.add_variable(
            name,
            &["current_north", "current_east"],
            Values::F32(values.clone()),
            &[Attribute::text("units", "m s-1"), Attribute::text("standard_name", standard_name)],
        );
    }
}

fn fleet(file: &mut Dataset, epoch: &EpochRecord) {
    let cells =
        |cells: &mut dyn Iterator<Item = CellId>| Values::I32(cells.map(|n| n.0 as i32).collect());
    let routes = &epoch.routes;
    file.add_dimension("post", epoch.layout.len());
    let cell_number = [Attribute::text("long_name", "cell, counted eastward, then northward")];
    file.add_variable("layout", &["post"], cells(&mut epoch.layout.iter().copied()), &cell_number);
    file.add_dimension("vehicle", routes.len());
    let posts = cells(&mut routes.iter().map(|route| route.post));
    file.add_variable("vehicle_post", &["vehicle"], posts, &cell_number);
    file.add_variable(
        "expected_travel_time",
        &["vehicle"],
        Values::F64(routes.iter().map(|route| route.expected_travel_time_h).collect()),
        &[Attribute::text("units", "h")],
    );
    file.add_variable(
        "arrived",
        &["vehicle"],
        Values::I16(routes.iter().map(|route| i16::from(route.arrived)).collect()),
        &[Attribute::text("long_name", "1 if on its post at the end of the epoch")],
    );
    let tracks: Vec<_> = routes.iter().map(|route| route.track.as_slice()).collect();
    ragged(file, "track", &tracks);
    let planned: Vec<_> = routes.iter().map(|route| route.planned.as_slice()).collect();
    ragged(file, "planned", &planned);
}

/// Tracks end to end, as CF's contiguous ragged array: `NAME_count` says how many
/// points of `NAME_time`, `NAME_east`, `NAME_north` belong to each vehicle.
fn ragged(file: &mut Dataset, name: &str, tracks: &[&[TrackPoint]]) {
    let points = || tracks.iter().copied().flatten();
    let point = format!("{name}_point");
    file.add_variable(
        &format!("{name}_count"),
        &["vehicle"],
        Values::I32(tracks.iter().map(|track| track.len() as i32).collect()),
        &[Attribute::text("sample_dimension", &point)],
    );
    if points().next().is_none() {
        return; // NetCDF has no dimension of length 0; the counts say it all
    }
    file.add_dimension(&point, points().count());
    let mut add = |suffix: &str, unit: &str, value: fn(&TrackPoint) -> f64| {
        file.add_variable(
            &format!("{name}_{suffix}"),
            &[&point],
            Values::F64(points().map(value).collect()),
            &[Attribute::text("units", unit)],
        );
    };
    add("time", "h", |at| at.time_h);
    add("east", "m", |at| at.position.east_m);
    add("north", "m", |at| at.position.north_m);
}
