use super::lines::Lines;
use super::tables::{read_bathymetry, read_reflection, read_sound_speed};
use crate::environment::{
    Boundary, FluidHalfSpace, Interface, ProfileLaw, Section, SoundSpeedField,
};
use crate::error::AcousticsError;
use crate::field::{
    BeamCoordinates, BeamKind, BeamShape, Coherence, LaunchFan, Receivers, SourceGeometry,
    TraceSettings,
};
use crate::model::{Case, Run};
use crate::seawater::Absorption;
use std::path::Path;

const KM: f64 = 1000.0;

/// Reads `CASE.env`, and `CASE.ssp`, `.bty`, `.brc` and `.trc` where it refers to
/// them. Understood are one medium; profiles C, N and Q; flat surfaces and
/// straight-piecewise sea floors; boundaries V, R, A (fluid) and F; volume
/// attenuation T and F; run types C, S, I and R with Cartesian hat and Gaussian
/// beams.
///
/// # Errors
/// If a file cannot be read, a line does not hold what belongs there or asks for
/// something else, or the environment makes no sense.
pub fn read_case(path: &Path) -> Result<Case, AcousticsError> {
    let mut lines = Lines::open(path)?;
    let (title, _) = lines.text("a title in quotes")?;
    let frequency_hz = lines.number("a frequency in Hz")?;
    let media = lines.count("the number of media")?;
    if media != 1 {
        return Err(lines.unsupported("number of media", &media));
    }

    let (options, _) = lines.text("the options of the water column in quotes")?;
    let option = |index: usize| options.chars().nth(index).unwrap_or(' ');
    let unit = AttenuationUnit { letter: option(2), frequency_hz };
    if !"NFMWQL".contains(unit.letter) {
        return Err(lines.unsupported("unit of attenuation", &unit.letter));
    }
    if !matches!(option(4), ' ' | '_') {
        return Err(lines.unsupported("altimetry", &option(4)));
    }
    let surface = read_boundary(&mut lines, option(1), unit, &path.with_extension("trc"))?;
    let absorption = read_absorption(&mut lines, option(3))?;

    let mut mesh = [0.0, 0.0, f64::NAN];
    lines.record("mesh points, roughness and depth of the water", &mut mesh)?;
    let (depth_m, speed_m_s) = read_profile(&mut lines, mesh[2])?;
    let sound_speed = match option(0) {
        'C' => SoundSpeedField::profile(depth_m, speed_m_s)?,
        'N' => SoundSpeedField::new(vec![0.0], depth_m, speed_m_s, ProfileLaw::LinearSquaredIndex)?,
        'Q' => read_sound_speed(&path.with_extension("ssp"), depth_m)?,
        other => return Err(lines.unsupported("sound-speed interpolation", &other)),
    };

    let (bottom_options, _) = lines.text("the options of the bottom in quotes")?;
    let bottom_option = |index: usize| bottom_options.chars().nth(index).unwrap_or(' ');
    let bathymetry = match bottom_option(1) {
        '~' | '*' => read_bathymetry(&path.with_extension("bty"))?,
        _ => Interface::flat(mesh[2])?,
    };
    let bottom = read_boundary(&mut lines, bottom_option(0), unit, &path.with_extension("brc"))?;
    let mut section = Section::new(sound_speed, bathymetry, bottom)?;
    section.surface = surface;
    section.absorption = absorption;

    let source_depth_m = lines.vector("the number of source depths", "source depths in m")?;
    let receiver_depth_m = lines.vector("the number of receiver depths", "receiver depths in m")?;
    let mut range_m = lines.vector("the number of receiver ranges", "receiver ranges in km")?;
    for range in &mut range_m {
        *range *= KM;
    }
    let (run_options, _) = lines.text("the run type in quotes")?;
    let (run, beams) = run_type(&lines, &run_options)?;
    let beam_count = lines.count("the number of beams")?;
    let mut angles = [f64::NAN; 2];
    lines.record("the launch angles of the first and last beam", &mut angles)?;
    let fan = LaunchFan::uniform(angles[0], angles[1], beam_count)?;
    let mut limits = [f64::NAN; 3];
    lines.record("a step in m, a depth in m and a range in km", &mut limits)?;
    if limits.iter().any(|limit| limit.is_nan()) || limits[2] <= 0.0 {
        return Err(lines.syntax("a step in m, a depth in m and a range in km"));
    }
    Ok(Case {
        title,
        frequency_hz,
        section,
        source_depth_m,
        geometry: SourceGeometry::Point,
        beam_pattern: None,
        receivers: Receivers::new(range_m, receiver_depth_m)?,
        fan,
        beams,
        run,
        settings: TraceSettings::to_range(limits[2] * KM),
    })
}

#[derive(Clone, Copy)]
struct AttenuationUnit {
    letter: char,
    frequency_hz: f64,
}

impl AttenuationUnit {
    /// An attenuation of this unit in dB per wavelength.
    fn db_wavelength(self, value: f64, speed_m_s: f64) -> f64 {
        const DB_PER_NEPER: f64 = 8.685_889_638_065_037;
        let wavelength_m = speed_m_s / self.frequency_hz;
        match self.letter {
            'N' => value * DB_PER_NEPER * wavelength_m,
            'F' => value * self.frequency_hz / KM * wavelength_m,
            'M' => value * wavelength_m,
            'Q' if value > 0.0 => std::f64::consts::PI * DB_PER_NEPER / value,
            'L' => std::f64::consts::TAU * DB_PER_NEPER * value,
            _ => value,
        }
    }
}

fn read_boundary(
    lines: &mut Lines,
    letter: char,
    unit: AttenuationUnit,
    table: &Path,
) -> Result<Boundary, AcousticsError> {
    match letter {
        'V' => Ok(Boundary::Vacuum),
        'R' => Ok(Boundary::Rigid),
        'F' => read_reflection(table).map(Boundary::Table),
        'A' => {
            // Depth, compressional and shear speed, density, attenuations.
            let mut half_space = [0.0, 1500.0, 0.0, 1.0, 0.0, 0.0];
            lines.record("the properties of a half-space", &mut half_space)?;
            let [_, speed, shear, density, attenuation, _] = half_space;
            if shear != 0.0 {
                return Err(lines.unsupported("half-space with a shear speed of", &shear));
            }
            let attenuation = unit.db_wavelength(attenuation, speed);
            FluidHalfSpace::new(speed, density, attenuation).map(Boundary::Fluid)
        }
        other => Err(lines.unsupported("boundary condition", &other)),
    }
}

fn read_absorption(lines: &mut Lines, letter: char) -> Result<Absorption, AcousticsError> {
    match letter {
        ' ' => Ok(Absorption::None),
        'T' => Ok(Absorption::Thorp),
        'F' => {
            let mut water = [f64::NAN; 4];
            let expected = "temperature, salinity, pH and depth";
            lines.record(expected, &mut water)?;
            if water.iter().any(|value| value.is_nan()) {
                return Err(lines.syntax(expected));
            }
            let [temperature_c, salinity_psu, ph, depth_m] = water;
            Ok(Absorption::FrancoisGarrison { temperature_c, salinity_psu, ph, depth_m })
        }
        other => Err(lines.unsupported("volume attenuation", &other)),
    }
}

/// Depths and speeds down to the depth of the water. Further columns of a level
/// (shear, density, attenuation) carry over from the level before.
fn read_profile(
    lines: &mut Lines,
    water_depth_m: f64,
) -> Result<(Vec<f64>, Vec<f64>), AcousticsError> {
    let (mut depth_m, mut speed_m_s) = (Vec::new(), Vec::new());
    let mut level = [f64::NAN, 1500.0, 0.0, 1.0, 0.0, 0.0];
    loop {
        level[0] = f64::NAN;
        lines.record("a depth and a sound speed", &mut level)?;
        let [depth, speed, shear, _, attenuation, _] = level;
        if depth.is_nan() {
            return Err(lines.syntax("a depth and a sound speed"));
        }
        if shear != 0.0 {
            return Err(lines.unsupported("water with a shear speed of", &shear));
        }
        if attenuation != 0.0 {
            return Err(lines.unsupported("water with an attenuation of", &attenuation));
        }
        depth_m.push(depth);
        speed_m_s.push(speed);
        // The last level may be written with other digits than the depth.
        if depth >= water_depth_m - 1e-3 {
            return Ok((depth_m, speed_m_s));
        }
    }
}

fn run_type(lines: &Lines, options: &str) -> Result<(Run, BeamKind), AcousticsError> {
    let option = |index: usize| options.chars().nth(index).unwrap_or(' ');
    let shape = match option(1) {
        'G' | '^' | ' ' => BeamShape::Hat,
        'B' => BeamShape::Gaussian,
        other => return Err(lines.unsupported("beam type", &other)),
    };
    if !matches!(option(3), ' ' | 'R') {
        return Err(lines.unsupported("source type", &option(3)));
    }
    if !matches!(option(4), ' ' | 'R') {
        return Err(lines.unsupported("receiver grid", &option(4)));
    }
    let run = match option(0) {
        'C' => Run::Field(Coherence::Coherent),
        'S' => Run::Field(Coherence::SemiCoherent),
        'I' => Run::Field(Coherence::Incoherent),
        'R' => Run::Rays,
        other => return Err(lines.unsupported("run type", &other)),
    };
    Ok((run, BeamKind { shape, coordinates: BeamCoordinates::Cartesian }))
}
