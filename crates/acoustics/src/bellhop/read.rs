use super::case_files::CaseFiles;
use super::companions::read_beam_pattern;
use super::options::RunType;
use super::records::Records;
use super::water::Water;
use crate::error::{AcousticsError, within};
use crate::field::{LaunchFan, ReceiverLayout, Receivers, Source, TraceSettings};
use crate::model::{Case, Run};
use std::path::Path;

const KM: f64 = 1000.0;

/// More receivers than this, counted for every source, are taken for a damaged file.
const MOST_RECEIVERS: usize = 50_000_000;

/// Boxes are not smaller than this, nor longer than twice around the Earth.
const LEAST_BOX_M: f64 = 1.0;
const MOST_BOX_M: f64 = 1e8;

/// In a box that ends where the water does, rays end when they come to the bottom: the
/// box is made this much less deep, metres.
const ENDS_AT_FLOOR_M: f64 = 1e-3;

/// What the files of a case say.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The case.
    pub case: Case,
    /// Whether arrivals are wanted in a binary file.
    pub binary_arrivals: bool,
    /// What of the files is not taken by the word, as programs of the BELLHOP family do
    /// not either: with file and line.
    pub notes: Vec<String>,
}

/// Reads the case of `CASE.env`, or of `CASE`: [`CaseFiles::load`], then
/// [`CaseFiles::read`].
///
/// # Errors
/// As of these two.
pub fn read_case(path: &Path) -> Result<Case, AcousticsError> {
    Ok(CaseFiles::load(path)?.read()?.case)
}

pub(crate) fn read_texts(files: &CaseFiles) -> Result<Reading, AcousticsError> {
    let path = files.path("env");
    let text = files.text("env").ok_or_else(|| AcousticsError::Unreadable {
        path: path.clone(),
        reason: "there is no text".to_owned(),
    })?;
    let mut env = Records::new(&path, text);
    let mut notes = Vec::new();

    let (title, _) = env.text("a title in quotes")?;
    let [frequency_hz] = env.all("a frequency in Hz")?;
    env.blame(within("a frequency", "positive", frequency_hz, frequency_hz > 0.0))?;
    let media = env.count("the number of media")?;
    if media != 1 {
        return Err(env.unsupported("a number of media other than 1:", media));
    }
    let water = Water::read(files, &mut env, frequency_hz, &mut notes)?;

    let source_depth_m = env.vector("the number of source depths", "source depths in m")?;
    for &depth_m in &source_depth_m {
        env.blame(Source { depth_m, frequency_hz }.check(&water.section))?;
    }
    let mut receiver_depth_m =
        env.vector("the number of receiver depths", "receiver depths in m")?;
    let (top_m, depth_m) = (water.top_m, water.depth_m);
    if receiver_depth_m.iter().any(|depth| !(top_m..=depth_m).contains(depth)) {
        note(&mut notes, &env, "receivers outside of the water are moved to its rim");
        for depth in &mut receiver_depth_m {
            *depth = depth.clamp(top_m, depth_m);
        }
    }
    sort(&mut receiver_depth_m, &mut notes, &env);
    let mut range_m = env.vector("the number of receiver ranges", "receiver ranges in km")?;
    sort(&mut range_m, &mut notes, &env);
    for range in &mut range_m {
        *range *= KM;
    }
    let place = env.place().1;

    let run_type = RunType::read(&mut env)?;
    let beam_pattern =
        run_type.has_beam_pattern.then(|| read_beam_pattern(files, &env)).transpose()?;
    let longest_m = range_m.iter().copied().fold(0.0, f64::max);
    let receivers = match run_type.layout {
        ReceiverLayout::Grid => Receivers::new(range_m, receiver_depth_m),
        ReceiverLayout::Pairs => Receivers::pairs(range_m, receiver_depth_m),
    };
    let receivers = receivers.map_err(|problem| AcousticsError::InFile {
        path: path.clone(),
        line: place,
        problem: Box::new(problem),
    })?;
    if receivers.count().saturating_mul(source_depth_m.len()) > MOST_RECEIVERS {
        return Err(env.unsupported("more than 50 million receivers:", receivers.count()));
    }

    let automatic = automatic_beams(run_type.run, frequency_hz, longest_m, depth_m);
    let fan = read_fan(&mut env, water.single_beam, automatic)?;
    let [_, deepest_m, far_km]: [f64; 3] =
        env.all("a step in m, a depth in m and a range in km")?;
    let far_m = far_km * KM;
    let on_earth = (LEAST_BOX_M..=MOST_BOX_M).contains(&far_m);
    env.blame(within("the range of the box in m", "from 1 to 1e8", far_m, on_earth))?;
    let below = deepest_m > top_m;
    env.blame(within("the depth of the box", "below the surface", deepest_m, below))?;
    let mut settings = TraceSettings::fine(far_m);
    if deepest_m <= water.deepest_level_m {
        settings.deepest_m = deepest_m;
    }
    let floor_m = water.section.bathymetry().deepest_m();
    if (floor_m - ENDS_AT_FLOOR_M..=floor_m).contains(&deepest_m) {
        note(&mut notes, &env, "the box ends at the bottom, and so do rays");
        settings.deepest_m = floor_m - ENDS_AT_FLOOR_M;
    }
    let adds_up = !matches!(run_type.run, Run::Rays | Run::Eigenrays);
    if adds_up && fan.beams().len() == 1 && fan.beams()[0].width_rad <= 0.0 {
        return Err(env.unsupported("a field of beams in number", 1));
    }
    let case = Case {
        title,
        frequency_hz,
        section: water.section,
        source_depth_m,
        geometry: run_type.geometry,
        beam_pattern,
        receivers,
        fan,
        beams: run_type.beams,
        run: run_type.run,
        settings,
    };
    Ok(Reading { case, binary_arrivals: run_type.binary, notes })
}

pub(crate) fn note(notes: &mut Vec<String>, records: &Records, what: &str) {
    let (path, line) = records.place();
    notes.push(format!("{}, line {line}: {what}", path.display()));
}

fn sort(values: &mut [f64], notes: &mut Vec<String>, records: &Records) {
    if !values.is_sorted() {
        values.sort_by(f64::total_cmp);
        note(notes, records, "the values are sorted");
    }
}

/// How many beams a zero asks for, as measured on a program of the BELLHOP family.
fn automatic_beams(run: Run, frequency_hz: f64, longest_m: f64, depth_m: f64) -> usize {
    const LEAST: f64 = 300.0;
    const MOST: f64 = 1e6;
    if run == Run::Rays {
        return 50;
    }
    let wavelengths = longest_m * frequency_hz / 1500.0;
    // Neighbours a tenth of the depth apart where they are furthest.
    let angle_rad = (depth_m / (10.0 * longest_m)).atan();
    let beams = (0.3 * wavelengths).max(std::f64::consts::PI / angle_rad);
    // Whole numbers may have lost their last digit.
    (beams.clamp(LEAST, MOST) + 1e-6) as usize
}

fn read_fan(
    env: &mut Records,
    single_beam: bool,
    automatic: usize,
) -> Result<LaunchFan, AcousticsError> {
    let expected = "the number of beams, and that of a single one";
    let mut counts = [f64::NAN, 1.0];
    env.values(expected, if single_beam { &mut counts } else { &mut counts[..1] })?;
    let count = match env.checked_count(expected, counts[0])? {
        0 => automatic,
        count => count,
    };
    let single = env.checked_count(expected, counts[1])?;
    let expected = "launch angles in degrees: two and a slash, or one for every beam";
    let angles = env.values_or_steps(count, expected)?;
    let fan = env.blame(LaunchFan::at(&angles))?;
    if !single_beam || single == 0 {
        return Ok(fan);
    }
    fan.only(single - 1).ok_or_else(|| env.unsupported("a single beam of number", single))
}
