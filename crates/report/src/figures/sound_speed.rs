//! The fields of sound speed (Fig. 2 of the paper): for each epoch a slice at
//! the fleet's depth, a section along the region's middle, and the mean profile.

use super::map::{EAST, M_PER_KM, Map, NORTH};
use super::{WIDTH, footer, letter, readable_time};
use crate::canvas::{Align, Canvas, Frame, Stroke};
use crate::colour::{INK, MUTED, Rgb, SEABED, THERMAL, WHITE};
use crate::plot::{Axes, REMARK, Scale, edges};
use crate::ticks;
use sonarfleet::record::{EpochRecord, RunRecord, SoundSpeedRecord};

const LEFT: f64 = 38.0;
const TOP: f64 = 26.0;
const GAP: f64 = 9.0;
/// Room for colour bars, their numbers and labels.
const BAR_ROOM: f64 = 52.0;
const SECTION_HEIGHT: f64 = 92.0;
/// Between a panel and the next below it: axis labels and a remark.
const ROW_GAP: f64 = 40.0;

const ENVELOPE: Rgb = Rgb(0xcf, 0xd9, 0xe4);
const FLEET_DASH: [f64; 2] = [4.0, 2.5];

pub(super) fn draw(record: &RunRecord, epochs: &[EpochRecord]) -> Canvas {
    let count = epochs.len().max(2) as f64;
    let width = (WIDTH - LEFT - BAR_ROOM - (count - 1.0) * GAP) / count;
    let map_height = Map::height(record, 0.0, width, 240.0);
    let section_top = TOP + map_height + ROW_GAP;
    let profile_top = section_top + SECTION_HEIGHT + ROW_GAP;
    let mut canvas = Canvas::new(WIDTH, profile_top + SECTION_HEIGHT + 40.0);

    let all = || epochs.iter().map(|epoch| &epoch.sound_speed);
    let fallback = (1480.0, 1540.0);
    let slice_range = ticks::range(all().flat_map(|sound| slice(sound, record.fleet_depth_m)));
    let slices = Scale { table: THERMAL, range: ticks::round_range(slice_range, 5, fallback) };
    let whole = ticks::range(all().flat_map(|s| s.speed_m_s.iter().map(|&c| f64::from(c))));
    let sections = Scale { table: THERMAL, range: ticks::round_range(whole, 5, fallback) };
    // Room at both ends keeps the numbers of neighbouring panels apart.
    let (low, high) = whole.unwrap_or(fallback);
    let room = (0.08 * (high - low)).max(1.0);
    let speeds = (low - room, high + room);
    let depth = all().map(deepest_m).fold(0.0, f64::max);
    let depth = if depth > 0.0 { depth } else { 1.0 };

    let mut right = LEFT + width;
    for (index, epoch) in epochs.iter().enumerate() {
        let sound = &epoch.sound_speed;
        let x = LEFT + index as f64 * (width + GAP);
        let first = index == 0;

        let map = Map::new(record, 0.0, Frame::new(x, TOP, width, map_height));
        draw_slice(&mut canvas, &map, sound, record.fleet_depth_m, slices);
        map.axes.draw(&mut canvas, Some(EAST), first.then_some(NORTH));
        let title = format!("{} Epoch {}", letter(index), epoch.epoch);
        map.axes.titles(&mut canvas, &title, &readable_time(&epoch.time));
        right = map.axes.frame.right();

        let section = Axes {
            frame: Frame { y: section_top, height: SECTION_HEIGHT, ..map.axes.frame },
            x: map.axes.x,
            y: [depth, 0.0],
        };
        draw_section(&mut canvas, section, record, sound, sections);
        section.draw(&mut canvas, Some(EAST), first.then_some("Depth (m)"));

        let profile = Axes {
            frame: Frame { y: profile_top, ..section.frame },
            x: [speeds.0, speeds.1],
            y: section.y,
        };
        draw_profile(&mut canvas, profile, sound, record.fleet_depth_m);
        profile.draw(&mut canvas, Some("Sound speed (m/s)"), first.then_some("Depth (m)"));
    }
    row_remarks(&mut canvas, record, epochs, [section_top, profile_top]);
    let bar = |top, height| Frame::new(right + 7.0, top, 7.0, height);
    slices.bar(&mut canvas, bar(TOP, map_height), "Sound speed (m/s)");
    sections.bar(&mut canvas, bar(section_top, SECTION_HEIGHT), "Sound speed (m/s)");
    let bottom = profile_top + SECTION_HEIGHT + 34.0;
    footer(&mut canvas, record, bottom);
    canvas
}

fn row_remarks(
    canvas: &mut Canvas,
    record: &RunRecord,
    epochs: &[EpochRecord],
    [section_top, profile_top]: [f64; 2],
) {
    let Some(sound) = epochs.first().map(|epoch| &epoch.sound_speed) else { return };
    let (Some(level), Some(row)) = (nearest(&sound.depth_m, record.fleet_depth_m), middle(sound))
    else {
        return;
    };
    let section = format!(
        "Top: slice at {} m. Below: section from west to east at {} km north; dashed: depth of the fleet, {} m",
        ticks::number(sound.depth_m[level], 0),
        ticks::number(sound.north_m[row] / M_PER_KM, 1),
        ticks::number(record.fleet_depth_m, 0),
    );
    canvas.text([LEFT, section_top - 4.5], &section, Align::Start, REMARK);
    let profile =
        "Mean over the region; shaded: from the slowest to the fastest point of each depth";
    canvas.text([LEFT, profile_top - 4.5], profile, Align::Start, REMARK);
}

fn draw_slice(
    canvas: &mut Canvas,
    map: &Map,
    sound: &SoundSpeedRecord,
    depth_m: f64,
    scale: Scale,
) {
    let values: Vec<f64> = slice(sound, depth_m).collect();
    let columns = sound.east_m.len();
    let value = |column, row| values.get(row * columns + column).copied().unwrap_or(f64::NAN);
    let [x, y] = [&sound.east_m, &sound.north_m].map(|points| kilometre_edges(points));
    map.axes.cells(canvas, [&x, &y], value, scale);
    map.bathymetry(canvas, Stroke::new(WHITE, 0.35));
}

fn draw_section(
    canvas: &mut Canvas,
    axes: Axes,
    record: &RunRecord,
    sound: &SoundSpeedRecord,
    scale: Scale,
) {
    let Some(row) = middle(sound) else { return };
    let columns = sound.east_m.len();
    let value = |column: usize, level: usize| {
        f64::from(sound.speed_m_s[(level * sound.north_m.len() + row) * columns + column])
    };
    let depth_edges: Vec<f64> = edges(&sound.depth_m).iter().map(|d| d.max(0.0)).collect();
    axes.cells(canvas, [&kilometre_edges(&sound.east_m), &depth_edges], value, scale);

    let grid = record.grid;
    let cell_row = ((sound.north_m[row] / grid.cell_height_m).max(0.0) as usize).min(grid.rows - 1);
    let bottom: Vec<[f64; 2]> = (0..grid.columns)
        .map(|column| {
            let east = (column as f64 + 0.5) * grid.cell_width_m / M_PER_KM;
            [east, f64::from(record.cell_depth_m[cell_row * grid.columns + column])]
        })
        .collect();
    // Half a cell is missing at both ends: the bottom runs on level.
    let level_end = |end: Option<&[f64; 2]>, x: f64| end.map(|&[_, depth]| [x, depth]);
    let bottom: Vec<[f64; 2]> = level_end(bottom.first(), axes.x[0])
        .into_iter()
        .chain(bottom.iter().copied())
        .chain(level_end(bottom.last(), axes.x[1]))
        .collect();
    for pair in bottom.windows(2).filter(|pair| pair.iter().all(|p| p[1].is_finite())) {
        let [from, to] =
            [pair[0], pair[1]].map(|[x, depth]| axes.at(x, depth.clamp(axes.y[1], axes.y[0])));
        let floor = axes.frame.bottom();
        canvas.polygon(vec![from, to, [to[0], floor], [from[0], floor]], SEABED);
        canvas.line(vec![from, to], Stroke::new(INK, 0.6));
    }
    fleet_depth(canvas, axes, record.fleet_depth_m, WHITE);
}

fn draw_profile(canvas: &mut Canvas, axes: Axes, sound: &SoundSpeedRecord, fleet_depth_m: f64) {
    let points = sound.north_m.len() * sound.east_m.len();
    if points == 0 {
        return;
    }
    let mut profile: Vec<[[f64; 2]; 3]> = Vec::new();
    for (level, &depth) in sound.depth_m.iter().enumerate() {
        let values: Vec<f64> = sound.speed_m_s[level * points..(level + 1) * points]
            .iter()
            .map(|&speed| f64::from(speed))
            .filter(|speed| speed.is_finite())
            .collect();
        let Some((low, high)) = ticks::range(values.iter().copied()) else { break };
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        profile.push([low, mean, high].map(|speed| axes.at(speed, depth)));
    }
    for pair in profile.windows(2) {
        let [above, here] = [pair[0], pair[1]];
        canvas.polygon(vec![above[0], above[2], here[2], here[0]], ENVELOPE);
    }
    let mean: Vec<_> = profile.iter().map(|[_, mean, _]| *mean).collect();
    canvas.clipped_line(&mean, axes.frame, Stroke::new(INK, 1.0));
    fleet_depth(canvas, axes, fleet_depth_m, MUTED);
}

fn fleet_depth(canvas: &mut Canvas, axes: Axes, depth_m: f64, colour: Rgb) {
    let line = [axes.at(axes.x[0], depth_m), axes.at(axes.x[1], depth_m)];
    canvas.dashed_line(&line, axes.frame, Stroke::new(colour, 0.8), FLEET_DASH);
}

/// Sound speeds at the level nearest to a depth, [north, east].
fn slice(sound: &SoundSpeedRecord, depth_m: f64) -> impl Iterator<Item = f64> {
    let points = sound.north_m.len() * sound.east_m.len();
    let level = nearest(&sound.depth_m, depth_m);
    let values = level.map_or(&[][..], |level| &sound.speed_m_s[level * points..][..points]);
    values.iter().map(|&speed| f64::from(speed))
}

fn nearest(depths: &[f64], depth_m: f64) -> Option<usize> {
    let distance = |&level: &usize| (depths[level] - depth_m).abs();
    (0..depths.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

fn middle(sound: &SoundSpeedRecord) -> Option<usize> {
    let drawable = !sound.north_m.is_empty() && !sound.east_m.is_empty();
    drawable.then_some(sound.north_m.len() / 2)
}

/// Depth of the deepest level that has a value, metres.
fn deepest_m(sound: &SoundSpeedRecord) -> f64 {
    let points = sound.north_m.len() * sound.east_m.len();
    let wet = |level: &usize| {
        sound.speed_m_s[level * points..(level + 1) * points].iter().any(|c| c.is_finite())
    };
    (0..sound.depth_m.len()).rev().find(wet).map_or(0.0, |level| sound.depth_m[level])
}

fn kilometre_edges(points: &[f64]) -> Vec<f64> {
    edges(points).iter().map(|edge| edge / M_PER_KM).collect()
}
