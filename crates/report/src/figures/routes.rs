//! Layouts and paths over the current (Fig. 10 of the paper).

use super::map::{EAST, M_PER_KM, Map, NORTH, diamond};
use super::{WIDTH, epoch_title, footer, letter};
use crate::canvas::{Align, Canvas, Frame, Point, Stroke, text_width};
use crate::colour::{CURRENT, FAILURE, FAINT, INK, MUTED, PLANNED, POST, TRACK, WHITE};
use crate::plot::{LABEL, REMARK};
use crate::ticks::{self, number};
use sonarfleet::record::{EpochRecord, RouteRecord, RunRecord, TrackPoint};

const LEFT: f64 = 36.0;
const GAP: f64 = 12.0;
/// Above a panel: its title and its numbers.
const TOP: f64 = 25.0;
/// Below a panel: ticks and label.
const BELOW: f64 = 27.0;
const LEGEND: f64 = 40.0;
const DASH: [f64; 2] = [2.6, 1.8];
/// Least distance between arrows, points.
const ARROW_SPACING: f64 = 15.0;
/// Arrows nearer to the frame than this are left out, points.
const EDGE: f64 = 4.0;

pub(super) fn draw(record: &RunRecord, epochs: &[EpochRecord]) -> Canvas {
    let columns = epochs.len().clamp(1, 2);
    let rows = epochs.len().div_ceil(columns);
    let width = (WIDTH - LEFT - 10.0 - GAP) / 2.0;
    let width = if columns == 1 { 1.5 * width } else { width };
    let margin = record.transit_margin_m.clamp(0.0, f64::MAX);
    let height = Map::height(record, margin, width, 400.0);
    let row_height = TOP + height + BELOW;
    let mut canvas = Canvas::new(WIDTH, rows as f64 * row_height + LEGEND + 14.0);
    let fastest = fastest_m_s(epochs);

    for (index, epoch) in epochs.iter().enumerate() {
        let (column, row) = (index % columns, index / columns);
        let x = LEFT + column as f64 * (width + GAP);
        let room = Frame::new(x, row as f64 * row_height + TOP, width, height);
        let map = Map::new(record, margin, room);
        draw_epoch(&mut canvas, &map, record, epoch, fastest);
        map.axes.draw(&mut canvas, Some(EAST), (column == 0).then_some(NORTH));

        let title = format!("{} {}", letter(index), epoch_title(epoch));
        map.axes.titles(&mut canvas, &title, &summary(epoch));
    }
    let top = rows as f64 * row_height + 6.0;
    legend(&mut canvas, record, top, fastest);
    footer(&mut canvas, record, top + LEGEND + 4.0);
    canvas
}

fn summary(epoch: &EpochRecord) -> String {
    let metrics = &epoch.metrics;
    let unreachable = match metrics.unreachable {
        0 => String::new(),
        count => format!(", {count} unreachable"),
    };
    format!(
        "J_{{d}} = {}, λ₂ = {} · {} of {} on post after {} h{unreachable}",
        number(metrics.detection_utility, 2),
        number(metrics.algebraic_connectivity, 3),
        metrics.arrived,
        epoch.routes.len(),
        number(epoch.duration_h, 0),
    )
}

fn draw_epoch(
    canvas: &mut Canvas,
    map: &Map,
    record: &RunRecord,
    epoch: &EpochRecord,
    fastest: f64,
) {
    map.bathymetry(canvas, Stroke::new(FAINT, 0.4));
    map.blocked(canvas);
    currents(canvas, map, epoch, fastest);
    edges(canvas, map, record);

    let line = |track: &[TrackPoint]| -> Vec<Point> {
        track.iter().map(|point| map.at(point.position)).collect()
    };
    let frame = map.axes.frame;
    for route in &epoch.routes {
        let points = line(&route.planned);
        canvas.dashed_line(&points, frame, Stroke::new(PLANNED, 0.8), DASH);
    }
    for route in &epoch.routes {
        canvas.clipped_line(&line(&route.track), frame, Stroke::new(TRACK, 1.1));
    }
    for &cell in &record.fixed_sensors {
        diamond(canvas, map.at(record.grid.centre(cell)), 3.4, WHITE);
    }
    for route in &epoch.routes {
        let post = map.at(record.grid.centre(route.post));
        if route.failure.is_some() {
            cross(canvas, post);
        } else {
            square(canvas, post, route.arrived);
        }
    }
    for route in &epoch.routes {
        if let Some(start) = route.track.first() {
            start_mark(canvas, map.at(start.position), frame);
        }
        if let Some(end) = whereabouts(route) {
            end_mark(canvas, map.at(end.position), frame);
        }
    }
}

/// Where a vehicle under way is when the epoch ends.
fn whereabouts(route: &RouteRecord) -> Option<&TrackPoint> {
    route.track.last().filter(|_| !route.arrived && route.failure.is_none())
}

fn edges(canvas: &mut Canvas, map: &Map, record: &RunRecord) {
    let grid = record.grid;
    let [width, height] = [grid.width_m(), grid.height_m()].map(|metres| metres / M_PER_KM);
    let [x, y] = map.axes.at(0.0, height);
    let scale = map.axes.scale();
    canvas.outline(Frame::new(x, y, width * scale, height * scale), Stroke::new(INK, 0.9));
}

fn currents(canvas: &mut Canvas, map: &Map, epoch: &EpochRecord, fastest: f64) {
    let current = &epoch.current;
    let stride = |points: &[f64]| {
        let step = points.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
        let step = step / M_PER_KM * map.axes.scale();
        if step.is_finite() && step > 0.0 { (ARROW_SPACING / step).ceil() as usize } else { 1 }
    };
    let (skip_east, skip_north) = (stride(&current.east_m), stride(&current.north_m));
    // Centred, so that the outermost arrows keep the same distance from both edges.
    let first = |count: usize, skip: usize| count.saturating_sub(1) % skip / 2;
    let columns = current.east_m.len();
    let frame = map.axes.frame;
    for row in (first(current.north_m.len(), skip_north)..current.north_m.len()).step_by(skip_north)
    {
        for column in (first(columns, skip_east)..columns).step_by(skip_east) {
            let at =
                map.axes.at(current.east_m[column] / M_PER_KM, current.north_m[row] / M_PER_KM);
            let inside = within(at, frame.shrunk(EDGE));
            let index = row * columns + column;
            let velocity = [current.u_m_s[index], current.v_m_s[index]].map(f64::from);
            if inside && velocity.iter().all(|v| v.is_finite()) {
                arrow(canvas, at, velocity, fastest, frame);
            }
        }
    }
}

/// An arrow of current that starts half its length before a point.
fn arrow(canvas: &mut Canvas, at: Point, [u, v]: [f64; 2], fastest: f64, frame: Frame) {
    const HEAD: f64 = 3.2;
    let length = arrow_length(u.hypot(v), fastest);
    if length < 0.4 {
        return;
    }
    let direction = [u / u.hypot(v), -v / u.hypot(v)];
    let along = |distance: f64, aside: f64| {
        [
            at[0] + direction[0] * distance - direction[1] * aside,
            at[1] + direction[1] * distance + direction[0] * aside,
        ]
    };
    let head = HEAD.min(length * 0.6);
    let neck = along(length / 2.0 - head, 0.0);
    canvas.clipped_line(&[along(-length / 2.0, 0.0), neck], frame, Stroke::new(CURRENT, 0.7));
    let tip = along(length / 2.0, 0.0);
    if within(tip, frame) {
        let side = head * 0.36;
        let neck = length / 2.0 - head;
        canvas.polygon(vec![tip, along(neck, side), along(neck, -side)], CURRENT);
    }
}

fn arrow_length(speed_m_s: f64, fastest_m_s: f64) -> f64 {
    speed_m_s / fastest_m_s * ARROW_SPACING * 1.15
}

/// Fastest current of the epochs, m/s; 1 where there is none.
fn fastest_m_s(epochs: &[EpochRecord]) -> f64 {
    let speeds = epochs.iter().flat_map(|epoch| {
        let current = &epoch.current;
        current.u_m_s.iter().zip(&current.v_m_s).map(|(&u, &v)| f64::from(u.hypot(v)))
    });
    ticks::range(speeds).map(|(_, high)| high).filter(|&high| high > 0.0).unwrap_or(1.0)
}

fn square(canvas: &mut Canvas, [x, y]: Point, filled: bool) {
    let frame = |half: f64| Frame::new(x - half, y - half, 2.0 * half, 2.0 * half);
    canvas.rectangle(frame(2.6), POST);
    if !filled {
        canvas.rectangle(frame(1.6), WHITE);
    }
}

fn cross(canvas: &mut Canvas, [x, y]: Point) {
    for side in [-1.0, 1.0] {
        let points = vec![[x - 2.8, y - side * 2.8], [x + 2.8, y + side * 2.8]];
        canvas.line(points, Stroke::new(FAILURE, 1.4));
    }
}

fn start_mark(canvas: &mut Canvas, at: Point, frame: Frame) {
    if within(at, frame) {
        canvas.disc(at, 1.9, WHITE);
        canvas.circle(at, 1.6, Stroke::new(TRACK, 0.8));
    }
}

fn end_mark(canvas: &mut Canvas, at: Point, frame: Frame) {
    if within(at, frame) {
        canvas.disc(at, 1.9, TRACK);
    }
}

fn within([x, y]: Point, frame: Frame) -> bool {
    (frame.x..=frame.right()).contains(&x) && (frame.y..=frame.bottom()).contains(&y)
}

fn legend(canvas: &mut Canvas, record: &RunRecord, top: f64, fastest: f64) {
    let whole = Frame::new(0.0, 0.0, WIDTH, f64::MAX);
    let reference = reference_speed(fastest);
    let arrow_label = format!("Current at {} m: {reference} m/s", number(record.fleet_depth_m, 0));
    type Sample = Box<dyn Fn(&mut Canvas, Point)>;
    let stroke_sample = |stroke: Stroke, dashed: bool| -> Sample {
        Box::new(move |canvas, [x, y]| {
            let points = [[x - 8.0, y], [x + 8.0, y]];
            if dashed {
                canvas.dashed_line(&points, whole, stroke, DASH);
            } else {
                canvas.line(points.to_vec(), stroke);
            }
        })
    };
    let mut entries: Vec<(Sample, String)> = vec![
        (Box::new(move |canvas, at| start_mark(canvas, at, whole)), "Start".into()),
        (stroke_sample(Stroke::new(TRACK, 1.1), false), "Travelled".into()),
        (Box::new(move |canvas, at| end_mark(canvas, at, whole)), "Under way".into()),
        (stroke_sample(Stroke::new(PLANNED, 0.8), true), "Planned".into()),
        (Box::new(|canvas, at| square(canvas, at, true)), "Post reached".into()),
        (Box::new(|canvas, at| square(canvas, at, false)), "Post ahead".into()),
        (Box::new(cross), "Post unreachable".into()),
    ];
    if !record.fixed_sensors.is_empty() {
        entries.push((Box::new(|canvas, at| diamond(canvas, at, 3.4, WHITE)), "Fixed".into()));
    }
    let arrow_sample: Sample =
        Box::new(move |canvas, at| arrow(canvas, at, [reference, 0.0], fastest, whole));
    entries.push((arrow_sample, arrow_label));
    entries.push((stroke_sample(Stroke::new(INK, 0.9), false), "Region".into()));
    let depths = Map::new(record, 0.0, Frame::new(0.0, 0.0, 1.0, 1.0)).depth_levels();
    if let [first, .., last] = depths[..] {
        let step = (last - first) / (depths.len() - 1) as f64;
        let label = format!("Water depth, every {} m", number(step, 0));
        entries.push((stroke_sample(Stroke::new(FAINT, 0.6), false), label));
    }

    let (mut x, mut y) = (LEFT, top + 8.0);
    for (sample, label) in entries {
        let width = 20.0 + text_width(&label, LABEL);
        if x + width > WIDTH - 6.0 {
            (x, y) = (LEFT, y + 13.0);
        }
        sample(canvas, [x + 8.0, y - 2.4]);
        canvas.text([x + 20.0, y], &label, Align::Start, LABEL);
        x += width + 13.0;
    }
    if record.transit_margin_m > 0.0 {
        let margin = number(record.transit_margin_m / M_PER_KM, 1);
        let text = format!("The frame is the limit of transit, {margin} km beyond the region");
        let style = crate::canvas::Style { colour: MUTED, ..REMARK };
        canvas.text([LEFT, y + 13.0], &text, Align::Start, style);
    }
}

/// The largest of 1, 2, 5 times a power of ten that is not above a speed.
fn reference_speed(fastest: f64) -> f64 {
    let power = 10_f64.powf(fastest.log10().floor());
    let mantissa = [5.0, 2.0].into_iter().find(|m| m * power <= fastest).unwrap_or(1.0);
    // Through text, so that 0.1 stays 0.1.
    format!("{:.6}", mantissa * power).parse().unwrap_or(mantissa * power)
}
