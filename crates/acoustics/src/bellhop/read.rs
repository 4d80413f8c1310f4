use super::case_files::CaseFiles;
use super::companions::{
    read_beam_pattern, read_interface, read_reflection, read_sound_speed, require,
};
use super::options::{AttenuationUnit, Options, RunType};
use super::records::Records;
use crate::environment::{
    AttenuationProfile, Boundary, ElasticHalfSpace, FluidHalfSpace, Interface, ProfileLaw, Section,
    SoundSpeedField,
};
use crate::error::{AcousticsError, within};
use crate::field::{LaunchFan, ReceiverLayout, Receivers, TraceSettings};
use crate::model::{Case, Run};
use crate::seawater::Absorption;
use std::path::Path;

const KM: f64 = 1000.0;

/// More receivers than this, counted for every source, are taken for a damaged file.
const MOST_RECEIVERS: usize = 50_000_000;

/// Boxes are not smaller than this, nor longer than twice around the Earth.
const LEAST_BOX_M: f64 = 1.0;
const MOST_BOX_M: f64 = 1e8;

/// Levels are not further from the surface than this.
const MOST_DEPTH_M: f64 = 1e6;

/// Checks that a sound speed is one of water, generously: what is far from it makes
/// profiles too steep to follow.
pub(crate) fn check_speed(records: &Records, speed_m_s: f64) -> Result<(), AcousticsError> {
    let watery = (100.0..=10_000.0).contains(&speed_m_s);
    records.blame(within("a sound speed in water in m/s", "from 100 to 10 000", speed_m_s, watery))
}

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

fn note(notes: &mut Vec<String>, records: &Records, what: &str) {
    let (path, line) = records.place();
    notes.push(format!("{}, line {line}: {what}", path.display()));
}

fn sort(values: &mut [f64], notes: &mut Vec<String>, records: &Records) {
    if !values.is_sorted() {
        values.sort_by(f64::total_cmp);
        note(notes, records, "the values are sorted");
    }
}

/// Depth, speeds of compressional and shear waves, density and attenuations, before a
/// file says anything. What a slash leaves out carries over from the line before: from
/// the half-space above to the levels of the water, and to the half-space below.
const MEDIUM: [f64; 6] = [0.0, 1500.0, 0.0, 1.0, 0.0, 0.0];

/// The part of an `.env` file that describes the environment.
struct Water {
    section: Section,
    /// Where the water begins and ends as the `.env` file has it.
    top_m: f64,
    depth_m: f64,
    /// Depth of the last sound-speed level.
    deepest_level_m: f64,
    /// Whether a single beam is asked for.
    single_beam: bool,
}

impl Water {
    fn read(
        files: &CaseFiles,
        env: &mut Records,
        frequency_hz: f64,
        notes: &mut Vec<String>,
    ) -> Result<Self, AcousticsError> {
        let options = Options::new(env.text("the options of the water column in quotes")?.0);
        let unit = AttenuationUnit::new(env, options.letter(2), frequency_hz)?;
        let single_beam = options.letter(5) == 'I';
        if !single_beam {
            options.none_from(5, env, "the sixth option of the water column")?;
        }
        options.none_from(6, env, "the seventh option of the water column")?;
        let altimetry = match options.letter(4) {
            '~' | '*' => Some(read_interface(files, "ati", env, unit)?),
            ' ' | '_' => None,
            other => return Err(env.unsupported("altimetry (~, * or blank)", other)),
        };
        let profile_option = options.letter(0);
        if !"CNPSQ".contains(profile_option) {
            return Err(env.unsupported(
                "the interpolation of sound speed (one of C, N, P, S, Q)",
                profile_option,
            ));
        }
        if profile_option == 'Q' {
            require(files, "ssp", env)?;
        }
        let mut medium = MEDIUM;
        let surface =
            SurfaceOrBottom::read(files, env, options.letter(1), (unit, "trc"), &mut medium)?;
        let absorption = read_absorption(env, options.letter(3))?;

        let expected = "the number of mesh points, the roughness and the depth of the water";
        let [_, roughness_m, depth_m] = env.all(expected)?;
        if roughness_m != 0.0 {
            note(notes, env, "the roughness is left out");
        }
        let levels = Levels::read(env, depth_m, unit, &mut medium, notes)?;
        let top_m = levels.depth_m[0];
        let attenuation = levels.attenuation(env)?;
        let deepest_level_m = levels.depth_m[levels.depth_m.len() - 1];
        let (top_density, bottom_density) = levels.densities();
        let sound_speed = levels.field(files, env, profile_option)?;

        let (letters, rest) = env.text("the options of the bottom in quotes")?;
        let options = Options::new(letters);
        options.none_from(2, env, "the third option of the bottom")?;
        let roughness = rest.split_whitespace().next().unwrap_or("0");
        if roughness.trim_end_matches('/').parse().is_ok_and(|value: f64| value != 0.0) {
            note(notes, env, "the roughness of the bottom is left out");
        }
        let (bathymetry, beyond) = match options.letter(1) {
            '~' | '*' => read_interface(files, "bty", env, unit)?,
            ' ' | '_' => (env.blame(Interface::flat(depth_m))?, None),
            other => return Err(env.unsupported("bathymetry (~, * or blank)", other)),
        };
        let bottom =
            SurfaceOrBottom::read(files, env, options.letter(0), (unit, "brc"), &mut medium)?;
        let bottom = bottom.over(env, unit, bottom_density)?;
        let mut section = env.blame(Section::new(sound_speed, bathymetry, bottom))?;
        if let (Some(beyond), Boundary::Fluid(_) | Boundary::Elastic(_)) = (beyond, &section.bottom)
        {
            section.bottom = beyond;
        }
        section.surface = surface.over(env, unit, top_density)?;
        section.absorption = absorption;
        section.attenuation = attenuation;
        if let Some((altimetry, beyond)) = altimetry {
            section.altimetry = Some(altimetry);
            if let (Some(beyond), Boundary::Fluid(_) | Boundary::Elastic(_)) =
                (beyond, &section.surface)
            {
                section.surface = beyond;
            }
        }
        env.blame(section.check())?;
        Ok(Self { section, top_m, depth_m, deepest_level_m, single_beam })
    }
}

/// What lies beyond the water, whose density at the boundary may not be known yet.
enum SurfaceOrBottom {
    Known(Boundary),
    /// Speeds of compressional and shear waves, density, attenuations.
    HalfSpace([f64; 5]),
}

impl SurfaceOrBottom {
    fn read(
        files: &CaseFiles,
        env: &mut Records,
        letter: char,
        (unit, table): (AttenuationUnit, &str),
        medium: &mut [f64; 6],
    ) -> Result<Self, AcousticsError> {
        Ok(match letter {
            'V' => Self::Known(Boundary::Vacuum),
            'R' => Self::Known(Boundary::Rigid),
            'F' => Self::Known(Boundary::Table(read_reflection(files, table, env)?)),
            'A' => {
                env.values("the properties of a half-space", medium)?;
                let [_, properties @ ..] = *medium;
                half_space(env, properties, unit, 1.0)?;
                Self::HalfSpace(properties)
            }
            other => {
                return Err(env.unsupported("the boundary (one of V, R, A, F)", other));
            }
        })
    }

    fn over(
        self,
        env: &Records,
        unit: AttenuationUnit,
        water_density: f64,
    ) -> Result<Boundary, AcousticsError> {
        match self {
            Self::Known(boundary) => Ok(boundary),
            Self::HalfSpace(values) => half_space(env, values, unit, water_density),
        }
    }
}

/// A half-space of its speeds of compressional and shear waves, its density, and the
/// attenuations of both.
pub(crate) fn half_space(
    records: &Records,
    [speed, shear, density, attenuation, shear_attenuation]: [f64; 5],
    unit: AttenuationUnit,
    water_density: f64,
) -> Result<Boundary, AcousticsError> {
    let attenuation = unit.db_wavelength(attenuation, speed);
    let fluid = records.blame(FluidHalfSpace::new(speed, density / water_density, attenuation))?;
    if shear == 0.0 {
        return Ok(Boundary::Fluid(fluid));
    }
    let attenuation = unit.db_wavelength(shear_attenuation, shear);
    records.blame(ElasticHalfSpace::new(fluid, shear, attenuation)).map(Boundary::Elastic)
}

fn read_absorption(env: &mut Records, letter: char) -> Result<Absorption, AcousticsError> {
    match letter {
        ' ' | '_' => Ok(Absorption::None),
        'T' => Ok(Absorption::Thorp),
        'F' => {
            let [temperature_c, salinity_psu, ph, depth_m] =
                env.all("temperature in °C, salinity, pH and depth in m")?;
            Ok(Absorption::FrancoisGarrison { temperature_c, salinity_psu, ph, depth_m })
        }
        'B' => Err(env.unsupported("biological volume attenuation", 'B')),
        other => Err(env.unsupported("the volume attenuation (T, F or blank)", other)),
    }
}

/// Levels of the sound-speed profile, down to the depth of the water.
struct Levels {
    depth_m: Vec<f64>,
    speed_m_s: Vec<f64>,
    density: Vec<f64>,
    db_wavelength: Vec<f64>,
}

impl Levels {
    fn read(
        env: &mut Records,
        water_depth_m: f64,
        unit: AttenuationUnit,
        medium: &mut [f64; 6],
        notes: &mut Vec<String>,
    ) -> Result<Self, AcousticsError> {
        /// The last level may be written with other digits than the depth.
        const SAME_DEPTH_M: f64 = 1e-3;
        let expected = "a depth and a sound speed";
        let [mut depth_m, mut speed_m_s, mut density, mut db_wavelength] =
            [const { Vec::new() }; 4];
        loop {
            medium[0] = f64::NAN;
            let found = env.values(expected, medium)?;
            let [depth, speed, shear, rho, attenuation, _] = *medium;
            if depth.is_nan() {
                return Err(env.syntax(expected));
            }
            if depth_m.last().is_some_and(|above| depth <= *above) {
                return Err(env.syntax("a depth below that of the level before"));
            }
            if shear != 0.0 && depth_m.is_empty() {
                note(notes, env, "the shear speed of the water is left out");
            }
            if attenuation != 0.0 && depth_m.is_empty() && found < 5 {
                note(notes, env, "the attenuation of the half-space above holds for the water too");
            }
            check_speed(env, speed)?;
            let on_earth = depth.abs() <= MOST_DEPTH_M;
            env.blame(within("a depth in m", "from -1e6 to 1e6", depth, on_earth))?;
            env.blame(within("a density of water", "positive", rho, rho > 0.0))?;
            depth_m.push(depth);
            speed_m_s.push(speed);
            density.push(rho);
            db_wavelength.push(unit.db_wavelength(attenuation, speed));
            if depth >= water_depth_m - SAME_DEPTH_M {
                return Ok(Self { depth_m, speed_m_s, density, db_wavelength });
            }
        }
    }

    fn attenuation(&self, env: &Records) -> Result<Option<AttenuationProfile>, AcousticsError> {
        if self.db_wavelength.iter().all(|&value| value == 0.0) {
            return Ok(None);
        }
        let profile = AttenuationProfile::new(self.depth_m.clone(), self.db_wavelength.clone());
        env.blame(profile).map(Some)
    }

    /// Densities at the first and the last level.
    fn densities(&self) -> (f64, f64) {
        (self.density[0], self.density[self.density.len() - 1])
    }

    fn field(
        self,
        files: &CaseFiles,
        env: &Records,
        option: char,
    ) -> Result<SoundSpeedField, AcousticsError> {
        let law = match option {
            'N' => ProfileLaw::LinearSquaredIndex,
            'S' => ProfileLaw::CubicSpline,
            'P' => ProfileLaw::MonotoneCubic,
            'Q' => return read_sound_speed(files, env, self.depth_m),
            _ => ProfileLaw::LinearSpeed,
        };
        env.blame(SoundSpeedField::new(vec![0.0], self.depth_m, self.speed_m_s, law))
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
