//! The curve of a training: what it earned, how connected its layouts became, and
//! how its policy bottom.

use super::{WIDTH, shortened};
use crate::canvas::{Align, Canvas, Frame, Point, Stroke, text_width};
use crate::colour::{INK, PLANNED, POST, POST_TINT, Rgb, TRACK};
use crate::plot::{Axes, LABEL, REMARK, TITLE};
use crate::ticks;
use sonarfleet::record::{TrainingPoint, TrainingRecord};

const LEFT: f64 = 46.0;
/// Right of the panels: numbers and a label.
const RIGHT: f64 = 50.0;
const TOP: f64 = 34.0;
const HEIGHT: f64 = 92.0;
const GAP: f64 = 22.0;
/// Below the last panel: ticks, label and the foot.
const BELOW: f64 = 42.0;
const MEDIAN_WIDTH: f64 = 1.2;
/// A required level.
const LEVEL: Stroke = Stroke::new(INK, 0.8);
const DASH: [f64; 2] = [3.0, 2.0];
/// From so many episodes on they are counted in thousands.
const MANY_EPISODES: f64 = 20_000.0;

/// One number of a training as lines over its episodes.
struct Curve {
    /// In the legend.
    name: &'static str,
    number: fn(&TrainingPoint) -> f64,
    /// Of the median, and of a single seed.
    colours: [Rgb; 2],
}

const fn first(name: &'static str, number: fn(&TrainingPoint) -> f64) -> Curve {
    Curve { name, number, colours: [TRACK, PLANNED] }
}

const fn second(name: &'static str, number: fn(&TrainingPoint) -> f64) -> Curve {
    Curve { name, number, colours: [POST, POST_TINT] }
}

pub(super) fn draw(record: &TrainingRecord) -> Canvas {
    let height = TOP + 3.0 * HEIGHT + 2.0 * GAP + BELOW;
    let mut canvas = Canvas::new(WIDTH, height);
    canvas.text([LEFT, 12.0], &shortened(&record.name, 100), Align::Start, TITLE.bold());
    let median = record.median();
    let episodes = Episodes::of(record);
    let panel = |index: usize| Panel {
        record,
        median: &median,
        episodes,
        frame: Frame::new(LEFT, TOP + index as f64 * (HEIGHT + GAP), WIDTH - LEFT - RIGHT, HEIGHT),
    };

    let utility = first("Detection utility J_{d}", |point| point.detection_utility);
    let reward = second("Reward R", |point| point.reward);
    let top = panel(0);
    let axes = top.axes(&[&utility, &reward], &[]);
    top.lines(&mut canvas, axes, &[&reward, &utility]);
    axes.draw(&mut canvas, None, Some("Per episode"));
    axes.title(&mut canvas, "(a) Reward");
    top.legend(&mut canvas, &[&utility, &reward], None);

    let connectivity = first("Connectivity λ₂", |point| point.algebraic_connectivity);
    let multiplier = second("Multiplier λ_{k}", |point| point.multiplier);
    let threshold = record.connectivity_threshold;
    let middle = panel(1);
    let axes = middle.axes(&[&connectivity], &[0.0, threshold]);
    let right = middle.axes(&[&multiplier], &[0.0]);
    middle.lines(&mut canvas, right, &[&multiplier]);
    middle.lines(&mut canvas, axes, &[&connectivity]);
    let level = [axes.at(axes.x[0], threshold), axes.at(axes.x[1], threshold)];
    canvas.dashed_line(&level, axes.frame, LEVEL, DASH);
    axes.draw(&mut canvas, None, Some("λ₂"));
    axes.title(&mut canvas, "(b) Connectivity");
    right.draw_right(&mut canvas, "λ_{k}");
    let required = format!("Required τ = {threshold}");
    middle.legend(&mut canvas, &[&connectivity, &multiplier], Some(&required));

    let entropy = first("Entropy", |point| point.entropy);
    let divergence = second("Divergence of an update (approx_kl)", |point| point.approx_kl);
    let bottom = panel(2);
    let axes = bottom.axes(&[&entropy], &[0.0]);
    let right = bottom.axes(&[&divergence], &[0.0]);
    bottom.lines(&mut canvas, right, &[&divergence]);
    bottom.lines(&mut canvas, axes, &[&entropy]);
    axes.draw(&mut canvas, Some(episodes.label()), Some("Entropy (nats)"));
    axes.title(&mut canvas, "(c) Policy");
    right.draw_right(&mut canvas, "Divergence (nats)");
    bottom.legend(&mut canvas, &[&entropy, &divergence], None);

    canvas.text([WIDTH - 6.0, height - 6.0], &foot(record), Align::End, REMARK);
    canvas
}

/// The unit of the abscissa, and where it ends.
#[derive(Clone, Copy)]
struct Episodes {
    unit: f64,
    range: (f64, f64),
}

impl Episodes {
    fn of(record: &TrainingRecord) -> Self {
        let all = record.runs.iter().flat_map(|run| &run.points).map(|point| point.episodes);
        let (low, high) = ticks::range(all).unwrap_or((0.0, 1.0));
        let unit = if high >= MANY_EPISODES { 1000.0 } else { 1.0 };
        let low = if low < high { 0.0_f64.min(low) } else { high - 1.0 };
        Self { unit, range: (low / unit, high / unit) }
    }

    const fn label(self) -> &'static str {
        if self.unit > 1.0 { "Episodes (thousands)" } else { "Episodes" }
    }
}

struct Panel<'a> {
    record: &'a TrainingRecord,
    median: &'a [TrainingPoint],
    episodes: Episodes,
    frame: Frame,
}

impl Panel<'_> {
    /// Axes that hold curves and further values.
    fn axes(&self, curves: &[&Curve], values: &[f64]) -> Axes {
        let points = self.record.runs.iter().flat_map(|run| &run.points);
        let mut all: Vec<f64> = points
            .flat_map(|point| curves.iter().map(|curve| (curve.number)(point)))
            .filter(|value| value.is_finite())
            .collect();
        all.sort_by(f64::total_cmp);
        // Few points far out would flatten all others; their lines leave the frame.
        let outer = all.len() / 200;
        let inner = all[outer..all.len() - outer].iter().chain(values).copied();
        let (low, high) = ticks::round_range(ticks::range(inner), 8, (0.0, 1.0));
        let Episodes { range: (left, right), .. } = self.episodes;
        Axes { frame: self.frame, x: [left, right], y: [low, high] }
    }

    /// Every seed thin, and above them the medians bold; a single run is its own median.
    fn lines(&self, canvas: &mut Canvas, axes: Axes, curves: &[&Curve]) {
        let line = |points: &[TrainingPoint], curve: &Curve| -> Vec<Point> {
            let at = |point: &TrainingPoint| {
                axes.at(point.episodes / self.episodes.unit, (curve.number)(point))
            };
            points.iter().map(at).collect()
        };
        if self.record.runs.len() > 1 {
            for curve in curves {
                for run in &self.record.runs {
                    let stroke = Stroke::new(curve.colours[1], 0.5);
                    canvas.clipped_line(&line(&run.points, curve), axes.frame, stroke);
                }
            }
        }
        for curve in curves {
            let stroke = Stroke::new(curve.colours[0], MEDIAN_WIDTH);
            canvas.clipped_line(&line(self.median, curve), axes.frame, stroke);
        }
    }

    /// Right-aligned above the frame.
    fn legend(&self, canvas: &mut Canvas, curves: &[&Curve], level: Option<&str>) {
        const SAMPLE: f64 = 14.0;
        let whole = Frame::new(0.0, 0.0, WIDTH, f64::MAX);
        let mut entries: Vec<(&str, Option<Rgb>)> =
            curves.iter().map(|curve| (curve.name, Some(curve.colours[0]))).collect();
        entries.extend(level.map(|name| (name, None)));
        let width = |name: &str| SAMPLE + 4.0 + text_width(name, LABEL) + 12.0;
        let total: f64 = entries.iter().map(|(name, _)| width(name)).sum();
        let mut x = self.frame.right() + 12.0 - total;
        let y = self.frame.y - 4.5;
        for (name, colour) in entries {
            let sample = [[x, y - 2.4], [x + SAMPLE, y - 2.4]];
            if let Some(colour) = colour {
                canvas.line(sample.to_vec(), Stroke::new(colour, MEDIAN_WIDTH));
            } else {
                canvas.dashed_line(&sample, whole, LEVEL, DASH);
            }
            canvas.text([x + SAMPLE + 4.0, y], name, Align::Start, LABEL);
            x += width(name);
        }
    }
}

fn foot(record: &TrainingRecord) -> String {
    let seeds = match &record.runs[..] {
        [] => "no runs".to_owned(),
        [run] => format!("seed {}", run.seed),
        runs => {
            let seeds: Vec<String> = runs.iter().map(|run| run.seed.to_string()).collect();
            format!("thin: seeds {}; bold: their median", seeds.join(", "))
        }
    };
    let longest = record.runs.iter().filter_map(|run| run.points.last());
    let seconds = ticks::range(longest.map(|point| point.seconds))
        .map_or(String::new(), |(_, high)| format!(" · up to {} s each", ticks::number(high, 0)));
    shortened(&format!("{seeds}{seconds} · sonarfleet {}", record.version), 165)
}
