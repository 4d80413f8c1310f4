//! Transmission loss, prior, and what a random and the target layout detect
//! (Fig. 3 of the paper).

use super::map::{EAST, Map, NORTH, diamond};
use super::priors::prior_range;
use super::{WIDTH, epoch_title, footer};
use crate::canvas::{Align, Canvas, Frame};
use crate::colour::{AMP, DENSE, LOSS, WHITE};
use crate::plot::{Axes, Scale, TITLE};
use crate::ticks::number;
use sonarfleet::grid::CellId;
use sonarfleet::record::{EpochRecord, RunRecord};

const LEFT: f64 = 36.0;
const TOP: f64 = 34.0;
const PANEL: f64 = 182.0;
const COLUMN: f64 = 262.0;
const ROW_GAP: f64 = 44.0;

pub(super) fn draw(record: &RunRecord, epoch: &EpochRecord) -> Canvas {
    let height = Map::height(record, 0.0, PANEL, 300.0);
    let mut canvas = Canvas::new(WIDTH, TOP + 2.0 * height + ROW_GAP + 40.0);
    canvas.text([LEFT, 12.0], &epoch_title(epoch), Align::Start, TITLE.bold());

    let metrics = &epoch.metrics;
    let source = record.grid.centre(epoch.loss_source);
    let kilometres = |metres: f64| number(metres / 1000.0, 1);
    let loss_title = format!(
        "(a) Transmission loss from {} km E, {} km N",
        kilometres(source.east_m),
        kilometres(source.north_m)
    );
    let layout_title = |name: &str, utility: f64, connectivity: f64| {
        let threshold = record.connectivity_threshold;
        format!(
            "{name}: J_{{d}} = {}, λ₂ = {} {} τ = {threshold}",
            number(utility, 2),
            number(connectivity, 3),
            if connectivity >= threshold { "≥" } else { "<" },
        )
    };
    let random_title = layout_title(
        "(c) Random layout",
        metrics.random_detection_utility,
        metrics.random_algebraic_connectivity,
    );
    let target_title = layout_title(
        "(d) Target layout",
        metrics.detection_utility,
        metrics.algebraic_connectivity,
    );
    let detected = Scale { table: DENSE, range: (0.0, 1.0) };
    let weighted = Scale { table: AMP, range: prior_range(std::slice::from_ref(epoch)) };
    let panels = [
        Panel {
            title: loss_title,
            label: "Transmission loss (dB re 1 m)",
            scale: Scale { table: LOSS, range: loss_range(epoch) },
            value: &|cell| f64::from(epoch.loss_db[cell.0]),
            layout: None,
        },
        Panel {
            title: "(b) Target prior".to_owned(),
            label: "Target prior P_{T}",
            scale: weighted,
            value: &|cell| epoch.prior[cell.0],
            layout: None,
        },
        Panel {
            title: random_title,
            label: "Cumulative detection P_{net}",
            scale: detected,
            value: &|cell| epoch.random_detection_probability[cell.0],
            layout: Some(&epoch.random_layout),
        },
        Panel {
            title: target_title,
            label: "Cumulative detection P_{net}",
            scale: detected,
            value: &|cell| epoch.detection_probability[cell.0],
            layout: Some(&epoch.layout),
        },
    ];
    for (index, panel) in panels.into_iter().enumerate() {
        let (column, row) = ((index % 2) as f64, (index / 2) as f64);
        let room =
            Frame::new(LEFT + column * COLUMN, TOP + row * (height + ROW_GAP), PANEL, height);
        let map = Map::new(record, 0.0, room);
        map.field(&mut canvas, panel.value, panel.scale);
        map.blocked(&mut canvas);
        match panel.layout {
            Some(layout) => map.sensors(&mut canvas, layout),
            None if index == 0 => diamond(&mut canvas, map.at(source), 3.6, WHITE),
            None => {}
        }
        map.axes.draw(&mut canvas, Some(EAST), Some(NORTH));
        // At the room's edge: titles are wider than the map of a narrow region.
        let titled = Axes { frame: Frame { x: room.x, ..map.axes.frame }, ..map.axes };
        titled.title(&mut canvas, &panel.title);
        let frame = map.axes.frame;
        let bar = Frame::new(frame.right() + 7.0, frame.y, 7.0, frame.height);
        panel.scale.bar(&mut canvas, bar, panel.label);
    }
    footer(&mut canvas, record, TOP + 2.0 * height + ROW_GAP + 34.0);
    canvas
}

struct Panel<'a> {
    title: String,
    label: &'static str,
    scale: Scale,
    value: &'a dyn Fn(CellId) -> f64,
    layout: Option<&'a [CellId]>,
}

/// Losses above this are all drawn alike, dB: nothing is heard there.
const HIGHEST_SHOWN_DB: f64 = 120.0;

/// The range of losses without the outermost fiftieth at both ends, which would
/// take most of the colours (the source's own cell, deep shadows), in tens.
pub(super) fn loss_range(epoch: &EpochRecord) -> (f64, f64) {
    let mut losses: Vec<f64> =
        epoch.loss_db.iter().map(|&loss| f64::from(loss)).filter(|loss| loss.is_finite()).collect();
    losses.sort_by(f64::total_cmp);
    let Some(last) = losses.len().checked_sub(1) else { return (40.0, 120.0) };
    let margin = last / 50;
    let low = (losses[margin] / 10.0).floor() * 10.0;
    let high = (losses[last - margin] / 10.0).ceil() * 10.0;
    (low, high.min(HIGHEST_SHOWN_DB).max(low + 10.0))
}
