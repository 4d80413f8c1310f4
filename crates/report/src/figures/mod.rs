//! The figures of a run, each as SVG and PNG.

mod chart;
mod comparison;
mod layouts;
mod map;
mod placement;
mod priors;
mod routes;
mod scores;
mod sound_speed;
mod training;

use crate::canvas::{self, Align, Canvas};
use crate::error::written;
use crate::error::{ReportError, Result};
use crate::plot::REMARK;
use crate::{ticks, valid};
use sonarfleet::placement::comparison::Comparison;
use sonarfleet::record::{
    ChartRecord, EpochRecord, LayoutsRecord, RunRecord, ScoresRecord, TrainingRecord,
};
use std::path::{Path, PathBuf};

/// Width of a figure over two columns of a journal, in points (184 mm).
const WIDTH: f64 = 522.0;
/// Epochs on one figure; further epochs continue on further figures.
const EPOCHS_PER_FIGURE: usize = 4;

/// Draws the figures of a run into a directory, which is made if it is missing,
/// and returns the files written, an SVG and a PNG (288 dots per inch) for each:
///
/// - `sound_speed`: fields of sound speed, as Fig. 2 of the paper;
/// - `placement_epoch_K`, one per epoch: transmission loss, prior, and cumulative
///   detection of a random and of the target layout, as Fig. 3;
/// - `priors`: the target priors of the epochs, as Fig. 9;
/// - `routes`: layouts and paths over the current, as Fig. 10.
///
/// Figures of all epochs hold four of them; further epochs continue on
/// `sound_speed_2` and so on. Files are whole or not there.
///
/// # Errors
///
/// A record whose arrays do not fit its grids, and files that cannot be written.
pub fn write_figures(record: &RunRecord, directory: impl AsRef<Path>) -> Result<Vec<PathBuf>> {
    let directory = directory.as_ref();
    valid::check(record)?;
    std::fs::create_dir_all(directory)
        .map_err(|source| ReportError::Write { path: directory.to_owned(), source })?;

    let mut files = Vec::new();
    for (page, epochs) in record.epochs.chunks(EPOCHS_PER_FIGURE).enumerate() {
        let suffix = if page == 0 { String::new() } else { format!("_{}", page + 1) };
        let mut save = |name: &str, canvas: &Canvas| {
            write(canvas, &directory.join(format!("{name}{suffix}")), &mut files)
        };
        save("sound_speed", &sound_speed::draw(record, epochs))?;
        save("priors", &priors::draw(record, epochs))?;
        save("routes", &routes::draw(record, epochs))?;
    }
    for epoch in &record.epochs {
        let name = directory.join(format!("placement_epoch_{}", epoch.epoch));
        write(&placement::draw(record, epoch), &name, &mut files)?;
    }
    Ok(files)
}

/// Draws the curve of a training as `STEM.svg` and `STEM.png`, whose folder is made if
/// it is missing, and returns both: reward and `J_d`, λ₂ and its multiplier, entropy
/// and divergence, against episodes; one thin line per seed, and the median bold.
///
/// # Errors
///
/// Files that cannot be written.
pub fn write_training(record: &TrainingRecord, stem: impl AsRef<Path>) -> Result<Vec<PathBuf>> {
    write_alone(&training::draw(record), stem.as_ref())
}

/// Draws what placement methods achieved as `STEM.svg` and `STEM.png`, whose folder is
/// made if it is missing, and returns both: a panel per problem with `J_d` of every
/// trial, filled where it is feasible, each method's median, the best layout found and
/// the upper bound. The note stands at the foot.
///
/// # Errors
///
/// Files that cannot be written.
pub fn write_comparison(
    comparisons: &[Comparison],
    note: &str,
    stem: impl AsRef<Path>,
) -> Result<Vec<PathBuf>> {
    write_alone(&comparison::draw(comparisons, note), stem.as_ref())
}

/// Draws layouts of one problem side by side as `STEM.svg` and `STEM.png`, and returns
/// both: the prior, and what every layout detects, as Fig. 3 of the paper.
///
/// # Errors
///
/// A record whose arrays do not fit its grid, and files that cannot be written.
pub fn write_layouts(record: &LayoutsRecord, stem: impl AsRef<Path>) -> Result<Vec<PathBuf>> {
    valid::check_layouts(record)?;
    write_alone(&layouts::draw(record), stem.as_ref())
}

/// Draws lines in panels side by side as `STEM.svg` and `STEM.png`, and returns both:
/// one thin line per run, and the median bold, as Figs. 4 to 6 of the paper.
///
/// # Errors
///
/// Files that cannot be written.
pub fn write_chart(record: &ChartRecord, stem: impl AsRef<Path>) -> Result<Vec<PathBuf>> {
    write_alone(&chart::draw(record), stem.as_ref())
}

/// Draws what methods reach as `STEM.svg` and `STEM.png`, and returns both: R, `J_d`
/// and λ₂ of every run and their medians, as Fig. 7 of the paper.
///
/// # Errors
///
/// Files that cannot be written.
pub fn write_scores(record: &ScoresRecord, stem: impl AsRef<Path>) -> Result<Vec<PathBuf>> {
    write_alone(&scores::draw(record), stem.as_ref())
}

/// Writes a single figure into a folder that is made if it is missing.
fn write_alone(canvas: &Canvas, stem: &Path) -> Result<Vec<PathBuf>> {
    if let Some(folder) = stem.parent() {
        std::fs::create_dir_all(folder)
            .map_err(|source| ReportError::Write { path: folder.to_owned(), source })?;
    }
    let mut files = Vec::new();
    write(canvas, stem, &mut files)?;
    Ok(files)
}

fn write(canvas: &Canvas, name: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    let failed = |path: &Path| {
        let path = path.to_owned();
        move |reason| ReportError::Draw { path, reason }
    };
    // Names may hold points of their own, as in `tau-0.95`.
    let with = |extension: &str| {
        let mut path = name.as_os_str().to_owned();
        path.push(extension);
        PathBuf::from(path)
    };
    let svg = with(".svg");
    written(&svg, canvas::to_svg(canvas).map_err(failed(&svg))?.as_bytes())?;
    let png = with(".png");
    written(&png, &canvas::to_png(canvas).map_err(failed(&png))?)?;
    files.extend([svg, png]);
    Ok(())
}

/// One line at the foot: where and of what this is.
fn footer(canvas: &mut Canvas, record: &RunRecord, y: f64) {
    let [west, east, south, north] = region_deg(record);
    let degrees = |value| ticks::number(value, 2);
    let text = format!(
        "{} · {}–{}° E, {}–{}° N · {} · sonarfleet {} · seed {}",
        record.name,
        degrees(west),
        degrees(east),
        degrees(south),
        degrees(north),
        record.ocean_source,
        record.version,
        record.seed
    );
    canvas.text([WIDTH - 6.0, y], &shortened(&text, 165), Align::End, REMARK);
}

/// West, east, south and north edge of the region in degrees: half a cell beyond
/// the outermost centres.
pub(crate) fn region_deg(record: &RunRecord) -> [f64; 4] {
    let edges = |values: &[f64], count: usize| {
        let (low, high) = ticks::range(values.iter().copied()).unwrap_or((f64::NAN, f64::NAN));
        let half = (high - low) / (2 * count.saturating_sub(1).max(1)) as f64;
        [low - half, high + half]
    };
    let [west, east] = edges(&record.cell_longitude_deg, record.grid.columns);
    let [south, north] = edges(&record.cell_latitude_deg, record.grid.rows);
    [west, east, south, north]
}

fn shortened(text: &str, limit: usize) -> String {
    if text.chars().count() <= limit {
        return text.to_owned();
    }
    text.chars().take(limit - 1).chain(['…']).collect()
}

/// "Epoch 1 · 2025-10-09 06:00 UTC", from an ISO 8601 time.
fn epoch_title(epoch: &EpochRecord) -> String {
    format!("Epoch {} · {}", epoch.epoch, readable_time(&epoch.time))
}

/// An ISO 8601 time in UTC without its seconds; other texts as they are.
pub(crate) fn readable_time(time: &str) -> String {
    let (date, clock) = time.split_once('T').unwrap_or((time, ""));
    let minutes = clock.split(':').take(2).collect::<Vec<_>>();
    match minutes[..] {
        [hour, minute] if hour.len() == 2 && minute.len() >= 2 && minute.is_char_boundary(2) => {
            format!("{date} {hour}:{} UTC", &minute[..2])
        }
        _ => shortened(time, 32),
    }
}

/// "(a)", "(b)", …
fn letter(index: usize) -> String {
    format!("({})", char::from(b'a' + (index % 26) as u8))
}
