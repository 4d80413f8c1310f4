//! What methods reach on one problem: R, `J_d` and λ₂ of every run, and their medians
//! (Fig. 7 of the paper).

use super::chart::colour;
use super::{WIDTH, letter, shortened};
use crate::canvas::{Align, Canvas, Frame, Stroke, text_width};
use crate::colour::{FAINT, INK, WHITE};
use crate::plot::{Axes, LABEL, REMARK, TICK, TITLE};
use crate::ticks::{self, number};
use sonarfleet::record::{ScoreRecord, ScoresRecord, median};

const TOP: f64 = 38.0;
const ROW: f64 = 24.0;
const GAP: f64 = 22.0;
const RIGHT: f64 = 14.0;
/// Below the panels: ticks, label and the foot.
const BELOW: f64 = 44.0;
/// Most room for the methods' names.
const NAMES: f64 = 190.0;
/// Beyond the values, as a share of their range.
const ROOM: f64 = 0.05;
const LEVEL: Stroke = Stroke::new(INK, 0.8);
const DASH: [f64; 2] = [3.0, 2.0];

/// One number of a score over a panel of its own.
struct Measure {
    title: &'static str,
    label: &'static str,
    number: fn(&ScoreRecord) -> f64,
    decimals: usize,
}

const MEASURES: [Measure; 3] = [
    Measure { title: "Reward", label: "R", number: |score| score.reward, decimals: 2 },
    Measure {
        title: "Detection utility",
        label: "J_{d}",
        number: |score| score.detection_utility,
        decimals: 2,
    },
    Measure {
        title: "Connectivity",
        label: "λ₂",
        number: |score| score.algebraic_connectivity,
        decimals: 3,
    },
];

pub(super) fn draw(record: &ScoresRecord) -> Canvas {
    let mut names: Vec<&str> = record.scores.iter().map(|score| score.name.as_str()).collect();
    names.dedup();
    let rows = names.len().max(1) as f64;
    let height = TOP + rows * ROW + BELOW;
    let mut canvas = Canvas::new(WIDTH, height);
    canvas.text([14.0, 12.0], &shortened(&record.name, 120), Align::Start, TITLE.bold());

    let widest = names.iter().map(|name| text_width(name, LABEL)).fold(0.0, f64::max).min(NAMES);
    let left = 14.0 + widest + 8.0;
    for (row, name) in names.iter().enumerate() {
        let y = TOP + (row as f64 + 0.5) * ROW + 2.4;
        canvas.text([left - 8.0, y], name, Align::End, LABEL);
    }
    let width = (WIDTH - left - RIGHT - 2.0 * GAP) / 3.0;
    for (index, measure) in MEASURES.iter().enumerate() {
        let frame = Frame::new(left + index as f64 * (width + GAP), TOP, width, rows * ROW);
        let level = (measure.label == "λ₂").then_some(record.connectivity_threshold);
        let values = record.scores.iter().map(measure.number).chain(level);
        // Room for the discs at both ends.
        let range = ticks::range(values)
            .map(|(low, high)| (low - ROOM * (high - low), high + ROOM * (high - low)));
        let (low, high) = ticks::round_range(range, 5, (0.0, 1.0));
        let axes = Axes { frame, x: [low, high], y: [0.0, rows] };
        for row in 0..names.len() {
            let y = TOP + (row as f64 + 0.5) * ROW;
            canvas.line(vec![[frame.x, y], [frame.right(), y]], Stroke::new(FAINT, 0.4));
        }
        if let Some(level) = level {
            let [x, _] = axes.at(level, 0.0);
            canvas.dashed_line(&[[x, frame.y], [x, frame.bottom()]], frame, LEVEL, DASH);
            canvas.text([x, frame.y - 4.5], "τ", Align::Middle, REMARK);
        }
        for (row, name) in names.iter().enumerate() {
            let of = record.scores.iter().filter(|score| score.name == *name);
            let numbers: Vec<f64> = of.map(measure.number).collect();
            let y = TOP + (row as f64 + 0.5) * ROW;
            for &value in numbers.iter().filter(|value| value.is_finite()) {
                let [x, _] = axes.at(value, 0.0);
                canvas.disc([x, y], 2.0, colour(row).tint());
            }
            let middle = median(numbers);
            if middle.is_finite() {
                let [x, _] = axes.at(middle, 0.0);
                canvas.disc([x, y], 3.2, colour(row));
                let text = number(middle, measure.decimals);
                let half = text_width(&text, TICK) / 2.0;
                let x = x.max(frame.x + half + 2.0).min(frame.right() - half - 2.0);
                let ground = Frame::new(x - half, y - 11.0, 2.0 * half, 6.5);
                canvas.rectangle(ground, WHITE);
                canvas.text([x, y - 5.0], &text, Align::Middle, TICK);
            }
        }
        axes.draw_below(&mut canvas, measure.label);
        axes.title(&mut canvas, &format!("{} {}", letter(index), measure.title));
    }
    let foot = shortened(&format!("{} · sonarfleet {}", record.note, record.version), 165);
    canvas.text([WIDTH - 6.0, height - 6.0], &foot, Align::End, REMARK);
    canvas
}
