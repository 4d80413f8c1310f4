//! Panels: axes over a frame, fields of cells, colour bars.

use crate::canvas::{Align, Canvas, Frame, Point, Stroke, Style, text_width};
use crate::colour::{ColourTable, HATCH, INK, MUTED, NO_DATA};
use crate::ticks;

/// Labels of axes and colour bars.
pub(crate) const LABEL: Style = Style::new(7.0, INK);
/// Numbers at ticks.
pub(crate) const TICK: Style = Style::new(6.5, INK);
/// Titles of panels.
pub(crate) const TITLE: Style = Style::new(7.5, INK);
/// Remarks.
pub(crate) const REMARK: Style = Style::new(6.0, MUTED);

const FRAME_STROKE: Stroke = Stroke::new(INK, 0.6);
const TICK_LENGTH: f64 = 2.5;

/// A frame with linear axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axes {
    pub(crate) frame: Frame,
    /// Values at the left and right edge.
    pub(crate) x: [f64; 2],
    /// Values at the lower and upper edge.
    pub(crate) y: [f64; 2],
}

impl Axes {
    /// Where a pair of values is on the figure.
    pub(crate) fn at(&self, x: f64, y: f64) -> Point {
        let [left, right] = self.x;
        let [low, high] = self.y;
        [
            self.frame.x + (x - left) / (right - left) * self.frame.width,
            self.frame.bottom() - (y - low) / (high - low) * self.frame.height,
        ]
    }

    /// Points per unit of the x axis.
    pub(crate) fn scale(&self) -> f64 {
        self.frame.width / (self.x[1] - self.x[0])
    }

    /// The frame with ticks outside, and numbers where asked.
    pub(crate) fn draw(&self, canvas: &mut Canvas, x_label: Option<&str>, y_label: Option<&str>) {
        let Frame { x, y, height, .. } = self.frame;
        self.abscissa(canvas, x_label);

        let count = ((height / 18.0) as usize).clamp(2, 6);
        let positions = ticks::ticks(self.y[0].min(self.y[1]), self.y[0].max(self.y[1]), count);
        let mut widest = 0.0_f64;
        for (&value, text) in positions.iter().zip(ticks::labels(&positions)) {
            let [_, at] = self.at(self.x[0], value);
            canvas.line(vec![[x - TICK_LENGTH, at], [x, at]], FRAME_STROKE);
            if y_label.is_some() {
                canvas.text([x - TICK_LENGTH - 2.0, at + 2.4], &text, Align::End, TICK);
                widest = widest.max(text_width(&text, TICK));
            }
        }
        if let Some(label) = y_label {
            let at = [x - TICK_LENGTH - 2.0 - widest - 5.0, y + height / 2.0];
            canvas.upright_text(at, label, Align::Middle, LABEL);
        }
    }

    /// The frame with ticks, numbers and a label below, for rows that carry names.
    pub(crate) fn draw_below(&self, canvas: &mut Canvas, label: &str) {
        self.abscissa(canvas, Some(label));
    }

    /// The frame and what is below it.
    fn abscissa(&self, canvas: &mut Canvas, x_label: Option<&str>) {
        let Frame { x, width, .. } = self.frame;
        let bottom = self.frame.bottom();
        canvas.outline(self.frame, FRAME_STROKE);

        let count = ((width / 24.0) as usize).clamp(2, 6);
        let positions = ticks::ticks(self.x[0].min(self.x[1]), self.x[0].max(self.x[1]), count);
        for (&value, text) in positions.iter().zip(ticks::labels(&positions)) {
            let [at, _] = self.at(value, self.y[0]);
            canvas.line(vec![[at, bottom], [at, bottom + TICK_LENGTH]], FRAME_STROKE);
            if x_label.is_some() {
                canvas.text([at, bottom + TICK_LENGTH + 7.0], &text, Align::Middle, TICK);
            }
        }
        if let Some(label) = x_label {
            let at = [x + width / 2.0, bottom + TICK_LENGTH + 16.5];
            canvas.text(at, label, Align::Middle, LABEL);
        }
    }

    /// Ticks, numbers and a label at the right, for lines on a scale of their own.
    pub(crate) fn draw_right(&self, canvas: &mut Canvas, label: &str) {
        let right = self.frame.right();
        let [low, high] = self.y;
        let count = ((self.frame.height / 18.0) as usize).clamp(2, 6);
        let positions = ticks::ticks(low, high, count);
        let mut widest = 0.0_f64;
        for (&value, text) in positions.iter().zip(ticks::labels(&positions)) {
            let [_, y] = self.at(self.x[0], value);
            canvas.line(vec![[right, y], [right + TICK_LENGTH, y]], FRAME_STROKE);
            canvas.text([right + TICK_LENGTH + 2.0, y + 2.4], &text, Align::Start, TICK);
            widest = widest.max(text_width(&text, TICK));
        }
        let x = right + TICK_LENGTH + 2.0 + widest + 9.0;
        let middle = self.frame.y + self.frame.height / 2.0;
        canvas.upright_text([x, middle], label, Align::Middle, LABEL);
    }

    /// Title above the frame, at its left.
    pub(crate) fn title(&self, canvas: &mut Canvas, text: &str) {
        canvas.text([self.frame.x, self.frame.y - 4.5], text, Align::Start, TITLE);
    }

    /// Title above the frame, and a remark in small type between the two.
    pub(crate) fn titles(&self, canvas: &mut Canvas, text: &str, remark: &str) {
        canvas.text([self.frame.x, self.frame.y - 13.5], text, Align::Start, TITLE);
        canvas.text([self.frame.x, self.frame.y - 4.5], remark, Align::Start, REMARK);
    }

    /// Cells between edges, coloured by value; hatched where there is none.
    pub(crate) fn cells(
        &self,
        canvas: &mut Canvas,
        [x_edges, y_edges]: [&[f64]; 2],
        value: impl Fn(usize, usize) -> f64,
        scale: Scale,
    ) {
        for row in 0..y_edges.len().saturating_sub(1) {
            for column in 0..x_edges.len().saturating_sub(1) {
                let [left, bottom] = self.at(x_edges[column], y_edges[row]);
                let [right, top] = self.at(x_edges[column + 1], y_edges[row + 1]);
                let Some(cell) = self.clipped([left, right], [bottom, top]) else { continue };
                match value(column, row) {
                    value if value.is_finite() => canvas.rectangle(cell, scale.colour(value)),
                    _ => no_data(canvas, cell),
                }
            }
        }
    }

    /// Marks a cell as one that has a value but may not be used.
    pub(crate) fn hatched(&self, canvas: &mut Canvas, x: [f64; 2], y: [f64; 2]) {
        let [left, bottom] = self.at(x[0], y[0]);
        let [right, top] = self.at(x[1], y[1]);
        if let Some(cell) = self.clipped([left, right], [bottom, top]) {
            hatch(canvas, cell);
        }
    }

    fn clipped(&self, x: [f64; 2], y: [f64; 2]) -> Option<Frame> {
        let left = x[0].min(x[1]).max(self.frame.x);
        let right = x[0].max(x[1]).min(self.frame.right());
        let top = y[0].min(y[1]).max(self.frame.y);
        let bottom = y[0].max(y[1]).min(self.frame.bottom());
        (left < right && top < bottom).then(|| Frame::new(left, top, right - left, bottom - top))
    }
}

fn no_data(canvas: &mut Canvas, cell: Frame) {
    canvas.rectangle(cell, NO_DATA);
    hatch(canvas, cell);
}

/// Diagonals that run on from cell to cell.
fn hatch(canvas: &mut Canvas, cell: Frame) {
    const SPACING: f64 = 3.0;
    let (low, high) = (cell.x + cell.y, cell.right() + cell.bottom());
    let mut sum = (low / SPACING).ceil() * SPACING;
    while sum < high {
        let left = cell.x.max(sum - cell.bottom());
        let right = cell.right().min(sum - cell.y);
        canvas.line(vec![[left, sum - left], [right, sum - right]], Stroke::new(HATCH, 0.35));
        sum += SPACING;
    }
}

/// Values mapped to a colour table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    pub(crate) table: ColourTable,
    pub(crate) range: (f64, f64),
}

impl Scale {
    pub(crate) fn colour(self, value: f64) -> crate::colour::Rgb {
        self.table.at((value - self.range.0) / (self.range.1 - self.range.0))
    }

    /// A colour bar that rises along a frame, with its label at the right.
    pub(crate) fn bar(self, canvas: &mut Canvas, frame: Frame, label: &str) {
        const STEPS: usize = 128;
        let axes = Axes { frame, x: [0.0, 1.0], y: [self.range.0, self.range.1] };
        for step in 0..STEPS {
            let height = frame.height / STEPS as f64;
            let y = frame.bottom() - (step + 1) as f64 * height;
            let colour = self.table.at((step as f64 + 0.5) / STEPS as f64);
            canvas.rectangle(Frame::new(frame.x, y, frame.width, height + 0.05), colour);
        }
        canvas.outline(frame, FRAME_STROKE);
        let count = ((frame.height / 18.0) as usize).clamp(2, 6);
        let positions = ticks::ticks(self.range.0, self.range.1, count);
        let mut widest = 0.0_f64;
        for (&value, text) in positions.iter().zip(ticks::labels(&positions)) {
            let [_, y] = axes.at(0.0, value);
            let right = frame.right();
            canvas.line(vec![[right, y], [right + 2.0, y]], FRAME_STROKE);
            canvas.text([right + 4.0, y + 2.4], &text, Align::Start, TICK);
            widest = widest.max(text_width(&text, TICK));
        }
        let at = [frame.right() + 4.0 + widest + 9.0, frame.y + frame.height / 2.0];
        canvas.upright_text(at, label, Align::Middle, LABEL);
    }
}

/// Edges of cells around points: half-way between neighbours.
pub(crate) fn edges(points: &[f64]) -> Vec<f64> {
    match points {
        [] => Vec::new(),
        [only] => vec![only - 0.5, only + 0.5],
        [first, second, ..] => {
            let (last, before) = (points[points.len() - 1], points[points.len() - 2]);
            let mut edges = vec![first - (second - first) / 2.0];
            edges.extend(points.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])));
            edges.push(last + (last - before) / 2.0);
            edges
        }
    }
}
