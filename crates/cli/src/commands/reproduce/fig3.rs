//! Fig. 3: what a random layout detects, and what optimised ones do.

use super::score::{median_run, more, reward, text, utility};
use super::study::{AUTO, RANDOM, Study, scores};
use super::training::{self, Course};
use super::{Outcome, Row};
use crate::args::Preset;
use anyhow::Result;
use sonarfleet::grid::CellId;
use sonarfleet::record::{LayoutRecord, LayoutsRecord};
use sonarfleet_learning::placement::paper::Process;
use sonarfleet_report::write_layouts;
use std::path::Path;

pub(super) fn fig3(study: &mut Study<'_>, stem: &Path) -> Result<Outcome> {
    let vehicles = study.problem.vehicles();
    let course = Course { process: Process::Sequential, preset: Preset::Ours, vehicles };
    let trained = study.trained(course)?;
    let random = study.solve(RANDOM, &study.problem)?;
    let auto = study.solve(AUTO, &study.problem)?;

    let problem = &study.problem;
    let layout = |name: &str, cells: &[CellId]| {
        let found = problem.evaluate(cells);
        LayoutRecord {
            name: name.into(),
            cells: cells.to_vec(),
            detection_probability: problem.network_detection(cells),
            detection_utility: found.detection_utility,
            algebraic_connectivity: found.algebraic_connectivity,
        }
    };
    let (random_scores, auto_scores) = (scores(&random), scores(&auto));
    let trained_scores = training::scores(&trained);
    let record = LayoutsRecord {
        name: format!("Layouts of {vehicles} vehicles: {}", study.name),
        version: env!("CARGO_PKG_VERSION").into(),
        grid: *problem.grid(),
        blocked_cells: problem.grid().cells().filter(|cell| is_blocked(study, *cell)).collect(),
        fixed_sensors: problem.fixed_sensors().to_vec(),
        connectivity_threshold: problem.connectivity_threshold(),
        prior: problem.prior().values().to_vec(),
        layouts: vec![
            layout(RANDOM.words, &random[median_run(&random_scores)].cells),
            layout(&course.words(), &trained[median_run(&trained_scores)].best),
            layout(AUTO.words, &auto[median_run(&auto_scores)].cells),
        ],
    };
    write_layouts(&record, stem)?;

    let by_chance = utility(&random_scores);
    let row = |what: &str, paper, ours| Row { figure: "Fig. 3", what: what.into(), paper, ours };
    let rows = vec![
        row("random layout, J_d", "14.6", format!("{by_chance:.2}")),
        row("sequential PPO", "R 35.98 (λ₂ 0.9)", text(&trained_scores)),
        row("auto", "–", text(&auto_scores)),
        row(
            "sequential PPO over random",
            "+120.68 % (14.6 → 35.98 is +146 %)",
            format!("{} (R over J_d)", more(by_chance, reward(&trained_scores), 2)),
        ),
        row(
            "auto over random",
            "–",
            format!("{} (R over J_d)", more(by_chance, reward(&auto_scores), 2)),
        ),
    ];
    Ok(Outcome { rows, record: serde_json::to_value(record)? })
}

fn is_blocked(study: &Study<'_>, cell: CellId) -> bool {
    study.input.deployable.as_ref().is_some_and(|deployable| !deployable[cell.0])
}
