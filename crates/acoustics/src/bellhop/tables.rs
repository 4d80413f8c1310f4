use super::lines::Lines;
use crate::environment::{Interface, ProfileLaw, ReflectionTable, SoundSpeedField};
use crate::error::AcousticsError;
use std::path::Path;

const KM: f64 = 1000.0;

/// Reads a `.bty` file: the sea floor, straight between its nodes.
pub(crate) fn read_bathymetry(path: &Path) -> Result<Interface, AcousticsError> {
    let mut lines = Lines::open(path)?;
    let (kind, _) = lines.text("the type of the sea floor in quotes")?;
    if !kind.starts_with('L') {
        return Err(lines.unsupported("sea floor of type", &kind));
    }
    let count = lines.count("the number of bathymetry nodes")?;
    let (mut range_m, mut depth_m) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let mut node = [f64::NAN; 2];
        let expected = "a range in km and a depth in m";
        lines.record(expected, &mut node)?;
        if node.iter().any(|value| value.is_nan()) {
            return Err(lines.syntax(expected));
        }
        range_m.push(node[0] * KM);
        depth_m.push(node[1]);
    }
    Interface::new(range_m, depth_m)
}

/// Reads a `.ssp` file: sound speeds over range at the levels of the `.env` file.
pub(crate) fn read_sound_speed(
    path: &Path,
    depth_m: Vec<f64>,
) -> Result<SoundSpeedField, AcousticsError> {
    let mut lines = Lines::open(path)?;
    let columns = lines.count("the number of profiles")?;
    let mut range_m = vec![f64::NAN; columns];
    let expected = "the ranges of the profiles in km";
    if lines.values(expected, &mut range_m)? < columns {
        return Err(lines.syntax(expected));
    }
    for range in &mut range_m {
        *range *= KM;
    }
    let mut speed_m_s = vec![0.0; columns * depth_m.len()];
    let mut row = vec![f64::NAN; columns];
    for level in 0..depth_m.len() {
        let expected = "the sound speeds of a level";
        if lines.values(expected, &mut row)? < columns {
            return Err(lines.syntax(expected));
        }
        for (column, speed) in row.iter().enumerate() {
            speed_m_s[column * depth_m.len() + level] = *speed;
        }
    }
    SoundSpeedField::new(range_m, depth_m, speed_m_s, ProfileLaw::LinearSpeed)
}

/// Reads a `.brc` or `.trc` file: reflection coefficients over grazing angle.
pub(crate) fn read_reflection(path: &Path) -> Result<ReflectionTable, AcousticsError> {
    let mut lines = Lines::open(path)?;
    let count = lines.count("the number of reflection coefficients")?;
    let (mut angle, mut modulus, mut phase) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..count {
        let mut entry = [f64::NAN; 3];
        let expected = "a grazing angle, a modulus and a phase in degrees";
        lines.record(expected, &mut entry)?;
        if entry.iter().any(|value| value.is_nan()) {
            return Err(lines.syntax(expected));
        }
        angle.push(entry[0]);
        modulus.push(entry[1]);
        phase.push(entry[2]);
    }
    ReflectionTable::new(angle, modulus, &phase)
}
