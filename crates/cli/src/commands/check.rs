//! `sonarfleet check`: what is wrong with a scenario, in plain words.

use super::Manner;
use crate::args::CheckArgs;
use anyhow::Result;
use serde_json::json;
use sonarfleet::mission::{Theatre, findings};
use sonarfleet::scenario::Scenario;
use sonarfleet_acoustics::environment::Seabed;

pub(crate) fn check(args: &CheckArgs, manner: Manner) -> Result<()> {
    let scenario = super::scenario(args.scenario.as_deref())?;
    let theatre = Theatre::of(&scenario)?;
    let findings = findings(&scenario, &theatre);
    if manner.json {
        super::print_json(&json!({ "usable": true, "findings": findings }))
    } else {
        if !manner.quiet {
            super::say(format_args!("{}", describe(&scenario, &theatre)))?;
        }
        for finding in &findings {
            super::say(format_args!("note: {finding}"))?;
        }
        super::say(format_args!("The scenario can be run."))?;
        Ok(())
    }
}

/// The scenario in a few lines.
fn describe(scenario: &Scenario, theatre: &Theatre) -> String {
    let (grid, region) = (&scenario.grid, scenario.region());
    let depths = || theatre.cell_depth_m.iter().copied();
    format!(
        "{}\n  region   {:.4} to {:.4}° E, {:.4} to {:.4}° N: {} × {} cells of {:.0} × {:.0} m\n  \
         ocean    {}\n  depth    {:.0} to {:.0} m\n  fleet    {} vehicles at {:.0} m, {:.2} m/s\n  \
         epochs   {} of {} h from {}\n  \
         sound    {}\n  seabed   {}\n  targets  {:.1} expected in the first epoch",
        scenario.file.name,
        region.west_deg,
        region.east_deg,
        region.south_deg,
        region.north_deg,
        grid.columns,
        grid.rows,
        grid.cell_width_m,
        grid.cell_height_m,
        scenario.ocean.describe(),
        depths().fold(f64::INFINITY, f64::min),
        depths().fold(f64::NEG_INFINITY, f64::max),
        scenario.fleet.len(),
        scenario.fleet_depth_m,
        scenario.vehicle.speed_m_s(),
        scenario.epochs.len(),
        scenario.epoch_h,
        scenario.start,
        sound(scenario),
        seabed(scenario),
        scenario.epochs[0].prior.total(),
    )
}

/// At which frequencies transmission loss is taken, and where from.
fn sound(scenario: &Scenario) -> String {
    let table = |file: bool| {
        if file {
            "from files".into()
        } else {
            format!("{}, {} quality", scenario.loss_model.name(), scenario.quality.name())
        }
    };
    let plan = &scenario.epochs[0];
    let detection =
        format!("detection at {} Hz ({})", scenario.frequency_hz, table(plan.loss_file.is_some()));
    if !scenario.has_communication_table(0) {
        return format!("{detection}; links by the same tables");
    }
    format!(
        "{detection}; links at {} Hz ({})",
        scenario.communication_frequency_hz,
        table(plan.communication_loss_file.is_some())
    )
}

/// What the sea floor is made of, and who says so.
fn seabed(scenario: &Scenario) -> String {
    let floor = &scenario.seabed;
    let named = scenario.file.seabed.sediment.parse::<Seabed>();
    let name = match named {
        Ok(seabed) if scenario.file.seabed.half_space.is_none() => {
            format!("{} ({})", seabed.name(), seabed.source())
        }
        _ => "as measured".into(),
    };
    format!(
        "{name}: {} m/s, {} g/cm³, {} dB per wavelength",
        floor.speed_m_s, floor.density_ratio, floor.attenuation_db_wavelength
    )
}
