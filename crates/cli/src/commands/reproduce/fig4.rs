//! Fig. 4: the training of sequential and of exchange PPO, and the paper's comparison
//! with particle swarm and genetic algorithm.

use super::score::{more, number, reward, text};
use super::study::{GENETIC, GENETIC_PAPER, SWARM, SWARM_PAPER, Study, scores};
use super::training::{self, Course, Trained};
use super::{Outcome, Row};
use crate::args::Preset;
use anyhow::Result;
use serde_json::json;
use sonarfleet::record::{
    ChartRecord, PanelRecord, SeriesRecord, TrainingPoint, TrainingRecord, TrainingRun, median,
};
use sonarfleet_learning::placement::paper::Process;
use sonarfleet_report::write_chart;
use std::path::Path;

/// Points of a curve at most; each is the mean over as many updates as that takes.
const POINTS: usize = 150;

pub(super) fn fig4(study: &mut Study<'_>, stem: &Path) -> Result<Outcome> {
    let vehicles = study.problem.vehicles();
    let mut rows = Vec::new();
    let mut row =
        |what: String, paper, ours| rows.push(Row { figure: "Fig. 4", what, paper, ours });
    let mut records = Vec::new();
    let mut sequential = Vec::new();
    for (process, final_reward, time) in
        [(Process::Sequential, "R 35.98", "250.0 s"), (Process::Exchange, "R 29.63", "240.9 s")]
    {
        for preset in [Preset::Ours, Preset::Paper] {
            let course = Course { process, preset, vehicles };
            let trained = study.trained(course)?;
            let found = training::scores(&trained);
            let end = median(trained.iter().map(Trained::final_reward).collect());
            let ours =
                format!("{}; its rollouts at the end: mean R {}", text(&found), number(end, 2));
            row(course.words(), final_reward, ours);
            let seconds = median(trained.iter().map(|trained| trained.seconds).collect());
            row(format!("{}, training", course.words()), time, format!("{seconds:.1} s"));
            records.push(record(study, course, &trained));
            if process == Process::Sequential {
                sequential.push((course.words(), reward(&found)));
            }
        }
    }
    let contestants =
        [(SWARM_PAPER, "+16–21 %"), (SWARM, "–"), (GENETIC_PAPER, "+2–3.7 %"), (GENETIC, "–")];
    let mut peers = Vec::new();
    for (contestant, paper) in contestants {
        let solved = study.solve(contestant, &study.problem)?;
        if solved.is_empty() {
            continue;
        }
        let found = scores(&solved);
        let seconds = median(solved.iter().map(|solved| solved.seconds).collect());
        let time = if contestant.method == SWARM_PAPER.method { "26.8 s" } else { "–" };
        let ours = format!("{}; {seconds:.1} s", text(&found));
        row(format!("{}, and its time", contestant.words), time, ours);
        for (words, ours) in &sequential {
            let what = format!("{words}, R over that of {}", contestant.words);
            row(what, paper, more(reward(&found), *ours, 1));
        }
        peers.push(json!({"method": contestant.method, "seconds": seconds, "scores": found}));
    }

    let chart = ChartRecord {
        name: format!("Training of sequential and exchange PPO: {}", study.name),
        note: format!(
            "mean R of the layouts of a rollout, means over blocks of updates · thin: {} seeds; bold: their median",
            study.seeds
        ),
        version: env!("CARGO_PKG_VERSION").into(),
        panels: vec![
            panel(&records, "Against time", "Wall-clock time (s)", |point| point.seconds),
            panel(&records, "Against experience", "Episodes (thousands)", |point| {
                point.episodes / 1000.0
            }),
        ],
    };
    write_chart(&chart, stem)?;
    Ok(Outcome { rows, record: json!({"trainings": records, "peers": peers}) })
}

fn record(study: &Study<'_>, course: Course, trained: &[Trained]) -> TrainingRecord {
    let shortest = trained.iter().map(|trained| trained.points.len()).min().unwrap_or(0);
    let run = |trained: &Trained| TrainingRun {
        seed: trained.seed,
        points: blocks(&trained.points, shortest.min(POINTS)),
    };
    TrainingRecord {
        name: course.words(),
        version: env!("CARGO_PKG_VERSION").into(),
        connectivity_threshold: study.problem.connectivity_threshold(),
        runs: trained.iter().map(run).collect(),
    }
}

/// Means over so many blocks of about equal length.
fn blocks(points: &[TrainingPoint], count: usize) -> Vec<TrainingPoint> {
    let block = |k: usize| {
        let block = &points[k * points.len() / count..(k + 1) * points.len() / count];
        let mean = |number: fn(&TrainingPoint) -> f64| {
            let finite: Vec<f64> = block.iter().map(number).filter(|n| n.is_finite()).collect();
            finite.iter().sum::<f64>() / finite.len() as f64
        };
        TrainingPoint {
            episodes: mean(|point| point.episodes),
            seconds: mean(|point| point.seconds),
            reward: mean(|point| point.reward),
            detection_utility: mean(|point| point.detection_utility),
            algebraic_connectivity: mean(|point| point.algebraic_connectivity),
            multiplier: mean(|point| point.multiplier),
            approx_kl: mean(|point| point.approx_kl),
            entropy: mean(|point| point.entropy),
        }
    };
    (0..count).map(block).collect()
}

fn panel(
    records: &[TrainingRecord],
    title: &str,
    x_label: &str,
    x: fn(&TrainingPoint) -> f64,
) -> PanelRecord {
    let line = |points: &[TrainingPoint]| {
        points.iter().map(|point| [x(point), point.reward]).collect::<Vec<_>>()
    };
    let series = |record: &TrainingRecord| SeriesRecord {
        name: record.name.clone(),
        runs: record.runs.iter().map(|run| line(&run.points)).collect(),
        median: line(&record.median()),
    };
    PanelRecord {
        title: title.into(),
        x_label: x_label.into(),
        y_label: "Reward R".into(),
        level: None,
        series: records.iter().map(series).collect(),
    }
}
