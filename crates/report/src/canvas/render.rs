//! Canvases drawn with plotters' SVG and bitmap backends.

use super::text::{FONT, Run};
use super::{Align, Canvas, Point, Shape, Stroke};
use crate::colour::Rgb;
use plotters::backend::{BitMapBackend, DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, FontTransform, RGBColor, TextStyle};

/// Units of an SVG file per point: plotters' coordinates are whole numbers.
const SVG_UNITS_PER_POINT: f64 = 20.0;
/// Pixels of a PNG per point: 288 dots per inch.
const PIXELS_PER_POINT: usize = 4;
/// Pictures are drawn this much larger and averaged, because plotters does not
/// smooth the edges of polygons.
const SUPERSAMPLING: usize = 2;

/// plotters divides its font sizes by this to get the em of an SVG text.
const SVG_SIZE_PER_EM: f64 = 1.24;
/// Where plotters puts the baseline of an SVG text anchored at its top, in ems.
const SVG_BASELINE_EM: f64 = 0.76;

/// Nothing, or what a backend said.
type Drawn = Result<(), String>;

fn said(error: impl std::fmt::Display) -> String {
    error.to_string()
}

/// The figure as an SVG document.
pub(crate) fn to_svg(canvas: &Canvas) -> Result<String, String> {
    let mut svg = String::new();
    {
        let size = size(canvas, SVG_UNITS_PER_POINT);
        let mut backend = SVGBackend::with_string(&mut svg, size);
        let mut pen = Pen { backend: &mut backend, scale: SVG_UNITS_PER_POINT, vector: true };
        pen.draw(canvas)?;
        pen.backend.present().map_err(said)?;
    }
    Ok(dress(&svg, canvas))
}

/// Gives the document its size in points, families to fall back to, round joins
/// and seamless cells, which plotters has no words for.
fn dress(svg: &str, canvas: &Canvas) -> String {
    let units = size(canvas, SVG_UNITS_PER_POINT);
    let plain = format!("<svg width=\"{}\" height=\"{}\"", units.0, units.1);
    let sized = format!("<svg width=\"{}pt\" height=\"{}pt\"", canvas.width, canvas.height);
    let svg = svg.replacen(&plain, &sized, 1);
    // Verdana has the metrics of DejaVu Sans.
    let svg = svg.replace(
        &format!("font-family=\"{FONT}\""),
        &format!("font-family=\"{FONT}, Verdana, sans-serif\""),
    );
    let style = "<style>rect{shape-rendering:crispEdges}\
                 polyline{stroke-linejoin:round;stroke-linecap:butt}</style>\n";
    match svg.find(">\n") {
        Some(end) => format!("{}{style}{}", &svg[..end + 2], &svg[end + 2..]),
        None => svg,
    }
}

/// The figure as a PNG file.
pub(crate) fn to_png(canvas: &Canvas) -> Result<Vec<u8>, String> {
    let scale = (PIXELS_PER_POINT * SUPERSAMPLING) as f64;
    let (width, height) = size(canvas, PIXELS_PER_POINT as f64);
    let large = (width * SUPERSAMPLING as u32, height * SUPERSAMPLING as u32);
    let mut pixels = vec![0xff; large.0 as usize * large.1 as usize * 3];
    {
        let mut backend = BitMapBackend::with_buffer(&mut pixels, large);
        let mut pen = Pen { backend: &mut backend, scale, vector: false };
        pen.draw(canvas)?;
        pen.backend.present().map_err(said)?;
    }
    let pixels = averaged(&pixels, width as usize, height as usize);
    encode(&pixels, width, height).map_err(said)
}

/// Means of squares of `SUPERSAMPLING` × `SUPERSAMPLING` pixels.
fn averaged(large: &[u8], width: usize, height: usize) -> Vec<u8> {
    let stride = width * SUPERSAMPLING * 3;
    let mut small = Vec::with_capacity(width * height * 3);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let mut sum = 0_u32;
                for dy in 0..SUPERSAMPLING {
                    let row = (y * SUPERSAMPLING + dy) * stride + x * SUPERSAMPLING * 3 + channel;
                    sum += (0..SUPERSAMPLING).map(|dx| u32::from(large[row + 3 * dx])).sum::<u32>();
                }
                small.push((sum / (SUPERSAMPLING * SUPERSAMPLING) as u32) as u8);
            }
        }
    }
    small
}

fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, png::EncodingError> {
    const METRES_PER_POINT: f64 = 0.0254 / 72.0;
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_adaptive_filter(png::AdaptiveFilterType::Adaptive);
    let density = (PIXELS_PER_POINT as f64 / METRES_PER_POINT).round() as u32;
    let unit = png::Unit::Meter;
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: density, yppu: density, unit }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(file)
}

fn size(canvas: &Canvas, scale: f64) -> (u32, u32) {
    ((canvas.width * scale).round() as u32, (canvas.height * scale).round() as u32)
}

struct Pen<'a, B: DrawingBackend> {
    backend: &'a mut B,
    scale: f64,
    /// Whether the backend strokes lines itself.
    vector: bool,
}

impl<B: DrawingBackend> Pen<'_, B> {
    fn draw(&mut self, canvas: &Canvas) -> Drawn {
        let whole = super::Frame::new(0.0, 0.0, canvas.width, canvas.height);
        let paper = Shape::Rectangle { frame: whole, fill: crate::colour::WHITE };
        for shape in std::iter::once(&paper).chain(&canvas.shapes) {
            self.shape(shape)?;
        }
        Ok(())
    }

    fn shape(&mut self, shape: &Shape) -> Drawn {
        match shape {
            Shape::Rectangle { frame, fill } => {
                let from = self.place([frame.x, frame.y]);
                let to = self.place([frame.right(), frame.bottom()]);
                self.backend.draw_rect(from, to, &paint(*fill).filled(), true).map_err(said)
            }
            Shape::Polygon { points, fill } => {
                let points: Vec<_> = points.iter().map(|&point| self.place(point)).collect();
                self.backend.fill_polygon(points, &paint(*fill).filled()).map_err(said)
            }
            Shape::Line { points, stroke } if self.vector => {
                let points: Vec<_> = points.iter().map(|&point| self.place(point)).collect();
                let width = (stroke.width * self.scale).round().max(1.0) as u32;
                self.backend
                    .draw_path(points, &paint(stroke.colour).stroke_width(width))
                    .map_err(said)
            }
            Shape::Line { points, stroke } => self.stroke(points, *stroke),
            Shape::Disc { centre, radius, fill } => {
                let radius = (radius * self.scale).round() as u32;
                let centre = self.place(*centre);
                self.backend.draw_circle(centre, radius, &paint(*fill).filled(), true).map_err(said)
            }
            Shape::Text { at, run, align, upright } if self.vector => {
                self.vector_text(*at, run, *align, *upright)
            }
            Shape::Text { at, run, align, upright } => self.raster_text(*at, run, *align, *upright),
        }
    }

    fn vector_text(&mut self, at: Point, run: &Run, align: Align, upright: bool) -> Drawn {
        let em = run.style.size * self.scale;
        let weight = if run.style.bold { FontStyle::Bold } else { FontStyle::Normal };
        let mut font = FontDesc::new(FontFamily::Name(FONT), em * SVG_SIZE_PER_EM, weight);
        let mut top = [at[0] * self.scale, at[1] * self.scale];
        if upright {
            font = font.transform(FontTransform::Rotate270);
            top[0] -= em * SVG_BASELINE_EM;
        } else {
            top[1] -= em * SVG_BASELINE_EM;
        }
        let anchor = match align {
            Align::Start => HPos::Left,
            Align::Middle => HPos::Center,
            Align::End => HPos::Right,
        };
        let colour = paint(run.style.colour);
        let style = TextStyle::from(font).color(&colour).pos(Pos::new(anchor, VPos::Top));
        let top = (top[0].round() as i32, top[1].round() as i32);
        self.backend.draw_text(&run.text, &style, top).map_err(said)
    }

    fn raster_text(&mut self, at: Point, run: &Run, align: Align, upright: bool) -> Drawn {
        let before = match align {
            Align::Start => 0.0,
            Align::Middle => run.width() / 2.0,
            Align::End => run.width(),
        };
        let start = if upright { [at[0], at[1] + before] } else { [at[0] - before, at[1]] };
        let (x, y) = self.place(start);
        let colour = paint(run.style.colour);
        run.cover(self.scale, |right, down, coverage| {
            let pixel = if upright { (x + down, y - right) } else { (x + right, y + down) };
            let paint = colour.mix(coverage).to_backend_color();
            self.backend.draw_pixel(pixel, paint).map_err(said)
        })
    }

    /// A line as one quadrilateral per segment, with discs where segments meet:
    /// the bitmap backend's own thick lines fray at sharp turns.
    fn stroke(&mut self, points: &[Point], stroke: Stroke) -> Drawn {
        let half = (stroke.width * self.scale / 2.0).max(0.5);
        let fill = paint(stroke.colour).filled();
        for (index, pair) in points.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]].map(|p| [p[0] * self.scale, p[1] * self.scale]);
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            if length < 0.5 {
                continue;
            }
            let across = [(from[1] - to[1]) / length * half, (to[0] - from[0]) / length * half];
            let corner = |end: Point, side: f64| {
                let x = end[0] + side * across[0];
                let y = end[1] + side * across[1];
                (x.round() as i32, y.round() as i32)
            };
            let corners =
                [corner(from, 1.0), corner(to, 1.0), corner(to, -1.0), corner(from, -1.0)];
            self.backend.fill_polygon(corners, &fill).map_err(said)?;
            if index > 0 && half > 1.0 {
                let joint = (from[0].round() as i32, from[1].round() as i32);
                self.backend.draw_circle(joint, half.round() as u32, &fill, true).map_err(said)?;
            }
        }
        Ok(())
    }

    fn place(&self, point: Point) -> (i32, i32) {
        ((point[0] * self.scale).round() as i32, (point[1] * self.scale).round() as i32)
    }
}

fn paint(colour: Rgb) -> RGBColor {
    RGBColor(colour.0, colour.1, colour.2)
}
