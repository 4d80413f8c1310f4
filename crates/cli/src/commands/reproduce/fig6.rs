//! Fig. 6: the detection utility against executed steps.

use super::study::Study;
use super::training::Course;
use super::{Outcome, Row};
use crate::args::Preset;
use crate::commands::methods;
use anyhow::Result;
use sonarfleet::grid::CellId;
use sonarfleet::placement::PlacementProblem;
use sonarfleet::record::{ChartRecord, PanelRecord, SeriesRecord, median};
use sonarfleet_learning::placement::paper::Process;
use sonarfleet_report::write_chart;
use std::path::Path;

/// Share of the steps at which the paper looks, and what is left then, in percent.
const STEPS_PERCENT: f64 = 70.0;
const KEPT_PERCENT: f64 = 85.0;

pub(super) fn fig6(study: &mut Study<'_>, stem: &Path) -> Result<Outcome> {
    let vehicles = study.problem.vehicles();
    let course = Course { process: Process::Sequential, preset: Preset::Ours, vehicles };
    let trained = study.trained(course)?;
    let policy = methods::policy(None)?;
    let problem = &study.problem;
    let drawn: Vec<Vec<CellId>> = (1..=study.seeds)
        .filter_map(|seed| policy.samples(problem, seed).into_iter().next())
        .map(|sample| sample.layout)
        .collect();
    let decoded: Vec<Vec<CellId>> = trained.iter().map(|trained| trained.decoded.clone()).collect();

    let executed = ((STEPS_PERCENT / 100.0 * vehicles as f64).round() as usize).clamp(1, vehicles);
    let mut rows = Vec::new();
    let mut series = Vec::new();
    for (name, layouts) in [(course.words(), decoded), ("Policy, no training".into(), drawn)] {
        let runs: Vec<_> = layouts.iter().map(|layout| kept(problem, layout)).collect();
        let at = |step: usize| median(runs.iter().map(|run| run[step - 1][1]).collect());
        let whole: Vec<f64> =
            layouts.iter().map(|layout| problem.evaluate(layout).detection_utility).collect();
        rows.push(Row {
            figure: "Fig. 6",
            what: format!("{name}, utility kept at 70 % of the steps"),
            paper: "≈ 85 %",
            ours: format!(
                "{:.1} % at {executed} of {vehicles} (J_d {:.2} in the end)",
                at(executed),
                median(whole),
            ),
        });
        let line = (1..=vehicles).map(|step| [step as f64, at(step)]).collect();
        series.push(SeriesRecord { name, runs, median: line });
    }
    let chart = ChartRecord {
        name: format!("Utility against executed steps: {}", study.name),
        note: format!("thin: {} seeds; bold: their median", study.seeds),
        version: env!("CARGO_PKG_VERSION").into(),
        panels: vec![PanelRecord {
            title: "Detection utility of the vehicles placed first".into(),
            x_label: format!("Executed steps of {vehicles}"),
            y_label: "Share of the final J_{d} (%)".into(),
            level: Some((format!("paper: ≈ {KEPT_PERCENT} % at {STEPS_PERCENT} %"), KEPT_PERCENT)),
            series,
        }],
    };
    write_chart(&chart, stem)?;
    Ok(Outcome { rows, record: serde_json::to_value(chart)? })
}

/// Percent of a layout's utility that its first vehicles have, by their number.
fn kept(problem: &PlacementProblem, layout: &[CellId]) -> Vec<[f64; 2]> {
    let utility = |step: usize| problem.evaluate(&layout[..step]).detection_utility;
    let whole = utility(layout.len());
    (1..=layout.len()).map(|step| [step as f64, 100.0 * utility(step) / whole]).collect()
}
