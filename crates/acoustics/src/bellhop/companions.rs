//! The files that `.env` files refer to.

use super::case_files::CaseFiles;
use super::media::{check_speed, half_space};
use super::options::AttenuationUnit;
use super::records::Records;
use crate::environment::{
    Boundary, Interface, InterfaceShape, ProfileLaw, ReflectionTable, SoundSpeedField,
};
use crate::error::AcousticsError;
use crate::field::BeamPattern;

const KM: f64 = 1000.0;

/// The file of an ending, which a line of the `.env` file refers to.
pub(crate) fn require<'a>(
    files: &'a CaseFiles,
    ending: &str,
    env: &Records,
) -> Result<Records<'a>, AcousticsError> {
    let needed = files.path(ending);
    if let Some(text) = files.text(ending) {
        return Ok(Records::new(&needed, text));
    }
    let (path, line) = env.place();
    Err(AcousticsError::MissingCompanion { path: path.to_owned(), line, needed })
}

/// Reads a `.bty` or `.ati` file, and from one in the long format what lies beyond the
/// interface.
pub(crate) fn read_interface(
    files: &CaseFiles,
    ending: &str,
    env: &Records,
    unit: AttenuationUnit,
) -> Result<(Interface, Option<Boundary>), AcousticsError> {
    let mut records = require(files, ending, env)?;
    let (letters, _) = records.text("the type of the interface in quotes")?;
    let mut letters = letters.chars();
    let shape = match letters.next() {
        Some('L') => InterfaceShape::Straight,
        Some('C') => InterfaceShape::Curvilinear,
        _ => return Err(records.syntax("the type of the interface in quotes, L or C")),
    };
    let long = match letters.next().unwrap_or(' ') {
        ' ' | 'S' => false,
        'L' => true,
        other => return Err(records.unsupported("the format of an interface (S or L)", other)),
    };
    let count = records.count("the number of nodes")?;
    let (mut range_m, mut depth_m) = (Vec::new(), Vec::new());
    let mut beyond: Option<[f64; 5]> = None;
    for _ in 0..count {
        let [range_km, depth] = if long {
            let expected =
                "a range in km, a depth in m, two speeds, a density and two attenuations";
            let [range_km, depth, found @ ..] = records.all::<7>(expected)?;
            if beyond.is_some_and(|beyond| beyond.map(f64::to_bits) != found.map(f64::to_bits)) {
                return Err(records.unsupported("a bottom that changes with range:", "long format"));
            }
            beyond = Some(found);
            [range_km, depth]
        } else {
            records.all("a range in km and a depth in m")?
        };
        range_m.push(range_km * KM);
        depth_m.push(depth);
    }
    let interface = records.blame(Interface::new(range_m, depth_m))?;
    let beyond = beyond.map(|values| half_space(&records, values, unit, 1.0)).transpose()?;
    Ok((interface.with_shape(shape), beyond))
}

/// Reads a `.ssp` file: sound speeds over range at the levels of the `.env` file.
pub(crate) fn read_sound_speed(
    files: &CaseFiles,
    env: &Records,
    depth_m: Vec<f64>,
) -> Result<SoundSpeedField, AcousticsError> {
    let mut records = require(files, "ssp", env)?;
    let columns = records.count("the number of profiles")?;
    let row = |records: &mut Records, expected| {
        let mut row = vec![f64::NAN; columns];
        records.values(expected, &mut row)?;
        if row.iter().any(|value| value.is_nan()) { Err(records.syntax(expected)) } else { Ok(row) }
    };
    let range_m =
        row(&mut records, "a range in km for every profile")?.iter().map(|km| km * KM).collect();
    let mut rows = Vec::new();
    for _ in &depth_m {
        let speeds = row(&mut records, "a sound speed of every profile, in a row for every level")?;
        speeds.iter().try_for_each(|&speed| check_speed(&records, speed))?;
        rows.push(speeds);
    }
    let speed_m_s =
        (0..columns).flat_map(|column| rows.iter().map(move |row| row[column])).collect();
    let field = SoundSpeedField::new(range_m, depth_m, speed_m_s, ProfileLaw::LinearSpeed);
    records.blame(field)
}

/// Reads a `.brc` or `.trc` file: reflection coefficients over grazing angle.
pub(crate) fn read_reflection(
    files: &CaseFiles,
    ending: &str,
    env: &Records,
) -> Result<ReflectionTable, AcousticsError> {
    let mut records = require(files, ending, env)?;
    let count = records.count("the number of reflection coefficients")?;
    let (mut angle, mut modulus, mut phase) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..count {
        let entry: [f64; 3] = records.all("a grazing angle, a modulus and a phase in degrees")?;
        angle.push(entry[0]);
        modulus.push(entry[1]);
        phase.push(entry[2]);
    }
    records.blame(ReflectionTable::new(angle, modulus, &phase))
}

/// Reads a `.sbp` file: levels of the source over angle.
pub(crate) fn read_beam_pattern(
    files: &CaseFiles,
    env: &Records,
) -> Result<BeamPattern, AcousticsError> {
    let mut records = require(files, "sbp", env)?;
    let count = records.count("the number of angles of the beam pattern")?;
    let (mut angle, mut level) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let [angle_deg, level_db] = records.all("an angle in degrees and a level in dB")?;
        angle.push(angle_deg);
        level.push(level_db);
    }
    records.blame(BeamPattern::new(angle, level))
}
