//! Fig. 7: a policy trained for a larger fleet, cut short.

use super::score::{Score, reward, text};
use super::study::{POLICY, SWARM, SWARM_PAPER, Study, scores};
use super::training::{self, Course};
use super::{Outcome, Row};
use crate::args::Preset;
use anyhow::Result;
use sonarfleet::record::ScoresRecord;
use sonarfleet_learning::placement::paper::Process;
use sonarfleet_report::write_scores;
use std::path::Path;

pub(super) fn fig7(study: &mut Study<'_>, stem: &Path) -> Result<Outcome> {
    let vehicles = study.problem.vehicles();
    let threshold = study.problem.connectivity_threshold();
    let more_vehicles = vehicles + vehicles.div_ceil(4); // the paper's 50 for 40
    let course = |process, vehicles| Course { process, preset: Preset::Ours, vehicles };
    let larger = course(Process::Sequential, more_vehicles);
    let exchange = course(Process::Exchange, vehicles);

    let larger_problem = study.with(more_vehicles, threshold)?;
    let mdp = larger.settings().sequential_mdp(&larger_problem);
    let cut: Vec<Score> = study
        .trained(larger)?
        .iter()
        .map(|trained| trained.policy.decode(&mdp, vehicles, trained.seed))
        .map(|layout| Score::of(&study.problem, &layout))
        .collect();
    let exchanged = training::scores(&study.trained(exchange)?);

    let cut_name = format!("Sequential PPO for {more_vehicles}, {vehicles} steps");
    let mut found = vec![(cut_name.clone(), cut), ("Exchange PPO, our settings".into(), exchanged)];
    for contestant in [SWARM_PAPER, SWARM, POLICY] {
        let solved = study.solve(contestant, &study.problem)?;
        if !solved.is_empty() {
            found.push((contestant.words.into(), scores(&solved)));
        }
    }
    let beaten = |cut: &[Score]| {
        let others = found[1..].iter().filter(|(_, scores)| reward(scores) < reward(cut));
        let names: Vec<&str> = others.map(|(name, _)| name.as_str()).collect();
        if names.is_empty() { "none of the others".into() } else { names.join("; ") }
    };
    let rows = found
        .iter()
        .map(|(name, scores)| {
            let (paper, verdict) = if *name == cut_name {
                ("beats PSO and exchange PPO at 40", format!("; beats {}", beaten(scores)))
            } else {
                ("–", String::new())
            };
            let ours = format!("{}{verdict}", text(scores));
            Row { figure: "Fig. 7", what: name.clone(), paper, ours }
        })
        .collect::<Vec<_>>();
    let record = ScoresRecord {
        name: format!(
            "{vehicles} vehicles by a policy trained for {more_vehicles}: {}",
            study.name
        ),
        note: format!("small: {} seeds; large: their median", study.seeds),
        version: env!("CARGO_PKG_VERSION").into(),
        connectivity_threshold: threshold,
        scores: found
            .iter()
            .flat_map(|(name, scores)| scores.iter().map(|score| score.record(name)))
            .collect(),
    };
    write_scores(&record, stem)?;
    Ok(Outcome { rows, record: serde_json::to_value(record)? })
}
