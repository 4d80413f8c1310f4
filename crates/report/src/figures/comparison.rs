//! Methods side by side: what each achieved on some problems.

use super::{WIDTH, letter, shortened};
use crate::canvas::{Align, Canvas, Frame, Point, Stroke, text_width};
use crate::colour::{FAILURE, FAINT, INK, MUTED, Rgb, TRACK, WHITE};
use crate::plot::{Axes, LABEL, REMARK, TICK, TITLE};
use crate::ticks;
use sonarfleet::placement::comparison::{Comparison, Trial};

/// Panels in a row; further problems continue below.
const PANELS: usize = 4;
/// Room for the methods' names.
const NAMES: f64 = 92.0;
const RIGHT: f64 = 12.0;
const GAP: f64 = 12.0;
const TOP: f64 = 40.0;
/// Height of a method's row.
const ROW: f64 = 15.0;
/// Below a row of panels: ticks and label, and the next row's titles.
const BELOW: f64 = 54.0;
const FOOT: f64 = 12.0;
/// Within a method's row: where the first and the last seed's marks are.
const SPREAD: f64 = 0.6;
const RADIUS: f64 = 2.1;

/// Worse than this share of the best layout found, values are drawn at the edge.
const SHOWN_SHARE: f64 = 0.72;
/// Room at both ends of an axis, as a share of its range.
const MARGIN: f64 = 0.05;

const BOUND: Stroke = Stroke::new(MUTED, 0.8);
const BEST: Stroke = Stroke::new(INK, 0.8);
const MEDIAN: Stroke = Stroke::new(INK, 1.3);
const DASH: [f64; 2] = [3.0, 2.0];
const FEASIBLE: Rgb = TRACK;
const INFEASIBLE: Rgb = FAILURE;

pub(super) fn draw(comparisons: &[Comparison], note: &str) -> Canvas {
    let methods = methods(comparisons);
    let height = methods.len().max(1) as f64 * ROW;
    let rows = comparisons.len().div_ceil(PANELS).max(1);
    let bottom = TOP + rows as f64 * (height + BELOW);
    let mut canvas = Canvas::new(WIDTH, bottom + FOOT);
    legend(&mut canvas);
    let columns = comparisons.len().clamp(1, PANELS) as f64;
    let width = (WIDTH - NAMES - RIGHT - (columns - 1.0) * GAP) / columns;
    for (index, comparison) in comparisons.iter().enumerate() {
        let (column, row) = (index % PANELS, index / PANELS);
        let frame = Frame::new(
            NAMES + column as f64 * (width + GAP),
            TOP + row as f64 * (height + BELOW),
            width,
            height,
        );
        let panel = Panel { comparison, methods: &methods, axes: axes(comparison, frame) };
        if column == 0 {
            panel.names(&mut canvas);
        }
        panel.draw(&mut canvas, index);
    }
    canvas.text([WIDTH - 6.0, bottom + FOOT - 6.0], &shortened(note, 165), Align::End, REMARK);
    canvas
}

/// All methods, in the order in which they were first run.
fn methods(comparisons: &[Comparison]) -> Vec<&str> {
    let mut methods: Vec<&str> = Vec::new();
    for method in comparisons.iter().flat_map(Comparison::methods) {
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    methods
}

/// From what is worth showing to the upper bound.
fn axes(comparison: &Comparison, frame: Frame) -> Axes {
    let values = || comparison.trials.iter().map(|trial| trial.detection_utility);
    let (low, high) = ticks::range(values().chain([comparison.upper_bound])).unwrap_or((0.0, 1.0));
    let shown = SHOWN_SHARE * comparison.best_found().unwrap_or(high);
    let (low, high) =
        if low < high { (low.max(shown).min(high - 1e-6), high) } else { (low - 1.0, high + 1.0) };
    let margin = MARGIN * (high - low);
    Axes { frame, x: [low - margin, high + margin], y: [0.0, 1.0] }
}

struct Panel<'a> {
    comparison: &'a Comparison,
    methods: &'a [&'a str],
    axes: Axes,
}

impl Panel<'_> {
    /// Middle of a method's row.
    fn row(&self, method: usize) -> f64 {
        self.axes.frame.y + (method as f64 + 0.5) * ROW
    }

    fn names(&self, canvas: &mut Canvas) {
        for (index, name) in self.methods.iter().enumerate() {
            let at = [self.axes.frame.x - 6.0, self.row(index) + 2.5];
            canvas.text(at, &shortened(name, 22), Align::End, LABEL);
        }
    }

    fn draw(&self, canvas: &mut Canvas, index: usize) {
        let Comparison { problem, connectivity_threshold, vehicles, upper_bound, .. } =
            self.comparison;
        let frame = self.axes.frame;
        for row in 0..self.methods.len() {
            let y = self.row(row);
            canvas.line(vec![[frame.x, y], [frame.right(), y]], Stroke::new(FAINT, 0.35));
        }
        self.upright(canvas, *upper_bound, BOUND, Some(DASH));
        if let Some(best) = self.comparison.best_found() {
            self.upright(canvas, best, BEST, None);
        }
        for (row, method) in self.methods.iter().enumerate() {
            self.trials(canvas, row, method);
        }
        self.scale(canvas);
        let room = (frame.width / 4.2) as usize;
        let title = format!("{} {}", letter(index), shortened(problem, room));
        let remark = format!("τ = {connectivity_threshold}, {vehicles} vehicles");
        self.axes.titles(canvas, &title, &remark);
    }

    /// One mark per seed, and the median of all.
    fn trials(&self, canvas: &mut Canvas, row: usize, method: &str) {
        let of_method = |trial: &&Trial| trial.method == method;
        let trials: Vec<&Trial> = self.comparison.trials.iter().filter(of_method).collect();
        let middle = self.row(row);
        let summaries = self.comparison.summaries();
        let median = summaries.iter().find(|summary| summary.method == method);
        if let Some(median) = median.filter(|_| trials.len() > 1) {
            let (x, _) = self.across(median.detection_utility);
            let half = 0.42 * ROW;
            canvas.line(vec![[x, middle - half], [x, middle + half]], MEDIAN);
        }
        let step = SPREAD * ROW / trials.len().max(2).saturating_sub(1) as f64;
        let first = middle - 0.5 * step * trials.len().saturating_sub(1) as f64;
        for (k, trial) in trials.iter().enumerate() {
            let (x, outside) = self.across(trial.detection_utility);
            let at = [x, first + k as f64 * step];
            if outside {
                arrow(canvas, at, trial.feasible);
            } else {
                mark(canvas, at, trial.feasible);
            }
        }
    }

    /// Where a value is, and whether that is only the edge nearest to it.
    fn across(&self, utility: f64) -> (f64, bool) {
        let [low, high] = self.axes.x;
        let [x, _] = self.axes.at(utility.clamp(low, high), 0.0);
        if utility < low { (x + RADIUS + 1.2, true) } else { (x, false) }
    }

    fn upright(&self, canvas: &mut Canvas, utility: f64, stroke: Stroke, dash: Option<[f64; 2]>) {
        let line = [self.axes.at(utility, 0.0), self.axes.at(utility, 1.0)];
        match dash {
            Some(dash) => canvas.dashed_line(&line, self.axes.frame, stroke, dash),
            None => canvas.clipped_line(&line, self.axes.frame, stroke),
        }
    }

    /// The frame, and the scale below it.
    fn scale(&self, canvas: &mut Canvas) {
        const LENGTH: f64 = 2.5;
        const STROKE: Stroke = Stroke::new(INK, 0.6);
        let Frame { x, width, .. } = self.axes.frame;
        let bottom = self.axes.frame.bottom();
        canvas.outline(self.axes.frame, STROKE);
        let count = ((width / 24.0) as usize).clamp(2, 8);
        let positions = ticks::ticks(self.axes.x[0], self.axes.x[1], count);
        for (&value, text) in positions.iter().zip(ticks::labels(&positions)) {
            let [at, _] = self.axes.at(value, 0.0);
            canvas.line(vec![[at, bottom], [at, bottom + LENGTH]], STROKE);
            canvas.text([at, bottom + LENGTH + 7.0], &text, Align::Middle, TICK);
        }
        let at = [x + width / 2.0, bottom + LENGTH + 16.5];
        canvas.text(at, "Detection utility J_{d}", Align::Middle, LABEL);
    }
}

fn mark(canvas: &mut Canvas, at: Point, feasible: bool) {
    canvas.disc(at, RADIUS + 0.5, WHITE);
    if feasible {
        canvas.disc(at, RADIUS, FEASIBLE);
    } else {
        canvas.circle(at, RADIUS - 0.3, Stroke::new(INFEASIBLE, 0.8));
    }
}

/// Points to where the value would be.
fn arrow(canvas: &mut Canvas, [x, y]: Point, feasible: bool) {
    let corners = vec![[x - RADIUS, y], [x + RADIUS, y - RADIUS], [x + RADIUS, y + RADIUS]];
    if feasible {
        canvas.polygon(corners, FEASIBLE);
    } else {
        let closed = corners.iter().chain(&corners[..1]).copied().collect();
        canvas.polygon(corners, WHITE);
        canvas.line(closed, Stroke::new(INFEASIBLE, 0.8));
    }
}

fn legend(canvas: &mut Canvas) {
    const SAMPLE: f64 = 12.0;
    const Y: f64 = 12.0;
    let whole = Frame::new(0.0, 0.0, WIDTH, f64::MAX);
    canvas.text([6.0, Y], "Placement methods", Align::Start, TITLE.bold());
    let names = ["Feasible", "Infeasible", "Below the axis", "Median", "Best found", "Upper bound"];
    let width = |name: &str| SAMPLE + 4.0 + text_width(name, LABEL) + 11.0;
    let mut x = WIDTH - RIGHT + 11.0 - names.iter().map(|name| width(name)).sum::<f64>();
    for (index, name) in names.into_iter().enumerate() {
        let (middle, y) = (x + SAMPLE / 2.0, Y - 2.4);
        let across = [[x, y], [x + SAMPLE, y]];
        match index {
            0 => mark(canvas, [middle, y], true),
            1 => mark(canvas, [middle, y], false),
            2 => arrow(canvas, [middle, y], true),
            3 => canvas.line(vec![[middle, y - 4.0], [middle, y + 4.0]], MEDIAN),
            4 => canvas.line(across.to_vec(), BEST),
            _ => canvas.dashed_line(&across, whole, BOUND, DASH),
        }
        canvas.text([x + SAMPLE + 4.0, Y], name, Align::Start, LABEL);
        x += width(name);
    }
}
