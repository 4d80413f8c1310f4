//! The part of `.env` files that describes the environment.

use super::case_files::CaseFiles;
use super::companions::{read_interface, read_reflection, read_sound_speed, require};
use super::media::{check_speed, half_space};
use super::options::{AttenuationUnit, Options};
use super::records::Records;
use crate::environment::{
    AttenuationProfile, Boundary, Interface, ProfileLaw, Section, SoundSpeedField,
};
use crate::error::{AcousticsError, within};
use crate::seawater::Absorption;

/// Levels are not further from the surface than this.
const MOST_DEPTH_M: f64 = 1e6;

/// Depth, speeds of compressional and shear waves, density and attenuations, before a
/// file says anything. What a slash leaves out carries over from the line before: from
/// the half-space above to the levels of the water, and to the half-space below.
const MEDIUM: [f64; 6] = [0.0, 1500.0, 0.0, 1.0, 0.0, 0.0];

/// The part of an `.env` file that describes the environment.
pub(crate) struct Water {
    pub(crate) section: Section,
    /// Where the water begins and ends as the `.env` file has it.
    pub(crate) top_m: f64,
    pub(crate) depth_m: f64,
    /// Depth of the last sound-speed level.
    pub(crate) deepest_level_m: f64,
    /// Whether a single beam is asked for.
    pub(crate) single_beam: bool,
}

impl Water {
    pub(crate) fn read(
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
            notes.push(env.note("the roughness is left out"));
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
            notes.push(env.note("the roughness of the bottom is left out"));
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
                notes.push(env.note("the shear speed of the water is left out"));
            }
            if attenuation != 0.0 && depth_m.is_empty() && found < 5 {
                notes.push(
                    env.note("the attenuation of the half-space above holds for the water too"),
                );
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
