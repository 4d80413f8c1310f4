//! Made-up comparisons of methods.

use sonarfleet::grid::{CellId, SurveillanceGrid};
use sonarfleet::record::{
    ChartRecord, LayoutRecord, LayoutsRecord, PanelRecord, ScoreRecord, ScoresRecord, SeriesRecord,
};

const METHODS: [&str; 3] =
    ["Sequential PPO, our settings", "Policy, no training", "PSO as the paper"];
const THRESHOLD: f64 = 0.95;

/// Two layouts on a grid of so many columns and rows.
pub(crate) fn layouts(columns: usize, rows: usize) -> LayoutsRecord {
    let grid = SurveillanceGrid { columns, rows, cell_width_m: 1000.0, cell_height_m: 1000.0 };
    let count = grid.cell_count();
    let wave = |k: usize| 0.5 + 0.5 * (k as f64 / 5.0).sin();
    let layout = |name: &str, step: usize, algebraic_connectivity| LayoutRecord {
        name: name.into(),
        cells: (0..count).step_by(step).map(CellId).collect(),
        detection_probability: (0..count).map(|k| wave(k * step)).collect(),
        detection_utility: 12.345,
        algebraic_connectivity,
    };
    LayoutsRecord {
        name: "Layouts of a sample".into(),
        version: "0.1.0".into(),
        grid,
        blocked_cells: vec![CellId(1)],
        fixed_sensors: vec![CellId(0)],
        connectivity_threshold: THRESHOLD,
        prior: (0..count).map(|k| 0.3 * wave(k)).collect(),
        layouts: vec![layout("Random layout", 3, 0.1), layout("Auto", 5, 0.97)],
    }
}

/// Lines of so many runs in so many panels.
pub(crate) fn chart(panels: usize, runs: usize, points: usize) -> ChartRecord {
    let series = |(index, name): (usize, &str)| {
        let line = |run: usize| -> Vec<[f64; 2]> {
            let rise = |x: f64| (20.0 + 3.0 * index as f64) * (1.0 - (-x / 9.0).exp());
            (0..points).map(|k| [k as f64, rise(k as f64) + run as f64]).collect()
        };
        SeriesRecord {
            name: name.into(),
            runs: (0..runs).map(line).collect(),
            median: line(runs / 2),
        }
    };
    let panel = |index: usize| PanelRecord {
        title: format!("Panel {index}"),
        x_label: "Steps".into(),
        y_label: "Share of the final J_{d} (%)".into(),
        level: (index == 0).then(|| ("paper: 15".into(), 15.0)),
        series: METHODS.into_iter().enumerate().map(series).collect(),
    };
    ChartRecord {
        name: "A sample against steps".into(),
        note: "thin: seeds; bold: their median".into(),
        version: "0.1.0".into(),
        panels: (0..panels).map(panel).collect(),
    }
}

/// So many runs of every method.
pub(crate) fn scores(runs: usize) -> ScoresRecord {
    let score = |index: usize, run: usize| ScoreRecord {
        name: METHODS[index].into(),
        reward: 35.0 - 3.0 * index as f64 + 0.4 * run as f64,
        detection_utility: 36.0 - index as f64 + 0.4 * run as f64,
        algebraic_connectivity: 0.97 - 0.04 * index as f64 + 0.01 * run as f64,
    };
    ScoresRecord {
        name: "Methods on a sample".into(),
        note: "small: seeds; large: their median".into(),
        version: "0.1.0".into(),
        connectivity_threshold: THRESHOLD,
        scores: (0..METHODS.len()).flat_map(|m| (0..runs).map(move |run| score(m, run))).collect(),
    }
}
