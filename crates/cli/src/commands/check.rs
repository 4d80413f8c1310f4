//! `sonarfleet check`: what is wrong with a scenario, in plain words.

use super::Manner;
use crate::args::CheckArgs;
use anyhow::Result;
use serde_json::json;
use sonarfleet::mission::{Theatre, findings};
use sonarfleet::scenario::Scenario;

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
         epochs   {} of {} h from {}\n  targets  {:.1} expected in the first epoch",
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
        scenario.epochs[0].prior.total(),
    )
}
