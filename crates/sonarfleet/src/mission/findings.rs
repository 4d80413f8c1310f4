//! What a planner should know of a scenario before running it, in plain words.

use super::Theatre;
use crate::scenario::Scenario;
use sonarfleet_ocean::OceanState;

/// Ocean states further apart than this many times the median interval are a gap.
const GAP_FACTOR: f64 = 1.5;

/// Things worth knowing that do not prevent a run.
pub fn findings(scenario: &Scenario, theatre: &Theatre) -> Vec<String> {
    let mut findings = Vec::new();
    land(scenario, theatre, &mut findings);
    time(scenario, theatre, &mut findings);
    currents(scenario, theatre, &mut findings);
    starts(scenario, theatre, &mut findings);
    findings
}

fn land(scenario: &Scenario, theatre: &Theatre, findings: &mut Vec<String>) {
    let blocked = theatre.blocked_cells().len();
    let cells = scenario.grid.cell_count();
    if blocked > 0 {
        findings.push(format!(
            "{blocked} of {cells} cells cannot hold a vehicle (land, shallower than {} m, or excluded)",
            scenario.fleet_depth_m
        ));
    }
    if cells - blocked < scenario.fleet.len() {
        findings.push(format!(
            "only {} cells can hold a vehicle, but the fleet has {}: placement will fail",
            cells - blocked,
            scenario.fleet.len()
        ));
    }
}

fn time(scenario: &Scenario, theatre: &Theatre, findings: &mut Vec<String>) {
    let hours =
        |state: &OceanState| state.time.duration_since(scenario.start).as_secs_f64() / 3600.0;
    let times: Vec<f64> = theatre.forecast.states.iter().map(hours).collect();
    let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    if let Some(&median) = sorted.get(sorted.len() / 2) {
        for (step, from) in
            steps.iter().zip(&times).filter(|(step, _)| **step > GAP_FACTOR * median)
        {
            findings.push(format!(
                "the ocean data have a gap of {step:.1} h at hour {from:.1} (elsewhere {median:.1} h); \
                 states are interpolated across it"
            ));
        }
    }
    let run_end_h = scenario.epoch_h * scenario.epochs.len() as f64;
    if let Some(&end_h) = times.last().filter(|&&end_h| end_h < run_end_h) {
        findings.push(format!(
            "the ocean data end {:.1} h before the last epoch does; the last currents hold on",
            run_end_h - end_h
        ));
    }
}

fn currents(scenario: &Scenario, theatre: &Theatre, findings: &mut Vec<String>) {
    let strongest = theatre.currents.greatest_speed_m_s();
    let speed = scenario.vehicle.speed_m_s();
    if strongest > speed {
        findings.push(format!(
            "currents at {} m reach {strongest:.2} m/s, the vehicles make {speed:.2} m/s: some posts \
             may be unreachable at times",
            scenario.fleet_depth_m
        ));
    }
}

fn starts(scenario: &Scenario, theatre: &Theatre, findings: &mut Vec<String>) {
    let aground =
        scenario.fleet.iter().filter(|&&position| theatre.currents.is_land(position)).count();
    if aground > 0 {
        findings.push(format!("{aground} vehicles start on land or above too little water"));
    }
    let outside =
        scenario.fleet.iter().filter(|&&start| scenario.grid.cell_at(start).is_none()).count();
    if outside > 0 {
        findings.push(format!(
            "{outside} vehicles start outside the region, where they do not count as listening"
        ));
    }
}
