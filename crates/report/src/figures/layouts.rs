//! The prior, and what layouts of one problem detect (Fig. 3 of the paper).

use super::map::{EAST, Map, NORTH};
use super::priors::range_of;
use super::{WIDTH, letter, shortened};
use crate::canvas::{Align, Canvas, Frame};
use crate::colour::{AMP, DENSE};
use crate::plot::{Axes, REMARK, Scale, TITLE};
use crate::ticks::number;
use sonarfleet::grid::CellId;
use sonarfleet::record::{LayoutRecord, LayoutsRecord};

const LEFT: f64 = 36.0;
const TOP: f64 = 42.0;
const PANEL: f64 = 182.0;
const COLUMN: f64 = 262.0;
const ROW_GAP: f64 = 54.0;
const COLUMNS: usize = 2;

pub(super) fn draw(record: &LayoutsRecord) -> Canvas {
    let height = Map::height(record, 0.0, PANEL, 300.0);
    let rows = (1 + record.layouts.len()).div_ceil(COLUMNS) as f64;
    let foot = TOP + rows * (height + ROW_GAP) - 6.0;
    let mut canvas = Canvas::new(WIDTH, foot + 6.0);
    canvas.text([LEFT, 12.0], &shortened(&record.name, 120), Align::Start, TITLE.bold());

    let weighted = Scale { table: AMP, range: range_of(record.prior.iter().copied()) };
    let detected = Scale { table: DENSE, range: (0.0, 1.0) };
    for index in 0..=record.layouts.len() {
        let (column, row) = ((index % COLUMNS) as f64, (index / COLUMNS) as f64);
        let room =
            Frame::new(LEFT + column * COLUMN, TOP + row * (height + ROW_GAP), PANEL, height);
        let map = Map::new(record, 0.0, room);
        let layout = index.checked_sub(1).map(|index| &record.layouts[index]);
        let (values, scale, label) = match layout {
            None => (&record.prior, weighted, "Target prior P_{T}"),
            Some(layout) => {
                (&layout.detection_probability, detected, "Cumulative detection P_{net}")
            }
        };
        map.field(&mut canvas, |cell: CellId| values[cell.0], scale);
        map.blocked(&mut canvas);
        map.sensors(&mut canvas, layout.map_or(&[], |layout| &layout.cells[..]));
        map.axes.draw(&mut canvas, Some(EAST), Some(NORTH));
        // At the room's edge: titles are wider than the map of a narrow region.
        let titled = Axes { frame: Frame { x: room.x, ..map.axes.frame }, ..map.axes };
        let letter = letter(index);
        match layout {
            None => titled.title(&mut canvas, &format!("{letter} Target prior")),
            Some(layout) => titled.titles(
                &mut canvas,
                &format!("{letter} {}", layout.name),
                &numbers(layout, record.connectivity_threshold),
            ),
        }
        let frame = map.axes.frame;
        scale.bar(&mut canvas, Frame::new(frame.right() + 7.0, frame.y, 7.0, frame.height), label);
    }
    let text = format!("sonarfleet {}", record.version);
    canvas.text([WIDTH - 6.0, foot], &text, Align::End, REMARK);
    canvas
}

fn numbers(layout: &LayoutRecord, threshold: f64) -> String {
    format!(
        "J_{{d}} = {}, λ₂ = {} {} τ = {threshold}",
        number(layout.detection_utility, 2),
        number(layout.algebraic_connectivity, 3),
        if layout.algebraic_connectivity >= threshold { "≥" } else { "<" },
    )
}
