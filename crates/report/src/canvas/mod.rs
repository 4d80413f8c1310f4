//! A figure as a list of shapes, in points (1/72 inch) from its top left corner;
//! `render` turns it into SVG and PNG.

mod clip;
mod render;
mod text;

pub(crate) use render::{to_png, to_svg};

use crate::colour::Rgb;
use text::Run;

/// A place on the figure: points to the right and down.
pub(crate) type Point = [f64; 2];

/// A rectangle of the figure, in points.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Frame {
    pub(crate) const fn new(x: f64, y: f64, width: f64, height: f64) -> Self {
        Self { x, y, width, height }
    }

    pub(crate) fn right(self) -> f64 {
        self.x + self.width
    }

    /// The frame without a rim of this width.
    pub(crate) fn shrunk(self, rim: f64) -> Self {
        let (width, height) = (self.width - 2.0 * rim, self.height - 2.0 * rim);
        Self::new(self.x + rim, self.y + rim, width, height)
    }

    pub(crate) fn bottom(self) -> f64 {
        self.y + self.height
    }
}

/// How a line looks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stroke {
    pub(crate) colour: Rgb,
    pub(crate) width: f64,
}

impl Stroke {
    pub(crate) const fn new(colour: Rgb, width: f64) -> Self {
        Self { colour, width }
    }
}

/// Which point of a text its position is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Align {
    Start,
    Middle,
    End,
}

/// How a text looks: size of the em in points, weight, colour.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Style {
    pub(crate) size: f64,
    pub(crate) bold: bool,
    pub(crate) colour: Rgb,
}

impl Style {
    pub(crate) const fn new(size: f64, colour: Rgb) -> Self {
        Self { size, bold: false, colour }
    }

    pub(crate) const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }
}

enum Shape {
    Rectangle { frame: Frame, fill: Rgb },
    Polygon { points: Vec<Point>, fill: Rgb },
    Line { points: Vec<Point>, stroke: Stroke },
    Disc { centre: Point, radius: f64, fill: Rgb },
    Text { at: Point, run: Run, align: Align, upright: bool },
}

/// A figure being drawn.
pub(crate) struct Canvas {
    width: f64,
    height: f64,
    shapes: Vec<Shape>,
}

impl Canvas {
    /// An empty figure of this size, in points.
    pub(crate) const fn new(width: f64, height: f64) -> Self {
        Self { width, height, shapes: Vec::new() }
    }

    pub(crate) fn rectangle(&mut self, frame: Frame, fill: Rgb) {
        self.shapes.push(Shape::Rectangle { frame, fill });
    }

    pub(crate) fn polygon(&mut self, points: Vec<Point>, fill: Rgb) {
        self.shapes.push(Shape::Polygon { points, fill });
    }

    pub(crate) fn outline(&mut self, frame: Frame, stroke: Stroke) {
        let Frame { x, y, .. } = frame;
        let (right, bottom) = (frame.right(), frame.bottom());
        self.line(vec![[x, y], [right, y], [right, bottom], [x, bottom], [x, y]], stroke);
    }

    pub(crate) fn line(&mut self, points: Vec<Point>, stroke: Stroke) {
        if points.len() > 1 {
            self.shapes.push(Shape::Line { points, stroke });
        }
    }

    /// The part of a line that lies inside a frame.
    pub(crate) fn clipped_line(&mut self, points: &[Point], frame: Frame, stroke: Stroke) {
        for piece in clip::polyline(points, frame) {
            self.line(piece, stroke);
        }
    }

    /// A dashed line: `dash` points drawn, `gap` points left out.
    pub(crate) fn dashed_line(
        &mut self,
        points: &[Point],
        frame: Frame,
        stroke: Stroke,
        [dash, gap]: [f64; 2],
    ) {
        for piece in clip::polyline(points, frame) {
            for dash in clip::dashes(&piece, dash, gap) {
                self.line(dash, stroke);
            }
        }
    }

    pub(crate) fn disc(&mut self, centre: Point, radius: f64, fill: Rgb) {
        self.shapes.push(Shape::Disc { centre, radius, fill });
    }

    /// A circle that leaves what is under it visible.
    pub(crate) fn circle(&mut self, centre: Point, radius: f64, stroke: Stroke) {
        const CORNERS: usize = 36;
        let corner = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / CORNERS as f64;
            [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]
        };
        self.line((0..=CORNERS).map(corner).collect(), stroke);
    }

    /// Text whose baseline starts, is centred or ends at a point. `_{…}` sets a
    /// subscript.
    pub(crate) fn text(&mut self, at: Point, text: &str, align: Align, style: Style) {
        self.set_text(at, text, align, style, false);
    }

    /// Text that reads upwards.
    pub(crate) fn upright_text(&mut self, at: Point, text: &str, align: Align, style: Style) {
        self.set_text(at, text, align, style, true);
    }

    fn set_text(&mut self, at: Point, text: &str, align: Align, style: Style, upright: bool) {
        let runs = text::runs(text, style);
        if let [_] = runs[..] {
            self.shapes.extend(runs.into_iter().map(|run| Shape::Text { at, run, align, upright }));
            return;
        }
        let width: f64 = runs.iter().map(Run::width).sum();
        let mut offset = match align {
            Align::Start => 0.0,
            Align::Middle => -width / 2.0,
            Align::End => -width,
        };
        for run in runs {
            let (along, down) = (offset, run.drop);
            offset += run.width();
            let at =
                if upright { [at[0] + down, at[1] - along] } else { [at[0] + along, at[1] + down] };
            self.shapes.push(Shape::Text { at, run, align: Align::Start, upright });
        }
    }
}

/// Width of a text in points, subscripts included.
pub(crate) fn text_width(text: &str, style: Style) -> f64 {
    text::runs(text, style).iter().map(Run::width).sum()
}
