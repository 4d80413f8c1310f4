//! `sonarfleet ocean …`: look into ocean files, make a synthetic ocean, ask for a real one.

use super::Manner;
use crate::args::OceanCommand;
use anyhow::{Context, Result};
use jiff::Timestamp;
use serde_json::json;
use sonarfleet::scenario::{FleetSection, OceanSource, Scenario, ScenarioFile};
use sonarfleet_acoustics::seawater::SoundSpeedEquation;
use sonarfleet_ocean::Column;
use sonarfleet_ocean::io::{
    ForecastRequest, download_request, inspect, read_forecast, write_bathymetry, write_forecast,
};
use sonarfleet_ocean::synthetic::{SyntheticOcean, TITLE};
use std::fs;
use std::path::{Path, PathBuf};

/// Depth to which water is asked for where the scenario does not know better, metres.
const DEEPEST_M: f64 = 6000.0;

pub(crate) fn ocean(command: &OceanCommand, manner: Manner) -> Result<()> {
    match command {
        OceanCommand::Inspect { files } => show(files, manner),
        OceanCommand::Profile { files, longitude, latitude, time } => {
            profile(files, *longitude, *latitude, *time, manner)
        }
        OceanCommand::Synth { directory, scenario } => {
            synthesise(directory, scenario.as_deref(), manner)
        }
        OceanCommand::Request { scenario } => request(scenario.as_deref(), manner),
    }
}

fn show(files: &[PathBuf], manner: Manner) -> Result<()> {
    let inspections = files.iter().map(|path| inspect(path)).collect::<Result<Vec<_>, _>>()?;
    if manner.json {
        return super::print_json(&inspections);
    }
    for inspection in &inspections {
        super::say(format_args!("{inspection}"))?;
    }
    Ok(())
}

fn profile(
    files: &[PathBuf],
    longitude_deg: f64,
    latitude_deg: f64,
    time: Option<Timestamp>,
    manner: Manner,
) -> Result<()> {
    let request = ForecastRequest { required: &[], region: None, span: None };
    let forecast = read_forecast(files, &request)?;
    let state = match time {
        Some(time) => forecast.at(time)?,
        None => forecast.states[0].clone(),
    };
    let column = state.column(longitude_deg, latitude_deg).with_context(|| {
        format!("{}: no water at {longitude_deg}° E, {latitude_deg}° N", names(files))
    })?;
    let rows = rows(&column, latitude_deg);
    if manner.json {
        let objects: Vec<_> = rows
            .iter()
            .map(|row| COLUMNS.iter().zip(row).collect::<std::collections::BTreeMap<_, _>>())
            .collect();
        return super::print_json(&json!({ "time": state.time.to_string(), "levels": objects }));
    }
    super::say(format_args!("{}", COLUMNS.join(",")))?;
    for row in rows {
        let fields: Vec<String> = row
            .iter()
            .map(|value| value.map_or_else(String::new, |value| value.to_string()))
            .collect();
        super::say(format_args!("{}", fields.join(",")))?;
    }
    Ok(())
}

const COLUMNS: [&str; 6] = [
    "depth_m",
    "temperature_c",
    "salinity_psu",
    "sound_speed_m_s",
    "current_east_m_s",
    "current_north_m_s",
];

/// One row per level; what the files do not hold is none.
fn rows(column: &Column, latitude_deg: f64) -> Vec<[Option<f64>; 6]> {
    let at = |values: &[f64], level: usize| values.get(level).copied().filter(|v| !v.is_nan());
    let speed = SoundSpeedEquation::default();
    column
        .depth_m
        .iter()
        .enumerate()
        .map(|(level, &depth_m)| {
            let temperature = at(&column.temperature_c, level);
            let salinity = at(&column.salinity_psu, level);
            let sound = temperature
                .zip(salinity)
                .map(|(t, s)| speed.speed_m_s(t, s, depth_m, latitude_deg));
            let [east, north] =
                [&column.current_east_m_s, &column.current_north_m_s].map(|v| at(v, level));
            [Some(depth_m), temperature, salinity, sound, east, north]
        })
        .collect()
}

fn names(files: &[PathBuf]) -> String {
    files.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ")
}

fn synthesise(directory: &Path, scenario: Option<&Path>, manner: Manner) -> Result<()> {
    let scenario = super::scenario(scenario)?;
    let ocean = match &scenario.ocean {
        OceanSource::Synthetic(ocean) => *ocean,
        OceanSource::Files { .. } => SyntheticOcean {
            region: scenario.region(),
            start: scenario.start,
            ..SyntheticOcean::default()
        },
    };
    fs::create_dir_all(directory).with_context(|| format!("{}", directory.display()))?;
    let mut written = write_forecast(&ocean.forecast(), directory, TITLE)?;
    let bathymetry = directory.join("bathymetry.nc");
    write_bathymetry(&ocean.bathymetry(), &bathymetry, TITLE)?;
    written.push(bathymetry);
    if manner.json {
        return super::print_json(&json!({ "files": written }));
    }
    if !manner.quiet {
        super::say(format_args!("{TITLE}"))?;
        for path in &written {
            super::say(format_args!("  {}", path.display()))?;
        }
    }
    Ok(())
}

fn request(path: Option<&Path>, manner: Manner) -> Result<()> {
    let mut file = match path {
        Some(path) => ScenarioFile::read(path)?,
        None => Scenario::embedded().file,
    };
    // The files it names need not exist yet: only where and when matters.
    file = ScenarioFile {
        region: file.region,
        time: file.time,
        navigation: file.navigation,
        fleet: FleetSection { vehicles: 1, ..file.fleet },
        ..ScenarioFile::default()
    };
    let origin = path.map_or("embedded scenario".into(), |path| path.display().to_string());
    let scenario = Scenario::check(file, &origin, Path::new(""))?;
    let run_h = scenario.epoch_h * scenario.epochs.len() as f64;
    let end = scenario.instant(run_h + scenario.file.navigation.horizon_h);
    let text = download_request(scenario.region(), scenario.start, end, DEEPEST_M);
    if manner.json {
        return super::print_json(&json!({ "request": text }));
    }
    super::say(format_args!("{text}"))?;
    Ok(())
}
