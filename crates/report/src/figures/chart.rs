//! Lines of several methods in panels side by side: one thin line per run, and the
//! median bold (Figs. 4 to 6 of the paper).

use super::{WIDTH, letter, shortened};
use crate::canvas::{Align, Canvas, Frame, Point, Stroke, text_width};
use crate::colour::{INK, MUTED, Rgb, SERIES};
use crate::plot::{Axes, LABEL, REMARK, TITLE};
use crate::ticks;
use sonarfleet::record::{ChartRecord, PanelRecord, SeriesRecord};

const LEFT: f64 = 46.0;
const RIGHT: f64 = 14.0;
const HEIGHT: f64 = 190.0;
/// Between panels: numbers and a label.
const GAP: f64 = 52.0;
/// Below the panels: ticks, label and the foot.
const BELOW: f64 = 44.0;
/// The first line of the legend, and from each line to the next.
const LEGEND: f64 = 27.0;
const LEGEND_LINE: f64 = 12.0;
const MEDIAN_WIDTH: f64 = 1.3;
/// Medians of so few points show each of them.
const FEW_POINTS: usize = 12;
const LEVEL: Stroke = Stroke::new(INK, 0.8);
const DASH: [f64; 2] = [3.0, 2.0];

pub(super) fn draw(record: &ChartRecord) -> Canvas {
    let names = names(record);
    let legend = legend(&names);
    let lines = legend.last().map_or(0.0, |entry| entry.line + 1.0);
    let top = LEGEND + lines * LEGEND_LINE + 16.0;
    let height = top + HEIGHT + BELOW;
    let mut canvas = Canvas::new(WIDTH, height);
    canvas.text([LEFT, 12.0], &shortened(&record.name, 120), Align::Start, TITLE.bold());
    for entry in &legend {
        let y = LEGEND + entry.line * LEGEND_LINE;
        let sample = vec![[entry.x, y - 2.4], [entry.x + SAMPLE, y - 2.4]];
        canvas.line(sample, Stroke::new(colour(entry.index), MEDIAN_WIDTH));
        canvas.text([entry.x + SAMPLE + 4.0, y], names[entry.index], Align::Start, LABEL);
    }

    let count = record.panels.len().max(1) as f64;
    let width = (WIDTH - LEFT - RIGHT - (count - 1.0) * GAP) / count;
    for (index, panel) in record.panels.iter().enumerate() {
        let frame = Frame::new(LEFT + index as f64 * (width + GAP), top, width, HEIGHT);
        let axes = axes(panel, frame);
        let of = |series: &SeriesRecord| names.iter().position(|name| *name == series.name);
        for series in &panel.series {
            let stroke = Stroke::new(colour(of(series).unwrap_or(0)).tint(), 0.5);
            for run in series.runs.iter().filter(|_| series.runs.len() > 1) {
                canvas.clipped_line(&line(axes, run), frame, stroke);
            }
        }
        if let Some((name, level)) = &panel.level {
            let at = axes.at(axes.x[0], *level);
            canvas.dashed_line(&[at, [frame.right(), at[1]]], frame, LEVEL, DASH);
            canvas.text([frame.x + 4.0, at[1] - 3.0], name, Align::Start, REMARK);
        }
        for series in &panel.series {
            let colour = colour(of(series).unwrap_or(0));
            let points = line(axes, &series.median);
            if points.len() <= FEW_POINTS {
                for &point in points.iter().filter(|point| point[1].is_finite()) {
                    canvas.disc(point, 2.2, colour);
                }
            }
            canvas.clipped_line(&points, frame, Stroke::new(colour, MEDIAN_WIDTH));
        }
        axes.draw(&mut canvas, Some(&panel.x_label), Some(&panel.y_label));
        let title = if record.panels.len() > 1 {
            format!("{} {}", letter(index), panel.title)
        } else {
            panel.title.clone()
        };
        axes.title(&mut canvas, &title);
    }
    let foot = shortened(&format!("{} · sonarfleet {}", record.note, record.version), 165);
    canvas.text([WIDTH - 6.0, height - 6.0], &foot, Align::End, REMARK);
    canvas
}

/// The colour of a series; what there is no colour left for is grey.
pub(super) fn colour(index: usize) -> Rgb {
    SERIES.get(index).copied().unwrap_or(MUTED)
}

/// The series by name, in the order of their appearance.
fn names(record: &ChartRecord) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for series in record.panels.iter().flat_map(|panel| &panel.series) {
        if !names.contains(&series.name.as_str()) {
            names.push(&series.name);
        }
    }
    names
}

const SAMPLE: f64 = 14.0;

/// Where an entry of the legend starts.
struct Entry {
    index: usize,
    x: f64,
    line: f64,
}

/// Entries in lines as wide as the figure.
fn legend(names: &[&str]) -> Vec<Entry> {
    let (mut x, mut line) = (LEFT, 0.0);
    let place = |(index, name): (usize, &&str)| {
        let width = SAMPLE + 4.0 + text_width(name, LABEL) + 12.0;
        if x > LEFT && x + width > WIDTH {
            (x, line) = (LEFT, line + 1.0);
        }
        let entry = Entry { index, x, line };
        x += width;
        entry
    };
    names.iter().enumerate().map(place).collect()
}

/// Axes that hold all lines, but for the outermost of many points.
fn axes(panel: &PanelRecord, frame: Frame) -> Axes {
    let points = || {
        let of = |series: &'_ SeriesRecord| {
            series.runs.iter().flatten().chain(&series.median).copied().collect::<Vec<_>>()
        };
        panel.series.iter().flat_map(of)
    };
    let (left, right) = ticks::range(points().map(|[x, _]| x)).unwrap_or((0.0, 1.0));
    let (left, right) = if left < right { (left, right) } else { (left - 0.5, right + 0.5) };
    let mut values: Vec<f64> = points().map(|[_, y]| y).filter(|y| y.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    let outer = values.len() / 200;
    let inner = values[outer..values.len() - outer].iter().copied();
    let level = panel.level.iter().map(|(_, level)| *level);
    let (low, high) = ticks::round_range(ticks::range(inner.chain(level)), 8, (0.0, 1.0));
    Axes { frame, x: [left, right], y: [low, high] }
}

fn line(axes: Axes, points: &[[f64; 2]]) -> Vec<Point> {
    points.iter().map(|&[x, y]| axes.at(x, y)).collect()
}
