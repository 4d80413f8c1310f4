//! Fig. 5: the final reward against the required connectivity τ.

use super::score::{Score, more, number, reward};
use super::study::{
    ANNEALING, AUTO, Contestant, GENETIC, GENETIC_PAPER, POLICY, SWARM, SWARM_PAPER, Study, scores,
};
use super::{Outcome, Row};
use anyhow::Result;
use serde_json::json;
use sonarfleet::record::{ChartRecord, PanelRecord, SeriesRecord};
use sonarfleet_report::write_chart;
use std::path::Path;

const THRESHOLDS: [f64; 5] = [0.93, 0.94, 0.95, 0.96, 0.97];

/// The methods, and what the paper says of the reward from the first τ to the last.
const CONTESTANTS: [(Contestant, &str); 7] = [
    (POLICY, "−0.02 % (sequential PPO)"),
    (AUTO, "–"),
    (ANNEALING, "–"),
    (SWARM_PAPER, "−3.2 %"),
    (GENETIC_PAPER, "−1.6 %"),
    (SWARM, "–"),
    (GENETIC, "–"),
];

pub(super) fn fig5(study: &mut Study<'_>, stem: &Path) -> Result<Outcome> {
    let vehicles = study.problem.vehicles();
    let mut found: Vec<(Contestant, &'static str, Vec<Vec<Score>>)> = CONTESTANTS
        .into_iter()
        .filter(|(contestant, _)| contestant.is_known())
        .map(|(contestant, paper)| (contestant, paper, Vec::new()))
        .collect();
    for threshold in THRESHOLDS {
        let problem = study.with(vehicles, threshold)?;
        for (contestant, _, by_threshold) in &mut found {
            by_threshold.push(scores(&study.solve(*contestant, &problem)?));
        }
    }

    let mut rows = Vec::new();
    for (contestant, paper, by_threshold) in &found {
        let rewards: Vec<f64> = by_threshold.iter().map(|scores| reward(scores)).collect();
        let (first, last) = (rewards[0], rewards[rewards.len() - 1]);
        let feasible = by_threshold.iter().flatten().filter(|score| score.evaluation.feasible);
        rows.push(Row {
            figure: "Fig. 5",
            what: format!("{}, R from τ 0.93 to 0.97", contestant.words),
            paper,
            ours: format!(
                "{} ({} → {}; {} of {} feasible)",
                more(first, last, 2),
                number(first, 2),
                number(last, 2),
                feasible.count(),
                by_threshold.iter().flatten().count(),
            ),
        });
    }
    let panel = |title: &str, y_label: &str, number: fn(f64, f64) -> f64| PanelRecord {
        title: title.into(),
        x_label: "Required connectivity τ".into(),
        y_label: y_label.into(),
        level: None,
        series: found.iter().map(|(c, _, scores)| series(c.words, scores, number)).collect(),
    };
    let chart = ChartRecord {
        name: format!("Reward against the required connectivity: {}", study.name),
        note: format!("thin: {} seeds; bold: their median", study.seeds),
        version: env!("CARGO_PKG_VERSION").into(),
        panels: vec![
            panel("Final reward", "Reward R", |reward, _| reward),
            panel("Change from the first τ", "Change of R (%)", |reward, first| {
                100.0 * (reward / first - 1.0)
            }),
        ],
    };
    write_chart(&chart, stem)?;
    let methods: Vec<_> = found
        .iter()
        .map(|(contestant, _, scores)| json!({"method": contestant.method, "scores": scores}))
        .collect();
    Ok(Outcome { rows, record: json!({"thresholds": THRESHOLDS, "methods": methods}) })
}

/// A number of a reward and of the median at the first threshold, by threshold.
fn series(name: &str, by_threshold: &[Vec<Score>], number: fn(f64, f64) -> f64) -> SeriesRecord {
    let first = reward(&by_threshold[0]);
    let line = |rewards: &dyn Fn(&[Score]) -> f64| {
        let points = THRESHOLDS.iter().zip(by_threshold);
        points.map(|(&threshold, scores)| [threshold, number(rewards(scores), first)]).collect()
    };
    SeriesRecord {
        name: name.into(),
        runs: (0..by_threshold[0].len()).map(|run| line(&|scores| scores[run].reward)).collect(),
        median: line(&reward),
    }
}
