//! Target priors of the epochs side by side (Fig. 9 of the paper).

use super::map::{EAST, Map, NORTH};
use super::{WIDTH, footer, letter, readable_time};
use crate::canvas::{Canvas, Frame};
use crate::colour::AMP;
use crate::plot::Scale;
use crate::ticks;
use sonarfleet::record::{EpochRecord, RunRecord};

const LEFT: f64 = 34.0;
const TOP: f64 = 26.0;
const GAP: f64 = 9.0;
/// Room for the colour bar, its numbers and its label.
const BAR_ROOM: f64 = 44.0;

pub(super) fn draw(record: &RunRecord, epochs: &[EpochRecord]) -> Canvas {
    let count = epochs.len().max(2) as f64;
    let width = (WIDTH - LEFT - BAR_ROOM - (count - 1.0) * GAP) / count;
    let height = Map::height(record, 0.0, width, 300.0);
    let mut canvas = Canvas::new(WIDTH, TOP + height + 40.0);
    let scale = Scale { table: AMP, range: prior_range(epochs) };

    let mut right = LEFT;
    for (index, epoch) in epochs.iter().enumerate() {
        let room = Frame::new(LEFT + index as f64 * (width + GAP), TOP, width, height);
        let map = Map::new(record, 0.0, room);
        map.field(&mut canvas, |cell| epoch.prior[cell.0], scale);
        map.blocked(&mut canvas);
        map.axes.draw(&mut canvas, Some(EAST), (index == 0).then_some(NORTH));
        let title = format!("{} Epoch {}", letter(index), epoch.epoch);
        map.axes.titles(&mut canvas, &title, &readable_time(&epoch.time));
        right = map.axes.frame.right();
    }
    scale.bar(&mut canvas, Frame::new(right + 7.0, TOP, 7.0, height), "Target prior P_{T}");
    let bottom = TOP + height + 34.0;
    footer(&mut canvas, record, bottom);
    canvas
}

/// From zero to a round number above the largest prior of the epochs.
pub(super) fn prior_range(epochs: &[EpochRecord]) -> (f64, f64) {
    range_of(epochs.iter().flat_map(|epoch| epoch.prior.iter().copied()))
}

/// From zero to a round number above the largest value.
pub(super) fn range_of(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = ticks::range(values.chain([0.0])).unwrap_or((0.0, 1.0));
    if high > 0.0 { ticks::round_range(Some((low, high)), 8, (0.0, 1.0)) } else { (0.0, 1.0) }
}
